#include "glissade/design/design.hpp"

#include "design/design_text.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

using namespace glissade;
using namespace glissade::test;

namespace {

/// The YAML blocks of docs/design-file.md.
std::vector<std::string> examples() {
  const std::string page = bytes_of(designs_path("../docs/design-file.md"));
  constexpr std::string_view kOpening = "```yaml\n";
  std::vector<std::string> blocks;
  for (std::size_t at = page.find(kOpening); at != std::string::npos; at = page.find(kOpening, at)) {
    at += kOpening.size();
    const std::size_t end = page.find("```", at);
    blocks.push_back(page.substr(at, end - at));
    at = end;
  }
  return blocks;
}

}  // namespace

TEST_CASE("every whole design in the reference reads without a problem") {
  int designs = 0;
  for (const std::string& example : examples()) {
    if (!example.starts_with("glissade: 1")) continue;
    ++designs;
    CHECK(problems_of(example) == "");
  }
  CHECK(designs == 2);
}

TEST_CASE("every part of a design in the reference reads in its place") {
  int parts = 0;
  for (const std::string& example : examples()) {
    INFO(example);
    if (example.starts_with("# in track:")) {
      ++parts;
      for (const char* finish : {"{x: 5.4 m, z: free}", "{x: 5.4 m, z: {lowest: 0 m, highest: 2 m}}",
                                 "{x: {lowest: 4 m}, z: 1.1 m}"}) {
        REQUIRE(example.find(finish) != std::string::npos);
        CHECK(problems_with("{x: 5.4 m, z: 1.1 m}", finish) == "");
      }
    } else if (example.starts_with("# in track, to an edge:")) {
      ++parts;
      const std::size_t edge = example.find("\nedge:") + 1;
      const std::size_t start = example.find("\nstart:") + 1;
      REQUIRE(start > edge);
      const std::string to_edge = "  " + example.substr(edge, start - edge);
      const std::string limits = "limits: {exit_speed: {lowest: 9 m/s}}\n";
      constexpr std::string_view kEnds = "  start: {x: 0 m, z: 6.2 m}\n  finish: {x: 5.4 m, z: 1.1 m}\n";
      for (const std::string& ends : {to_edge, to_edge + "  " + example.substr(start)}) {
        std::string text = sound_design_with(kEnds, ends);
        CHECK(problems_of(text.insert(text.find("centerline:"), limits)) == "");
      }
    } else if (example.starts_with("# in body:")) {
      ++parts;
      std::string keys = example.substr(example.find('\n') + 1);
      for (std::size_t at = keys.find('\n'); at + 1 < keys.size(); at = keys.find('\n', at + 1)) {
        keys.insert(at + 1, "  ");
      }
      // A friction that changes rides on tracks that are given.
      const bool given = keys.starts_with("friction:");
      const std::string text = sound_design_with("friction_angle: 17 deg\n", keys + "limits: {}\n");
      CHECK(problems_of(text, {{"centerline.kind", given ? "straight" : "fastest"}}) == "");
    } else if (example.starts_with("# in design:")) {
      ++parts;
      std::string text = sound_design_with("centerline: {kind: fastest}\n", example);
      text.erase(text.find("  finish"), std::string_view("  finish: {x: 5.4 m, z: 1.1 m}\n").size());
      CHECK(problems_of(text) == "");
    }
  }
  CHECK(parts == 6);
}

TEST_CASE("the errors that the reference shows are those that are told") {
  const std::string page = bytes_of(designs_path("../docs/design-file.md"));
  const auto shown = [&](std::string_view part, std::string_view replacement) {
    std::string text;
    for (const char letter : problems_with(part, replacement)) {
      text += letter;
      if (letter == '\n') text += "    ";
    }
    const std::size_t start = text.find("d.yaml");
    text.replace(0, start + 6, "    chute.yaml");
    return page.find(text) != std::string::npos;
  };
  CHECK(shown("17 deg", "17 mm"));
  CHECK(shown("4 mm", "500 mm"));
  CHECK(shown("z: 6.2 m}", "z: 6.2 m"));
  CHECK(shown("17 deg", "48 deg"));
}

TEST_CASE("the reference counts the designs that are shipped, and has every word of export") {
  const std::string page = bytes_of(designs_path("../docs/design-file.md"));
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(designs_path("")))
    count += entry.path().extension() == ".yaml" ? 1 : 0;
  // Whoever adds one counts anew, in the README too.
  CHECK(count == 24);
  CHECK(page.find("`designs/` holds twenty-four that") != std::string::npos);
  CHECK(bytes_of(designs_path("../README.md")).find("(designs): twenty-four designs") != std::string::npos);
  const std::string exports = page.substr(page.find("## mesh, export"));
  for (const auto& format : kWorkshopFiles) {
    CAPTURE(std::string(format.word));
    CHECK(exports.find("`" + std::string(format.word) + "`") != std::string::npos);
  }
}
