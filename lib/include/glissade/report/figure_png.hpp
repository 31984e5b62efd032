#pragma once

#include <filesystem>
#include <string>

namespace glissade {

/// Draws an SVG into a PNG file at `scale` pixels per CSS pixel, on white.
/// @throws InputError if the text is not an SVG drawing; FileError if the file cannot be written
void write_png(const std::filesystem::path& file, const std::string& svg, double scale = 2.0);

}  // namespace glissade
