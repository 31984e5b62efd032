// 'glissade help', and the pages for man(1) that are made of the same texts.

#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <cctype>
#include <filesystem>
#include <sstream>
#include <string>

using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

/// Letters and digits alone: what setting a text in another width leaves as it is.
std::string letters_of(const std::string& text) {
  std::string letters;
  for (const char letter : text) {
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0) letters += letter;
  }
  return letters;
}

/// The commands that the program's help lists.
std::vector<std::string> commands() {
  std::vector<std::string> names;
  std::istringstream lines(glissade_run({"help"}).output);
  bool listed = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "Commands:") listed = true;
    if (line.empty() && listed && !names.empty()) break;
    if (listed && line.size() > 2 && line.starts_with("  ") && line[2] != ' ')
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return names;
}

}  // namespace

TEST_CASE("help COMMAND prints what COMMAND --help prints") {
  CHECK(glissade_run({"help"}).output == glissade_run({"--help"}).output);
  CHECK(commands().size() >= 10);
  for (const std::string& command : commands()) {
    const Outcome outcome = glissade_run({"help", command});
    INFO(command);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.output == glissade_run({command, "--help"}).output);
    CHECK_THAT(outcome.output, Contains("Usage: glissade " + command));
  }
  const Outcome slip = glissade_run({"help", "bild"});
  CHECK(slip.exit_code == 2);
  CHECK_THAT(slip.errors, Contains("there is no command bild") && Contains("Try: glissade help build"));
}

TEST_CASE("a misspelt command is told, whatever is asked of it") {
  for (const char* const option : {"--help", "-h", "--version"}) {
    const Outcome slip = glissade_run({"bild", option});
    INFO(option);
    CHECK(slip.exit_code == 2);
    CHECK(slip.output.empty());
    CHECK_THAT(slip.errors, Contains("there is no command bild") && Contains("Try: glissade build"));
  }
}

TEST_CASE("each command has a page for man, without a warning, that says what its help says") {
  const TempDir place;
  REQUIRE(glissade_run({"help", "--man-pages", (place / "man").string()}).exit_code == 0);
  std::vector<std::string> names = commands();
  CHECK(static_cast<std::size_t>(std::distance(fs::directory_iterator(place / "man"), {})) ==
        names.size() + 1);
  const bool has_man = run_program("sh", {"-c", "command -v man"}).exit_code == 0;
  if (!has_man) WARN("man is not installed: the pages are not set");
  for (const std::string& command : names) {
    const fs::path page = place / "man" / ("glissade-" + command + ".1");
    INFO(page);
    REQUIRE(fs::exists(page));
    if (!has_man) continue;
    const Outcome set =
        run_program("env", {"LC_ALL=C.UTF-8", "MANWIDTH=100", "man", "--warnings", "-l", page.string()});
    CHECK(set.exit_code == 0);
    CHECK(set.errors == "");
    const std::string said = letters_of(set.output);
    // Every line of the help, headings apart, in its letters.
    std::istringstream lines(glissade_run({"help", command}).output);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("Usage: ")) line.erase(0, 7);
      if (!line.ends_with(':')) CHECK_THAT(said, Contains(letters_of(line)));
    }
  }
}

TEST_CASE("the pages for man are the same bytes each time, and name each other") {
  const TempDir place;
  for (const char* folder : {"a", "b"}) {
    REQUIRE(glissade_run({"help", "--man-pages", (place / folder).string()}).exit_code == 0);
  }
  const std::string page = bytes_of(place / "a/glissade.1");
  CHECK(page == bytes_of(place / "b/glissade.1"));
  CHECK_THAT(page, Contains("glissade\\-build (1)"));
  CHECK_THAT(bytes_of(place / "a/glissade-build.1"), Contains(".SH EXAMPLES"));
}
