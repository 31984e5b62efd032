#pragma once

#include <string_view>
#include <vector>

namespace glissade::data {

/// A file of lib/data, as it was when the library was built.
struct DataFile {
  std::string_view path;  ///< below lib/data: "rules/fis-in-run.yaml"
  std::string_view text;
};

/// @param folder  below lib/data: "rules"
/// @return the files in it, in the order of their names; empty if there is no such folder
[[nodiscard]] std::vector<DataFile> shipped_data(std::string_view folder);

}  // namespace glissade::data
