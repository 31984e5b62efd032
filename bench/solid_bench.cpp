// Sweeps solids of 0.1, 1 and 5 million triangles along short and long tracks, and puts them through the
// self-intersection test, ours and CGAL's.

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/solid/mesh_facts.hpp"
#include "glissade/solid/sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <benchmark/benchmark.h>

namespace {

using namespace glissade;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

/// A fastest track of the given run, half as deep, mu = 0.2.
CoulombBrachistochrone track_of(double run) {
  return CoulombBrachistochrone(Endpoints{run, 0.5 * run}, Friction::from_coefficient(0.2));
}

enum Shape : std::int64_t { chute, trough, pipe };

CrossSection section_of(std::int64_t shape) {
  switch (shape) {
    case trough:
      return CrossSection::half_pipe(0.4, 0.004);
    case pipe:
      return CrossSection::pipe(0.4, 0.004);
    default:
      return CrossSection::u_channel(0.4, 0.25, 0.004);
  }
}

const char* name_of(std::int64_t shape) {
  constexpr std::array<const char*, 3> kNames{"u-channel", "half-pipe", "pipe"};
  return kNames.at(static_cast<std::size_t>(shape));
}

/// The options with which a solid gets about so many triangles: the tolerance that asks for them.
SweepOptions options_for(const Centerline& track, const CrossSection& section, std::int64_t triangles) {
  const auto wanted = static_cast<double>(triangles);
  SweepOptions options;
  options.shape_triangles = static_cast<std::size_t>(triangles);
  options.tolerance = 0.5e-3;
  for (int i = 0; i < 20; ++i) {
    const auto count = static_cast<double>(sweep(track, section, Placement(), options).mesh.triangles.size());
    if (std::fabs(count / wanted - 1.0) < 0.05) break;
    options.tolerance *= std::clamp(count / wanted, 0.1, 10.0);
  }
  return options;
}

/// What the arguments name: run of the track [m], shape of the section, about how many triangles, azimuth [deg].
struct Task {
  explicit Task(const benchmark::State& state)
      : track(track_of(static_cast<double>(state.range(0)))),
        section(section_of(state.range(1))),
        options(options_for(track, section, state.range(2))),
        placement({}, Angle::from_degrees(static_cast<double>(state.range(3)))) {}

  [[nodiscard]] Solid solid() const { return sweep(track, section, placement, options); }

  CoulombBrachistochrone track;
  CrossSection section;
  SweepOptions options;
  Placement placement;
};

void label(benchmark::State& state, const Solid& solid) {
  state.SetLabel(name_of(state.range(1)));
  state.counters["triangles"] = static_cast<double>(solid.mesh.triangles.size());
  state.counters["deviation_um"] = 1e6 * solid.max_deviation;
}

void sweep_solid(benchmark::State& state) {
  const Task task(state);
  Solid solid;
  for ([[maybe_unused]] const auto iteration : state) solid = task.solid();
  label(state, solid);
  state.counters["M_triangles_per_s"] =
      benchmark::Counter(1e-6 * static_cast<double>(solid.mesh.triangles.size() * state.iterations()),
                         benchmark::Counter::kIsRate);
}

void measure_solid(benchmark::State& state) {
  const Solid solid = Task(state).solid();
  MeshFacts facts;
  for ([[maybe_unused]] const auto iteration : state) facts = measure(solid.mesh);
  if (!facts.valid()) state.SkipWithError("the solid must be valid");
  label(state, solid);
  state.counters["smallest_angle_deg"] = facts.smallest_angle.degrees();
}

/// The self-intersection test alone, of a mesh that CGAL holds already.
template <typename Triangles>
void test_with_cgal(benchmark::State& state, const std::vector<Point>& points, const Triangles& triangles) {
  CGAL::Surface_mesh<Point> mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  bool meets = false;
  for ([[maybe_unused]] const auto iteration : state) {
    meets = CGAL::Polygon_mesh_processing::does_self_intersect(mesh);
  }
  if (meets) state.SkipWithError("CGAL finds a self-intersection");
}

void self_intersections_with_cgal(benchmark::State& state) {
  const Solid solid = Task(state).solid();
  std::vector<Point> points;
  for (const Vec3& p : solid.mesh.vertices) points.emplace_back(p.x, p.y, p.z);
  test_with_cgal(state, points, solid.mesh.triangles);
  label(state, solid);
}

/// Facets of one plane to the last digit keep CGAL's predicates from an early answer. Walls along an axis are
/// such planes; in general coordinates are rounded and they are not.
constexpr std::int64_t kAlongAxis = 0;
constexpr std::int64_t kAcrossAxes = 30;

/// What CGAL's test costs where all facets are of one plane and nearly isotropic.
void self_intersections_of_flat_sheet_with_cgal(benchmark::State& state) {
  constexpr std::size_t kSide = 707;
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  const Placement placement({}, Angle::from_degrees(static_cast<double>(state.range(0))));
  for (std::size_t i = 0; i <= kSide; ++i) {
    for (std::size_t j = 0; j <= kSide; ++j) {
      const Vec3 p = placement.to_space(1e-3 * static_cast<double>(i), 1e-3 * static_cast<double>(j), 0.2);
      points.emplace_back(p.x, p.y, p.z);
      if (i == kSide || j == kSide) continue;
      const std::size_t corner = i * (kSide + 1) + j;
      const std::size_t next = corner + kSide + 1;
      triangles.push_back({corner, next, next + 1});
      triangles.push_back({corner, next + 1, corner + 1});
    }
  }
  test_with_cgal(state, points, triangles);
  state.counters["triangles"] = static_cast<double>(triangles.size());
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const std::int64_t triangles : {100'000, 1'000'000, 5'000'000}) {
    benchmark->Args({5, chute, triangles, kAlongAxis});
  }
  benchmark->Unit(benchmark::kMillisecond);
}

void shapes_of_a_million(benchmark::internal::Benchmark* benchmark) {
  for (const std::int64_t run : {1, 5, 100, 1000}) {
    for (const std::int64_t shape : {chute, trough, pipe}) {
      for (const std::int64_t azimuth : {kAlongAxis, kAcrossAxes}) {
        benchmark->Args({run, shape, 1'000'000, azimuth});
      }
    }
  }
  benchmark->Unit(benchmark::kMillisecond)->Iterations(1);
}

}  // namespace

BENCHMARK(sweep_solid)->Apply(sizes);
BENCHMARK(measure_solid)->Apply(shapes_of_a_million);
BENCHMARK(self_intersections_with_cgal)->Apply(shapes_of_a_million);
BENCHMARK(self_intersections_of_flat_sheet_with_cgal)
    ->Arg(kAlongAxis)
    ->Arg(kAcrossAxes)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

BENCHMARK_MAIN();
