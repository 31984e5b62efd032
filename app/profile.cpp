#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/profile_drawing.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/interrupt.hpp"
#include "app/option_value.hpp"
#include "app/searched_track.hpp"
#include "app/table.hpp"
#include "app/time_budget.hpp"
#include "app/track_input.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kProfileDescription =
    "Draw the longitudinal section: DXF at 1:1, PDF sheets with the section, the parameters in English, "
    "German and\n"
    "French, gates and coordinates, the coordinate table as CSV, and the cross-section with its grooves as "
    "DXF.";

constexpr const char* kProfileFooter =
    "Examples:\n"
    "  glissade profile designs/hills/garmisch_hs142.yaml                  into out/garmisch_hs142/\n"
    "  glissade profile designs/hills/garmisch_hs142.yaml --step 0.5m --row run\n"
    "  glissade profile designs/hills/garmisch_hs142.yaml --offset beam=-350mm --offset tube=120mm";

struct ProfileArguments {
  DesignInput design;
  std::string directory;
  std::string step;
  std::string row = "arc-length";
  std::vector<std::string> offsets;
  TimeBudget time_budget;
  Verbosity verbosity;
};

CountedFrom row_named(const std::string& word) {
  if (word == "arc-length") return CountedFrom::arc_length;
  if (word == "to-edge") return CountedFrom::to_edge;
  if (word == "run") return CountedFrom::run;
  throw InputError({"--row", "'" + word + "' is no way to count stations", "", "arc-length, to-edge or run"});
}

ParallelLine parallel_of(const std::string& text) {
  const std::size_t sign = text.find('=');
  const std::string name = text.substr(0, sign);
  const bool named = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char letter) {
    return std::isalnum(letter) != 0 || letter == '_' || letter == '-';
  });
  if (sign == std::string::npos || !named) {
    throw InputError({"--offset", "'" + text + "' is not of the form NAME=LENGTH",
                      "A name has letters, digits, - and _; the length counts upwards, square to the track.",
                      "--offset beam=-350mm"});
  }
  return {name, option_value(text.substr(sign + 1), Dimension::length, "--offset")};
}

ProfileOptions options_of(const ProfileArguments& options) {
  ProfileOptions profile;
  if (!options.step.empty()) profile.step = option_value(options.step, Dimension::length, "--step");
  profile.row = row_named(options.row);
  for (const std::string& text : options.offsets) {
    profile.parallels.push_back(parallel_of(text));
    const std::string& name = profile.parallels.back().name;
    const auto same = std::count_if(profile.parallels.begin(), profile.parallels.end(),
                                    [&](const ParallelLine& line) { return line.name == name; });
    if (same > 1) throw InputError({"--offset", "two lines are named " + name, "", "another name"});
  }
  return profile;
}

ExitCode draw_profile(const ProfileArguments& options) {
  const ProfileOptions wanted = options_of(options);
  const Design design = options.design.read();
  const Track track = searched_track(design, options.verbosity, options.time_budget.seconds());
  const std::size_t stations = coordinate_table(design, track, wanted).size();
  const std::filesystem::path folder = options.directory.empty()
                                           ? std::filesystem::path("out") / design.file.stem()
                                           : std::filesystem::path(options.directory);
  const std::vector<std::filesystem::path> files = [&] {
    const Interrupt interrupt;  // who ends it then finds all of the files, or none
    return into_directory_of("-d", [&] { return write_profile(folder, design, track, wanted); });
  }();
  print(
      labelled("Section", files[0].generic_string()) + labelled("Sheets", files[1].generic_string()) +
          labelled("Coordinates", files[2].generic_string() + ", " + std::to_string(stations) + " stations") +
          (files.size() > 3 ? labelled("Cross-section", files[3].generic_string()) : ""),
      "All files are written, into " + folder.string() + ".");
  require_searched_through(design, track);
  return ExitCode::done;
}

}  // namespace

void add_profile(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("profile", kProfileDescription)->footer(kProfileFooter);
  const auto options = std::make_shared<ProfileArguments>();
  options->design.add_to(command);
  command.add_option("-d,--directory", options->directory, "Directory for the files [default: out/NAME]")
      ->type_name("DIR");
  command
      .add_option(
          "--step", options->step,
          "Between stations of the coordinate table [default: 1 m; on a track below 20 m or above 2 km "
          "a round length that makes some hundred]")
      ->type_name("LENGTH");
  command
      .add_option(
          "--row", options->row,
          "Stations at round values of arc-length, to-edge (along the track) or run (horizontal, from the "
          "edge) [default: arc-length]")
      ->type_name("WORD");
  command
      .add_option("--offset", options->offsets,
                  "A parallel line, square above the track or below it where negative; may be repeated")
      ->type_name("NAME=LENGTH")
      ->take_all()
      ->allow_extra_args(false);
  options->time_budget.add_to(command);
  options->verbosity.add_to(command, "Show no progress");
  command.callback([options, &action] { action = [options] { return draw_profile(*options); }; });
}

}  // namespace glissade::app
