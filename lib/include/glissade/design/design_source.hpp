#pragma once

#include "glissade/design/design.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace glissade {

/// Whether a design that no track can fulfil, since friction lets none arrive, is an error already when it is read.
enum class ReachCheck { yes, no };

/// A design file that is parsed once and read many times, each time with other values in some places.
///
/// Identity: with(overrides) is parse_design(text(), file(), overrides), problems and their places included.
/// Cost: what with() does is proportional to the size of the file, without the parsing.
class DesignSource {
 public:
  /// @throws FileError as read_design(); InputError if the text is no YAML document or is empty
  [[nodiscard]] static DesignSource read(const std::filesystem::path& file);
  /// @throws InputError likewise
  [[nodiscard]] static DesignSource parse(std::string text, std::filesystem::path file);

  /// Safe to call from several threads at once.
  /// @param reach  `no` for a design that is to be ridden on a track which is there already
  /// @throws as parse_design()
  [[nodiscard]] Design with(const std::vector<Override>& overrides, ReachCheck reach = ReachCheck::yes) const;

  /// @return other files that the design names, as Design::data_files, also where the design has problems
  [[nodiscard]] std::vector<DataFile> data_files(const std::vector<Override>& overrides = {}) const;

  [[nodiscard]] const std::string& text() const noexcept;
  [[nodiscard]] const std::filesystem::path& file() const noexcept;

 private:
  struct Parsed;
  explicit DesignSource(std::shared_ptr<const Parsed> parsed) : parsed_(std::move(parsed)) {}

  std::shared_ptr<const Parsed> parsed_;
};

}  // namespace glissade
