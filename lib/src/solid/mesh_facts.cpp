#include "glissade/solid/mesh_facts.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/stop.hpp"

#include "solid/mesh_check.hpp"
#include "solid/nesting.hpp"
#include "solid/position_index.hpp"
#include "solid/self_intersections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace glissade {

using namespace solid;

namespace {

constexpr std::uint32_t kNone = UINT32_MAX;

std::size_t next_corner(std::size_t corner) {
  return corner == 2 ? 0 : corner + 1;
}

void check_sizes(const TriangleMesh& mesh) {
  if (mesh.vertices.size() >= kNone || mesh.triangles.size() >= kNone) {
    throw InputError({"mesh",
                      std::to_string(mesh.vertices.size()) + " vertices and " +
                          std::to_string(mesh.triangles.size()) + " triangles are too many",
                      "Each must stay below 4294967295.", "a coarser tolerance"});
  }
}

/// A sum that carries along what each addition rounds away (Neumaier).
class CompensatedSum {
 public:
  void add(double term) {
    const double total = total_ + term;
    lost_ += std::fabs(total_) >= std::fabs(term) ? (total_ - total) + term : (term - total) + total_;
    total_ = total;
  }
  [[nodiscard]] double value() const { return total_ + lost_; }

 private:
  double total_ = 0.0;
  double lost_ = 0.0;
};

/// Which facets belong together; sets of facets that grow by joining (union-find).
class FacetGroups {
 public:
  explicit FacetGroups(std::size_t facets) : parent_(facets) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  [[nodiscard]] std::uint32_t root(std::uint32_t facet) {
    while (parent_[facet] != facet) {
      parent_[facet] = parent_[parent_[facet]];
      facet = parent_[facet];
    }
    return facet;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t first = root(a);
    const std::uint32_t second = root(b);
    // The lower number leads, so that groups do not depend on the order of joining.
    parent_[std::max(first, second)] = std::min(first, second);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// The facets around every vertex, as one array with an offset per vertex.
class Incidence {
 public:
  Incidence(std::size_t vertices, const std::vector<FacetCorners>& facets)
      : start_(vertices + 1, 0), facet_(3 * facets.size()) {
    for (const FacetCorners& facet : facets) {
      for (const std::uint32_t vertex : facet) ++start_[vertex + 1];
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<std::size_t> free(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < facets.size(); ++i) {
      for (const std::uint32_t vertex : facets[i]) facet_[free[vertex]++] = static_cast<std::uint32_t>(i);
    }
  }

  [[nodiscard]] const std::uint32_t* begin(std::size_t vertex) const {
    return facet_.data() + start_[vertex];
  }
  [[nodiscard]] const std::uint32_t* end(std::size_t vertex) const {
    return facet_.data() + start_[vertex + 1];
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> facet_;
};

/// One end of an edge seen from a vertex: the vertex at its other end and the facet it bounds.
struct Spoke {
  std::uint32_t neighbour = 0;
  std::uint32_t facet = 0;
  std::uint32_t wedge = 0;  ///< of the facet among those around the vertex
  bool outgoing = false;    ///< the facet runs through the edge away from the vertex
};

using Edge = std::array<std::uint32_t, 2>;

struct Topology {
  std::size_t edges = 0;
  std::size_t boundary_edges = 0;
  std::size_t non_manifold_edges = 0;
  std::size_t non_manifold_vertices = 0;
  std::size_t used_vertices = 0;
  std::optional<Edge> boundary_edge;  ///< the first of each
  std::optional<Edge> non_manifold_edge;
  std::optional<std::uint32_t> non_manifold_vertex;
};

// Whether the work is to end is asked once in so many vertices or facets.
constexpr std::size_t kItemsBetweenPauses = std::size_t{1} << 16U;

void pause(std::size_t item, const std::stop_token& stop) {
  if (item % kItemsBetweenPauses == 0) require_going(stop);
}

/// Walks once around every vertex; an edge is counted at its vertex of lower number.
class TopologyCount {
 public:
  TopologyCount(std::size_t vertices, const std::vector<FacetCorners>& facets, const std::stop_token& stop)
      : facets_(facets), incidence_(vertices, facets), groups_(facets.size()) {
    for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
      pause(vertex, stop);
      visit(static_cast<std::uint32_t>(vertex));
    }
  }

  [[nodiscard]] const Topology& topology() const { return topology_; }
  [[nodiscard]] FacetGroups& groups() { return groups_; }

 private:
  void visit(std::uint32_t vertex) {
    gather_spokes(vertex);
    if (spokes_.empty()) return;
    ++topology_.used_vertices;
    is_fan_ = true;
    for (std::size_t first = 0; first < spokes_.size();) {
      std::size_t last = first + 1;
      while (last < spokes_.size() && spokes_[last].neighbour == spokes_[first].neighbour) ++last;
      visit_edge(vertex, first, last);
      first = last;
    }
    if (is_fan_ && wedge_count() == 1) return;
    ++topology_.non_manifold_vertices;
    if (!topology_.non_manifold_vertex) topology_.non_manifold_vertex = vertex;
  }

  void gather_spokes(std::uint32_t vertex) {
    spokes_.clear();
    wedges_.clear();
    for (const std::uint32_t* facet = incidence_.begin(vertex); facet != incidence_.end(vertex); ++facet) {
      const FacetCorners& corners = facets_[*facet];
      const std::size_t here = corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
      const std::size_t after = next_corner(here);
      const auto wedge = static_cast<std::uint32_t>(wedges_.size());
      wedges_.push_back(wedge);
      spokes_.push_back({corners[after], *facet, wedge, true});
      spokes_.push_back({corners[next_corner(after)], *facet, wedge, false});
    }
    std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& a, const Spoke& b) {
      return a.neighbour != b.neighbour ? a.neighbour < b.neighbour : a.facet < b.facet;
    });
  }

  /// Spokes [first, last) are all facets at one edge.
  void visit_edge(std::uint32_t vertex, std::size_t first, std::size_t last) {
    const std::size_t facets_here = last - first;
    if (facets_here > 2) is_fan_ = false;
    for (std::size_t i = first + 1; i < last; ++i) {
      wedges_[wedge_root(spokes_[i].wedge)] = wedge_root(spokes_[first].wedge);
    }
    if (vertex > spokes_[first].neighbour) return;

    ++topology_.edges;
    for (std::size_t i = first + 1; i < last; ++i) groups_.join(spokes_[first].facet, spokes_[i].facet);
    const Edge edge{vertex, spokes_[first].neighbour};
    if (facets_here == 1) {
      ++topology_.boundary_edges;
      if (!topology_.boundary_edge) topology_.boundary_edge = edge;
    }
    const bool is_flipped = facets_here == 2 && spokes_[first].outgoing == spokes_[first + 1].outgoing;
    if (facets_here <= 2 && !is_flipped) return;
    ++topology_.non_manifold_edges;
    if (!topology_.non_manifold_edge) topology_.non_manifold_edge = edge;
  }

  [[nodiscard]] std::uint32_t wedge_root(std::uint32_t wedge) {
    while (wedges_[wedge] != wedge) {
      wedges_[wedge] = wedges_[wedges_[wedge]];
      wedge = wedges_[wedge];
    }
    return wedge;
  }

  [[nodiscard]] std::size_t wedge_count() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < wedges_.size(); ++i) count += wedges_[i] == i ? 1 : 0;
    return count;
  }

  const std::vector<FacetCorners>& facets_;
  Incidence incidence_;
  FacetGroups groups_;
  Topology topology_;
  std::vector<Spoke> spokes_;
  std::vector<std::uint32_t> wedges_;
  bool is_fan_ = true;
};

/// Every vertex that shares its position with an earlier one stands for that one.
struct Welding {
  std::vector<std::uint32_t> leader;
  std::size_t duplicates = 0;
  std::optional<std::uint32_t> first_duplicate;
};

Welding weld(const std::vector<Vec3>& vertices, const std::stop_token& stop) {
  Welding welding{
      .leader = std::vector<std::uint32_t>(vertices.size()), .duplicates = 0, .first_duplicate = {}};
  PositionIndex index(vertices, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    pause(i, stop);
    const auto vertex = static_cast<std::uint32_t>(i);
    welding.leader[i] = index.enter(vertices[i], vertex);
    if (welding.leader[i] == vertex) continue;
    ++welding.duplicates;
    if (!welding.first_duplicate) welding.first_duplicate = vertex;
  }
  return welding;
}

/// @return cotangent of the smallest angle of a triangle with these squared sides and twice this area
double largest_cotangent(double ab, double bc, double ca, double double_area) {
  // The smallest angle faces the shortest side.
  const double shortest = std::min({ab, bc, ca});
  return (ab + bc + ca - 2.0 * shortest) / (2.0 * double_area);
}

void measure_shape(const TriangleMesh& mesh, const std::stop_token& stop, MeshFacts& facts) {
  double shortest_squared = std::numeric_limits<double>::infinity();
  double cotangent = 0.0;
  CompensatedSum double_area;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    pause(i, stop);
    const auto& [ia, ib, ic] = mesh.triangles[i];
    const Vec3 a = mesh.vertices[ia];
    const Vec3 ab = mesh.vertices[ib] - a;
    const Vec3 ac = mesh.vertices[ic] - a;
    const Vec3 bc = mesh.vertices[ic] - mesh.vertices[ib];
    const Vec3 normal = cross(ab, ac);
    const double facet_double_area = std::sqrt(dot(normal, normal));
    double_area.add(facet_double_area);
    shortest_squared = std::min({shortest_squared, dot(ab, ab), dot(bc, bc), dot(ac, ac)});
    cotangent =
        std::max(cotangent, largest_cotangent(dot(ab, ab), dot(bc, bc), dot(ac, ac), facet_double_area));
  }
  facts.area = 0.5 * double_area.value();
  facts.shortest_edge = mesh.triangles.empty() ? 0.0 : std::sqrt(shortest_squared);
  const bool has_angle = !mesh.triangles.empty() && facts.degenerate_facets == 0;
  facts.smallest_angle = Angle::from_radians(has_angle ? math::atan2(1.0, cotangent) : 0.0);
}

/// Volume of every piece by the divergence theorem about the middle of the bounding box, which keeps the
/// terms small; pieces in the order of their lowest facet.
Pieces find_pieces(const std::vector<Vec3>& vertices, const std::vector<FacetCorners>& facets,
                   FacetGroups& groups, Vec3 centre) {
  Pieces pieces{.of_facet = std::vector<std::uint32_t>(facets.size()), .volumes = {}};
  std::vector<CompensatedSum> sums;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const std::uint32_t root = groups.root(static_cast<std::uint32_t>(i));
    if (root == i) {
      pieces.of_facet[i] = static_cast<std::uint32_t>(sums.size());
      sums.emplace_back();
    } else {
      pieces.of_facet[i] = pieces.of_facet[root];
    }
    const Vec3 a = vertices[facets[i][0]] - centre;
    const Vec3 b = vertices[facets[i][1]] - centre;
    const Vec3 c = vertices[facets[i][2]] - centre;
    sums[pieces.of_facet[i]].add(dot(a, cross(b - a, c - a)));
  }
  for (const CompensatedSum& sum : sums) pieces.volumes.push_back(sum.value() / 6.0);
  return pieces;
}

/// Expects everything else to be known.
void measure_facing(const std::vector<Vec3>& vertices, const std::vector<FacetCorners>& facets,
                    const Pieces& pieces, const std::stop_token& stop, MeshFacts& facts) {
  if (!facts.closed() || facts.non_manifold_edges > 0) return;
  // Without knowing inside from outside, at least nothing may be inside out.
  const bool is_plain =
      facts.watertight() && facts.self_intersections == 0 && facts.self_intersections_complete;
  const WrongPieces wrong =
      is_plain ? wrong_pieces(vertices, facets, pieces, stop) : pieces_inside_out(pieces);
  const auto corner_of = [&](std::optional<std::uint32_t> piece) -> std::optional<Vec3> {
    if (!piece) return std::nullopt;
    const auto found = std::find(pieces.of_facet.begin(), pieces.of_facet.end(), *piece);
    return vertices[facets[static_cast<std::size_t>(found - pieces.of_facet.begin())].front()];
  };
  facts.oriented_outward = wrong.none();
  facts.inside_out_pieces = wrong.inside_out;
  facts.nested_pieces = wrong.nested;
  facts.places.inside_out_piece = corner_of(wrong.first_inside_out);
  facts.places.nested_piece = corner_of(wrong.first_nested);
}

/// Expects the self-intersections to be known.
void measure_topology(const TriangleMesh& mesh, const std::vector<FacetCorners>& facets,
                      const std::stop_token& stop, MeshFacts& facts) {
  TopologyCount count(mesh.vertices.size(), facets, stop);
  const Topology& topology = count.topology();
  facts.boundary_edges = topology.boundary_edges;
  facts.non_manifold_edges = topology.non_manifold_edges;
  facts.non_manifold_vertices = topology.non_manifold_vertices;
  facts.unused_vertices = mesh.vertices.size() - topology.used_vertices;
  facts.euler_characteristic = static_cast<long long>(topology.used_vertices) -
                               static_cast<long long>(topology.edges) + static_cast<long long>(facets.size());

  const auto middle = [&](const std::optional<Edge>& edge) {
    return edge ? std::optional(0.5 * (mesh.vertices[(*edge)[0]] + mesh.vertices[(*edge)[1]])) : std::nullopt;
  };
  facts.places.boundary_edge = middle(topology.boundary_edge);
  facts.places.non_manifold_edge = middle(topology.non_manifold_edge);
  if (topology.non_manifold_vertex) {
    facts.places.non_manifold_vertex = mesh.vertices[*topology.non_manifold_vertex];
  }

  const Vec3 centre = 0.5 * (facts.lower + facts.upper);
  const Pieces pieces = find_pieces(mesh.vertices, facets, count.groups(), centre);
  CompensatedSum total;
  for (const double volume : pieces.volumes) total.add(volume);
  facts.components = pieces.volumes.size();
  facts.volume = total.value();

  measure_facing(mesh.vertices, facets, pieces, stop, facts);
}

bool has_repeated_vertex(const FacetCorners& facet) {
  return facet[0] == facet[1] || facet[1] == facet[2] || facet[2] == facet[0];
}

std::vector<FacetCorners> facets_of_three_vertices(const TriangleMesh& mesh) {
  std::vector<FacetCorners> facets;
  facets.reserve(mesh.triangles.size());
  for (const FacetCorners& facet : mesh.triangles) {
    if (!has_repeated_vertex(facet)) facets.push_back(facet);
  }
  return facets;
}

bool is_degenerate(const std::vector<Vec3>& vertices, const FacetCorners& facet) {
  return has_repeated_vertex(facet) ||
         are_collinear(vertices[facet[0]], vertices[facet[1]], vertices[facet[2]]);
}

std::vector<FacetCorners> proper_facets(const TriangleMesh& mesh, const Welding& welding,
                                        const std::stop_token& stop, MeshFacts& facts) {
  std::vector<FacetCorners> facets;
  facets.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    pause(i, stop);
    const auto& [ia, ib, ic] = mesh.triangles[i];
    const FacetCorners facet{welding.leader[ia], welding.leader[ib], welding.leader[ic]};
    if (!is_degenerate(mesh.vertices, facet)) {
      facets.push_back(facet);
    } else if (!facts.places.degenerate_facet) {
      facts.places.degenerate_facet = mesh.vertices[ia];
    }
  }
  facts.degenerate_facets = mesh.triangles.size() - facets.size();
  return facets;
}

std::string place_text(Vec3 p) {
  constexpr int kDigits = 6;
  return "(" + length_text(p.x, kDigits) + ", " + length_text(p.y, kDigits) + ", " +
         length_text(p.z, kDigits) + ")";
}

/// "3 edges with one facet only: the surface is open; the first at (0 m, 5 mm, 0 m)"
std::string with_place(std::string fault, std::size_t count, const std::optional<Vec3>& place) {
  if (!place) return fault;
  return fault + (count == 1 ? "; at " : "; the first at ") + place_text(*place);
}

std::string counted(std::size_t count, const char* singular, const char* plural) {
  return std::to_string(count) + ' ' + (count == 1 ? singular : plural);
}

}  // namespace

bool MeshFacts::valid() const {
  return watertight() && oriented_outward && degenerate_facets == 0 && duplicate_vertices == 0 &&
         self_intersections == 0 && self_intersections_complete;
}

std::vector<std::string> MeshFacts::faults() const {
  std::vector<std::string> faults;
  if (triangles == 0) return {"no facets"};
  const auto report = [&faults](std::size_t count, const std::optional<Vec3>& place, const char* singular,
                                const char* plural) {
    if (count > 0) faults.push_back(with_place(counted(count, singular, plural), count, place));
  };
  report(boundary_edges, places.boundary_edge, "edge with one facet only: the surface is open",
         "edges with one facet only: the surface is open");
  report(non_manifold_edges, places.non_manifold_edge,
         "edge where three or more facets meet, or two of opposite winding",
         "edges where three or more facets meet, or two of opposite winding");
  report(non_manifold_vertices, places.non_manifold_vertex, "vertex whose facets are not one fan",
         "vertices whose facets are not one fan");
  report(degenerate_facets, places.degenerate_facet, "facet without area", "facets without area");
  report(duplicate_vertices, places.duplicate_vertex, "vertex at the position of another",
         "vertices at the position of another");
  if (!self_intersections_complete) {
    const std::string pairs =
        counted(self_intersections, "pair of facets that intersect", "pairs of facets that intersect");
    faults.push_back("at least " + with_place(pairs, self_intersections, places.self_intersection) +
                     "; the search stopped at its limit");
  } else {
    report(self_intersections, places.self_intersection, "pair of facets that intersect",
           "pairs of facets that intersect");
  }
  report(inside_out_pieces, places.inside_out_piece,
         "piece whose facets face the wrong way: inside out, and no cavity within another",
         "pieces whose facets face the wrong way: inside out, and no cavities within others");
  report(nested_pieces, places.nested_piece,
         "piece within another whose facets face the wrong way: a cavity's would face inwards",
         "pieces within others whose facets face the wrong way: a cavity's would face inwards");
  return faults;
}

MeshFacts measure(const TriangleMesh& mesh, const std::stop_token& stop) {
  check_sizes(mesh);
  require_usable_positions(mesh, 0, mesh.vertices.size(), "measured");
  require_existing_vertices(mesh, 0, mesh.triangles.size());
  const MeshBox box = box_of(mesh);
  require_measurable_size(box);

  MeshFacts facts;
  facts.vertices = mesh.vertices.size();
  facts.triangles = mesh.triangles.size();
  facts.lower = box.lower;
  facts.upper = box.upper;
  {
    const Welding welding = weld(mesh.vertices, stop);
    require_going(stop);
    facts.duplicate_vertices = welding.duplicates;
    if (welding.first_duplicate) facts.places.duplicate_vertex = mesh.vertices[*welding.first_duplicate];
    const std::vector<FacetCorners> facets = proper_facets(mesh, welding, stop, facts);
    require_going(stop);
    const SelfIntersections found = find_self_intersections(
        mesh.vertices, facets, SelfIntersectionLimits::for_facets(facets.size()), stop);
    facts.self_intersections = found.pairs;
    facts.self_intersections_complete = found.complete;
    facts.places.self_intersection = found.first;
  }
  measure_shape(mesh, stop, facts);
  require_going(stop);
  measure_topology(mesh, facets_of_three_vertices(mesh), stop, facts);
  return facts;
}

}  // namespace glissade
