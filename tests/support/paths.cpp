#include "support/paths.hpp"

std::string test_data_path(const std::string& relative) {
  return std::string(GLISSADE_TEST_DATA) + "/" + relative;
}

std::string designs_path(const std::string& relative) {
  const std::string folder = GLISSADE_DESIGNS;
  return relative.empty() ? folder : folder + "/" + relative;
}
