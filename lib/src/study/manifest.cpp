#include "study/manifest.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/version.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/report/report.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

namespace glissade::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::optional<std::string> text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw FileError({file.string(), "cannot be read", "", "its permissions"});
  return text;
}

/// Settings of one key that are tried for the files that they name.
constexpr std::uint64_t kMostSettings = 1000;

/// The files that the designs of a study name: of the base, and of every word that a key takes.
std::set<fs::path> data_files_of(const Study& study) {
  std::set<fs::path> files;
  const auto add = [&](const std::vector<Override>& values) {
    try {
      const Design design = study.source.with(values, ReachCheck::no);
      for (const DataFile& data : design.data_files) files.insert(data.file);
    } catch (const Error&) {
      return;  // the point will say why
    }
  };
  add(study.base);
  for (const Factor& factor : study.plan.factors()) {
    const bool has_words = std::any_of(factor.inputs.begin(), factor.inputs.end(),
                                       [](const Input& input) { return !input.numeric; });
    if (!has_words) continue;
    for (std::uint64_t setting = 0; setting < std::min(factor.size, kMostSettings); ++setting) {
      std::vector<Override> values = study.base;
      const std::vector<std::string> texts = factor.at(setting);
      for (std::size_t i = 0; i < texts.size(); ++i) values.push_back({factor.inputs[i].key, texts[i]});
      add(values);
    }
  }
  return files;
}

/// What designs take from other files; their contents are part of what is studied.
Json profiles_of(const Study& study) {
  Json profiles = Json::array();
  for (const fs::path& file : data_files_of(study)) {
    if (!fs::is_regular_file(file)) continue;  // the point will say so
    profiles.push_back({{"file", file.filename().string()}, {"sha256", sha256_of_file(file)}});
  }
  return profiles;
}

/// The keys of two manifests whose values differ, for people.
std::string differences(const std::string& there, const std::string& here) {
  const Json old = Json::parse(there, nullptr, false);
  const Json now = Json::parse(here);
  if (!old.is_object()) return "it is no manifest of a sweep";
  std::string keys;
  for (const auto& [key, value] : now.items()) {
    if (old.contains(key) && old[key] == value) continue;
    keys += (keys.empty() ? "" : ", ") + key;
  }
  return keys.empty() ? "other keys" : keys;
}

/// A file that appears whole and only where there is none: a hard link is refused where a name is taken.
/// @return false if there was one
bool create_exclusively(const fs::path& target, const std::string& text) {
  const fs::path written =
      target.parent_path() / (".manifest-" + std::to_string(std::random_device{}()) + ".part");
  try {
    write_atomically(written, text);
  } catch (const FileError& error) {
    // Nobody asked for a file of that name.
    std::vector<Issue> issues = error.issues();
    for (Issue& issue : issues) issue.where = target.string();
    throw FileError(std::move(issues));
  }
  std::error_code error;
  fs::create_hard_link(written, target, error);
  std::error_code ignored;
  fs::remove(written, ignored);
  if (!error) return true;
  if (fs::exists(target)) return false;
  // A file system without links: the last resort is to rename.
  write_atomically(target, text);
  return true;
}

}  // namespace

fs::path chunk_path(const fs::path& directory, std::uint64_t chunk) {
  std::string name = std::to_string(chunk);
  constexpr std::size_t kDigits = 6;
  if (name.size() < kDigits) name.insert(0, kDigits - name.size(), '0');
  return directory / "chunks" / (name + ".csv");
}

std::string manifest_text(const Study& study, const std::vector<std::string>& columns) {
  Json json;
  json["glissade_sweep"] = 1;
  json["program"] = "glissade " + std::string(version());
  json["design"] = study.source.file().filename().string();
  json["design_sha256"] = sha256_of_text(study.source.text());
  json["profiles"] = profiles_of(study);
  json["set"] = Json::array();
  for (const Override& change : study.base) json["set"].push_back(change.key_path + "=" + change.value);
  json["variations"] = Json::array();
  for (const Factor& factor : study.plan.factors()) json["variations"].push_back(factor.text);
  json["frozen"] = study.frozen;
  json["points"] = study.plan.count();
  json["rows_per_chunk"] = kChunkRows;
  json["inputs"] = Json::array();
  for (const Factor& factor : study.plan.factors()) {
    const bool independent = !factor.distributions.empty() || factor.inputs.size() == 1;
    for (const Input& input : factor.inputs) {
      json["inputs"].push_back({{"key", input.key},
                                {"unit", input.unit},
                                {"column", input.column()},
                                {"numeric", input.numeric},
                                {"independent", independent}});
    }
  }
  json["quantities"] = columns;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

namespace {

/// A manifest is placed before any rows: where these lie without one, it has been taken away, or they were copied without it.
void require_no_rows_alone(const fs::path& directory) {
  std::error_code none;
  const fs::directory_iterator first(directory / "chunks", none);
  // Looked for once more: another process may have placed both since.
  if (none || first == fs::directory_iterator() || text_of(directory / kManifestName)) return;
  throw InputError(
      {(directory / "chunks").string(),
       "rows lie here, and no " + std::string(kManifestName) + " beside them tells of which sweep",
       "Rows of different sweeps are not mixed, and none that are there are overwritten.",
       "the manifest that was written with them, or another directory with -o"});
}

}  // namespace

void place_manifest(const fs::path& directory, const std::string& text) {
  const fs::path file = directory / kManifestName;
  std::optional<std::string> there = text_of(file);
  if (!there) require_no_rows_alone(directory);
  if (!there && create_exclusively(file, text)) return;
  if (!there) there = text_of(file);
  if (there == text) return;
  throw InputError(
      {file.string(),
       "the directory holds another sweep; these differ: " + differences(there.value_or(""), text),
       "Rows of different sweeps are not mixed, and none that are there are overwritten.",
       "another directory with -o, or remove this one"});
}

Results Results::open(const fs::path& directory) {
  const fs::path file = directory / kManifestName;
  const auto text = text_of(file);
  if (!text) {
    throw FileError({file.string(), "there is no manifest of a sweep here", "",
                     "the directory that was given to 'glissade sweep' with -o"});
  }
  try {
    const Json json = Json::parse(*text);
    if (json.at("glissade_sweep") != 1 || json.at("rows_per_chunk") != kChunkRows) {
      throw FileError({file.string(), "this is the manifest of another version of sweeps", "",
                       "the program that wrote it"});
    }
    Results results;
    results.directory_ = directory;
    results.points_ = json.at("points").get<std::uint64_t>();
    for (const Json& input : json.at("inputs")) {
      results.inputs_.push_back(input.at("column"));
      results.keys_.push_back(input.at("key"));
      results.units_.push_back(input.at("unit"));
      results.numeric_.push_back(input.at("numeric"));
      results.independent_.push_back(input.at("independent"));
    }
    results.quantities_ = json.at("quantities").get<std::vector<std::string>>();
    results.design_ = json.at("design");
    results.files_ = {results.design_};
    for (const Json& profile : json.at("profiles")) results.files_.push_back(profile.at("file"));
    for (const Json& variation : json.at("variations")) {
      if (auto table = points_file_of(variation.get<std::string>()))
        results.files_.push_back(*std::move(table));
    }
    results.base_ = json.at("set").get<std::vector<std::string>>();
    results.frozen_ = json.at("frozen");
    return results;
  } catch (const nlohmann::json::exception&) {
    throw FileError({file.string(), "this is no manifest of a sweep", "It is no JSON, or keys are missing.",
                     "the directory that was given to 'glissade sweep' with -o"});
  }
}

}  // namespace glissade::study
