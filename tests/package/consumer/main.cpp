// What a program of somebody else's does with an installed Glissade: every header is read, every module called.

#include "every_header.hpp"

#include <filesystem>
#include <iostream>

int main() {
  using namespace glissade;
  const std::string text =
      "glissade: 1\n"
      "track: {start: {x: 0 m, z: 2.5 m}, finish: {x: 3 m, z: 0.5 m}}\n"
      "body: {friction_angle: 17 deg}\n"
      "centerline: {kind: fastest}\n"
      "limits: {slope_angle: {highest: 70 deg}}\n"
      "cross_section: {kind: slab, width: 300 mm, thickness: 20 mm}\n"
      "mesh: {tolerance: 5 mm}\n"
      "export: [off]\n";
  const Design design = parse_design(text, "consumer.yaml");
  const Build built = build(design, "consumer-out");
  for (const LimitCheck& check : built.track.limit_checks) {
    if (!check.kept()) return 1;
  }
  write_png("consumer.png",
            figures_svg({ride_figure(RideQuantity::profile, {{"track", &built.track.motion}})}));
  const study::Plan plan({study::vary("body.friction_angle=10deg:20deg:11")});
  std::cout << "friction angle " << angle_text(design.body.friction.angle()) << ", " << built.files.size()
            << " files, " << plan.count() << " points\n";
}
