// What a program of somebody else's does with an installed Glissade: every module is called once.

#include <iostream>

#include <glissade/core/number_text.hpp>
#include <glissade/core/units.hpp>

int main() {
  using namespace glissade;
  const Friction friction = Friction::from_angle(Angle::from_degrees(17.0));
  std::cout << "friction angle " << angle_text(friction.angle().radians()) << '\n';
}
