#include "report/parts_view.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "core/grouped.hpp"
#include "parts/bodies/body_mesh.hpp"
#include "report/serial/packed.hpp"
#include "report/view_mesh.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

namespace glissade::report {
namespace {

constexpr int kStations = 400;      // of the track, to which pieces are related
constexpr std::size_t kLooks = 32;  // corners of a body whose height above the track is taken

struct Box {
  Vec3 lower{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()};
  Vec3 upper = -1.0 * lower;

  void add(Vec3 v) {
    lower = {std::min(lower.x, v.x), std::min(lower.y, v.y), std::min(lower.z, v.z)};
    upper = {std::max(upper.x, v.x), std::max(upper.y, v.y), std::max(upper.z, v.z)};
  }
  [[nodiscard]] Vec3 middle() const { return 0.5 * (lower + upper); }
};

Box box_of(const TriangleMesh& mesh) {
  Box box;
  for (const Vec3& vertex : mesh.vertices) box.add(vertex);
  return box;
}

/// A place as the track sees it.
struct Beside {
  std::size_t station = 0;  ///< of the nearest point of the track
  double left = 0.0;
  double above = 0.0;  ///< square to the track there [m]
};

/// The track's own directions at any place near it.
class TrackFrame {
 public:
  TrackFrame(const Centerline& centerline, const Placement& placement) : placement_(placement) {
    for (int i = 0; i <= kStations; ++i)
      stations_.push_back(centerline.at(centerline.length() * (static_cast<double>(i) / kStations)));
    cosine_ = math::cos(placement.azimuth().radians());
    sine_ = math::sin(placement.azimuth().radians());
  }

  [[nodiscard]] Beside beside(Vec3 place) const {
    const Vec3 from_start = place - placement_.start();
    const double x = from_start.x * cosine_ + from_start.y * sine_;
    double nearest = std::numeric_limits<double>::infinity();
    Beside found;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      const double ahead = x - stations_[i].x;
      const double up = stations_[i].drop + from_start.z;
      if (ahead * ahead + up * up >= nearest) continue;
      nearest = ahead * ahead + up * up;
      const double slope = stations_[i].slope_angle;
      found = {i, from_start.y * cosine_ - from_start.x * sine_,
               ahead * math::sin(slope) + up * math::cos(slope)};
    }
    return found;
  }

  [[nodiscard]] Vec3 at(std::size_t station) const {
    return placement_.to_space(stations_[station].x, stations_[station].drop, 0.0);
  }
  [[nodiscard]] Vec3 middle() const { return at(stations_.size() / 2); }
  [[nodiscard]] Vec3 left() const { return {-sine_, cosine_, 0.0}; }
  [[nodiscard]] Vec3 up(std::size_t station) const {
    const double slope = stations_[station].slope_angle;
    return {math::sin(slope) * cosine_, math::sin(slope) * sine_, math::cos(slope)};
  }

 private:
  Placement placement_;
  std::vector<CenterlinePoint> stations_;
  double cosine_ = 1.0;
  double sine_ = 0.0;
};

/// "floor_2" and "tile_3_half" without number and what follows it.
std::string kind_of(const std::string& name) {
  for (std::size_t i = name.rfind('_'); i != std::string::npos && i > 0; i = name.rfind('_', i - 1)) {
    if (i + 1 < name.size() && std::isdigit(static_cast<unsigned char>(name[i + 1])) != 0)
      return name.substr(0, i);
  }
  return name;
}

double mean_height(const TriangleMesh& mesh, const Frame& place, const TrackFrame& track) {
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / kLooks);
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); i += step, ++count)
    sum += track.beside(place.to_space(mesh.vertices[i])).above;
  return count > 0 ? sum / count : 0.0;
}

/// Which layer each part lies in, counted from below, 0 where the floor is; as many as there are.
struct Layers {
  std::vector<int> of_part;
  int count = 1;
};

Layers layers_of(const std::vector<ShopPart>& parts, const std::vector<double>& heights) {
  struct Kind {
    double sum = 0.0;
    int count = 0;
    [[nodiscard]] double height() const { return sum / count; }
  };
  std::map<std::string, Kind> kinds;
  double thinnest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Kind& kind = kinds[kind_of(parts[i].name)];
    kind.sum += heights[i];
    ++kind.count;
    thinnest = std::min(thinnest, parts[i].thickness);
  }
  std::vector<std::pair<double, std::string>> sorted;
  for (const auto& [name, kind] : kinds) sorted.emplace_back(kind.height(), name);
  std::sort(sorted.begin(), sorted.end());
  std::map<std::string, int> layer;
  int at = 0;
  int floor = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i > 0 && sorted[i].first - sorted[i - 1].first > 0.25 * thinnest) ++at;
    layer[sorted[i].second] = at;
    if (std::fabs(sorted[i].first) >= nearest) continue;
    nearest = std::fabs(sorted[i].first);
    floor = at;
  }
  Layers layers{{}, at + 1};
  for (const ShopPart& part : parts) {
    // Printed pieces follow one another along the track, their pins between them.
    const bool printed = std::holds_alternative<MeshBody>(part.body);
    layers.of_part.push_back(printed ? 0 : layer[kind_of(part.name)] - floor);
  }
  return layers;
}

constexpr int kRoundCorners = 12;  // of a hole, at least

/// The bodies of all parts, coarse enough for the page.
struct Drawn {
  std::vector<TriangleMesh> bodies;
  double sagitta = 0.0;
  bool merged = false;  ///< vertices of meshes that are not ours to draw coarser were merged
};

std::size_t triangles_of(const std::vector<TriangleMesh>& bodies) {
  std::size_t count = 0;
  for (const TriangleMesh& body : bodies) count += body.triangles.size();
  return count;
}

Drawn drawn_bodies(const std::vector<ShopPart>& parts, double size) {
  constexpr int kTries = 7;
  Drawn drawn;
  drawn.sagitta = size / 8000.0;
  for (int i = 0; i < kTries; ++i, drawn.sagitta *= 2.0) {
    drawn.bodies.clear();
    for (const ShopPart& part : parts) {
      TriangleMesh body = parts::facets_of(part.body, drawn.sagitta, kRoundCorners);
      if (i > 0 && std::holds_alternative<MeshBody>(part.body)) {
        body = parts::coarsened(body, drawn.sagitta);
        drawn.merged = true;
      }
      drawn.bodies.push_back(std::move(body));
    }
    if (triangles_of(drawn.bodies) <= kPartsViewTriangles) break;
  }
  return drawn;
}

void add(std::vector<float>& numbers, Vec3 v) {
  for (const double value : {v.x, v.y, v.z}) numbers.push_back(static_cast<float>(value));
}

Json body_json(const ShopPart& part, const TriangleMesh& body, const std::vector<Vec3>& shifts, Vec3 origin) {
  const Box box = box_of(body);
  std::vector<std::uint16_t> positions;
  for (const Vec3& v : body.vertices) {
    positions.push_back(on_grid(v.x, box.lower.x, box.upper.x));
    positions.push_back(on_grid(v.y, box.lower.y, box.upper.y));
    positions.push_back(on_grid(v.z, box.lower.z, box.upper.z));
  }
  std::vector<float> places;
  for (std::size_t i = 0; i < part.places.size(); ++i) {
    const Frame& place = part.places[i];
    for (const Vec3 v : {place.origin - origin, place.x, place.y, place.z, shifts[i]}) add(places, v);
  }
  Json json{{"number", part.number},
            {"lower_m", position_json(box.lower)},
            {"upper_m", position_json(box.upper)},
            {"colour", part.colour},
            {"positions", packed("u16", positions)}};
  constexpr std::size_t kShort = 65'536;
  if (body.vertices.size() < kShort) {
    std::vector<std::uint16_t> indices;
    for (const auto& triangle : body.triangles)
      for (const std::uint32_t corner : triangle) indices.push_back(static_cast<std::uint16_t>(corner));
    json["indices"] = packed("u16", indices);
  } else {
    std::vector<std::uint32_t> indices;
    for (const auto& triangle : body.triangles)
      indices.insert(indices.end(), triangle.begin(), triangle.end());
    json["indices"] = packed("u32", indices);
  }
  json["places"] = packed("f32", places);
  return json;
}

std::string note_of(const Drawn& drawn) {
  std::string note = "Bodies are drawn with " + core::grouped(triangles_of(drawn.bodies)) +
                     " facets, arcs within " + length_text(drawn.sagitta, 2);
  if (drawn.merged) note += "; corners of printed pieces that are closer together than that are one";
  return note + ". The files hold the exact ones.";
}

}  // namespace

std::vector<std::vector<Vec3>> shifts_apart(const std::vector<ShopPart>& parts, const Centerline& centerline,
                                            const Placement& placement) {
  const TrackFrame track(centerline, placement);
  std::vector<double> heights;
  std::vector<std::vector<Beside>> places;
  double half_width = 0.0;
  for (const ShopPart& part : parts) {
    const TriangleMesh body = parts::facets_of(part.body, 0.01 * centerline.length());
    heights.push_back(part.places.empty() ? 0.0 : mean_height(body, part.places.front(), track));
    places.emplace_back();
    const Box box = box_of(body);
    for (const Frame& place : part.places) {
      places.back().push_back(track.beside(place.to_space(box.middle())));
      for (const Vec3 corner : {box.lower, box.upper})
        half_width = std::max(half_width, std::fabs(track.beside(place.to_space(corner)).left));
    }
  }
  const Layers layers = layers_of(parts, heights);
  // A quarter of the track along it, its own width across, and half that from layer to layer, all of them within three
  // widths.
  const double step = std::min(0.5, 3.0 / layers.count) * 2.0 * half_width;
  std::vector<std::vector<Vec3>> shifts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    shifts.emplace_back();
    for (const Beside& place : places[i]) {
      const bool far_below = heights[i] < -1.5 * half_width;
      const Vec3 upward = far_below ? Vec3{0.0, 0.0, 1.0} : track.up(place.station);
      shifts.back().push_back(0.25 * (track.at(place.station) - track.middle()) + place.left * track.left() +
                              (layers.of_part[i] * step) * upward);
    }
  }
  return shifts;
}

Json parts_view_json(const ReportInput& input) {
  if (input.solid.solid == nullptr) return nullptr;
  const std::vector<ShopPart>& parts = input.workshop->workshop.parts;
  const Placement& placement = input.solid.solid->placement;
  const Centerline& centerline = input.motion->centerline();
  const Drawn drawn = drawn_bodies(parts, centerline.length());
  const std::vector<std::vector<Vec3>> shifts = shifts_apart(parts, centerline, placement);
  const Vec3 origin = placement.start();
  Json bodies = Json::array();
  for (std::size_t i = 0; i < parts.size(); ++i)
    bodies.push_back(body_json(parts[i], drawn.bodies[i], shifts[i], origin));
  return {{"steps", ViewMesh::kSteps},
          {"origin_m", position_json(origin)},
          {"note", note_of(drawn)},
          {"bodies", std::move(bodies)}};
}

}  // namespace glissade::report
