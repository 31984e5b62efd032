// Who may include whom (docs/development.md, layers), held against the sources as they are.

#include "support/catch.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace layering_test {

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"core", {}},
    {"centerline", {"core"}},
    {"motion", {"core", "centerline"}},
    {"clearance", {"core", "centerline"}},
    {"task", {"core", "centerline", "motion", "clearance"}},
    {"data", {}},
    {"trades", {"core", "centerline", "motion", "task"}},
    {"referee", {"core", "centerline", "motion", "clearance", "task"}},
    {"optimize", {"core", "centerline", "motion", "clearance", "task", "referee"}},
    {"section", {"core"}},
    {"route", {"core", "centerline"}},
    {"solid", {"core", "centerline", "section", "route"}},
    {"parts", {"core", "centerline", "motion", "section", "route", "solid"}},
    {"design", {"core", "centerline", "clearance", "task", "trades", "section", "parts", "data", "io"}},
    {"drawing", {"core", "centerline", "motion", "section", "route", "solid", "parts"}},
    {"io", {"core", "centerline", "motion", "section", "route", "solid", "parts", "trades", "drawing"}},
    {"report",
     {"core", "centerline", "motion", "clearance", "task", "referee", "optimize", "section", "route", "solid",
      "parts", "trades", "design", "io"}},
    {"pipeline",
     {"core", "centerline", "motion", "clearance", "task", "referee", "optimize", "section", "route", "solid",
      "parts", "drawing", "trades", "design", "io", "report"}},
    {"study",
     {"core", "centerline", "motion", "task", "trades", "referee", "optimize", "section", "design", "io",
      "report", "pipeline"}},
};

/// Third parties by the start of their include path, and the modules whose .cpp files and private headers may
/// name them.
const std::map<std::string, std::set<std::string>> kThirdParties = {
    {"CGAL/", {"solid"}},        {"nlopt", {"centerline", "optimize"}},
    {"yaml-cpp/", {"design"}},   {"boost/", {"centerline", "motion", "trades", "solid", "pipeline", "study"}},
    {"fmt/", {"report"}},        {"nlohmann/", {"design", "report", "pipeline", "study"}},
    {"openssl/", {"report"}},    {"librsvg/", {"report"}},
    {"cairo", {"report", "io"}}, {"zlib", {"io"}},
    {"tbb/", {"study"}},
};

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> includes_of(const std::string& text) {
  static const std::regex kInclude(R"re((?:^|\n)[ \t]*#[ \t]*include[ \t]*["<]([^">]+)[">])re");
  std::vector<std::string> names;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), kInclude); match != std::sregex_iterator();
       ++match) {
    names.push_back((*match)[1]);
  }
  return names;
}

/// @return the module that a path below lib/ or an include path belongs to; empty if none
std::string module_of(const std::string& path) {
  static const std::regex kModule(R"re(^(?:lib/include/|lib/src/)?(?:glissade/)?([a-z_]+)(?:\.hpp$|/))re");
  std::smatch match;
  if (!std::regex_search(path, match, kModule)) return "";
  return kMayInclude.contains(match[1]) ? std::string(match[1]) : "";
}

/// @return what breaks the layers in one file of lib/; `path` is relative to the project
std::vector<std::string> violations(const std::string& path, const std::string& text) {
  std::vector<std::string> found;
  const std::string module = module_of(path);
  if (module.empty()) return {path + " belongs to no module that kMayInclude knows"};
  const bool is_public = path.starts_with("lib/include/");
  for (const std::string& include : includes_of(text)) {
    const std::string other = module_of(include);
    if (!other.empty() && other != module && !kMayInclude.at(module).contains(other)) {
      found.push_back(path + " includes " + include + ", but " + module + " may not know " + other);
    }
    for (const auto& [prefix, modules] : kThirdParties) {
      if (!include.starts_with(prefix)) continue;
      if (is_public) found.push_back(path + " is public and includes " + include);
      if (!modules.contains(module)) found.push_back(path + " includes " + include);
    }
  }
  return found;
}

/// Folders of one module, the lowest first: each may know those before it, and what lies in none of them all.
const std::map<std::string, std::vector<std::string>> kFolders = {
    {"centerline", {"numerics", "optima", "profile"}},
    {"optimize",
     {"algebra", "discretise", "problem", "descent", "mesh", "search", "conflicts", "prices", "answer",
      "least_bound"}},
    {"parts", {"curves", "bodies", "shop", "plates", "supports", "strips", "tubes", "timber", "prints"}},
    {"pipeline", {"task", "ride", "rules", "redesign", "drawings", "files", "build"}},
};

/// @return what breaks the order of folders in one file of a module; `path` is relative to the project
std::vector<std::string> folder_violations(const std::string& path, const std::string& text) {
  static const std::regex kFolder(R"re(^(?:lib/src/)?([a-z_]+)/([a-z_]+)/)re");
  std::vector<std::string> found;
  const auto folder_of = [](const std::string& name) {
    std::smatch match;
    const bool has_one = std::regex_search(name, match, kFolder) && kFolders.contains(match[1]);
    return has_one ? std::pair(std::string(match[1]), std::string(match[2]))
                   : std::pair<std::string, std::string>();
  };
  const auto [module, folder] = folder_of(path);
  if (module.empty()) return found;
  const std::vector<std::string>& order = kFolders.at(module);
  const auto place = std::find(order.begin(), order.end(), folder);
  if (place == order.end()) return {path + " lies in a folder that kFolders does not know"};
  for (const std::string& include : includes_of(text)) {
    const auto [other_module, other] = folder_of(include);
    const bool is_private = !include.starts_with("glissade/") && include.starts_with(module + "/");
    if (!is_private) continue;
    if (other_module.empty() || std::find(order.begin(), place + 1, other) == place + 1)
      found.push_back(path + " includes " + include + ", which stands above it");
  }
  return found;
}

/// @return the namespace that what a private header of the module declares belongs to
std::string private_namespace(const std::string& module) {
  // Two folders are named as a public function or type is.
  if (module == "optimize") return "glissade::optimizer";
  if (module == "design") return "glissade::design_file";
  return "glissade::" + module;
}

/// @return types that a header defines outside any other, each with its namespace
std::vector<std::string> types_defined(const std::string& text) {
  static const std::regex kLine(
      R"re((?:^|\n)(?:namespace ([a-z_:]+) \{|(?:class|struct|enum class|enum)[ ]+(\w+)[^;\n]*\{|using (\w+) =))re");
  std::vector<std::string> types;
  std::string space;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), kLine); match != std::sregex_iterator();
       ++match) {
    if ((*match)[1].matched) space = (*match)[1];
    if ((*match)[2].matched) types.push_back(space + "::" + std::string((*match)[2]));
    if ((*match)[3].matched) types.push_back(space + "::" + std::string((*match)[3]));
  }
  return types;
}

/// @return lines of a public header in which an angle is a bare double, functions of arc length and stated bounds
///         apart
std::vector<std::string> bare_angles(const std::string& text) {
  static const std::regex kBare(R"(\bdouble\b.*\[rad\]|\bdouble (\w*_)?(angle|tilt|lean|azimuth)\b)");
  static const std::regex kFine(R"(constexpr double|\(double s\b|^ *///|_( = [^;]*)?;)");
  std::vector<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_search(line, kBare) && !std::regex_search(line, kFine)) found.push_back(line);
  }
  return found;
}

std::vector<fs::path> sources_below(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(GLISSADE_SOURCE_DIR) / folder)) {
    const std::string extension = entry.path().extension().string();
    if (entry.is_regular_file() && (extension == ".hpp" || extension == ".cpp"))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string relative_name(const fs::path& file) {
  return fs::relative(file, GLISSADE_SOURCE_DIR).generic_string();
}

/// @return the functions of a source that are longer than so many lines, with their length
std::vector<std::string> long_functions(const std::string& text, std::size_t most) {
  static const std::regex kBegins(
      R"(^(  )?(?! |namespace|class|struct|enum|if |for |while |switch |else|do |return|case )[^=]*\(.*\{$)");
  static const std::regex kContinues(
      R"(^(  )?(?! |namespace|class|struct|enum|if |for |while |switch |else|return|case |//)[^=;{}]*\([^;{}]*$)");
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  std::vector<std::string> found;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::size_t body = i;
    if (!std::regex_search(lines[i], kBegins)) {
      // A signature over several lines.
      if (!std::regex_search(lines[i], kContinues)) continue;
      while (body + 1 < lines.size() && !lines[body].ends_with("{") && !lines[body].ends_with(";") &&
             !lines[body].ends_with("}"))
        ++body;
      if (!lines[body].ends_with(" {")) continue;
    }
    const std::string close = std::string(lines[i].find_first_not_of(' '), ' ') + "}";
    std::size_t end = body;
    while (end < lines.size() && lines[end] != close) ++end;
    if (end < lines.size() && end - i + 1 > most) {
      found.push_back(lines[i] + " " + std::to_string(end - i + 1));
    }
    i = body;
  }
  return found;
}

/// @return the sources below some folders that a pattern is found in
std::set<std::string> files_with(const std::regex& pattern,
                                 const std::vector<std::string>& folders = {"lib", "app"}) {
  std::set<std::string> names;
  for (const std::string& folder : folders) {
    for (const fs::path& file : sources_below(folder)) {
      if (std::regex_search(text_of(file), pattern)) names.insert(relative_name(file));
    }
  }
  return names;
}

}  // namespace

TEST_CASE("a file that reaches into a layer above it is found out") {
  CHECK(violations("lib/src/motion/ride.cpp", "#include \"glissade/centerline/centerline.hpp\"\n").empty());
  CHECK(violations("lib/src/motion/ride.cpp", "#include \"optimize/knots.hpp\"\n").size() == 1);
  CHECK(violations("lib/include/glissade/core/vec.hpp", "#include \"glissade/pipeline.hpp\"\n").size() == 1);
  CHECK(violations("lib/src/solid/facts.cpp", "#include <CGAL/Surface_mesh.h>\n").empty());
  CHECK(violations("lib/include/glissade/solid/facts.hpp", "#include <CGAL/Surface_mesh.h>\n").size() == 1);
  CHECK(violations("lib/src/motion/ride.cpp", "#include <nlopt.hpp>\n").size() == 1);
  CHECK(violations("lib/src/gadgets/ride.cpp", "").size() == 1);
}

TEST_CASE("every file of the library includes only what its layer may know") {
  std::vector<std::string> found;
  const std::vector<fs::path> files = sources_below("lib");
  for (const fs::path& file : files) {
    for (const std::string& violation : violations(relative_name(file), text_of(file))) {
      found.push_back(violation);
    }
  }
  CHECK(files.size() >= 20);
  CHECK(found == std::vector<std::string>{});
}

TEST_CASE("folders of a module know only those below them") {
  CHECK(
      folder_violations("lib/src/optimize/mesh/a.cpp", "#include \"optimize/descent/search.hpp\"\n").empty());
  CHECK(folder_violations("lib/src/optimize/descent/a.cpp", "#include \"optimize/mesh/switches.hpp\"\n")
            .size() == 1);
  CHECK(folder_violations("lib/src/parts/curves/a.cpp", "#include \"parts/plates.hpp\"\n").size() == 1);
  CHECK(folder_violations("lib/src/parts/gadgets/a.cpp", "").size() == 1);
  CHECK(folder_violations("lib/src/parts/plates.cpp", "#include \"parts/tubes/mitred_pipe.hpp\"\n").empty());
  std::vector<std::string> found;
  std::size_t seen = 0;
  for (const auto& [module, order] : kFolders) {
    for (const fs::path& file : sources_below("lib/src/" + module)) {
      ++seen;
      for (const std::string& violation : folder_violations(relative_name(file), text_of(file)))
        found.push_back(violation);
    }
  }
  CHECK(seen > 250);
  CHECK(found == std::vector<std::string>{});
}

TEST_CASE("what a private header declares lies in a namespace of its module") {
  std::vector<std::string> found;
  static const std::regex kNamespace(R"re(\nnamespace ([a-z_:]+) \{)re");
  for (const fs::path& file : sources_below("lib/src")) {
    if (file.extension() != ".hpp") continue;
    const std::string name = relative_name(file);
    const std::string text = text_of(file);
    const std::string wanted = private_namespace(module_of(name));
    for (auto match = std::sregex_iterator(text.begin(), text.end(), kNamespace);
         match != std::sregex_iterator(); ++match) {
      const std::string space = (*match)[1];
      if (space != wanted && !space.starts_with(wanted + "::"))
        found.push_back(name + " opens namespace " + space);
    }
  }
  CHECK(found == std::vector<std::string>{});
}

TEST_CASE("no two headers define a type of one name in one namespace") {
  CHECK(types_defined("namespace glissade::io {\nstruct Trim {\nclass Ahead;\nusing Ids = int;\n") ==
        std::vector<std::string>{"glissade::io::Trim", "glissade::io::Ids"});
  std::map<std::string, std::string> known;
  std::vector<std::string> found;
  for (const fs::path& file : sources_below("lib")) {
    if (file.extension() != ".hpp") continue;
    for (const std::string& type : types_defined(text_of(file))) {
      const auto [entry, fresh] = known.emplace(type, relative_name(file));
      if (!fresh) found.push_back(type + " in " + entry->second + " and " + relative_name(file));
    }
  }
  CHECK(known.size() >= 100);
  CHECK(found == std::vector<std::string>{});
}

TEST_CASE("no third party's name appears in a public header") {
  static const std::regex kForeignNamespace(R"(\b(CGAL|nlopt|YAML|boost|fmt|nlohmann|tbb)::)");
  CHECK(files_with(kForeignNamespace, {"lib/include"}) == std::set<std::string>{});
}

TEST_CASE("elementary functions come from glissade/core/math.hpp, whose bits no processor changes") {
  static const std::regex kProcessorsOwn(
      R"(\bstd::(a?sinh?|a?cosh?|a?tanh?|atan2|exp2?|expm1|log(2|10|1p)?|pow|hypot|cbrt|erfc?|[lt]gamma)\b)"
      R"(|boost::math::(sin_pi|cos_pi|expm1|log1p|cbrt|powm1|hypot)\b)");
  CHECK(std::regex_search("std::sin(x)", kProcessorsOwn));
  CHECK(std::regex_search("&std::atan2", kProcessorsOwn));
  CHECK_FALSE(std::regex_search("std::sqrt(x) + std::fma(x, y, z) + math::sin(x)", kProcessorsOwn));
  CHECK(files_with(kProcessorsOwn) == std::set<std::string>{});
}

TEST_CASE(
    "public headers take and give an angle as Angle, where it is no sample of a curve nor plane geometry") {
  // docs/decisions/0008-angles-at-the-edges.md
  const std::set<std::string> samples = {
      "centerline/centerline.hpp", "centerline/coulomb_brachistochrone.hpp",
      "centerline/cubic_bend.hpp", "centerline/tabulated_curve.hpp",
      "parts/arc_spline.hpp",      "motion/law.hpp",
      "io/profile_csv.hpp"};
  const std::set<std::string> plane_geometry = {"core/math.hpp", "core/arc_path.hpp", "section/outline.hpp"};
  CHECK(bare_angles("  double slope_angle = 0.0;\n  double turn = 0.0;  ///< of it all [rad]\n").size() == 2);
  CHECK(bare_angles("  Angle angle;\n  double slope_angle(double s) const;\n  double angle_;\n").empty());
  std::vector<std::string> found;
  for (const fs::path& file : sources_below("lib/include/glissade")) {
    const std::string name = relative_name(file).substr(std::string("lib/include/glissade/").size());
    if (samples.contains(name) || plane_geometry.contains(name)) continue;
    for (const std::string& line : bare_angles(text_of(file))) found.push_back(name + ": " + line);
  }
  CHECK(found == std::vector<std::string>{});
}

TEST_CASE("degrees are made by Angle alone, and a quarter turn has one name") {
  static const std::regex kOwnFactor(
      R"((180\.0|180) ?/ ?\S*pi\b|pi ?/ ?180|57\.29577|0\.0174532|3\.14159|6\.28318|1\.57079)"
      R"(|constexpr double k\w+ = (0\.5 \* std::numbers::pi|std::numbers::pi / 2(\.0)?);)");
  CHECK(std::regex_search("angle * (180.0 / std::numbers::pi)", kOwnFactor));
  CHECK(std::regex_search("constexpr double kFlat = std::numbers::pi / 2.0;", kOwnFactor));
  CHECK_FALSE(std::regex_search("const double turn = 2.0 * std::numbers::pi;", kOwnFactor));
  CHECK(files_with(kOwnFactor) == std::set<std::string>{"lib/include/glissade/core/units.hpp"});
}

TEST_CASE("a limit, a format, a section and a law stand in the files that docs/development.md names") {
  const auto files_naming = [](const std::string& words) {
    return files_with(std::regex("\\b(" + words + ")\\b"));
  };
  const std::string in = "lib/include/glissade/";
  CHECK(files_naming("highest_curvature_load") ==
        std::set<std::string>{in + "task/limits.hpp", "lib/src/task/limit_catalogue.cpp",
                              "lib/src/referee/watches.cpp", "lib/src/optimize/problem/measures.cpp"});
  // One of three that a design without `export` gets, which makes it five here.
  CHECK(files_naming("write_scad|ExportFormat::scad") ==
        std::set<std::string>{in + "core/file_format.hpp", "lib/src/pipeline/files/formats.cpp",
                              in + "io/scad_file.hpp", "lib/src/io/scad_writer.cpp",
                              in + "design/design.hpp"});
  CHECK(files_naming("VChannel") ==
        std::set<std::string>{in + "section/measures.hpp", "lib/src/section/shapes.cpp",
                              "lib/src/section/cross_section.cpp", "lib/src/parts/plates/plate_section.cpp"});
  CHECK(files_naming("RollingBall|RollingDesign") ==
        std::set<std::string>{in + "motion/laws/rolling_ball.hpp", "lib/src/motion/laws/rolling_ball.cpp",
                              in + "design/body_design.hpp", "lib/src/pipeline/task/body.cpp"});
}

TEST_CASE("every constant of the search says where it comes from") {
  // docs/optimization.md, method; indices and constants of the language apart.
  static const std::set<std::string> kNames = {"kNodes",    "kOwn",      "kZeta",      "kFirst",
                                               "kSecond",   "kLength",   "kUnlimited", "kInfinity",
                                               "kOfLength", "kMeasures", "kWear"};
  static const std::regex kConstant(
      R"(^ *(?:static |inline )*constexpr [^=({]*\b(k[A-Z]\w*)(?:\[\d*\])? ?[={])");
  static const std::regex kOrigin(
      R"(//.*\b([Tt]heory|[Aa]ccuracy|[Rr]ounding|[Bb]udget|[Mm]easured|[Tt]aste)\b)");
  std::vector<std::string> found;
  std::size_t seen = 0;
  for (const fs::path& file : sources_below("lib/src/optimize")) {
    std::istringstream lines(text_of(file));
    std::string comment;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t begins = line.find_first_not_of(' ');
      const bool is_comment = begins != std::string::npos && line.compare(begins, 2, "//") == 0;
      std::smatch match;
      if (std::regex_search(line, match, kConstant) &&
          (!kNames.contains(match[1]) || std::regex_search(line, kOrigin))) {
        ++seen;
        if (!std::regex_search(line, kOrigin) && !std::regex_search(comment, kOrigin)) {
          found.push_back(relative_name(file) + ": " + line);
        }
      }
      comment = is_comment ? comment + line : "";
    }
  }
  CHECK(seen > 80);
  CHECK(found == std::vector<std::string>{});
}

TEST_CASE("a function is a page long: longer ones are known by name, and are to get shorter") {
  constexpr std::size_t kPage = 65;
  CHECK(long_functions("int f(int a,\n      int b) {\n  g();\n}\nint h() {\n}\n", 3) ==
        std::vector<std::string>{"int f(int a, 4"});
  const std::set<std::string> known = {"void Transcription::add_law_parts("};
  std::vector<std::string> found;
  for (const char* folder : {"lib", "app"}) {
    for (const fs::path& file : sources_below(folder)) {
      for (const std::string& function : long_functions(text_of(file), kPage)) {
        const bool is_known = std::any_of(known.begin(), known.end(), [&](const std::string& name) {
          return function.find(name) != std::string::npos;
        });
        if (!is_known) found.push_back(relative_name(file) + ": " + function);
      }
    }
  }
  CHECK(found == std::vector<std::string>{});
}

TEST_CASE("the README names the packages that each component links") {
  const std::map<std::string, std::string> names = {
      {"NLopt", "NLopt"}, {"sleef", "SLEEF"},     {"yaml-cpp", "yaml-cpp"}, {"cairo", "cairo"},
      {"ZLIB", "zlib"},   {"OpenSSL", "OpenSSL"}, {"fmt", "fmt"},           {"librsvg", "librsvg"},
      {"TBB", "TBB"},     {"Threads", ""}};
  std::istringstream readme(text_of(fs::path(GLISSADE_SOURCE_DIR) / "README.md"));
  std::vector<std::string> rows;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with("| `")) rows.push_back(line);
  }
  static const std::regex kNeeds(R"(glissade_needs(?:_module)?\((\w+) ([\w-]+))");
  std::size_t found = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(GLISSADE_SOURCE_DIR) / "lib/src")) {
    if (entry.path().filename() != "CMakeLists.txt") continue;
    const std::string text = text_of(entry.path());
    for (std::sregex_iterator match(text.begin(), text.end(), kNeeds), end; match != end; ++match) {
      ++found;
      const std::string component = "`" + (*match)[1].str() + "`";
      const std::string& package = names.at((*match)[2]);
      const bool told = std::any_of(rows.begin(), rows.end(), [&](const std::string& row) {
        return row.find(component) != std::string::npos && row.find(package) != std::string::npos;
      });
      INFO(component << " links " << package);
      CHECK(told);
    }
  }
  CHECK(found >= 10);
}

TEST_CASE("the program sees nothing of the library but its public headers") {
  std::vector<std::string> found;
  for (const fs::path& file : sources_below("app")) {
    for (const std::string& include : includes_of(text_of(file))) {
      const bool is_private = !include.starts_with("glissade/") && !module_of(include).empty();
      if (is_private) found.push_back(relative_name(file) + " includes " + include);
    }
  }
  CHECK(found == std::vector<std::string>{});
}

TEST_CASE("no file of the project names a path of one machine") {
  // Put together here so that this file does not name one either.
  static const std::regex kMachinePath(std::string(R"((^|[^A-Za-z0-9_.\]})/]))") + "/(wor" + "k|roo" +
                                       "t|hom" + "e|tm" + "p|Users)/");
  static const std::set<std::string> kSkipped = {"build", "out", ".git", "node_modules"};
  static const std::set<std::string> kText = {".hpp", ".cpp",  ".txt", ".cmake", ".in",
                                              ".md",  ".yaml", ".yml", ".sh",    ".json",
                                              ".csv", ".scad", ".ts",  ".js",    ""};
  std::vector<std::string> found;
  auto entry = fs::recursive_directory_iterator(GLISSADE_SOURCE_DIR);
  for (; entry != fs::recursive_directory_iterator(); ++entry) {
    if (kSkipped.contains(entry->path().filename().string())) {
      if (entry->is_directory()) entry.disable_recursion_pending();
    } else if (entry->is_regular_file() && kText.contains(entry->path().extension().string())) {
      const std::string text = text_of(entry->path());
      if (text.size() < 2'000'000 && std::regex_search(text, kMachinePath)) {
        found.push_back(relative_name(entry->path()));
      }
    }
  }
  CHECK(found == std::vector<std::string>{});
}

}  // namespace layering_test
