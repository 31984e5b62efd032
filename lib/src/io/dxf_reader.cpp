#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/io/dxf_file.hpp"

#include "io/byte_source.hpp"
#include "io/utf8.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace glissade {

using namespace io;

namespace {

/// A drawing that a workshop gets has kilobytes; this is far above what it may ever be.
constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 28U;

/// A code and its value, from two lines.
struct Group {
  int code = 0;
  std::string_view value;
  std::size_t line = 0;  ///< of the value
};

class Groups {
 public:
  Groups(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {}

  [[nodiscard]] FileError error(std::size_t line, const std::string& what,
                                const std::string& why = "") const {
    return FileError({name_ + ":" + std::to_string(line), what, why, ""});
  }

  /// @throws FileError at the end of the file: EOF comes first in a whole one
  Group next() {
    Group group;
    const std::string_view code = trimmed(line());
    const auto [end, problem] = std::from_chars(code.data(), code.data() + code.size(), group.code);
    if (problem != std::errc{} || end != code.data() + code.size()) {
      throw error(line_, "has no group code", "A DXF file has a line with a number before each value.");
    }
    group.value = line();
    group.line = line_;
    return group;
  }

  [[nodiscard]] double number(const Group& group) const {
    const std::string_view text = trimmed(group.value);
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
      throw error(group.line, "is no number where group " + std::to_string(group.code) + " needs one");
    }
    return value;
  }

  static std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
  }

 private:
  std::string_view line() {
    if (rest_.empty()) throw error(line_, "the file ends before EOF", "It is cut off.");
    const std::size_t end = rest_.find('\n');
    std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    ++line_;
    return text;
  }

  std::string_view rest_;
  std::string name_;
  std::size_t line_ = 0;
};

/// What the groups of one entity say.
struct Entity {
  std::string kind;
  std::string layer = "0";
  std::string text;
  ArcPath path;                  ///< of a polyline
  std::map<int, double> values;  ///< of all others by group code
};

void take_vertex(Entity& entity, const Groups& groups, const Group& group) {
  auto& vertices = entity.path.vertices;
  if (group.code == 10) vertices.push_back({{groups.number(group), 0.0}, 0.0});
  if (vertices.empty()) return;
  if (group.code == 20) vertices.back().at.y = groups.number(group);
  if (group.code == 42) vertices.back().bulge = groups.number(group);
}

void take(Entity& entity, const Groups& groups, const Group& group) {
  if (group.code == 8) entity.layer = Groups::trimmed(group.value);
  if (group.code == 1) entity.text = group.value;
  if (entity.kind == "LWPOLYLINE") {
    take_vertex(entity, groups, group);
    if (group.code == 70) entity.path.closed = (static_cast<int>(groups.number(group)) & 1) != 0;
  } else if ((group.code >= 10 && group.code < 60) || (group.code >= 70 && group.code < 80)) {
    entity.values[group.code] = groups.number(group);
  }
}

std::string utf8_of(std::string_view ascii) {
  std::string text;
  for (std::size_t i = 0; i < ascii.size();) {
    unsigned character = 0;
    const bool escaped = ascii.substr(i, 3) == "\\U+" && i + 7 <= ascii.size() &&
                         std::from_chars(ascii.data() + i + 3, ascii.data() + i + 7, character, 16).ptr ==
                             ascii.data() + i + 7;
    if (!escaped) {
      text += ascii[i++];
      continue;
    }
    i += 7;
    append_utf8(text, character);
  }
  return text;
}

void add(Drawing& drawing, const Entity& entity) {
  const auto value = [&](int code) {
    const auto found = entity.values.find(code);
    return found == entity.values.end() ? 0.0 : found->second;
  };
  const Vec2 place{value(10), value(20)};
  const auto layer = [&] { return drawing.layer({entity.layer, LineStyle::continuous, 0.25, 7}); };
  if (entity.kind == "LWPOLYLINE") {
    drawing.add(layer(), entity.path);
  } else if (entity.kind == "LINE") {
    drawing.line(layer(), place, {value(11), value(21)});
  } else if (entity.kind == "CIRCLE") {
    drawing.add(layer(), Circle{place, value(40)});
  } else if (entity.kind == "ARC") {
    const double start = Angle::from_degrees(value(50)).radians();
    double sweep = Angle::from_degrees(value(51) - value(50)).radians();
    while (sweep <= 0.0) sweep += 2.0 * std::numbers::pi;
    const auto at = [&](double angle) {
      const auto [sine, cosine] = math::sine_cosine(angle);
      return place + value(40) * Vec2{cosine, sine};
    };
    drawing.add(layer(), ArcPath{{{at(start), bulge_of_sweep(sweep)}, {at(start + sweep)}}, false});
  } else if (entity.kind == "TEXT") {
    DrawnText text;
    text.layer = layer();
    text.at = place;
    text.height_mm = value(40);
    text.text = utf8_of(entity.text);
    const auto anchor = static_cast<int>(value(72));
    text.anchor = anchor == 1 ? TextAnchor::centre : anchor == 2 ? TextAnchor::right : TextAnchor::left;
    text.angle = Angle::from_degrees(value(50));
    drawing.texts.push_back(std::move(text));
  }
}

/// @return the group that ends the entity
Group read_entity(Groups& groups, Entity& entity) {
  while (true) {
    const Group group = groups.next();
    if (group.code == 0) return group;
    take(entity, groups, group);
  }
}

void read_entities(Groups& groups, Drawing& drawing) {
  Group group = groups.next();
  while (group.code != 0) group = groups.next();
  while (Groups::trimmed(group.value) != "ENDSEC") {
    Entity entity;
    entity.kind = Groups::trimmed(group.value);
    group = read_entity(groups, entity);
    add(drawing, entity);
  }
}

/// Layers of the section TABLES.
void read_tables(Groups& groups, Drawing& drawing) {
  DrawingLayer* layer = nullptr;
  while (true) {
    const Group group = groups.next();
    const std::string_view value = Groups::trimmed(group.value);
    if (group.code == 0) {
      if (value == "ENDSEC") return;
      layer = nullptr;
      if (value == "LAYER") layer = &drawing.layers.emplace_back();
      continue;
    }
    if (layer == nullptr) continue;
    if (group.code == 2) layer->name = value;
    if (group.code == 62) layer->colour = static_cast<int>(groups.number(group));
    if (group.code == 6) {
      layer->style = value == "DASHED"   ? LineStyle::dashed
                     : value == "CENTER" ? LineStyle::chain
                                         : LineStyle::continuous;
    }
    if (group.code == 370) layer->width_mm = groups.number(group) / 100.0;
  }
}

void read_header(Groups& groups) {
  constexpr int kUnitIsMillimetre = 4;
  std::string_view variable;
  while (true) {
    const Group group = groups.next();
    if (group.code == 0 && Groups::trimmed(group.value) == "ENDSEC") return;
    if (group.code == 9) variable = Groups::trimmed(group.value);
    if (group.code == 70 && variable == "$INSUNITS" &&
        static_cast<int>(groups.number(group)) != kUnitIsMillimetre) {
      throw groups.error(group.line, "$INSUNITS is " + std::string(Groups::trimmed(group.value)),
                         "Drawings are read in millimetres, 4.");
    }
  }
}

}  // namespace

Drawing read_dxf(const std::filesystem::path& file) {
  const std::string text = whole_text(file, kLargestFile);
  Groups groups(text, file.string());
  Drawing drawing;
  while (true) {
    const Group group = groups.next();
    if (group.code != 0) continue;
    const std::string_view word = Groups::trimmed(group.value);
    if (word == "EOF") return drawing;
    if (word != "SECTION") continue;
    const std::string_view section = Groups::trimmed(groups.next().value);
    if (section == "HEADER") read_header(groups);
    if (section == "TABLES") read_tables(groups, drawing);
    if (section == "ENTITIES") read_entities(groups, drawing);
  }
}

namespace {

bool near(const PathPiece& a, const PathPiece& b) {
  // Of an arc, R12 holds the circle and two angles.
  const double size = norm(a.from) + norm(a.to) + length(a);
  const double leeway = 1e-9 * size;
  return norm(a.from - b.from) <= leeway && norm(a.to - b.to) <= leeway &&
         std::fabs(a.bulge - b.bulge) <= 1e-9;
}

/// @return the pieces of all paths, each running to the left
std::vector<PathPiece> all_pieces(const Drawing& drawing) {
  std::vector<PathPiece> all;
  for (const DrawnPath& drawn : drawing.paths) {
    for (const PathPiece& piece : pieces_of(drawn.path)) {
      all.push_back(piece.bulge < 0.0 ? PathPiece{piece.to, piece.from, -piece.bulge} : piece);
    }
  }
  return all;
}

bool same_paths(const Drawing& found, const Drawing& meant, DxfVersion version) {
  const auto layer = [](const Drawing& drawing, const DrawnPath& drawn) {
    return drawing.layers[drawn.layer].name;
  };
  if (version == DxfVersion::r12) {
    const std::vector<PathPiece> pieces = all_pieces(found);
    const std::vector<PathPiece> others = all_pieces(meant);
    return std::equal(pieces.begin(), pieces.end(), others.begin(), others.end(), near);
  }
  return std::equal(found.paths.begin(), found.paths.end(), meant.paths.begin(), meant.paths.end(),
                    [&](const DrawnPath& a, const DrawnPath& b) {
                      return a.path == b.path && layer(found, a) == layer(meant, b);
                    });
}

}  // namespace

void require_same_dxf(const std::filesystem::path& file, const Drawing& drawing, const DxfOptions& options) {
  const Drawing found = read_dxf(file);
  const Drawing meant = without_dimensions(drawing);
  const bool same =
      same_paths(found, meant, options.version) &&
      std::equal(found.circles.begin(), found.circles.end(), meant.circles.begin(), meant.circles.end(),
                 [](const DrawnCircle& a, const DrawnCircle& b) { return a.circle == b.circle; }) &&
      found.texts.size() == meant.texts.size();
  if (!same) {
    throw InternalError(
        {file.filename().string(), "the file read back differs from what was written", "", ""});
  }
}

}  // namespace glissade
