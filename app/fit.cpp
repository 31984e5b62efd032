#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/pipeline/json.hpp"
#include "glissade/pipeline/speeds.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/option_value.hpp"
#include "app/summary.hpp"
#include "app/table.hpp"
#include "app/told_of.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kFitDescription =
    "Fit friction and drag to measured speeds, with their uncertainty and correlation, and tell how well "
    "they\n"
    "and those of the design explain each speed.\n"
    "\n"
    "The CSV file has the columns design (a design file beside it; left out where DESIGN.yaml is given), "
    "gate or\n"
    "length_m, speed_km_h or speed_m_per_s and, if wanted, before_edge_m and count.";

constexpr const char* kFitFooter =
    "Examples:\n"
    "  glissade fit designs/hills/measured_speeds.csv\n"
    "  glissade fit designs/hills/measured_speeds.csv --drag \"0.0013 1/m\"    the friction alone";

struct FitArguments {
  std::string speeds;
  std::string design;
  std::string friction;
  std::string drag;
  bool json = false;
};

std::string with_uncertainty(double value, const std::optional<double>& uncertainty, bool held, bool at_bound,
                             const std::string& unit) {
  std::string text = rounded_text(value, 4);
  if (uncertainty) text += " +- " + rounded_text(*uncertainty, 2);
  if (!unit.empty()) text += " " + unit;
  if (held) text += ", as given";
  if (at_bound) text += ", its bound: less than none would fit better";
  return text;
}

std::string resistance_text(const CommonResistance& designed) {
  const auto text = [](const std::optional<double>& value, const char* unit) {
    return value ? rounded_text(*value, 4) + unit : std::string("as each design has it");
  };
  return "friction " + text(designed.friction, "") + (designed.friction_changes ? " along its track" : "") +
         ", drag " + text(designed.drag, " 1/m");
}

std::string fit_summary(const std::vector<SpeedReading>& readings, const SpeedFit& fit,
                        const std::vector<SpeedResidual>& as_designed, const SpeedFitOptions& held) {
  Table table({"", "length [m]", "measured [m/s]", "design [m/s]", "off by", "fitted [m/s]", "off by"});
  const auto speed = [](double value) { return fixed_text(value, 2); };
  const auto excess = [&](double value) { return (value < 0.0 ? "" : "+") + fixed_text(value, 2); };
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const SpeedReading& reading = readings[i];
    table.add({reading.name, fixed_text(reading.track->length() - reading.from_start, 2),
               speed(reading.speed), speed(as_designed[i].computed), excess(as_designed[i].excess),
               speed(fit.residuals[i].computed), excess(fit.residuals[i].excess)});
  }
  std::string text = table.text() + "\n";
  text +=
      labelled("Design", resistance_text(common_resistance(readings)) + ": off by " +
                             rounded_text(rms_of(as_designed), 3) + " m/s in the root of the mean square");
  text += labelled(
      "Fitted",
      "friction " +
          with_uncertainty(fit.friction, fit.friction_uncertainty, held.friction.has_value(),
                           fit.friction_at_bound, "") +
          "\ndrag " +
          with_uncertainty(fit.drag, fit.drag_uncertainty, held.drag.has_value(), fit.drag_at_bound, "1/m") +
          "\noff by " + rounded_text(fit.rms, 3) + " m/s in the root of the mean square");
  if (!fit.correlation) return text;
  constexpr double kHardlyApart = 0.9;
  // Of a value: with less uncertainty it is told well enough, whatever goes with it.
  constexpr double kHardlyKnown = 0.2;
  std::string correlation = rounded_text(*fit.correlation, 3) + " between friction and drag";
  const auto is_known = [&](double value, const std::optional<double>& uncertainty) {
    return uncertainty && *uncertainty <= kHardlyKnown * value;
  };
  const bool known =
      is_known(fit.friction, fit.friction_uncertainty) && is_known(fit.drag, fit.drag_uncertainty);
  if (std::fabs(*fit.correlation) > kHardlyApart && !known) {
    correlation +=
        ": these speeds hardly tell the two apart;\nmore of one and less of the other explain them as well";
  }
  return text + labelled("Correlation", correlation);
}

ExitCode fit(const FitArguments& options) {
  std::optional<std::filesystem::path> design;
  if (!options.design.empty()) design = options.design;
  const std::vector<SpeedReading> readings = read_speeds(options.speeds, design);
  SpeedFitOptions held;
  if (!options.friction.empty()) {
    held.friction = option_value(options.friction, Dimension::number, "--friction-coefficient");
  }
  if (!options.drag.empty()) held.drag = option_value(options.drag, Dimension::per_length, "--drag");
  for (const auto& [name, value] :
       {std::pair{"--friction-coefficient", held.friction}, {"--drag", held.drag}}) {
    if (value && *value < 0.0)
      throw InputError({name, rounded_text(*value, 4) + " is negative", "", "0 or more"});
  }
  const SpeedFit fitted = told_of(options.speeds, [&] { return fit_speeds(readings, held); });
  const std::vector<SpeedResidual> as_designed =
      told_of(options.speeds, [&] { return speed_residuals(readings); });
  print(options.json ? fit_json(readings, fitted, as_designed)
                     : fit_summary(readings, fitted, as_designed, held));
  return ExitCode::done;
}

}  // namespace

void add_fit(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("fit", kFitDescription)->footer(kFitFooter);
  const auto options = std::make_shared<FitArguments>();
  command.add_option("speeds", options->speeds, "CSV file of measured speeds")
      ->type_name("SPEEDS.csv")
      ->required();
  command.add_option("design", options->design, "Design file of every row that names none")
      ->type_name("DESIGN.yaml");
  command
      .add_option("--friction-coefficient", options->friction, "Hold the friction at this, and fit the drag")
      ->type_name("NUMBER");
  command.add_option("--drag", options->drag, "Hold the drag at this, and fit the friction")
      ->type_name("1/LENGTH");
  add_json_flag(command, options->json, "the table");
  command.callback([options, &action] { action = [options] { return fit(*options); }; });
}

}  // namespace glissade::app
