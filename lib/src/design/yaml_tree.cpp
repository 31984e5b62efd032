#include "design/yaml_tree.hpp"

#include "glissade/core/odd_characters.hpp"
#include "glissade/core/words.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <sstream>
#include <utility>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

namespace glissade::design_file {
namespace {

/// Length of the UTF-8 sequence that starts at `offset`; 0 if it is malformed, overlong or a surrogate.
std::size_t utf8_length(std::string_view text, std::size_t offset) {
  const auto byte = [&](std::size_t index) -> unsigned {
    return offset + index < text.size() ? static_cast<unsigned char>(text[offset + index]) : 0U;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80U) return 1;
  const std::size_t length = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (lead < 0xC2U || lead > 0xF4U) return 0;
  for (std::size_t index = 1; index < length; ++index) {
    if ((byte(index) & 0xC0U) != 0x80U) return 0;
  }
  const unsigned second = byte(1);
  const bool overlong = (lead == 0xE0U && second < 0xA0U) || (lead == 0xF0U && second < 0x90U);
  const bool surrogate = lead == 0xEDU && second > 0x9FU;
  const bool beyond = lead == 0xF4U && second > 0x8FU;
  return overlong || surrogate || beyond ? 0 : length;
}

bool is_forbidden_control(char letter) {
  const auto code = static_cast<unsigned char>(letter);
  return (code < 0x20U && letter != '\n' && letter != '\r' && letter != '\t') || code == 0x7FU;
}

/// Finds lines, and turns the parser's byte columns into columns of characters.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {
    for (std::size_t offset = 0; offset < text.size(); ++offset) {
      if (text[offset] == '\n') starts_.push_back(offset + 1);
      if (is_continuation(text[offset])) continuations_.push_back(offset);
    }
  }

  [[nodiscard]] Position at_offset(std::size_t offset) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
    const auto line = static_cast<std::size_t>(after - starts_.begin());
    return {static_cast<int>(line), characters(starts_[line - 1], offset) + 1};
  }

  [[nodiscard]] Position at_mark(const YAML::Mark& mark) const { return at_offset(offset_of(mark)); }

  [[nodiscard]] std::size_t offset_of(const YAML::Mark& mark) const {
    if (mark.line < 0 || mark.column < 0) return 0;
    const std::size_t line = std::min(static_cast<std::size_t>(mark.line), starts_.size() - 1);
    return std::min(starts_[line] + static_cast<std::size_t>(mark.column), text_.size());
  }

  /// @param position  one that at_offset() gave
  [[nodiscard]] std::size_t offset_of(Position position) const {
    std::size_t offset = starts_[static_cast<std::size_t>(position.line) - 1];
    for (int column = 1; column < position.column && offset < text_.size(); ++offset) {
      if (offset + 1 == text_.size() || !is_continuation(text_[offset + 1])) ++column;
    }
    return offset;
  }

  [[nodiscard]] std::string_view text() const { return text_; }

 private:
  static bool is_continuation(char letter) { return (static_cast<unsigned char>(letter) & 0xC0U) == 0x80U; }

  [[nodiscard]] std::size_t continuations_before(std::size_t offset) const {
    const auto bound = std::lower_bound(continuations_.begin(), continuations_.end(), offset);
    return static_cast<std::size_t>(bound - continuations_.begin());
  }

  [[nodiscard]] int characters(std::size_t from, std::size_t to) const {
    return static_cast<int>((to - from) - (continuations_before(to) - continuations_before(from)));
  }

  std::string_view text_;
  std::vector<std::size_t> starts_{0};
  std::vector<std::size_t> continuations_;  // offsets of the bytes that continue a character
};

Issue nested_too_deep() {
  return {"", "nested deeper than " + std::to_string(kMaxDepth) + " levels", "No design needs that.", ""};
}

Issue not_closed(bool map, std::string why) {
  return {"", std::string("not valid YAML: this ") + (map ? "{" : "[") + " is not closed", std::move(why),
          map ? "a closing }" : "a closing ]"};
}

/// Builds the tree from the parser's events, and stops it before it recurses or grows beyond the limits.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const Lines& lines) : lines_(lines) {}

  [[nodiscard]] Node take() { return std::move(root_); }
  [[nodiscard]] bool has_content() const { return root_.kind != Node::Kind::null; }
  /// @return where the innermost list or map that is still open began; none if all are closed
  [[nodiscard]] std::optional<Position> open_since() const {
    if (open_.empty()) return {};
    return open_.back()->at;
  }

  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_anchor(mark, anchor);
    // The mark of a value that is not there is that of whatever comes next.
    Node node{Node::Kind::null, {}, lines_.at_mark(mark), {}, {}};
    if (expects_value()) node.at = open_.back()->entries.back().key_at;
    add(std::move(node));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    throw SyntaxProblem(lines_.at_mark(mark), no_anchors());
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    refuse_open_quote(mark, tag);
    refuse_control(mark, value);
    add({Node::Kind::scalar, value, lines_.at_mark(mark), {}, {}});
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(mark, tag, anchor, Node::Kind::sequence);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(mark, tag, anchor, Node::Kind::map);
  }
  void OnMapEnd() override { close(); }

  void OnAnchor(const YAML::Mark& mark, const std::string& /*name*/) override { refuse_anchor(mark, 1); }

 private:
  static Issue no_anchors() {
    return {"", "anchors and aliases (& and *) are not used in design files",
            "Every value stands where it is used.", "the value itself in their place"};
  }

  void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) const {
    if (anchor != YAML::NullAnchor) throw SyntaxProblem(lines_.at_mark(mark), no_anchors());
  }

  void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (tag.empty() || tag == "?" || tag == "!") return;
    throw SyntaxProblem(lines_.at_mark(mark),
                        {"", "the YAML tag " + shown(tag) + " is not used in design files", "",
                         "the value without it, or in quotes if it starts with !"});
  }

  /// What the text of a file may not have is not to come in by its escape codes either: a terminal would obey it.
  void refuse_control(const YAML::Mark& mark, const std::string& value) const {
    // Of a line that ends with a carriage return alone others tell.
    const bool has_returns = lines_.text().find('\r') != std::string_view::npos;
    const auto control = control_character(value, has_returns ? "\n\t\r" : "\n\t");
    if (!control) return;
    throw SyntaxProblem(lines_.at_mark(mark),
                        {"", "there is " + control->name + " in " + shown(with_controls_shown(value)),
                         "A terminal would obey it wherever the text is printed.", "the text without it"});
  }

  /// The parser takes a bracket that is not closed in the last line for the beginning of a key.
  [[nodiscard]] Issue not_a_key(const Node& node) const {
    const bool map = node.kind == Node::Kind::map;
    const std::string_view rest = lines_.text().substr(lines_.offset_of(node.at));
    const bool is_open =
        rest.starts_with(map ? '{' : '[') && rest.find(map ? '}' : ']') == std::string_view::npos;
    if (is_open) return not_closed(map, "It is still open at the end of the text.");
    return {"", "a key is missing, or is not a plain word", "Every entry is \"key: value\".",
            "brackets, commas and colons near here"};
  }

  /// The parser takes a quoted text that the end of the file cuts off.
  void refuse_open_quote(const YAML::Mark& mark, const std::string& tag) const {
    const std::size_t start = lines_.offset_of(mark);
    const std::string_view rest = lines_.text().substr(start);
    if (tag != "!" || rest.empty() || (rest[0] != '"' && rest[0] != '\'')) return;
    for (std::size_t index = 1; index < rest.size(); ++index) {
      if (rest[0] == '"' && rest[index] == '\\') {
        ++index;
      } else if (rest[index] == rest[0]) {
        return;
      }
    }
    throw SyntaxProblem(lines_.at_mark(mark),
                        {"", std::string("not valid YAML: this ") + rest[0] + " is not closed", "", ""});
  }

  void refuse_excess(Position at) {
    if (++nodes_ <= kMaxNodes) return;
    throw SyntaxProblem(at, {"", "more than " + std::to_string(kMaxNodes) + " values",
                             "A design file holds a design, not measured data.",
                             "kind: points with a CSV file for a measured profile"});
  }

  [[nodiscard]] bool expects_value() const {
    return !open_.empty() && open_.back()->kind == Node::Kind::map && has_key_.back();
  }

  /// @return the node at its place in the tree; null for the key of a map
  Node* add(Node node) {
    refuse_excess(node.at);
    if (open_.empty()) {
      root_ = std::move(node);
      return &root_;
    }
    Node& parent = *open_.back();
    if (parent.kind == Node::Kind::sequence) return &parent.items.emplace_back(std::move(node));
    if (has_key_.back()) {
      has_key_.back() = false;
      Entry& entry = parent.entries.back();
      entry.value = std::move(node);
      return &entry.value;
    }
    if (node.kind != Node::Kind::scalar) throw SyntaxProblem(node.at, not_a_key(node));
    has_key_.back() = true;
    parent.entries.push_back({std::move(node.scalar), node.at, {}});
    return nullptr;
  }

  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, Node::Kind kind) {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    const Position at = lines_.at_mark(mark);
    if (open_.size() >= static_cast<std::size_t>(kMaxDepth)) {
      throw SyntaxProblem(at, nested_too_deep());
    }
    open_.push_back(add({kind, {}, at, {}, {}}));
    has_key_.push_back(false);
  }

  void close() {
    open_.pop_back();
    has_key_.pop_back();
  }

  const Lines& lines_;
  Node root_;
  std::vector<Node*> open_;  // parents of the next node; a parent's address is stable while it is open
  std::vector<bool> has_key_;
  int nodes_ = 0;
};

/// What to try with a file that is no text in UTF-8 where that begins to show.
std::string hint_for_encoding(std::string_view text, std::size_t offset) {
  const std::string_view start = text.substr(0, 2);
  const bool utf_16 = start == "\xff\xfe" || start == "\xfe\xff" || (offset < 2 && text[offset] == '\0');
  if (utf_16) return "to save it in UTF-8: it seems to be in UTF-16";
  const auto is_letter = [](char c) { return static_cast<unsigned char>(c) >= 0xa0; };
  const bool after_text = offset > 0 && is_letter(text[offset]);
  if (after_text) return "to save it in UTF-8, if it is a design: a letter in another encoding stands here";
  return "the name of a design file (.yaml)";
}

void refuse_what_is_not_text(std::string_view text, const Lines& lines) {
  for (std::size_t offset = 0; offset < text.size();) {
    const std::size_t length = utf8_length(text, offset);
    if (length == 0 || is_forbidden_control(text[offset])) {
      throw SyntaxProblem(
          lines.at_offset(offset),
          {"", "not a text file: byte " + std::to_string(offset) + " belongs to no UTF-8 text",
           "A design file is YAML in UTF-8.", hint_for_encoding(text, offset)});
    }
    offset += length;
  }
}

std::string hint_for(const std::string& message) {
  if (message == YAML::ErrorMsg::TAB_IN_INDENTATION) return "blanks instead of the tab";
  return R"(indentation, closing brackets and quotes near here; quotes around a text with ": " or " #")";
}

/// The first line up to `last` that is indented with a tab: the parser stumbles over it, but does not always
/// say so, nor there.
std::optional<Position> indented_with_tab(const Lines& lines, int last) {
  const std::string_view text = lines.text();
  int line = 1;
  for (std::size_t from = 0; from < text.size() && line <= last; ++line) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const std::size_t content = std::min(text.find_first_not_of(" \t\r", from), end);
    const std::size_t tab = text.substr(0, content).find('\t', from);
    const bool blank = content == end || text[content] == '#';
    if (tab != std::string_view::npos && !blank) return lines.at_offset(tab);
    from = end + 1;
  }
  return {};
}

/// The first carriage return in the lines up to `last` that ends a line alone: the parser reads on in the same line.
std::optional<Position> ended_by_return_alone(const Lines& lines, int last) {
  const std::string_view text = lines.text();
  for (std::size_t at = text.find('\r'); at != std::string_view::npos; at = text.find('\r', at + 1)) {
    const std::size_t next = text.find_first_not_of('\r', at);
    if (next == std::string_view::npos || lines.at_offset(at).line > last) break;
    if (text[next] != '\n') return lines.at_offset(at);
    at = next;
  }
  return {};
}

SyntaxProblem explained(const YAML::Exception& problem, const Lines& lines, const TreeBuilder& builder) {
  const Position at = lines.at_mark(problem.mark);
  const bool is_open =
      problem.msg == YAML::ErrorMsg::END_OF_MAP_FLOW || problem.msg == YAML::ErrorMsg::END_OF_SEQ_FLOW;
  const std::optional<Position> since = builder.open_since();
  if (const auto tab = is_open ? std::nullopt : indented_with_tab(lines, at.line)) {
    return {*tab,
            {"", "not valid YAML: a tab indents this line", "YAML indents with blanks alone.",
             hint_for(YAML::ErrorMsg::TAB_IN_INDENTATION)}};
  }
  if (const auto end = ended_by_return_alone(lines, at.line)) {
    return {*end,
            {"", "the line ends with a carriage return (CR) alone",
             "Lines end with a line feed (LF), or with both; what follows reads as the same line.",
             "to save the file with line ends LF or CRLF"}};
  }
  if (!is_open || !since) return {at, {"", "not valid YAML: " + problem.msg, "", hint_for(problem.msg)}};
  const bool map = problem.msg == YAML::ErrorMsg::END_OF_MAP_FLOW;
  const bool at_end = std::pair(at.line, at.column) <= std::pair(since->line, since->column);
  const std::string place = "line " + std::to_string(at.line) + ", column " + std::to_string(at.column);
  return {*since, not_closed(map, at_end ? "It is still open at the end of the text."
                                         : "What first does not fit into it stands in " + place + ".")};
}

/// The parser takes minutes over a million open brackets before it reports the depth. Brackets in texts and
/// comments count too: a design has no thousand of them either.
void refuse_hopeless_nesting(std::string_view text, const Lines& lines) {
  constexpr int kMostOpen = 1000;
  int open = 0;
  for (std::size_t offset = 0; offset < text.size(); ++offset) {
    const char letter = text[offset];
    if (letter == '[' || letter == '{') ++open;
    if (letter == ']' || letter == '}') --open;
    if (open > kMostOpen) throw SyntaxProblem(lines.at_offset(offset), nested_too_deep());
  }
}

void parse_document(std::string_view text, const Lines& lines, TreeBuilder& builder) {
  std::istringstream stream{std::string(text)};
  YAML::Parser parser(stream);
  if (!parser.HandleNextDocument(builder)) return;
  TreeBuilder rest(lines);
  if (!parser.HandleNextDocument(rest)) return;
  throw SyntaxProblem(
      rest.has_content() ? rest.take().at : Position{1, 1},
      {"", "something follows the end of the design", "A design file holds one YAML document.",
       "one design per file, all top-level keys at the same indentation"});
}

}  // namespace

Node parse_tree(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const Lines lines(text);
  refuse_what_is_not_text(text, lines);
  refuse_hopeless_nesting(text, lines);
  TreeBuilder builder(lines);
  try {
    parse_document(text, lines, builder);
  } catch (const YAML::Exception& problem) {
    throw explained(problem, lines, builder);
  }
  return builder.take();
}

}  // namespace glissade::design_file
