#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace glissade::io {

/// A file in a zip archive.
struct ZipEntry {
  std::string name;
  std::string content;
};

/// @return a zip archive (PKWARE APPNOTE 6.3) of the entries, deflated, each dated 1980-01-01, without extra fields
[[nodiscard]] std::string zip_bytes(const std::vector<ZipEntry>& entries);

/// @param name  of the archive, for messages
/// @return the entries of an archive, stored or deflated, their checksums held
/// @throws FileError if it is none, is cut off or damaged, is encrypted, or an entry would take more than 1 GiB
[[nodiscard]] std::vector<ZipEntry> unzipped(std::string_view archive, const std::string& name);

}  // namespace glissade::io
