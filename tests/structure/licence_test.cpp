// The source is MIT, and what is linked with it must not make a binary GPL: of CGAL, whose packages are LGPL or
// GPL, the library uses headers under the former alone, down to the last one that they include.

#include "support/catch.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace licence_test {

namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::vector<std::string> cgal_headers_in(const std::string& text) {
  static const std::regex kInclude(R"(#\s*include\s*<(CGAL/[^>]+)>)");
  std::vector<std::string> headers;
  for (std::sregex_iterator match(text.begin(), text.end(), kInclude), end; match != end; ++match) {
    headers.push_back((*match)[1]);
  }
  return headers;
}

std::string licence_of(const std::string& text) {
  static const std::regex kLicence(R"(SPDX-License-Identifier:\s*([^\n]*))");
  std::smatch match;
  return std::regex_search(text, match, kLicence) ? match[1].str() : "no licence named";
}

bool is_gpl(const std::string& licence) {
  return licence.find("GPL") != std::string::npos && licence.find("LGPL") == std::string::npos;
}

}  // namespace

TEST_CASE("licence: no header of CGAL that the library includes is under the GPL") {
  std::vector<std::string> open;
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(fs::path(GLISSADE_SOURCE_DIR) / "lib")) {
    const fs::path extension = entry.path().extension();
    if (extension != ".cpp" && extension != ".hpp") continue;
    for (std::string& header : cgal_headers_in(text_of(entry.path()))) open.push_back(std::move(header));
  }
  REQUIRE_FALSE(open.empty());
  std::set<std::string> seen;
  while (!open.empty()) {
    const std::string header = open.back();
    open.pop_back();
    const fs::path file = fs::path(CGAL_HEADERS) / header;
    if (!fs::exists(file) || !seen.insert(header).second) continue;
    const std::string text = text_of(file);
    INFO(header << ": " << licence_of(text));
    CHECK_FALSE(is_gpl(licence_of(text)));
    for (std::string& included : cgal_headers_in(text)) open.push_back(std::move(included));
  }
  CHECK(seen.size() > 100);
}

TEST_CASE("licence: the look at headers does find the GPL") {
  CHECK(is_gpl(licence_of(text_of(fs::path(CGAL_HEADERS) / "CGAL/box_intersection_d.h"))));
  CHECK_FALSE(is_gpl(licence_of(text_of(fs::path(CGAL_HEADERS) / "CGAL/intersections.h"))));
}

}  // namespace licence_test
