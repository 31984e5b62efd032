// What the documents say, held against the program: help texts and the first design.

#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

using Catch::Matchers::Contains;

namespace {

const std::string kProject = GLISSADE_SOURCE_DIR;

/// A stretch of a document.
struct Block {
  std::size_t from = 0;
  std::size_t length = 0;
};

/// @return what stands between the fence that opens with ```LANGUAGE after `heading` and the one that closes
/// it
Block code_block(const std::string& text, const std::string& heading, const std::string& language) {
  const std::size_t section = text.find(heading);
  REQUIRE(section != std::string::npos);
  const std::string fence = "```" + language + "\n";
  const std::size_t opening = text.find(fence, section);
  REQUIRE(opening != std::string::npos);
  const std::size_t from = opening + fence.size();
  return {from, text.find("\n```", from - 1) + 1 - from};
}

std::vector<std::string> with_help(const std::string& command) {
  if (command.empty()) return {"--help"};
  return {command, "--help"};
}

/// The lines below "Examples:", without the remarks beside them.
std::vector<std::string> examples_of(const std::string& help) {
  std::vector<std::string> examples;
  const std::string heading = "Examples:\n";
  const std::size_t start = help.find(heading);
  if (start == std::string::npos) return examples;
  std::istringstream lines(help.substr(start + heading.size()));
  for (std::string line; std::getline(lines, line) && !line.empty();) {
    line.erase(0, line.find_first_not_of(' '));
    line = line.substr(0, line.find("   "));
    // A line that ends with a backslash goes on.
    if (!examples.empty() && examples.back().ends_with("\\")) {
      examples.back().back() = ' ';
      examples.back() += line;
    } else {
      examples.push_back(line);
    }
  }
  return examples;
}

}  // namespace

TEST_CASE("docs/cli.md quotes the help of every command as the program prints it") {
  // To write the blocks anew: GLISSADE_UPDATE_GOLDEN=1 in the environment, see docs/development.md.
  const std::string path = kProject + "/docs/cli.md";
  std::string text = bytes_of(path);
  const bool update = std::getenv("GLISSADE_UPDATE_GOLDEN") != nullptr;
  for (const std::string command :
       {"",          "build", "solve",  "ride",    "compare",  "plot",      "inspect",
        "init",      "gates", "fit",    "profile", "redesign", "survey",    "rules",
        "materials", "sweep", "schema", "rewrite", "help",     "completion"}) {
    const Outcome help = glissade_run(with_help(command));
    REQUIRE(help.exit_code == 0);
    const std::string heading = command.empty() ? "## glissade\n" : "## glissade " + command + "\n";
    const Block quoted = code_block(text, heading, "text");
    if (update) {
      text.replace(quoted.from, quoted.length, help.output);
    } else {
      INFO("glissade " + command + " --help");
      CHECK(text.substr(quoted.from, quoted.length) == help.output);
    }
    std::size_t longest = 0;
    for (std::size_t from = 0; from < help.output.size();) {
      const std::size_t to = help.output.find('\n', from);
      longest = std::max(longest, to - from);
      from = to + 1;
    }
    CHECK(longest <= 110);
  }
  if (update) put_bytes(path, text);
}

TEST_CASE("every example of --help does what it says") {
  const TempDir place;
  const RunLimits here{place.path(), {}, {}};
  std::filesystem::create_directory_symlink(designs_path(), place / "designs");
  const std::string program = glissade_program();
  const std::string find = "PATH=" + program.substr(0, program.rfind('/')) + ":$PATH; ";
  std::size_t tried = 0;
  for (const std::string command : {"", "init", "build", "solve", "compare", "plot", "inspect", "gates",
                                    "fit", "profile", "redesign", "survey", "sweep", "rewrite", "help"}) {
    if (command == "inspect") {
      REQUIRE(run_program(program, {"build", "designs/grain_chute.yaml", "-q"}, here).exit_code == 0);
      std::filesystem::copy_file(place / "out/grain_chute/grain_chute.off", place / "part.off");
    }
    for (const std::string& example : examples_of(glissade_run(with_help(command)).output)) {
      INFO(example);
      if (example.find("--watch") != std::string::npos)
        continue;  // it would not end; watch_test.cpp tries it
      // Searches of seconds: what is sought is that of the tests of redesigns, too.
      const bool is_slow =
          example.find("--for least-load") != std::string::npos ||
          example.find("redesign designs/hills/garmisch_hs142.yaml --speed") != std::string::npos;
      if (is_slow && !testing::thorough()) continue;
      const Outcome outcome = run_program("sh", {"-c", find + example}, here);
      INFO(outcome.errors);
      CHECK(outcome.exit_code == 0);
      ++tried;
    }
  }
  CHECK(tried >= 20);
}

TEST_CASE("the first design of the README builds, and has at most twenty lines") {
  const std::string text = bytes_of(kProject + "/README.md");
  const Block quoted = code_block(text, "## A first design", "yaml");
  const std::string design = text.substr(quoted.from, quoted.length);
  CHECK(std::count(design.begin(), design.end(), '\n') <= 20);
  const TempDir place;
  put_bytes(place / "first.yaml", design);
  const Outcome outcome = glissade_run({"build", "first.yaml"}, {place.path(), {}, {}});
  INFO(outcome.errors);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.output, Contains("proven"));
}

TEST_CASE("the program of the README is the example of that name") {
  const std::string text = bytes_of(kProject + "/README.md");
  const Block quoted = code_block(text, "## Using the library", "cpp");
  CHECK(text.substr(quoted.from, quoted.length) == bytes_of(kProject + "/examples/fastest_track.cpp"));
}

TEST_CASE("every document that the README leads to is there") {
  const std::string text = bytes_of(kProject + "/README.md");
  std::size_t count = 0;
  for (std::size_t from = text.find("]("); from != std::string::npos; from = text.find("](", from + 1)) {
    const std::string target = text.substr(from + 2, text.find(')', from) - from - 2);
    if (target.starts_with("http") || target.starts_with("#")) continue;
    INFO(target);
    CHECK(std::filesystem::exists(kProject + "/" + target));
    ++count;
  }
  CHECK(count >= 5);
}
