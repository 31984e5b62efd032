#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace glissade {

/// The formats that a design can ask for in `export`.
enum class ExportFormat { stl, stl_ascii, off, scad, csv };

/// What a file tells of a solid.
enum class FileContent {
  rounded_mesh,  ///< its facets, coordinates in single precision
  exact_mesh,    ///< its facets, every double exactly
  exact_model,  ///< its facets and its centerline, every double exactly, as a program that other programs run
  stations      ///< points along the track, no facets
};

/// One format, as everybody but its writer needs to know it.
struct FileFormat {
  ExportFormat format = ExportFormat::stl;
  std::string_view word;           ///< that a design file uses
  std::string_view ending;         ///< of the file's name
  std::string_view ending_beside;  ///< where another file of the same set has `ending`
  FileContent content = FileContent::exact_mesh;
};

/// Every format, in the order of the enumeration: the one table that reader, names, costs and proof follow. How a
/// format is written and read back stands in the table of lib/src/pipeline/files/formats.cpp.
inline constexpr std::array<FileFormat, 5> kFileFormats = {{
    {ExportFormat::stl, "stl", ".stl", ".stl", FileContent::rounded_mesh},
    {ExportFormat::stl_ascii, "stl-ascii", ".stl", ".ascii.stl", FileContent::exact_mesh},
    {ExportFormat::off, "off", ".off", ".off", FileContent::exact_mesh},
    {ExportFormat::scad, "scad", ".scad", ".scad", FileContent::exact_model},
    {ExportFormat::csv, "csv", ".csv", ".csv", FileContent::stations},
}};

/// @return the table's row of a format
[[nodiscard]] constexpr const FileFormat& file_format(ExportFormat format) {
  return kFileFormats[static_cast<std::size_t>(format)];
}

/// @return the word that a design file uses, e.g. "stl-ascii"
[[nodiscard]] constexpr std::string_view word(ExportFormat format) {
  return file_format(format).word;
}

}  // namespace glissade
