// Writes, reads and measures meshes of 0.1, 1 and 5 million triangles. Every writer is timed in turn with one
// fwrite of the same bytes, and the counters give the ratio of the two best times: figures that hold on any
// machine.

#include "glissade/io/mesh_file.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <limits>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <benchmark/benchmark.h>

namespace {

using namespace glissade;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A torus of near-isotropic facets, some 0.6 m across.
TriangleMesh ring(std::int64_t triangles) {
  const auto across = static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles) / 6.0));
  const auto around = static_cast<std::size_t>(triangles) / (2 * across);
  return shapes::torus(0.3, 0.1, around, across);
}

/// As CGAL holds a mesh of points and indices; in millimetres.
struct Soup {
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Soup soup_of(const TriangleMesh& mesh) {
  Soup soup;
  for (const Vec3& p : mesh.vertices) soup.points.emplace_back(1000.0 * p.x, 1000.0 * p.y, 1000.0 * p.z);
  soup.triangles = mesh.triangles;
  return soup;
}

/// Times one writer and the plain fwrite of what it wrote in turn.
void time_writer(benchmark::State& state, const std::function<void(const std::string&)>& write) {
  const TempDir dir;
  const std::string target = (dir / "mesh").string();
  const std::string plain = (dir / "plain").string();
  write(target);
  const std::string bytes = bytes_of(target);
  double best_write = std::numeric_limits<double>::infinity();
  double best_fwrite = std::numeric_limits<double>::infinity();
  for ([[maybe_unused]] const auto iteration : state) {
    std::filesystem::remove(target);
    std::filesystem::remove(plain);
    best_fwrite = std::min(best_fwrite, seconds_of([&] {
                             std::FILE* file = std::fopen(plain.c_str(), "wb");
                             std::fwrite(bytes.data(), 1, bytes.size(), file);
                             std::fclose(file);
                           }));
    const double time = seconds_of([&] { write(target); });
    best_write = std::min(best_write, time);
    state.SetIterationTime(time);
  }
  state.counters["MB"] = static_cast<double>(bytes.size()) * 1e-6;
  state.counters["best_ms"] = 1e3 * best_write;
  state.counters["fwrite_ms"] = 1e3 * best_fwrite;
  state.counters["to_fwrite"] = best_write / best_fwrite;
}

void write_with_glissade(benchmark::State& state, MeshFormat format, bool is_rounded) {
  const TriangleMesh exact = ring(state.range(0));
  const TriangleMesh mesh = is_rounded ? as_written(exact, format, LengthUnit::millimetre) : exact;
  time_writer(state, [&mesh, format](const std::string& file) { write_mesh(file, format, mesh); });
}

void write_stl_with_cgal(benchmark::State& state) {
  const Soup soup = soup_of(ring(state.range(0)));
  time_writer(state, [&soup](const std::string& file) {
    CGAL::IO::write_STL(file, soup.points, soup.triangles, CGAL::parameters::use_binary_mode(true));
  });
}

void write_off_with_cgal(benchmark::State& state) {
  static constexpr int kAllDigits = 17;
  const Soup soup = soup_of(ring(state.range(0)));
  time_writer(state, [&soup](const std::string& file) {
    CGAL::IO::write_OFF(file, soup.points, soup.triangles, CGAL::parameters::stream_precision(kAllDigits));
  });
}

void read_with_glissade(benchmark::State& state, MeshFormat format) {
  const TempDir dir;
  write_mesh(dir / "mesh", format, ring(state.range(0)));
  for ([[maybe_unused]] const auto iteration : state) {
    state.SetIterationTime(seconds_of([&] { benchmark::DoNotOptimize(read_mesh(dir / "mesh")); }));
  }
}

void round_for_stl(benchmark::State& state) {
  const TriangleMesh mesh = ring(state.range(0));
  for ([[maybe_unused]] const auto iteration : state) {
    state.SetIterationTime(seconds_of(
        [&] { benchmark::DoNotOptimize(as_written(mesh, MeshFormat::stl_binary, LengthUnit::millimetre)); }));
  }
}

void measure_with_glissade(benchmark::State& state) {
  const TriangleMesh mesh = ring(state.range(0));
  for ([[maybe_unused]] const auto iteration : state) {
    bool is_valid = false;
    state.SetIterationTime(seconds_of([&] { is_valid = measure(mesh).valid(); }));
    if (!is_valid) state.SkipWithError("the ring must be valid");
  }
}

/// The self-intersection test alone, of a mesh that CGAL holds already.
void self_intersections_with_cgal(benchmark::State& state) {
  const Soup soup = soup_of(ring(state.range(0)));
  CGAL::Surface_mesh<Point> mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
  for ([[maybe_unused]] const auto iteration : state) {
    state.SetIterationTime(seconds_of(
        [&] { benchmark::DoNotOptimize(CGAL::Polygon_mesh_processing::does_self_intersect(mesh)); }));
  }
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(100'000)->Arg(1'000'000)->Arg(5'000'000)->UseManualTime()->Unit(benchmark::kMillisecond);
}

}  // namespace

BENCHMARK_CAPTURE(write_with_glissade, stl_binary, MeshFormat::stl_binary, true)->Apply(sizes);
BENCHMARK_CAPTURE(write_with_glissade, stl_binary_not_yet_rounded, MeshFormat::stl_binary, false)
    ->Apply(sizes);
BENCHMARK(write_stl_with_cgal)->Apply(sizes);
BENCHMARK_CAPTURE(write_with_glissade, stl_ascii, MeshFormat::stl_ascii, false)->Apply(sizes);
BENCHMARK_CAPTURE(write_with_glissade, off, MeshFormat::off, false)->Apply(sizes);
BENCHMARK(write_off_with_cgal)->Apply(sizes);
BENCHMARK_CAPTURE(read_with_glissade, stl_binary, MeshFormat::stl_binary)->Apply(sizes);
BENCHMARK_CAPTURE(read_with_glissade, stl_ascii, MeshFormat::stl_ascii)->Apply(sizes);
BENCHMARK_CAPTURE(read_with_glissade, off, MeshFormat::off)->Apply(sizes);
BENCHMARK(round_for_stl)->Apply(sizes);
BENCHMARK(measure_with_glissade)->Apply(sizes);
BENCHMARK(self_intersections_with_cgal)->Apply(sizes);

BENCHMARK_MAIN();
