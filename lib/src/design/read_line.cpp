#include "design/read_line.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/words.hpp"
#include "glissade/io/profile_csv.hpp"

#include "core/counted.hpp"
#include "design/schema_words.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace glissade::design_file {
namespace {

constexpr std::string_view kLineExample = "[[0 m, 1 m], [5 m, 0.5 m]]";

ProfileCsvOptions read_columns(MapReader& map, Findings& findings) {
  ProfileCsvOptions options;
  if (const auto unit = map.find("unit")) {
    options.unit = map.choice(*unit, length_unit_words()).value_or(LengthUnit::metre);
  }
  const auto value = map.find("columns");
  if (!value) return options;
  const std::vector<Value> columns = as_list(*value, "[x, z]", findings, {.exactly = {2}});
  if (columns.size() == 2) {
    options.distance_column = as_text(columns[0], findings).value_or("");
    options.height_column = as_text(columns[1], findings).value_or("");
    refuse_column_twice(*value, {options.distance_column, options.height_column}, findings);
  } else if (value->node->kind == Node::Kind::sequence) {
    findings.add(value->node->at, value->key_path,
                 {"", "columns: " + core::counted(columns.size(), "name") + " instead of 2",
                  "A line needs the column of x and that of height.", "columns: [x, z]"});
  }
  return options;
}

/// A line lies in the vertical plane of the track, where one coordinate of the site alone is no distance.
std::optional<Issue> oblique_fault(const std::string& file, const ProfilePoints& points,
                                   const ProfileCsvOptions& options) {
  auto fault = distance_fault(points, options);
  if (!fault) return {};
  const std::string& other = points.other->column;
  fault->what = "file: " + file + ": " + fault->what;
  fault->hint =
      points.other->has_run
          ? fault->hint + ", if run_m counts from the start of this track"
          : "a column of the distance from the start towards the finish, sqrt(dx^2 + dy^2), of points "
            "in the vertical plane of the track; or another name for " +
                other + " if the heights do not depend on it";
  return fault;
}

/// What is wrong with the points as a line; none if nothing is.
std::optional<Issue> line_fault(const std::string& file, const ProfilePoints& points,
                                const ProfileCsvOptions& options) {
  if (points.points.size() < 2) {
    return Issue{"", "file: " + file + " has " + core::counted(points.points.size(), "point"),
                 "A line has at least two.", ""};
  }
  if (auto oblique = oblique_fault(file, points, options)) return oblique;
  for (std::size_t i = 1; i < points.points.size(); ++i) {
    if (points.points[i].x > points.points[i - 1].x) continue;
    const auto [before, here] = texts_apart(points.points[i - 1].x, points.points[i].x, &length_text);
    return Issue{"",
                 "file: " + file + ":" + std::to_string(points.lines[i]) + ": x does not grow from " +
                     before + " to " + here,
                 "A line runs from left to right and has one height at each x.",
                 "keep_outs for a shape that overhangs"};
  }
  return {};
}

std::vector<Vec2> read_file(MapReader& map, const Value& file, const std::filesystem::path& directory,
                            Findings& findings) {
  const std::string name = as_text(file, findings).value_or("");
  const ProfileCsvOptions options = read_columns(map, findings);
  // Found under the key of the points themselves, so that nobody looks for points that could not be read.
  const auto report = [&](Issue issue) {
    findings.add(file.node->at, map.path_of("line"), std::move(issue));
  };
  findings.add_data_file({directory / name, file.key_path});
  try {
    const ProfilePoints points = read_profile_csv(directory / name, options);
    if (auto fault = line_fault(name, points, options)) {
      report(*std::move(fault));
      return {};
    }
    std::vector<Vec2> line;
    line.reserve(points.points.size());
    for (const Vec2 point : points.points) line.push_back({point.x, -point.y});
    return line;
  } catch (const FileError& error) {
    Issue issue = error.issues().front();
    issue.what = "file: " + issue.where + ": " + issue.what;
    issue.where.clear();
    findings.add_file(file.node->at, map.path_of("line"), std::move(issue));
    return {};
  }
}

}  // namespace

void refuse_column_twice(const Value& value, const std::vector<std::string>& names, Findings& findings) {
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (name->empty() || std::find(names.begin(), name, *name) == name) continue;
    findings.add(value.node->at, value.key_path,
                 {"", "columns: " + shown(*name) + " is named twice",
                  "Every name stands for a number of its own.", "the columns in their order, each once"});
    return;
  }
}

std::optional<Profile> read_line(const Value& value, const std::filesystem::path& directory,
                                 Findings& findings) {
  MapReader map(value, "A line", "{line: [[0 m, 1 m], [5 m, 0.5 m]], clearance: 100 mm}", findings);
  Profile profile;
  const auto file = map.find("file");
  if (file) {
    map.expect({"file", "columns", "unit", "clearance"});
  } else {
    map.expect({"line", "file", "clearance"});
  }
  if (file) {
    profile.line = read_file(map, *file, directory, findings);
  } else if (const auto line = map.find("line")) {  // asked for first: a file stands in for it
    profile.line = as_points(*line, kLineExample, findings, {.least = 2});
  } else {
    static_cast<void>(map.need("line", kLineExample));
  }
  if (!file) {
    for (const std::string_view key : {"columns", "unit"})
      map.add_stranger(key, "file: terrain.csv beside it");
  } else {
    map.add_stranger("line", "either line or file");
  }
  profile.clearance = map.quantity("clearance", Dimension::length).value_or(0.0);
  map.refuse_unknown_keys();
  return profile;
}

}  // namespace glissade::design_file
