#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/io/step_file.hpp"

#include "io/byte_source.hpp"
#include "io/step_names.hpp"
#include "parts/bodies/brep.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace glissade {

using namespace io;
using namespace parts;

namespace {

using Id = std::uint32_t;
constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30U;

/// One entity: its keyword (empty of one that is several at once) and what its brackets hold.
struct Entity {
  std::string_view keyword;
  std::string_view body;
};

class StepEntities {
 public:
  StepEntities(std::string text, std::string name) : text_(std::move(text)), name_(std::move(name)) {
    if (text_.compare(0, 13, "ISO-10303-21;") != 0)
      throw error("is no STEP file", "It does not start with ISO-10303-21.");
    const std::size_t data = text_.find("DATA;");
    const std::size_t end = text_.rfind("ENDSEC;");
    if (data == std::string::npos || end == std::string::npos || end < data ||
        text_.find("END-ISO-10303-21;", end) == std::string::npos) {
      throw error("ends early", "It is cut off.");
    }
    read({text_.data() + data + 5, end - data - 5});
    sort();
    for (const auto& [id, entity] : entities_) require_references(id, entity.body);
  }

  [[nodiscard]] FileError error(const std::string& what, const std::string& why = "") const {
    return FileError({name_, what, why, ""});
  }

  [[nodiscard]] const Entity& at(Id id) const {
    const Entity* const found = find(id);
    if (found == nullptr) throw error("#" + std::to_string(id) + " is referred to and missing");
    return *found;
  }

  /// @return ids of the entities with a keyword, in their order
  [[nodiscard]] std::vector<Id> all(std::string_view keyword) const {
    std::vector<Id> ids;
    for (const auto& [id, entity] : entities_) {
      if (entity.keyword == keyword) ids.push_back(id);
    }
    return ids;
  }

  /// @return the parameters of an entity, apart at the commas that are inside no bracket or quote
  [[nodiscard]] static std::vector<std::string_view> split(std::string_view body) {
    std::vector<std::string_view> parts;
    constexpr std::size_t kUsual = 8;
    parts.reserve(kUsual);
    int depth = 0;
    bool quoted = false;
    std::size_t start = 0;
    for (std::size_t i = 0; i < body.size(); ++i) {
      const char c = body[i];
      if (c == '\'') quoted = !quoted;
      if (quoted) continue;
      if (c == '(') ++depth;
      if (c == ')') --depth;
      if (c == ',' && depth == 0) {
        parts.push_back(body.substr(start, i - start));
        start = i + 1;
      }
    }
    parts.push_back(body.substr(start));
    return parts;
  }

  [[nodiscard]] std::vector<std::string_view> parameters(Id id, std::size_t least) const {
    std::vector<std::string_view> parts = split(at(id).body);
    if (parts.size() < least) throw error("#" + std::to_string(id) + " has too few parameters");
    return parts;
  }

  /// @return the first parameters of one of several entities that are one
  [[nodiscard]] std::vector<std::string_view> parameters_within(Id id, std::string_view keyword,
                                                                std::size_t least) const {
    const std::string_view body = at(id).body;
    const std::size_t start = body.find(keyword);
    std::vector<std::string_view> parts;
    if (start != std::string_view::npos) parts = split(body.substr(start + keyword.size()));
    if (parts.size() < least)
      throw error("#" + std::to_string(id) + " is no " + std::string(keyword.substr(0, keyword.size() - 1)));
    return parts;
  }

  [[nodiscard]] Id reference(std::string_view text) const {
    Id id = 0;
    if (text.size() > 1 && text.front() == '#') {
      const auto [end, problem] = std::from_chars(text.data() + 1, text.data() + text.size(), id);
      if (problem == std::errc{} && end == text.data() + text.size()) return id;
    }
    throw error("\"" + std::string(text.substr(0, 20)) + "\" stands where an entity is due");
  }

  [[nodiscard]] std::vector<Id> references(std::string_view list) const {
    std::vector<Id> ids;
    for (const std::string_view one : split(inside(list))) ids.push_back(reference(one));
    return ids;
  }

  /// @return the references of a list of lists, one after the other
  [[nodiscard]] std::vector<Id> nested_references(std::string_view lists) const {
    std::vector<Id> ids;
    for (const std::string_view list : split(inside(lists))) {
      for (const Id id : references(list)) ids.push_back(id);
    }
    return ids;
  }

  [[nodiscard]] double number(std::string_view text) const {
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool as_due = text.find('.') != std::string_view::npos && text.find('e') == std::string_view::npos;
    if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(value) || !as_due) {
      throw error("\"" + std::string(text.substr(0, 20)) + "\" stands where a real number is due");
    }
    return value;
  }

  [[nodiscard]] Vec3 triple(Id id) const {
    const auto parts = split(inside(parameters(id, 2)[1]));
    if (parts.size() != 3) throw error("#" + std::to_string(id) + " has no three coordinates");
    return {number(parts[0]), number(parts[1]), number(parts[2])};
  }

 private:
  [[nodiscard]] std::string_view inside(std::string_view list) const {
    if (list.size() < 2 || list.front() != '(' || list.back() != ')') throw error("a list has no brackets");
    return list.substr(1, list.size() - 2);
  }

  void read(std::string_view data) {
    std::size_t start = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < data.size(); ++i) {
      if (data[i] == '\'') quoted = !quoted;
      if (quoted || data[i] != ';') continue;
      std::string_view statement = data.substr(start, i - start);
      while (!statement.empty() && (statement.front() == '\n' || statement.front() == '\r'))
        statement.remove_prefix(1);
      add(statement);
      start = i + 1;
    }
  }

  void add(std::string_view statement) {
    const std::size_t equals = statement.find('=');
    const std::size_t open = statement.find('(');
    if (equals == std::string_view::npos || open == std::string_view::npos || open < equals ||
        statement.back() != ')') {
      throw error("\"" + std::string(statement.substr(0, 30)) + "\" is no entity");
    }
    const Id id = reference(statement.substr(0, equals));
    const Entity entity{statement.substr(equals + 1, open - equals - 1),
                        statement.substr(open + 1, statement.size() - open - 2)};
    entities_.emplace_back(id, entity);
  }

  void sort() {
    const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
    if (!std::is_sorted(entities_.begin(), entities_.end(), before))
      std::sort(entities_.begin(), entities_.end(), before);
    const auto twice = std::adjacent_find(entities_.begin(), entities_.end(),
                                          [](const auto& a, const auto& b) { return a.first == b.first; });
    if (twice != entities_.end()) throw error("#" + std::to_string(twice->first) + " is there twice");
  }

  /// @return none of an id that is not there
  [[nodiscard]] const Entity* find(Id id) const {
    // As a rule they are numbered from 1 on without gaps.
    const std::size_t usual = std::size_t{id} - 1;
    if (usual < entities_.size() && entities_[usual].first == id) return &entities_[usual].second;
    const auto found = std::lower_bound(entities_.begin(), entities_.end(), id,
                                        [](const auto& entity, Id wanted) { return entity.first < wanted; });
    return found != entities_.end() && found->first == id ? &found->second : nullptr;
  }

  void require_references(Id owner, std::string_view body) const {
    bool quoted = false;
    for (std::size_t i = 0; i < body.size(); ++i) {
      if (body[i] == '\'') quoted = !quoted;
      if (quoted || body[i] != '#') continue;
      Id id = 0;
      std::from_chars(body.data() + i + 1, body.data() + body.size(), id);
      if (find(id) == nullptr) {
        throw error("#" + std::to_string(owner) + " refers to #" + std::to_string(id) + ", which is missing");
      }
    }
  }

  std::string text_;
  std::string name_;
  std::vector<std::pair<Id, Entity>> entities_;  // by their numbers
};

/// A frame of a curve or surface.
struct Placement3 {
  Vec3 origin;
  Vec3 axis;
  Vec3 reference;
};

/// What of a gap is more than the rounding of a radius: an arc all but straight has its centre thousands of kilometres away.
double beyond_rounding(double gap, double radius) {
  return std::max(0.0, gap - 4.0 * std::numeric_limits<double>::epsilon() * radius);
}

/// ISO 10303-42 gives the length of a direction no meaning.
Vec3 direction(const StepEntities& step, Id id) {
  const Vec3 along = step.triple(id);
  return (1.0 / norm(along)) * along;
}

Placement3 placement(const StepEntities& step, Id id) {
  const auto parts = step.parameters(id, 4);
  return {step.triple(step.reference(parts[1])), direction(step, step.reference(parts[2])),
          direction(step, step.reference(parts[3]))};
}

/// How far places are from the nearer end of a spline.
std::function<double(Vec3)> gap_from_ends(const StepEntities& step, const std::vector<Id>& poles) {
  return [first = step.triple(poles.front()), last = step.triple(poles.back())](Vec3 point) {
    return std::min(norm(first - point), norm(last - point));
  };
}

/// How far places are from a curve of the file.
std::function<double(Vec3)> gap_from_curve(const StepEntities& step, Id id) {
  const Entity& curve = step.at(id);
  if (curve.keyword.empty()) {
    // Several entities at once: a rational spline.
    return gap_from_ends(step, step.references(step.parameters_within(id, "B_SPLINE_CURVE(", 2)[1]));
  }
  const auto parts = step.parameters(id, 3);
  if (curve.keyword == "LINE") {
    const Vec3 from = step.triple(step.reference(parts[1]));
    const Vec3 along = direction(step, step.reference(step.parameters(step.reference(parts[2]), 3)[1]));
    return [from, along](Vec3 point) { return norm(cross(along, point - from)); };
  }
  if (curve.keyword == "B_SPLINE_CURVE_WITH_KNOTS") {
    return gap_from_ends(step, step.references(step.parameters(id, 3)[2]));
  }
  const Placement3 place = placement(step, step.reference(parts[1]));
  const Vec3 across = cross(place.axis, place.reference);
  const double first = step.number(parts[2]);
  if (curve.keyword == "CIRCLE") {
    return [place, across, first](Vec3 point) {
      const Vec3 spoke = point - place.origin;
      const double away = math::hypot(dot(spoke, place.reference), dot(spoke, across));
      return std::max(std::fabs(dot(spoke, place.axis)), beyond_rounding(std::fabs(away - first), first));
    };
  }
  if (curve.keyword == "ELLIPSE" && parts.size() > 3) {
    return [place, across, first, second = step.number(parts[3])](Vec3 point) {
      const Vec3 spoke = point - place.origin;
      const double away = math::hypot(dot(spoke, place.reference) / first, dot(spoke, across) / second);
      return std::max(std::fabs(dot(spoke, place.axis)), std::fabs(away - 1.0) * second);
    };
  }
  throw step.error("#" + std::to_string(id) + " is a curve of another kind",
                   "Lines, circles, ellipses, cubics and rational splines are read.");
}

/// How far places are from a surface of the file.
std::function<double(Vec3)> gap_from_surface(const StepEntities& step, Id id) {
  const Entity& surface = step.at(id);
  if (surface.keyword == "B_SPLINE_SURFACE_WITH_KNOTS") {
    std::vector<Vec3> poles;
    for (const Id pole : step.nested_references(step.parameters(id, 4)[3]))
      poles.push_back(step.triple(pole));
    return [poles = std::move(poles)](Vec3 point) {
      double least = std::numeric_limits<double>::infinity();
      for (const Vec3 pole : poles) least = std::min(least, norm(pole - point));
      return least;
    };
  }
  const auto parts = step.parameters(id, 2);
  const Placement3 place = placement(step, step.reference(parts[1]));
  if (surface.keyword == "PLANE")
    return [place](Vec3 point) { return std::fabs(dot(point - place.origin, place.axis)); };
  const double last = step.number(parts.back());
  if (surface.keyword == "CYLINDRICAL_SURFACE") {
    return [place, radius = last](Vec3 point) {
      const Vec3 spoke = point - place.origin;
      const double away = norm(spoke - dot(spoke, place.axis) * place.axis);
      return beyond_rounding(std::fabs(away - radius), radius);
    };
  }
  return [place, radius = step.number(parts[2]), half_angle = last](Vec3 point) {
    const Vec3 spoke = point - place.origin;
    const double along = dot(spoke, place.axis);
    const double away = norm(spoke - along * place.axis);
    const double wanted = radius + along * math::tan(half_angle);
    return beyond_rounding(std::fabs(away - wanted) * math::cos(half_angle), wanted);
  };
}

/// Reads one solid and holds its topology together.
class SolidCheck {
 public:
  SolidCheck(const StepEntities& step, Id solid) : step_(step) {
    const auto parts = step.parameters(solid, 2);
    found_.name = step_string_value(std::string(parts[0]));
    const Id shell = step.reference(parts[1]);
    if (step.at(shell).keyword != "CLOSED_SHELL")
      throw step.error("#" + std::to_string(shell) + " is no closed shell");
    for (const Id face : step.references(step.parameters(shell, 2)[1])) add_face(face);
  }

  StepSolid result() {
    found_.largest_radius_mm = largest_radius_;
    found_.vertices = vertices_.size();
    found_.edges = uses_.size();
    for (const auto& [edge, use] : uses_) chains_ = chains_ && use.first == 1 && use.second == 1;
    // Euler and Poincare: vertices - edges + faces - inner loops = 2 - 2 genus.
    const auto rings = static_cast<long>(found_.loops - found_.faces());
    const long sum = static_cast<long>(found_.vertices) - static_cast<long>(found_.edges) +
                     static_cast<long>(found_.faces()) - rings;
    found_.closed = chains_ && sum <= 2 && sum % 2 == 0;
    return found_;
  }

 private:
  void add_face(Id id) {
    const auto parts = step_.parameters(id, 4);
    const Id surface = step_.reference(parts[2]);
    const std::string_view kind = step_.at(surface).keyword;
    if (kind == "PLANE")
      ++found_.planes;
    else if (kind == "CYLINDRICAL_SURFACE")
      ++found_.cylinders;
    else if (kind == "CONICAL_SURFACE")
      ++found_.cones;
    else if (kind == "B_SPLINE_SURFACE_WITH_KNOTS")
      ++found_.splines;
    else
      throw step_.error("#" + std::to_string(surface) + " is a surface of another kind",
                        "Planes, cylinders, cones and B-splines are read.");
    if (kind == "CYLINDRICAL_SURFACE" || kind == "CONICAL_SURFACE") see_radius(surface);
    const auto gap = gap_from_surface(step_, surface);
    for (const Id bound : step_.references(parts[1]))
      add_loop(step_.reference(step_.parameters(bound, 3)[1]), gap);
  }

  void add_loop(Id id, const std::function<double(Vec3)>& gap_from_face) {
    ++found_.loops;
    Id first = 0;
    Id last = 0;
    for (const Id use : step_.references(step_.parameters(id, 2)[1])) {
      const auto parts = step_.parameters(use, 5);
      const Id edge = step_.reference(parts[3]);
      const bool forward = parts[4] == ".T.";
      auto& [there, back] = uses_[edge];
      ++(forward ? there : back);
      const auto ends = step_.parameters(edge, 5);
      Id from = step_.reference(ends[1]);
      Id to = step_.reference(ends[2]);
      if (there + back == 1) hold_vertices(step_.reference(ends[3]), from, to);
      hold(gap_from_face(vertex(from)));
      hold(gap_from_face(vertex(to)));
      if (!forward) std::swap(from, to);
      if (first == 0)
        first = from;
      else
        chains_ = chains_ && last == from;
      last = to;
    }
    chains_ = chains_ && first == last;
  }

  void hold_vertices(Id curve, Id from, Id to) {
    if (step_.at(curve).keyword == "CIRCLE") see_radius(curve);
    const auto gap = gap_from_curve(step_, curve);
    hold(gap(vertex(from)));
    hold(gap(vertex(to)));
  }

  Vec3 vertex(Id id) {
    const auto known = vertices_.find(id);
    if (known != vertices_.end()) return known->second;
    const Vec3 place = step_.triple(step_.reference(step_.parameters(id, 2)[1]));
    vertices_.emplace(id, place);
    return place;
  }

  /// Of a circle, cylinder or cone.
  void see_radius(Id round) {
    largest_radius_ = std::max(largest_radius_, step_.number(step_.parameters(round, 3)[2]));
  }

  void hold(double gap) { found_.worst_gap_mm = std::max(found_.worst_gap_mm, gap); }

  const StepEntities& step_;
  StepSolid found_;
  std::unordered_map<Id, std::pair<int, int>> uses_;
  std::unordered_map<Id, Vec3> vertices_;
  double largest_radius_ = 0.0;
  bool chains_ = true;
};

bool same_solid(const StepSolid& found, const ShopPart& part) {
  const Brep meant = brep_of(part);
  std::size_t planes = 0;
  std::size_t loops = 0;
  for (const BrepFace& face : meant.faces) {
    planes += face.kind == SurfaceKind::plane ? 1 : 0;
    loops += face.loops.size();
  }
  return found.closed && found.worst_gap_mm <= kStepAccuracy &&
         found.largest_radius_mm <= kStepLargestRadius && found.name == step_name(part) &&
         found.vertices == meant.vertices.size() && found.edges == meant.edges.size() &&
         found.planes == planes && found.faces() == meant.faces.size() && found.loops == loops;
}

void require(bool same, const std::filesystem::path& file) {
  if (same) return;
  throw InternalError({file.filename().string(), "the file read back differs from what was written", "", ""});
}

}  // namespace

StepFacts read_step_facts(const std::filesystem::path& file) {
  const StepEntities step(whole_text(file, kLargestFile), file.string());
  StepFacts facts;
  for (const Id solid : step.all("MANIFOLD_SOLID_BREP"))
    facts.solids.push_back(SolidCheck(step, solid).result());
  for (const Id usage : step.all("NEXT_ASSEMBLY_USAGE_OCCURRENCE")) {
    facts.occurrences.push_back(step_string_value(std::string(step.parameters(usage, 2)[1])));
  }
  return facts;
}

void require_same_step(const std::filesystem::path& file, const ShopPart& part) {
  const StepFacts facts = read_step_facts(file);
  require(facts.solids.size() == 1 && facts.occurrences.empty() && same_solid(facts.solids.front(), part),
          file);
}

void require_same_step(const std::filesystem::path& file, const Workshop& workshop) {
  const StepFacts facts = read_step_facts(file);
  require(std::equal(facts.solids.begin(), facts.solids.end(), workshop.parts.begin(), workshop.parts.end(),
                     same_solid),
          file);
  std::vector<std::string> places;
  for (const ShopPart& part : workshop.parts)
    places.insert(places.end(), part.places.size(), step_name(part));
  require(facts.occurrences == places, file);
}

}  // namespace glissade
