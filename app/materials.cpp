// glissade materials: what the library knows of bulk solids, each number with where it comes from.

#include "glissade/design/materials.hpp"

#include "glissade/core/nearest_word.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/words.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/table.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kMaterialsDescription =
    "List what is known of bulk solids and liners, with source and certainty.";

constexpr const char* kMaterialsFooter =
    "Examples:\n"
    "  glissade materials           all of them, with bulk density and wall friction\n"
    "  glissade materials wheat     one, on each liner, each number with its source\n"
    "  glissade materials uhmwpe    all materials on one liner";

std::string range_text(double low, double nominal, double high, Dimension dimension) {
  const std::string middle = quantity_text(nominal, dimension, 3);
  if (low == high) return middle;
  return quantity_text(low, dimension, 3) + " to " + quantity_text(high, dimension, 3);
}

/// "trade, to be checked": nothing that nobody read may look like a measurement.
std::string certainty_text(Certainty certainty) {
  return std::string(word(certainty)) + (needs_checking(certainty) ? ", to be checked" : "");
}

std::string density_text(const Material& material) {
  if (!material.density) return "-";
  const MaterialDensity& density = *material.density;
  return range_text(density.low, density.nominal, density.high, Dimension::density);
}

std::string friction_text(const FrictionFound& found) {
  return range_text(found.low.radians(), found.nominal.radians(), found.high.radians(), Dimension::angle);
}

std::string listing(const MaterialLibrary& library) {
  Table table({"material", "bulk density", "wall friction", "name"});
  for (const Material& material : library.materials) {
    std::optional<Angle> low;
    std::optional<Angle> high;
    for (const WallFriction& friction : material.friction) {
      low = low ? std::min(*low, friction.low) : friction.low;
      high = high ? std::max(*high, friction.high) : friction.high;
    }
    const std::string angles =
        low ? range_text(low->radians(), low->radians(), high->radians(), Dimension::angle) : "-";
    table.add({material.word, density_text(material), angles, material.name});
  }
  std::string liners;
  for (const Liner& liner : library.liners) liners += (liners.empty() ? "" : ", ") + liner.word;
  return table.text() + "\nliners: " + liners +
         "\n\nWall friction over all liners. 'glissade materials WORD' tells each with its source.\n";
}

void add_source(std::string& text, const MaterialSource& source) {
  text += "  (" + source.text + "; " + certainty_text(source.certainty) + ")\n";
}

std::string details(const Material& material, const MaterialLibrary& library) {
  std::string text = emphasised(material.name, Emphasis::heading) + "\n";
  if (material.density) {
    text += "  bulk density " + density_text(material) + "\n";
    add_source(text, material.density->from);
  }
  if (material.lateral_pressure_ratio) {
    text += "  lateral pressure ratio " + rounded_text(material.lateral_pressure_ratio->value, 3) + "\n";
    add_source(text, material.lateral_pressure_ratio->from);
  }
  if (material.highest_speed) {
    text += "  no faster than " + quantity_text(material.highest_speed->value, Dimension::speed) + ": " +
            material.highest_speed->why + "\n";
    add_source(text, material.highest_speed->from);
  }
  for (const Liner& liner : library.liners) {
    const auto found = friction_on(material, liner);
    if (!found) continue;
    text += "\n  on " + liner.word + ": " + friction_text(*found) + ", nominal " +
            angle_text(found->nominal, 3) + "\n";
    for (const WallFriction& friction : found->from) {
      text += "    " + range_text(friction.low.radians(), friction.nominal.radians(), friction.high.radians(),
                                  Dimension::angle);
      if (!friction.wall_class.empty()) text += " of walls " + friction.wall_class;
      if (friction.moisture) {
        text += " at " + rounded_text(100.0 * *friction.moisture->lowest, 3) + " to " +
                rounded_text(100.0 * *friction.moisture->highest, 3) + " % moisture";
      }
      text += "\n    ";
      add_source(text, friction.from);
    }
  }
  for (const std::string& warning : material.warnings) text += "\n  warning: " + warning + "\n";
  return text;
}

/// Materials that have something on a liner.
std::string on_liner(const Liner& liner, const MaterialLibrary& library) {
  Table table({"material", "on " + liner.word, "nominal", "certainty"});
  for (const Material& material : library.materials) {
    const auto found = friction_on(material, liner);
    if (!found) continue;
    table.add({material.word, friction_text(*found), angle_text(found->nominal, 3),
               certainty_text(found->certainty())});
  }
  return table.text();
}

ExitCode list_materials(const std::string& wanted) {
  const MaterialLibrary& library = shipped_materials();
  if (wanted.empty()) {
    print(listing(library));
    return ExitCode::done;
  }
  if (const Material* const material = library.material(wanted)) {
    print(details(*material, library));
    return ExitCode::done;
  }
  if (const Liner* const liner = library.liner(wanted)) {
    print(on_liner(*liner, library));
    return ExitCode::done;
  }
  std::vector<std::string_view> words;
  for (const Material& material : library.materials) words.push_back(material.word);
  for (const Liner& liner : library.liners) words.push_back(liner.word);
  const std::string_view near = nearest_word(wanted, words);
  throw InputError({"", shown(wanted) + " is neither a material nor a liner of the library", "",
                    near.empty() ? "'glissade materials', which lists them" : std::string(near)});
}

}  // namespace

void add_materials(CLI::App& program, Action& action) {
  const auto wanted = std::make_shared<std::string>();
  CLI::App& command = *program.add_subcommand("materials", kMaterialsDescription)->footer(kMaterialsFooter);
  command.add_option("WORD", *wanted, "a material or a liner, for all that is known of it");
  command.callback([wanted, &action] { action = [wanted] { return list_materials(*wanted); }; });
}

}  // namespace glissade::app
