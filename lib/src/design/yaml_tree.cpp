#include "design/yaml_tree.hpp"

#include "design/words.hpp"

#include <algorithm>
#include <cstddef>
#include <sstream>

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
    }
  }

  [[nodiscard]] Position at_offset(std::size_t offset) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
    const auto line = static_cast<std::size_t>(after - starts_.begin());
    return {static_cast<int>(line), characters(starts_[line - 1], offset) + 1};
  }

  [[nodiscard]] Position at_mark(const YAML::Mark& mark) const {
    if (mark.line < 0 || mark.column < 0) return {1, 1};
    const std::size_t line = std::min(static_cast<std::size_t>(mark.line), starts_.size() - 1);
    const std::size_t start = starts_[line];
    const std::size_t end = line + 1 < starts_.size() ? starts_[line + 1] : text_.size();
    const std::size_t offset = std::min(start + static_cast<std::size_t>(mark.column), end);
    return {static_cast<int>(line) + 1, characters(start, offset) + 1};
  }

 private:
  [[nodiscard]] int characters(std::size_t from, std::size_t to) const {
    const auto is_first_byte = [](char letter) {
      return (static_cast<unsigned char>(letter) & 0xC0U) != 0x80U;
    };
    const std::string_view part = text_.substr(from, to - from);
    return static_cast<int>(std::count_if(part.begin(), part.end(), is_first_byte));
  }

  std::string_view text_;
  std::vector<std::size_t> starts_{0};
};

/// Builds the tree from the parser's events, and stops it before it recurses or grows beyond the limits.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const Lines& lines) : lines_(lines) {}

  [[nodiscard]] Node take() { return std::move(root_); }
  [[nodiscard]] bool has_content() const { return root_.kind != Node::Kind::null; }

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
    if (node.kind != Node::Kind::scalar) {
      throw SyntaxProblem(node.at,
                          {"", "a key is missing, or is not a plain word", "Every entry is \"key: value\".",
                           "brackets, commas and colons near here"});
    }
    has_key_.back() = true;
    parent.entries.push_back({std::move(node.scalar), node.at, {}});
    return nullptr;
  }

  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, Node::Kind kind) {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    const Position at = lines_.at_mark(mark);
    if (open_.size() >= static_cast<std::size_t>(kMaxDepth)) {
      throw SyntaxProblem(at, {"", "nested deeper than " + std::to_string(kMaxDepth) + " levels",
                               "No design needs that.", ""});
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

void refuse_what_is_not_text(std::string_view text, const Lines& lines) {
  for (std::size_t offset = 0; offset < text.size();) {
    const std::size_t length = utf8_length(text, offset);
    if (length == 0 || is_forbidden_control(text[offset])) {
      throw SyntaxProblem(
          lines.at_offset(offset),
          {"", "not a text file: byte " + std::to_string(offset) + " belongs to no UTF-8 text",
           "A design file is YAML in UTF-8.", "the name of a design file (.yaml)"});
    }
    offset += length;
  }
}

std::string hint_for(const std::string& message) {
  if (message == YAML::ErrorMsg::TAB_IN_INDENTATION) return "spaces instead of tabs";
  return "indentation, closing brackets and quotes near here; quotes around a text with \": \" or \" #\"";
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
  TreeBuilder builder(lines);
  try {
    parse_document(text, lines, builder);
  } catch (const YAML::Exception& problem) {
    throw SyntaxProblem(lines.at_mark(problem.mark),
                        {"", "not valid YAML: " + problem.msg, "", hint_for(problem.msg)});
  }
  return builder.take();
}

}  // namespace glissade::design_file
