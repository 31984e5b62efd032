#pragma once

#include "support/program.hpp"
#include "support/temp_dir.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>

/// Second opinions on written files, from programs not ours. A missing program fails the test that asks.

/// What OpenSCAD said about a program and the solid that it made of it.
struct OpenscadResult {
  std::string output;
  std::string off;  ///< the solid as OFF text
  /// OpenSCAD's exact geometry found a closed, manifold solid.
  [[nodiscard]] bool simple() const { return output.find("Simple:        yes") != std::string::npos; }
  [[nodiscard]] bool clean() const {
    return output.find("WARNING") == std::string::npos && output.find("ERROR") == std::string::npos;
  }
};

/// Renders OpenSCAD source.
/// @throws std::runtime_error with its output if OpenSCAD fails or is missing
inline OpenscadResult openscad_render(const std::string& source) {
  const TempDir dir;
  put_bytes(dir / "in.scad", source);
  const std::string result = (dir / "out.off").string();
  const Outcome run = run_program("openscad", {"-o", result, (dir / "in.scad").string()});
  if (run.exit_code != 0) throw std::runtime_error("openscad failed:\n" + run.output + run.errors);
  return {run.output + run.errors, bytes_of(result)};
}

/// @return source that puts `solid` through exact geometry without changing it: OpenSCAD looks at nothing
///         when it prints a bare polyhedron, so a small cube far away is taken off
inline std::string scad_with_difference(const std::string& solid) {
  return "difference() { " + solid + " translate([1e6, 1e6, 1e6]) cube(1); }\n";
}

/// Takes a written .scad file by `use`, or an .stl or .off file by `import`, through a boolean operation.
inline OpenscadResult openscad_check(const std::filesystem::path& file) {
  const std::string name = std::filesystem::absolute(file).string();
  if (file.extension() == ".scad") {
    return openscad_render("use <" + name + ">\n" + scad_with_difference("glissade_solid();"));
  }
  return openscad_render(scad_with_difference("import(\"" + name + "\", convexity = 10);"));
}

/// What admesh found to repair in an STL file, from its table.
struct AdmeshResult {
  std::string output;
  /// Everything that it fixes is 0 and every edge has its partner.
  [[nodiscard]] bool repaired_nothing() const {
    for (const char* line : {"Total disconnected facets        :     0 ", "Degenerate facets     :     0",
                             "Edges fixed           :     0", "Facets removed        :     0",
                             "Facets added          :     0", "Facets reversed       :     0",
                             "Backwards edges       :     0", "Normals fixed         :     0"}) {
      if (output.find(line) == std::string::npos) return false;
    }
    return true;
  }
};

/// @throws std::runtime_error with its output if admesh fails or is missing
inline AdmeshResult admesh_check(const std::filesystem::path& file) {
  const Outcome run = run_program("admesh", {file.string()});
  if (run.exit_code != 0) throw std::runtime_error("admesh failed:\n" + run.output + run.errors);
  return {run.output};
}
