#include "study/sobol.hpp"

#include <boost/random/sobol.hpp>

namespace glissade::study {

std::vector<std::uint64_t> sobol_point(std::size_t dimensions, std::uint64_t index) {
  std::vector<std::uint64_t> point(dimensions, 0);
  // The generator leaves out the sequence's first point, the origin; with it every first 2^m points are evenly laid.
  if (index == 0) return point;
  boost::random::sobol sequence(dimensions);
  sequence.seed(index - 1);
  for (std::uint64_t& coordinate : point) coordinate = sequence();
  return point;
}

}  // namespace glissade::study
