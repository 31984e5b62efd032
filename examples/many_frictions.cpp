// One design at many frictions: does its track still deliver when the material sticks more?

#include <iostream>

#include <glissade/study/study.hpp>

int main() {
  using namespace glissade;
  const char* const design =
      "glissade: 1\n"
      "track: {start: {x: 0 m, z: 2.5 m}, finish: {x: 3 m, z: 0.5 m}}\n"
      "body: {friction_angle: 17 deg}\n"
      "centerline: {kind: fastest}\n"
      "cross_section: {kind: slab, width: 300 mm, thickness: 20 mm}\n"
      "mesh: {tolerance: 1 mm}\n"
      "export: [stl]\n";
  const study::Study study{DesignSource::parse(design, "chute.yaml"),
                           {},
                           study::Plan({study::vary("body.friction_angle=10deg:30deg:21")}),
                           true,  // every point rides the track for 17 deg
                           {"travel_time_s", "exit_speed_m_per_s"}};
  study::RunOptions options;
  options.directory = "frictions";
  const study::RunReport report = study::run(study, options);
  std::cout << report.points << " points in " << options.directory.string() << '\n';
}
