// libFuzzer target of the mesh readers: any bytes give a mesh that can be measured, or a FileError with one
// issue. Inputs of every kind are kept in tests/corpus/mesh.

#include "glissade/core/error.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "io/mesh_reader.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace glissade;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    MemorySource source(bytes);
    const TriangleMesh mesh = read_mesh_bytes(source, "input", LengthUnit::millimetre);
    if (mesh.triangles.empty() || mesh.vertices.empty()) std::abort();
    const MeshFacts facts = measure(mesh);
    if (facts.valid() != facts.faults().empty()) std::abort();
  } catch (const FileError& error) {
    if (error.issues().size() != 1 || error.issues().front().what.empty()) std::abort();
  }
  return 0;
}
