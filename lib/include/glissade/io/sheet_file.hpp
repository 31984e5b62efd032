#pragma once

#include "glissade/drawing/sheet.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace glissade {

/// Sheets as PDF, a page each of its own size, or SVG, a file a sheet; through cairo.
///
/// Lengths on paper are exact: 1 mm is 72/25.4 points, and a view at 1:1 is 1:1. Arcs are cubic curves within 1e-4 of their
/// radius (cairo's). Lettering is Glissade's own, as text that can be searched in PDF. Bytes depend on the sheets and on
/// cairo's version: the date of the document is fixed.

/// @param title  of the document
/// @throws InputError if there is no sheet or a number is not finite; FileError as AtomicFile
void write_pdf(const std::filesystem::path& file, const std::vector<Sheet>& sheets, const std::string& title);

/// @throws as write_pdf()
void write_svg(const std::filesystem::path& file, const Sheet& sheet);

/// @return the bytes of both
[[nodiscard]] std::string pdf_text(const std::vector<Sheet>& sheets, const std::string& title);
[[nodiscard]] std::string svg_text(const Sheet& sheet);

}  // namespace glissade
