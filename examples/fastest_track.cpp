// The fastest track between two points, and the ride down it.

#include <iostream>

#include <glissade/centerline/fastest_track.hpp>
#include <glissade/motion/motion.hpp>

int main() {
  using namespace glissade;
  const Body body{Friction::from_angle(Angle::from_degrees(17.0))};
  const FastestTrack track = fastest_track({3.0, 2.0}, body.friction, 0.0);  // 3 m out, 2 m down, from rest
  const Motion ride(track.centerline, body);
  std::cout << "length " << track.centerline->length() << " m, travel time " << ride.travel_time()
            << " s, exit speed " << ride.exit_speed() << " m/s\n";
}
