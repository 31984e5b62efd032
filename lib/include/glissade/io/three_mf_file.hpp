#pragma once

#include "glissade/parts/print_piece.hpp"

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

namespace glissade {

/// Solids as 3MF (core specification 1.x) for printers: one object a piece with its name and number, in millimetres, every
/// vertex where it is printed (no transforms: readers are known that scale vertices and not transforms).
///
/// Coordinates are numbers of single precision, as readers hold them, rounded as as_written() does for binary STL: no two vertices
/// become one. Bytes depend on the pieces and on zlib alone: entries are dated 1980-01-01, there are no random identifiers.

/// @param title  of the model
/// @throws InputError if there is no piece, a piece has no triangle, or as as_written(); FileError as AtomicFile
/// @throws Interrupted if `stop` asks for it, within some milliseconds but while the bytes are compressed
void write_three_mf(const std::filesystem::path& file, const std::vector<PrintPiece>& pieces,
                    const std::string& title, const std::stop_token& stop = {});
[[nodiscard]] std::string three_mf_bytes(const std::vector<PrintPiece>& pieces, const std::string& title,
                                         const std::stop_token& stop = {});

/// Reads the objects of a 3MF file in millimetres: meshes, names, numbers. Objects made of components and transforms of items
/// are refused, not overlooked.
/// @throws FileError if the file cannot be read, is no zip archive or has no model, is damaged or cut off, or its model is
///         not of what this reader knows; says what
[[nodiscard]] std::vector<PrintPiece> read_three_mf(const std::filesystem::path& file);

/// Holds a 3MF file against the pieces that it was written from: names, numbers, every vertex and triangle.
/// @throws InternalError if anything differs; FileError as read_three_mf()
void require_same_three_mf(const std::filesystem::path& file, const std::vector<PrintPiece>& pieces);

/// Lays pieces on beds, standing as they are: each on z = 0, in rows, largest first; beds stand side by side along x, a gap of a
/// fifth of their width between them.
/// @return the same pieces in the same order, moved
/// @throws InputError with every piece that is larger than the bed: its size, the bed's
[[nodiscard]] std::vector<PrintPiece> laid_on_beds(std::vector<PrintPiece> pieces, const PrintBed& bed = {});

}  // namespace glissade
