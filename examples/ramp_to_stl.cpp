// A channel swept along a track, proven and written for a printer or a workshop.

#include <iostream>

#include <glissade/centerline/fastest_track.hpp>
#include <glissade/io/mesh_file.hpp>
#include <glissade/section/cross_section.hpp>
#include <glissade/solid/mesh_facts.hpp>
#include <glissade/solid/sweep.hpp>

int main() {
  using namespace glissade;
  const Friction friction = Friction::from_angle(Angle::from_degrees(17.0));
  const FastestTrack track = fastest_track({3.0, 2.0}, friction, 0.0);
  const CrossSection section = CrossSection::u_channel(0.3, 0.12, 0.003);
  const Placement placement = Placement::through({0.0, 0.0, 2.5}, {3.0, 0.0, 0.5});
  SweepOptions options;
  options.tolerance = 0.5e-3;
  const Solid solid = sweep(*track.centerline, section, placement, options);
  const MeshFacts facts = measure(solid.mesh);
  if (!facts.valid()) return 1;
  write_mesh("ramp.stl", MeshFormat::stl_binary, solid.mesh);  // millimetres
  std::cout << facts.triangles << " triangles, " << facts.volume * 1e3 << " litres of material\n";
}
