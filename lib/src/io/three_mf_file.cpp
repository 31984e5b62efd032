#include "glissade/io/three_mf_file.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/version.hpp"
#include "glissade/io/atomic_file.hpp"

#include "core/millimetres.hpp"
#include "drawing/glyphs.hpp"
#include "io/byte_source.hpp"
#include "io/coordinates.hpp"
#include "io/zip_archive.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace glissade {

using namespace io;

namespace {

constexpr std::string_view kModelName = "3D/3dmodel.model";
constexpr std::string_view kTypes =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
    " <Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
    " <Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
    "</Types>\n";
constexpr std::string_view kRelations =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
    " <Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n"
    "</Relationships>\n";

// --- writing

template <typename Number>
void append(std::string& text, Number value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

/// @return text for an attribute: marks of XML escaped, control characters as spaces, broken UTF-8 as "?"
std::string xml_text(const std::string& text) {
  std::string safe;
  for (std::size_t i = 0; i < text.size();) {
    const char32_t character = drawing::characters_of(std::string_view(text).substr(i)).front();
    const std::size_t size = character < 0x80 ? 1 : character < 0x800 ? 2 : character < 0x10000 ? 3 : 4;
    if (character == 0xFFFD) {
      safe += '?';
      ++i;
      continue;
    }
    switch (character) {
      case U'&':
        safe += "&amp;";
        break;
      case U'<':
        safe += "&lt;";
        break;
      case U'>':
        safe += "&gt;";
        break;
      case U'"':
        safe += "&quot;";
        break;
      default:
        safe += character < 0x20 || character == 0x7F ? std::string(" ") : text.substr(i, size);
    }
    i += size;
  }
  return safe;
}

/// @return coordinates as a reader gets them [mm]
std::vector<FloatPosition> positions_of(const TriangleMesh& mesh, const std::stop_token& stop) {
  const bool rounded = is_single_precision(mesh, LengthUnit::millimetre, stop);
  const std::vector<Vec3> vertices =
      rounded ? mesh.vertices : single_precision(mesh, LengthUnit::millimetre, stop);
  std::vector<FloatPosition> positions;
  positions.reserve(vertices.size());
  for (const Vec3 vertex : vertices) positions.push_back(nearest(core::kMillimetres * vertex));
  return positions;
}

void append_object(std::string& text, const PrintPiece& piece, std::size_t id, const std::stop_token& stop) {
  text += "  <object id=\"";
  append(text, id);
  text += "\" type=\"model\" name=\"" + xml_text(piece.name) + "\" partnumber=\"" + xml_text(piece.number) +
          "\">\n   <mesh>\n    <vertices>\n";
  for (const FloatPosition& place : positions_of(piece.mesh, stop)) {
    text += "     <vertex x=\"";
    append(text, place[0]);
    text += "\" y=\"";
    append(text, place[1]);
    text += "\" z=\"";
    append(text, place[2]);
    text += "\"/>\n";
  }
  text += "    </vertices>\n    <triangles>\n";
  for (const auto& triangle : piece.mesh.triangles) {
    text += "     <triangle v1=\"";
    append(text, triangle[0]);
    text += "\" v2=\"";
    append(text, triangle[1]);
    text += "\" v3=\"";
    append(text, triangle[2]);
    text += "\"/>\n";
  }
  text += "    </triangles>\n   </mesh>\n  </object>\n";
}

std::string model_text(const std::vector<PrintPiece>& pieces, const std::string& title,
                       const std::stop_token& stop) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n <metadata name=\"Title\">" +
      xml_text(title) + "</metadata>\n <metadata name=\"Application\">Glissade " + std::string(version()) +
      "</metadata>\n <resources>\n";
  for (std::size_t i = 0; i < pieces.size(); ++i) append_object(text, pieces[i], i + 1, stop);
  text += " </resources>\n <build>\n";
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    text += "  <item objectid=\"";
    append(text, i + 1);
    text += "\" partnumber=\"" + xml_text(pieces[i].number) + "\"/>\n";
  }
  return text + " </build>\n</model>\n";
}

// --- reading

/// An element with its attributes.
struct Element {
  std::string_view name;
  std::map<std::string_view, std::string_view> attributes;
  bool closes = false;  ///< "</name>"
};

/// The elements of an XML text one after the other; text between them is skipped.
class Elements {
 public:
  Elements(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  [[nodiscard]] FileError error(const std::string& what) const {
    return FileError({name_, "its model " + what, "", ""});
  }

  /// @return false at the end
  bool next(Element& element) {
    do {
      const std::size_t open = rest_.find('<');
      if (open == std::string_view::npos) return false;
      const std::size_t close = rest_.find('>', open);
      if (close == std::string_view::npos) throw error("ends within an element");
      inside_ = rest_.substr(open + 1, close - open - 1);
      rest_.remove_prefix(close + 1);
    } while (inside_.empty() || inside_.front() == '?' || inside_.front() == '!');
    element.attributes.clear();
    element.closes = inside_.front() == '/';
    if (element.closes) inside_.remove_prefix(1);
    const std::size_t end = inside_.find_first_of(" \t\r\n/");
    element.name = inside_.substr(0, end);
    inside_.remove_prefix(std::min(inside_.size(), element.name.size()));
    while (take_attribute(element)) continue;
    return true;
  }

 private:
  bool take_attribute(Element& element) {
    const std::size_t start = inside_.find_first_not_of(" \t\r\n/");
    if (start == std::string_view::npos) return false;
    inside_.remove_prefix(start);
    const std::size_t equals = inside_.find('=');
    if (equals == std::string_view::npos || equals + 1 >= inside_.size())
      throw error("has an attribute without value");
    const char quote = inside_[equals + 1];
    const std::size_t end = inside_.find(quote, equals + 2);
    if ((quote != '"' && quote != '\'') || end == std::string_view::npos)
      throw error("has an attribute without quotes");
    element.attributes[inside_.substr(0, equals)] = inside_.substr(equals + 2, end - equals - 2);
    inside_.remove_prefix(end + 1);
    return true;
  }

  std::string_view rest_;
  std::string_view inside_;
  const std::string& name_;
};

std::string plain_text(std::string_view xml) {
  static constexpr std::array<std::pair<std::string_view, char>, 5> kMarks = {
      {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};
  std::string text;
  while (!xml.empty()) {
    const auto* const mark = std::find_if(kMarks.begin(), kMarks.end(),
                                          [&](const auto& one) { return xml.starts_with(one.first); });
    text += mark == kMarks.end() ? xml.front() : mark->second;
    xml.remove_prefix(mark == kMarks.end() ? 1 : mark->first.size());
  }
  return text;
}

class ModelReader {
 public:
  ModelReader(std::string_view model, const std::string& name) : elements_(model, name) {}

  std::vector<PrintPiece> pieces() {
    Element element;
    bool whole = false;
    while (elements_.next(element)) {
      if (element.closes) {
        whole = element.name == "model";
        continue;
      }
      take(element);
    }
    if (!whole) throw elements_.error("is cut off");
    for (const PrintPiece& piece : pieces_) require_corners(piece.mesh);
    return std::move(pieces_);
  }

 private:
  void take(const Element& element) {
    if (element.name == "model" && text(element, "unit") != "millimeter" && !text(element, "unit").empty()) {
      throw elements_.error("is in the unit " + std::string(text(element, "unit")) + "; millimeter is read");
    }
    if (element.name == "components") throw elements_.error("has an object of components");
    if (element.name == "item" && element.attributes.contains("transform"))
      throw elements_.error("has an item with a transform");
    if (element.name == "object") {
      pieces_.push_back({plain_text(text(element, "name")), plain_text(text(element, "partnumber")), {}});
    }
    if (element.name != "vertex" && element.name != "triangle") return;
    if (pieces_.empty()) throw elements_.error("has a " + std::string(element.name) + " outside any object");
    TriangleMesh& mesh = pieces_.back().mesh;
    if (element.name == "vertex") {
      const auto metres = [&](std::string_view key) {
        return static_cast<double>(number<float>(element, key)) / core::kMillimetres;
      };
      mesh.vertices.push_back({metres("x"), metres("y"), metres("z")});
    } else {
      mesh.triangles.push_back({number<std::uint32_t>(element, "v1"), number<std::uint32_t>(element, "v2"),
                                number<std::uint32_t>(element, "v3")});
    }
  }

  void require_corners(const TriangleMesh& mesh) const {
    for (const auto& triangle : mesh.triangles) {
      if (*std::max_element(triangle.begin(), triangle.end()) >= mesh.vertices.size()) {
        throw elements_.error("has a triangle with a corner that does not exist");
      }
    }
  }

  static std::string_view text(const Element& element, std::string_view key) {
    const auto found = element.attributes.find(key);
    return found == element.attributes.end() ? std::string_view() : found->second;
  }

  template <typename Number>
  [[nodiscard]] Number number(const Element& element, std::string_view key) const {
    const std::string_view word = text(element, key);
    Number value{};
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (problem != std::errc{} || end != word.data() + word.size() ||
        !std::isfinite(static_cast<double>(value))) {
      throw elements_.error("has \"" + std::string(word.substr(0, 20)) + "\" for the " + std::string(key) +
                            " of a " + std::string(element.name));
    }
    return value;
  }

  Elements elements_;
  std::vector<PrintPiece> pieces_;
};

// --- beds

struct Extent {
  Vec3 low;
  Vec3 high;
};

Extent extent_of(const TriangleMesh& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Extent extent{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const Vec3& vertex : mesh.vertices) {
    extent.low = {std::min(extent.low.x, vertex.x), std::min(extent.low.y, vertex.y),
                  std::min(extent.low.z, vertex.z)};
    extent.high = {std::max(extent.high.x, vertex.x), std::max(extent.high.y, vertex.y),
                   std::max(extent.high.z, vertex.z)};
  }
  return extent;
}

std::string size_in_words(Vec3 size) {
  return length_text(size.x) + " x " + length_text(size.y) + " x " + length_text(size.z);
}

}  // namespace

std::string three_mf_bytes(const std::vector<PrintPiece>& pieces, const std::string& title,
                           const std::stop_token& stop) {
  if (pieces.empty()) throw InputError({"3MF", "there is no piece", "A file holds one or more.", ""});
  for (const PrintPiece& piece : pieces) {
    if (piece.mesh.triangles.empty()) throw InputError({"piece " + piece.number, "has no triangle", "", ""});
    require_writable(piece.mesh, stop);
  }
  return zip_bytes({{"[Content_Types].xml", std::string(kTypes)},
                    {"_rels/.rels", std::string(kRelations)},
                    {std::string(kModelName), model_text(pieces, title, stop)}});
}

void write_three_mf(const std::filesystem::path& file, const std::vector<PrintPiece>& pieces,
                    const std::string& title, const std::stop_token& stop) {
  const std::string bytes = three_mf_bytes(pieces, title, stop);
  write_atomically(file, bytes);
}

std::vector<PrintPiece> read_three_mf(const std::filesystem::path& file) {
  FileSource source(file);
  std::string bytes(source.size(), '\0');
  bytes.resize(source.read(bytes.data(), bytes.size()));
  for (const ZipEntry& entry : unzipped(bytes, file.string())) {
    if (entry.name == kModelName) return ModelReader(entry.content, file.string()).pieces();
  }
  throw FileError(
      {file.string(), "has no " + std::string(kModelName), "A 3MF file has its model there.", ""});
}

void require_same_three_mf(const std::filesystem::path& file, const std::vector<PrintPiece>& pieces) {
  const std::vector<PrintPiece> found = read_three_mf(file);
  const bool same = std::equal(
      found.begin(), found.end(), pieces.begin(), pieces.end(), [](const PrintPiece& a, const PrintPiece& b) {
        return xml_text(a.name) == xml_text(b.name) && xml_text(a.number) == xml_text(b.number) &&
               a.mesh.triangles == b.mesh.triangles && positions_of(a.mesh, {}) == positions_of(b.mesh, {});
      });
  if (!same) {
    throw InternalError(
        {file.filename().string(), "the file read back differs from what was written", "", ""});
  }
}

std::vector<PrintPiece> laid_on_beds(std::vector<PrintPiece> pieces, const PrintBed& bed) {
  std::vector<Extent> extents;
  std::vector<std::size_t> order;
  std::vector<Issue> issues;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    extents.push_back(extent_of(pieces[i].mesh));
    order.push_back(i);
    const Vec3 size = extents[i].high - extents[i].low;
    if (size.x + 2.0 * bed.gap > bed.x || size.y + 2.0 * bed.gap > bed.y || size.z > bed.z) {
      issues.push_back({"piece " + pieces[i].number, "is " + size_in_words(size) + " and fits no bed",
                        "The bed is " + size_in_words({bed.x, bed.y, bed.z}) + " with a gap of " +
                            length_text(bed.gap) + ".",
                        "shorter pieces, or a larger bed"});
    }
  }
  if (!issues.empty()) throw InputError(std::move(issues));
  const auto depth = [&](std::size_t i) { return extents[i].high.y - extents[i].low.y; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return depth(a) > depth(b); });
  constexpr double kBetweenBeds = 1.2;
  double left = bed.gap, row = bed.gap, next_row = bed.gap, bed_at = 0.0;
  for (const std::size_t i : order) {
    const Vec3 size = extents[i].high - extents[i].low;
    if (left + size.x + bed.gap > bed.x) {
      left = bed.gap;
      row = next_row;
    }
    if (row + size.y + bed.gap > bed.y) {
      bed_at += kBetweenBeds * bed.x;
      left = row = next_row = bed.gap;
    }
    const Vec3 shift = Vec3{bed_at + left, row, 0.0} - extents[i].low;
    for (Vec3& vertex : pieces[i].mesh.vertices) vertex = vertex + shift;
    left += size.x + bed.gap;
    next_row = std::max(next_row, row + size.y + bed.gap);
  }
  return pieces;
}

}  // namespace glissade
