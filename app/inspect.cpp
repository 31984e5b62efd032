#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/pipeline/json.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "app/command_line.hpp"
#include "app/console.hpp"
#include "app/option_value.hpp"
#include "app/summary.hpp"
#include "app/table.hpp"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kInspectDescription =
    "Measure any mesh file: closed, manifold, facing outward, free of self-intersection.\n"
    "\n"
    "The exit code is 0 for a valid solid, 1 for a faulty one, 5 for a file that is no mesh.";

constexpr const char* kInspectFooter =
    "Examples:\n"
    "  glissade inspect out/grain_chute/grain_chute.stl\n"
    "  glissade inspect part.off --unit m --json";

struct InspectArguments {
  std::string file;
  std::string unit = "mm";
  bool json = false;
};

LengthUnit unit_named(const std::string& name) {
  if (name == "mm") return LengthUnit::millimetre;
  if (name == "m") return LengthUnit::metre;
  throw InputError({"--unit", "'" + name + "' is not a unit of mesh files", "", "--unit mm or --unit m"});
}

std::string facts_summary(const std::string& file, const MeshFacts& facts) {
  const auto count = [](const std::string& label, std::size_t value) {
    return labelled(label, count_text(value));
  };
  std::string text = emphasised(file, Emphasis::heading) + "\n\n";
  text += count("Triangles", facts.triangles) + count("Vertices", facts.vertices) +
          count("Pieces", facts.components);
  text += labelled("Volume", volume_text(facts.volume, 6));
  text += labelled("Surface", rounded_text(facts.area, 6) + " m^2");
  text += labelled("Size", length_text(facts.upper.x - facts.lower.x) + " x " +
                               length_text(facts.upper.y - facts.lower.y) + " x " +
                               length_text(facts.upper.z - facts.lower.z));
  text += labelled("Smallest angle", angle_text(facts.smallest_angle, 3));
  text += labelled("Shortest edge", length_text(facts.shortest_edge, 3));
  text += labelled("Euler number", std::to_string(facts.euler_characteristic)) + "\n";
  if (facts.valid()) {
    return text + labelled("Verdict", emphasised("valid", Emphasis::good) +
                                          ": watertight, facing outward, no self-intersection");
  }
  std::string faults = emphasised("faulty", Emphasis::bad);
  for (const std::string& fault : facts.faults()) faults += "\n- " + fault;
  return text + labelled("Verdict", faults);
}

ExitCode inspect_mesh(const InspectArguments& options) {
  const MeshFacts facts = measure(read_mesh(options.file, unit_named(options.unit)));
  print(options.json ? mesh_json(facts) : facts_summary(options.file, facts));
  return facts.valid() ? ExitCode::done : ExitCode::faulty;
}

}  // namespace

void add_inspect(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("inspect", kInspectDescription)->footer(kInspectFooter);
  const auto options = std::make_shared<InspectArguments>();
  command.add_option("mesh", options->file, "STL (binary or ASCII) or OFF file")
      ->type_name("MESH")
      ->required();
  command.add_option("--unit", options->unit, "Unit of the file's coordinates, mm or m [default: mm]")
      ->type_name("UNIT");
  add_json_flag(command, options->json, "the summary");
  command.callback([options, &action] { action = [options] { return inspect_mesh(*options); }; });
}

}  // namespace glissade::app
