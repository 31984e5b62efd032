// What the program offers to shells, and each shell asked as a user asks it: by a line that is not finished.

#include "glissade/design/design.hpp"

#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

using Catch::Matchers::Contains;

namespace {

using Words = std::set<std::string>;

Words lines_of(const std::string& text) {
  Words words;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    while (line.ends_with(' ')) line.pop_back();
    if (!line.empty()) words.insert(line.substr(0, line.find('\t')));
  }
  return words;
}

Words offered(std::vector<std::string> words) {
  words.insert(words.begin(), "__complete");
  return lines_of(glissade_run(words).output);
}

bool is_installed(const std::string& program) {
  return run_program("sh", {"-c", "command -v " + program}).exit_code == 0;
}

/// A directory with the script of a shell, the program on the path, and some files to complete.
class Place {
 public:
  explicit Place(const std::string& shell) {
    put_bytes(place_ / "script", glissade_run({"completion", shell}).output);
    put_bytes(place_ / "chute.yaml", "");
    put_bytes(place_ / "chute.stl", "");
    put_bytes(place_ / "notes.txt", "");
    std::filesystem::create_directory(place_ / "chutes");
    const std::string program = glissade_program();
    path_ = "PATH=" + program.substr(0, program.rfind('/')) + ":$PATH; export PATH; ";
  }

  [[nodiscard]] Outcome run(const std::string& command) const {
    return run_program("sh", {"-c", path_ + command}, {place_.path(), {}, {}});
  }
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return place_ / name; }

 private:
  TempDir place_;
  std::string path_;
};

/// What bash would insert, were Tab pressed at the end of the words.
Words bash_offers(const Place& place, const std::string& words) {
  put_bytes(place.file("ask"), "source ./script\nCOMP_WORDS=(" + words +
                                   ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_glissade glissade\nprintf "
                                   "'%s\\n' \"${COMPREPLY[@]}\"\n");
  const Outcome outcome = place.run("bash --norc --noprofile ./ask");
  INFO(outcome.errors);
  CHECK(outcome.exit_code == 0);
  return lines_of(outcome.output);
}

Words fish_offers(const Place& place, const std::string& line) {
  const Outcome outcome = place.run(
      "HOME=$PWD XDG_CONFIG_HOME=$PWD XDG_DATA_HOME=$PWD fish --no-config -c 'source ./script; "
      "complete --do-complete \"" +
      line + "\"'");
  INFO(outcome.errors);
  CHECK(outcome.exit_code == 0);
  return lines_of(outcome.output);
}

/// Types lines and Tab after each into one zsh on a terminal of its own.
/// @return what each line then is
std::vector<std::string> zsh_completes(const Place& place, const std::vector<std::string>& lines) {
  std::string ask =
      "zmodload zsh/zpty\n"
      "zpty z env HOME=$PWD TERM=dumb PS1=READY zsh -f -i\n"
      "zpty -w z 'autoload -Uz compinit; compinit -D -u; source ./script; PS1=; unsetopt zle_bracketed_paste "
      "2>/dev/null; "
      "stty -echo 2>/dev/null; show() { print -r -- \"<<$BUFFER>>\"; zle kill-whole-line }; zle -N show; "
      "bindkey ^X show; unsetopt prompt_cr prompt_sp; print COMES-FROM-HERE'\n"
      "zpty -r z text '*COMES-FROM-HERE*COMES-FROM-HERE*'\n";
  for (const std::string& line : lines) {
    ask += "zpty -w -n z $'" + line + "\\t\\x18'\n";
    ask += "zpty -r z text '*<<*>>*'\nprint -r -- \"$text\"\n";
  }
  put_bytes(place.file("ask"), ask);
  const Outcome outcome = place.run("timeout 60 zsh -f ./ask");
  INFO(outcome.output + outcome.errors);
  std::vector<std::string> completed;
  std::size_t to = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t from = outcome.output.find("<<", to);
    REQUIRE(from != std::string::npos);
    to = outcome.output.find(">>", from);
    completed.push_back(outcome.output.substr(from + 2, to - from - 2));
  }
  return completed;
}

}  // namespace

TEST_CASE("completion offers the commands, and of each the options that its help names") {
  const Words commands = offered({""});
  CHECK(commands.size() >= 10);
  CHECK(offered({"bu"}) == Words{"build"});
  CHECK(offered({"help", "bu"}) == Words{"build"});
  CHECK(offered({"help", ""}) == commands);
  CHECK(offered({"swim", ""}) == Words{});
  for (const std::string& command : commands) {
    const std::string help = glissade_run({"help", command}).output;
    const Words options = offered({command, "--"});
    CHECK(options.contains("--help"));
    for (const std::string& option : options) {
      INFO(command << " " << option);
      CHECK_THAT(help, Contains(option));
    }
    for (std::size_t at = help.find("\n      --"); at != std::string::npos;
         at = help.find("\n      --", at + 1)) {
      const std::size_t from = at + 7;
      CHECK(options.contains(help.substr(from, help.find_first_of(" \n", from) - from)));
    }
  }
}

TEST_CASE("completion knows kinds, keys and their words, formats, figures, units, shells and files") {
  CHECK(offered({"init", "ch"}) == Words{"chute", "chute-in-plates"});
  CHECK(offered({"solve", "--centerline", "c"}) == Words{"constant-speed", "cycloid"});
  CHECK(offered({"solve", "--centerline=c"}) == Words{"--centerline=constant-speed", "--centerline=cycloid"});
  CHECK(offered({"build", "x.yaml", "--set", "cross_section.kind=u"}) ==
        Words{"cross_section.kind=u-channel"});
  CHECK(offered({"build", "x.yaml", "--set", "body.friction_a"}).contains("body.friction_angle="));
  CHECK(offered({"build", "x.yaml", "--set", "limits.slope_angle.h"}) ==
        Words{"limits.slope_angle.highest="});
  CHECK(offered({"build", "x.yaml", "--set", "limits.concave="}) ==
        Words{"limits.concave=true", "limits.concave=false"});
  CHECK(offered({"build", "x.yaml", "--set", "export=[stl,of"}) == Words{"export=[stl,off"});
  CHECK_FALSE(offered({"build", "x.yaml", "--set", "export=[off,"}).contains("export=[off,off"));
  CHECK(offered({"sweep", "x.yaml", "--vary", "mesh.tol"}) == Words{"mesh.tolerance="});
  CHECK(offered({"plot", "--what", "speed,s"}) == Words{"speed,slope"});
  CHECK(offered({"inspect", "a.stl", "--unit", ""}) == Words{"mm", "m"});
  CHECK(offered({"sweep", "--sampling", "so"}) == Words{"sobol"});
  CHECK(offered({"completion", ""}) == Words{"bash", "zsh", "fish"});
  CHECK(offered({"build", ""}) == Words{":files"});
  CHECK(offered({"build", "x.yaml", ""}) == Words{});
  CHECK(offered({"compare", "x.yaml", ""}) == Words{":files"});
  CHECK(offered({"build", "x.yaml", "-o", ""}) == Words{":directories"});
}

TEST_CASE("every key that completion offers is one that a design file may have") {
  std::size_t tried = 0;
  for (const std::string& key : offered({"build", "x.yaml", "--set", ""})) {
    INFO(key);
    REQUIRE(key.ends_with('='));
    // What the program does with --set; hundreds of starts of the program would take long: every tenth is one.
    CHECK_THROWS_WITH(glissade::read_design(shipped("grain_chute"), {{key.substr(0, key.size() - 1), "?"}}),
                      !Contains("unknown key"));
    if (tried++ % 10 != 0) continue;
    const Outcome outcome = glissade_run({"solve", shipped("grain_chute"), "--set", key + "?"});
    INFO(outcome.errors);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.errors, !Contains("unknown key"));
  }
  CHECK(tried >= 60);
}

TEST_CASE("a shell that is not known is refused") {
  const Outcome outcome = glissade_run({"completion", "tcsh"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.errors,
             Contains("'tcsh' is no shell that Glissade knows") && Contains("bash, zsh or fish"));
}

TEST_CASE("bash completes commands, options, files and what stands behind =") {
  if (!is_installed("bash")) return;
  const Place place("bash");
  CHECK(bash_offers(place, "glissade bu") == Words{"build"});
  CHECK(bash_offers(place, "glissade build --js") == Words{"--json"});
  CHECK(bash_offers(place, "glissade build chut") == Words{"chute.yaml", "chutes"});
  CHECK(bash_offers(place, "glissade inspect chute.") == Words{"chute.stl"});
  CHECK(bash_offers(place, "glissade build -o chu") == Words{"chutes"});
  // Bash takes words apart at =.
  CHECK(bash_offers(place, "glissade build x --set cross_section.kind '=' u") == Words{"u-channel"});
  CHECK(bash_offers(place, "glissade build x --set cross_section.kind '='").contains("u-channel"));
  CHECK(bash_offers(place, "glissade build x --set mesh.tol") == Words{"mesh.tolerance="});
}

TEST_CASE("fish completes commands, options, files and what stands behind =") {
  if (!is_installed("fish")) {
    WARN("fish is not installed: its completion is not tried");
    return;
  }
  const Place place("fish");
  CHECK(fish_offers(place, "glissade bu") == Words{"build"});
  CHECK(fish_offers(place, "glissade build --js") == Words{"--json"});
  CHECK(fish_offers(place, "glissade build chut") == Words{"chute.yaml", "chutes/"});
  CHECK(fish_offers(place, "glissade inspect chute.") == Words{"chute.stl"});
  CHECK(fish_offers(place, "glissade build -o chu") == Words{"chutes/"});
  CHECK(fish_offers(place, "glissade build x --set cross_section.kind=u") ==
        Words{"cross_section.kind=u-channel"});
}

TEST_CASE("zsh completes commands, options, files and what stands behind =") {
  if (!is_installed("zsh")) {
    WARN("zsh is not installed: its completion is not tried");
    return;
  }
  const Place place("zsh");
  const std::vector<std::string> typed = {"glissade bu",
                                          "glissade build --js",
                                          "glissade build chute.",
                                          "glissade inspect chute.",
                                          "glissade build x --set cross_section.kind=u",
                                          "glissade build x --set mesh.tol"};
  CHECK(zsh_completes(place, typed) ==
        std::vector<std::string>{"glissade build ", "glissade build --json ", "glissade build chute.yaml ",
                                 "glissade inspect chute.stl ",
                                 "glissade build x --set cross_section.kind=u-channel ",
                                 "glissade build x --set mesh.tolerance="});
}
