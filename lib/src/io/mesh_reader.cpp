#include "io/mesh_reader.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "io/stl_layout.hpp"
#include "solid/mesh_check.hpp"

#include <array>
#include <optional>

namespace glissade::io {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kWhiteSpace = " \t\r\n\f\v";

std::string_view without_leading_space(std::string_view text) {
  const std::size_t start = text.find_first_not_of(kWhiteSpace);
  return start == text.npos ? std::string_view() : text.substr(start);
}

/// @return the first word that is not in a comment
std::string_view first_word(std::string_view head) {
  head = without_leading_space(head);
  while (head.starts_with('#')) {
    const std::size_t end = head.find_first_of("\r\n");
    head = end == head.npos ? std::string_view() : without_leading_space(head.substr(end));
  }
  return head.substr(0, head.find_first_of(kWhiteSpace));
}

/// @return number of facets that a binary STL with this start claims; none if it is too short for one
std::optional<std::uint32_t> claimed_facets(std::string_view head) {
  if (head.size() < stl::kPrefixBytes) return std::nullopt;
  return stl::little_endian(head.data() + stl::kHeaderBytes);
}

FileError neither(const Reading& reading) {
  return reading.error("is neither STL nor OFF",
                       R"(STL starts with "solid" or an 80-byte header and a count, OFF with "OFF".)",
                       "to save it as STL or OFF with the program that made it");
}

TriangleMesh read_by_content(Reading& reading, std::uint64_t size) {
  constexpr std::size_t kHead = 4096;
  std::string_view head = reading.text().peek(kHead);
  if (head.empty()) throw reading.error("is empty");

  // A size that fits the count to the byte is the surest sign: some binary files start with "solid".
  const std::optional<std::uint32_t> facets = claimed_facets(head);
  if (facets && stl::file_bytes(*facets) == size) return read_stl_binary(reading);

  const bool is_text = head.find('\0') == head.npos;
  if (head.starts_with(kByteOrderMark)) {
    std::array<char, kByteOrderMark.size()> mark{};
    (void)reading.text().read(mark.data(), mark.size());
    head = reading.text().peek(kHead);
  }
  const std::string_view word = first_word(head);
  if (is_text && equals_ignoring_case(word, "solid")) return read_stl_ascii(reading);
  if (equals_ignoring_case(word.substr(word.size() - std::min<std::size_t>(word.size(), 3)), "off")) {
    return read_off(reading);
  }
  if (is_text || !facets) throw neither(reading);
  throw reading.error("as binary STL it claims " + std::to_string(*facets) + " facets, which take " +
                          std::to_string(stl::file_bytes(*facets)) + " bytes, but it has " +
                          std::to_string(size),
                      "It is truncated or damaged, or neither STL nor OFF.");
}

}  // namespace

TriangleMesh read_mesh_bytes(ByteSource& source, const std::string& name, LengthUnit unit) {
  Reading reading(source, name, unit);
  TriangleMesh mesh = read_by_content(reading, source.size());
  if (mesh.triangles.empty()) throw reading.error("holds no facets");
  if (const std::optional<double> size = solid::size_too_small(solid::box_of(mesh))) {
    throw reading.error("holds a mesh " + rounded_text(*size, 3) + " m long, too small to be measured",
                        "Sizes begin at " + rounded_text(kSmallestMeshSize, 3) + " m.");
  }
  return mesh;
}

}  // namespace glissade::io

namespace glissade {

TriangleMesh read_mesh(const std::filesystem::path& file, LengthUnit unit, const std::stop_token& stop) {
  io::FileSource source(file, stop);
  return io::read_mesh_bytes(source, file.string(), unit);
}

}  // namespace glissade
