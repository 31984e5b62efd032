#include "glissade/design/design.hpp"

#include "design/design_text.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

using namespace glissade;
using namespace glissade::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int count = 0; count < times; ++count) text += part;
  return text;
}

}  // namespace

TEST_CASE("a file that is missing, a directory or too large is refused by its name") {
  CHECK_THROWS_AS(read_design("no/such.yaml"), FileError);
  CHECK_THROWS_WITH(read_design("no/such.yaml"),
                    StartsWith("no/such.yaml: cannot read the design file: no such file"));
  CHECK_THROWS_WITH(read_design(designs_path()), Contains("it is a directory"));
}

TEST_CASE("a path that cannot be followed is not told to be without a file") {
  const TempDir scratch;
  std::filesystem::create_symlink("around.yaml", scratch / "around.yaml");
  CHECK_THROWS_WITH(read_design(scratch / "around.yaml"),
                    Contains("cannot read the design file: Too many levels of symbolic links") &&
                        Contains("Try: its path, and the permissions of the directories in it"));
  CHECK_THROWS_WITH(read_design(scratch / std::string(300, 'a')), Contains("File name too long"));
  // Permissions do not stop root.
  if (::geteuid() == 0) return;
  std::filesystem::create_directory(scratch / "closed");
  std::ofstream(scratch / "closed" / "d.yaml").put('a');
  std::filesystem::permissions(scratch / "closed", std::filesystem::perms::none);
  CHECK_THROWS_WITH(read_design(scratch / "closed" / "d.yaml"),
                    Contains("cannot read the design file: Permission denied"));
  std::filesystem::permissions(scratch / "closed", std::filesystem::perms::owner_all);
}

TEST_CASE("a file of 100 MB is refused by its size, unread") {
  const TempDir scratch;
  const std::filesystem::path file = scratch / "huge.yaml";
  std::ofstream(file).put('a');
  std::filesystem::resize_file(file, 100'000'000);
  CHECK_THROWS_AS(read_design(file), FileError);
  CHECK_THROWS_WITH(read_design(file), Contains("larger than 4 MiB"));
}

TEST_CASE("a text without a design is refused") {
  CHECK_THAT(problems_of(""), StartsWith("d.yaml: the design file is empty"));
  CHECK_THAT(problems_of("# only a comment\n"), StartsWith("d.yaml: the design file is empty"));
  CHECK_THAT(problems_of("just words"), Contains("the design is a single value, not a group of keys"));
  CHECK_THAT(problems_of(std::string("\x7f"
                                     "ELF\x02\x01\0",
                                     7)),
             Contains("d.yaml:1:1: not a text file: byte 0"));
  CHECK_THAT(problems_of("name: \xff\xfe"), Contains("d.yaml:1:7: not a text file: byte 6"));
  CHECK_THAT(problems_of("name: \xed\xa0\x80"), Contains("not a text file"));
}

TEST_CASE("control characters come into no text by their escape codes either") {
  CHECK(problems_with("name: Chute", R"(name: "\x1b[31mred")") ==
        "d.yaml:2:7: there is a control character (U+001B) in <U+001B>[31mred\n"
        "      A terminal would obey it wherever the text is printed.\n"
        "      Try: the text without it");
  CHECK_THAT(problems_with("name: Chute", R"("na\x07me": Chute)"),
             Contains("d.yaml:2:1: there is a control character (U+0007) in na<U+0007>me"));
  CHECK_THAT(problems_with("name: Chute", R"(name: "\u009b31m")"), Contains("(U+009B) in <U+009B>31m"));
  CHECK_THAT(problems_with("name: Chute", "name: \u009b31m"), Contains("(U+009B) in <U+009B>31m"));
  CHECK_THAT(problems_with("name: Chute", R"(name: "a\nb")"),
             Contains("d.yaml:2:7: name: there is a line break (U+000A) in it"));
}

TEST_CASE("bad YAML is refused where it breaks") {
  CHECK_THAT(problems_with("z: 6.2 m}", "z: 6.2 m"),
             StartsWith("d.yaml:4:10: not valid YAML: this { is not closed\n"
                        "      What first does not fit into it stands in line 5, column 9."));
  CHECK_THAT(problems_with("scad]", "scad"), StartsWith("d.yaml:11:9: not valid YAML: this [ is not closed"));
  CHECK_THAT(problems_with("name: Chute", "name: \"Chute"),
             StartsWith("d.yaml:2:7: not valid YAML: this \" is not"));
  CHECK_THAT(problems_with("name: Chute", "name: a: b"), StartsWith("d.yaml:2:8: not valid YAML"));
  CHECK_THAT(problems_with("  start", "\tstart"), StartsWith("d.yaml:4:"));
}

TEST_CASE("anchors, aliases and tags are refused: nothing expands") {
  CHECK_THAT(problems_of("a: &a [1, 1]\nb: *a"), StartsWith("d.yaml:1:4: anchors and aliases"));
  CHECK_THAT(problems_of("b: *a"), Contains("not valid YAML"));
  CHECK_THAT(problems_of("a: !!float 1"), StartsWith("d.yaml:1:4: the YAML tag"));
}

TEST_CASE("deep nesting is refused before it can exhaust the stack") {
  for (const char* opening : {"[", "{a: ", "- ", "? ", "[{a: "}) {
    INFO(opening);
    CHECK_FALSE(problems_of(repeated(opening, 200'000)).empty());
  }
  CHECK_THAT(problems_of(repeated("- ", 100)), Contains("nested deeper than 32 levels"));
  CHECK_THAT(problems_of(repeated("[", 2'000)), Contains("nested deeper than 32 levels"));
}

TEST_CASE("a list of a million values is refused before it is built") {
  CHECK_THAT(problems_of("a: [" + repeated("1,", 1'000'000) + "]"), Contains("more than 50000 values"));
}

TEST_CASE("a second document is refused") {
  CHECK_THAT(problems_of(std::string(kSoundDesign) + "---\nname: b\n"),
             Contains("something follows the end of the design"));
  CHECK_THAT(problems_of(","), Contains("something follows the end"));
}

TEST_CASE("a byte order mark and line ends of two bytes are no problem") {
  std::string text = "\xef\xbb\xbf";
  for (const char letter : kSoundDesign) text += letter == '\n' ? "\r\n" : std::string(1, letter);
  CHECK(problems_of(text).empty());
  CHECK(parse_design(text, "d.yaml").where("body.friction_angle") == "d.yaml:7:19");
}

TEST_CASE("line ends that are carriage returns alone are told so") {
  std::string text(kSoundDesign);
  std::string windows;
  for (const char letter : text) windows += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
  std::replace(text.begin(), text.end(), '\n', '\r');
  CHECK_THAT(problems_of(text), StartsWith("d.yaml:1:") &&
                                    Contains("the line ends with a carriage return (CR) alone") &&
                                    Contains("Try: to save the file with line ends LF or CRLF"));
  CHECK(problems_of(windows) == problems_of(std::string(kSoundDesign)));
}

TEST_CASE("a design in another encoding is told so") {
  std::string wide = "\xff\xfe";
  for (const char letter : kSoundDesign) wide += {letter, '\0'};
  const std::string bare = wide.substr(2);
  for (const std::string& text : {wide, bare}) {
    CHECK_THAT(problems_of(text), Contains("Try: to save it in UTF-8: it seems to be in UTF-16"));
  }
  CHECK_THAT(problems_with("name: Chute", "name: M\xfchle"),
             StartsWith("d.yaml:2:8: not a text file") &&
                 Contains("Try: to save it in UTF-8, if it is a design: a letter in another encoding"));
  CHECK_THAT(problems_of("\x7f"
                         "ELF\x02"),
             Contains("Try: the name of a design file (.yaml)"));
}

TEST_CASE("columns count characters, not bytes") {
  CHECK_THAT(problems_with("name: Chute", "n\u00e4me: Chute"),
             StartsWith("d.yaml:2:1: unknown key n\u00e4me"));
  CHECK_THAT(problems_with("{kind: fastest}", "{kind: \"f\u00e4st\", p: 1 m}"),
             Contains("d.yaml:8:14: ") || Contains("d.yaml:8:20: "));
  CHECK_THAT(problems_with("mesh: {tolerance: 0.5 mm}", "mesh: {\"t\u00f6lerance\": 1 mm, tolerance: 0 mm}"),
             Contains("d.yaml:10:38: tolerance: 0 mm is not positive"));
}

TEST_CASE("everything that once broke a YAML reader is refused with a message") {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test_data_path("corpus/design"))) {
    INFO(entry.path().filename().string());
    ++files;
    // None of them is a design: each is refused, by a message that names the file.
    CHECK_THAT(problems_of(bytes_of(entry.path())), StartsWith("d.yaml"));
  }
  CHECK(files > 20);
}
