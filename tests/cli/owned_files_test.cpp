// A design owns the files that its builds wrote, and nothing else: what stays, what goes, what is set aside.

#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace owned_files_test {

using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

constexpr const char* kSlab =
    "glissade: 1\n"
    "track: {start: {x: 0 m, z: 1 m}, finish: {x: 2 m, z: 0 m}}\n"
    "body: {friction_angle: 10 deg}\n"
    "cross_section: {kind: slab, width: 200 mm, thickness: 20 mm}\n"
    "mesh: {tolerance: 5 mm}\n";

Names names_in(const fs::path& directory) {
  Names names;
  for (const auto& entry : fs::directory_iterator(directory))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// A directory with designs a.yaml and b.yaml, both built into out/.
class Builds {
 public:
  Builds() {
    put_bytes(place_ / "a.yaml", kSlab);
    put_bytes(place_ / "b.yaml", kSlab);
  }

  Outcome build(const std::string& design, const std::string& formats) const {
    const Outcome outcome = glissade_run(
        {"build", design + ".yaml", "-o", "out", "--no-report", "--set", "export=[" + formats + "]"},
        {place_.path(), {}, {}});
    INFO(outcome.errors);
    REQUIRE(outcome.exit_code == 0);
    return outcome;
  }

  [[nodiscard]] fs::path out(const std::string& name = "") const { return place_ / "out" / name; }
  [[nodiscard]] const TempDir& place() const { return place_; }

 private:
  TempDir place_;
};

}  // namespace

TEST_CASE("a build with fewer files removes those that the design's last build wrote, and says so") {
  const Builds builds;
  builds.build("a", "stl, off, csv");
  const Outcome outcome = builds.build("a", "stl");
  CHECK(names_in(builds.out()) == Names{".a.sha256", "a.stl"});
  CHECK_THAT(outcome.output, Contains("a.off  removed: an earlier build wrote it, this one does not") &&
                                 Contains("a.csv  removed"));
}

TEST_CASE("many files of one folder that go are told as one") {
  const TempDir place;
  put_bytes(place / "a.yaml", kSlab);
  const auto run = [&](const std::string& formats) {
    return glissade_run({"build", "a.yaml", "-o", "out", "--no-report", "--set",
                         "fabrication={process: timber}", "--set", "export=[" + formats + "]"},
                        {place.path(), {}, {}});
  };
  REQUIRE(run("dxf").exit_code == 0);
  std::size_t patterns = 0;
  for (const auto& entry : fs::directory_iterator(place / "out" / "a.parts")) {
    if (entry.path().extension() == ".dxf") ++patterns;
  }
  REQUIRE(patterns >= 4);
  const Outcome outcome = run("tables");
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.output, Contains(std::to_string(patterns) +
                                      " .dxf files removed: an earlier build wrote them, this one does not"));
  CHECK_THAT(outcome.output, !Contains(".dxf  removed"));
}

TEST_CASE("two designs in one directory leave each other's files alone, reports too") {
  const Builds builds;
  for (const char* design : {"a", "b"}) {
    REQUIRE(glissade_run({"build", std::string(design) + ".yaml", "-q", "-o", "out", "--set", "export=[stl]"},
                         {builds.place().path(), {}, {}})
                .exit_code == 0);
  }
  CHECK(names_in(builds.out()) ==
        Names{".a.sha256", ".b.sha256", "a.report.html", "a.stl", "b.report.html", "b.stl"});
  builds.build("a", "off");
  CHECK(names_in(builds.out()) == Names{".a.sha256", ".b.sha256", "a.off", "b.report.html", "b.stl"});
}

TEST_CASE("designs of one name from different directories do not replace each other") {
  const Builds builds;
  for (const char* folder : {"one", "two"}) {
    fs::create_directory(builds.place() / folder);
    put_bytes(builds.place() / folder / "x.yaml", kSlab);
  }
  const auto build = [&](const std::string& folder, const std::string& from) {
    return glissade_run({"build", folder + "x.yaml", "-o", (builds.place() / "out").string(), "--no-report",
                         "--set", "export=[stl]"},
                        {builds.place() / from, {}, {}});
  };
  REQUIRE(build("one/", "").exit_code == 0);
  const std::string first = bytes_of(builds.out("x.stl"));
  const Outcome refused = build("two/", "");
  CHECK(refused.exit_code != 0);
  CHECK_THAT(refused.errors, Contains("holds files of another design of the same name, ") &&
                                 Contains("one/x.yaml") && Contains("two/x.yaml would replace them") &&
                                 Contains("another directory with -o"));
  CHECK(bytes_of(builds.out("x.stl")) == first);
  // The same file from elsewhere is the same design; one that was moved is not another.
  CHECK(build("", "one").exit_code == 0);
  fs::remove(builds.place() / "two/x.yaml");
  fs::rename(builds.place() / "one/x.yaml", builds.place() / "two/x.yaml");
  CHECK(build("two/", "").exit_code == 0);
  CHECK(names_in(builds.out()) == Names{".x.sha256", "x.stl"});
}

TEST_CASE("a design whose file has the name of another's is refused, and nothing is set aside") {
  const Builds builds;
  put_bytes(builds.place() / "a.ascii.yaml", kSlab);
  const auto build = [&](const std::string& design, const std::string& formats) {
    return glissade_run(
        {"build", design + ".yaml", "-o", "out", "--no-report", "--set", "export=[" + formats + "]"},
        {builds.place().path(), {}, {}});
  };
  builds.build("a", "stl, stl-ascii");
  const Names files{".a.sha256", "a.ascii.stl", "a.stl"};
  CHECK(names_in(builds.out()) == files);
  const std::string first = bytes_of(builds.out("a.ascii.stl"));
  const Outcome refused = build("a.ascii", "stl");
  CHECK(refused.exit_code == 5);
  CHECK_THAT(refused.errors, Contains("out/a.ascii.stl: a build of another design, ") &&
                                 Contains("a.yaml, wrote this file") &&
                                 Contains("another directory with -o"));
  CHECK(names_in(builds.out()) == files);
  CHECK(bytes_of(builds.out("a.ascii.stl")) == first);

  // The other way round as well; and without the file of that name both are built.
  CHECK(build("a.ascii", "off").exit_code == 0);
  builds.build("a", "stl");
  CHECK(build("a.ascii", "stl").exit_code == 0);
  CHECK(build("a", "stl, stl-ascii").exit_code == 5);
  CHECK(names_in(builds.out()) == Names{".a.ascii.sha256", ".a.sha256", "a.ascii.stl", "a.stl"});

  // Of a design that is gone, or of a file that was changed, it is set aside.
  fs::remove(builds.place() / "a.ascii.yaml");
  builds.build("a", "stl, stl-ascii");
  CHECK(fs::exists(builds.out("a.ascii.stl.kept")));
}

TEST_CASE("a file that was changed since it was built is not removed") {
  const Builds builds;
  builds.build("a", "stl, scad");
  put_bytes(builds.out("a.scad"), "cube(1);  // mine\n");
  const Outcome outcome = builds.build("a", "stl");
  CHECK(names_in(builds.out()) == Names{".a.sha256", "a.scad", "a.stl"});
  CHECK(bytes_of(builds.out("a.scad")) == "cube(1);  // mine\n");
  CHECK_THAT(outcome.output, !Contains("removed"));
}

TEST_CASE("a file in the way that no build wrote, or that was changed, keeps its bytes under a new name") {
  const Builds builds;
  fs::create_directory(builds.out());
  put_bytes(builds.out("a.stl"), "somebody's");
  const Outcome outcome = builds.build("a", "stl");
  CHECK(names_in(builds.out()) == Names{".a.sha256", "a.stl", "a.stl.kept"});
  CHECK(bytes_of(builds.out("a.stl.kept")) == "somebody's");
  CHECK_THAT(outcome.output,
             Contains("a.stl.kept  set aside: it was in the way and not as a build of this design wrote it"));

  put_bytes(builds.out("a.stl"), "changed");
  builds.build("a", "stl");
  CHECK(names_in(builds.out()) == Names{".a.sha256", "a.stl", "a.stl.kept", "a.stl.kept-2"});
  CHECK(bytes_of(builds.out("a.stl.kept-2")) == "changed");

  builds.build("a", "stl");  // now it is ours again
  CHECK(names_in(builds.out()) == Names{".a.sha256", "a.stl", "a.stl.kept", "a.stl.kept-2"});
}

TEST_CASE("a link in the way is set aside, and what it leads to stays as it was") {
  const Builds builds;
  fs::create_directory(builds.out());
  put_bytes(builds.place() / "precious.stl", "precious");
  fs::create_symlink(builds.place() / "precious.stl", builds.out("a.stl"));
  builds.build("a", "stl");
  CHECK(bytes_of(builds.place() / "precious.stl") == "precious");
  CHECK(fs::is_symlink(builds.out("a.stl.kept")));
  CHECK(fs::is_regular_file(fs::symlink_status(builds.out("a.stl"))));
}

TEST_CASE("a list that somebody wrote cannot make a build remove other files") {
  const Builds builds;
  builds.build("a", "stl");
  put_bytes(builds.place() / "outside.txt", "");
  put_bytes(builds.out("inside.txt"), "not empty");
  const std::string empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
  put_bytes(builds.out(".a.sha256"), empty + "  ../outside.txt\n" + empty + "  inside.txt\nnonsense\n" +
                                         empty + "  " + (builds.place() / "outside.txt").string() + "\n");
  builds.build("a", "off");
  CHECK(fs::exists(builds.place() / "outside.txt"));
  CHECK(fs::exists(builds.out("inside.txt")));
  CHECK(fs::exists(builds.out("a.stl")));  // no list says that it is ours
}

TEST_CASE("the list of a design's files is one that sha256sum checks") {
  const Builds builds;
  builds.build("a", "stl, off");
  const Outcome outcome = run_program("sha256sum", {"-c", "--strict", ".a.sha256"}, {builds.out(), {}, {}});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.output == "a.off: OK\na.stl: OK\n");
}

TEST_CASE("what killed builds left is removed by the next build; what is in use or has another name is not") {
  const Builds builds;
  fs::create_directories(builds.out(".glissade-4194000-1/new"));
  put_bytes(builds.out(".glissade-4194000-1/new/a.stl"), "half");
  fs::create_directory(builds.out(".glissade-4194000-2"));
  fs::create_directory(builds.out(".glissade-notes"));
  put_bytes(builds.out(".glissade-1-2-3"), "a file");
  const int lock = ::open(builds.out(".glissade-4194000-2").c_str(), O_RDONLY | O_DIRECTORY);
  REQUIRE(::flock(lock, LOCK_EX | LOCK_NB) == 0);
  builds.build("a", "stl");
  ::close(lock);
  CHECK(names_in(builds.out()) ==
        Names{".a.sha256", ".glissade-1-2-3", ".glissade-4194000-2", ".glissade-notes", "a.stl"});
}

}  // namespace owned_files_test
