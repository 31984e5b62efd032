#include "pipeline/files/owned_files.hpp"

#include "glissade/core/error.hpp"
#include "glissade/report/report.hpp"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace glissade::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kChecksumDigits = 64;
constexpr std::uintmax_t kLargestList = 1U << 20U;
// A comment to sha256sum.
constexpr std::string_view kDesignLine = "# design: ";

std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c == '\n') {
      text += "\\n";
    } else if (c == '\\') {
      text += "\\\\";
    } else {
      text += c;
    }
  }
  return text;
}

/// sha256sum puts a backslash before lines whose name has escaped characters.
std::string line_of(const std::string& checksum, const std::string& name) {
  const std::string text = escaped(name);
  return (text == name ? "" : "\\") + checksum + "  " + text + "\n";
}

std::string unescaped(const std::string& text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      name += text[i];
    } else {
      ++i;
      name += text[i] == 'n' ? '\n' : text[i];
    }
  }
  return name;
}

bool stays_inside(const fs::path& name) {
  return !name.empty() && name.is_relative() &&
         std::none_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
}

/// @return name and checksum; none if the line is no line of a list
std::optional<std::pair<std::string, std::string>> entry_of(std::string_view line) {
  const bool escaped = line.starts_with('\\');
  if (escaped) line.remove_prefix(1);
  if (line.size() < kChecksumDigits + 3 || line.substr(kChecksumDigits, 2) != "  ") return std::nullopt;
  const std::string checksum(line.substr(0, kChecksumDigits));
  if (checksum.find_first_not_of("0123456789abcdef") != checksum.npos) return std::nullopt;
  const std::string rest(line.substr(kChecksumDigits + 2));
  std::string name = escaped ? unescaped(rest) : rest;
  if (!stays_inside(name)) return std::nullopt;
  return std::pair{std::move(name), checksum};
}

}  // namespace

std::string OwnedFiles::list_name(const std::string& stem) {
  return "." + stem + ".sha256";
}

OwnedFiles OwnedFiles::in(const fs::path& directory, const std::string& stem) {
  OwnedFiles owned;
  owned.directory_ = directory;
  const fs::path list = directory / list_name(stem);
  std::error_code error;
  if (fs::symlink_status(list, error).type() != fs::file_type::regular) return owned;
  if (const auto size = fs::file_size(list, error); error || size > kLargestList) return owned;
  std::ifstream stream(list, std::ios::binary);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(kDesignLine)) owned.design_ = unescaped(line.substr(kDesignLine.size()));
    if (auto entry = entry_of(line)) owned.checksums_.insert(std::move(*entry));
  }
  return owned;
}

bool OwnedFiles::unchanged(const std::string& name) const {
  const auto known = checksums_.find(name);
  if (known == checksums_.end()) return false;
  const fs::path file = directory_ / name;
  std::error_code error;
  if (fs::symlink_status(file, error).type() != fs::file_type::regular) return false;
  try {
    return sha256_of_file(file) == known->second;
  } catch (const FileError&) {
    return false;  // what cannot be read cannot be known to be ours
  }
}

std::vector<std::string> OwnedFiles::names() const {
  std::vector<std::string> names;
  for (const auto& [name, checksum] : checksums_) names.push_back(name);
  return names;
}

std::optional<fs::path> OwnedFiles::other_design(const fs::path& design) const {
  if (design_.empty() || design.empty()) return std::nullopt;
  const fs::path known = (directory_ / design_).lexically_normal();
  std::error_code error;
  if (!fs::exists(known, error) || !fs::exists(design, error)) return std::nullopt;
  if (fs::equivalent(known, design, error) || error) return std::nullopt;
  return known;
}

std::string OwnedFiles::list_of(const fs::path& directory, const std::vector<std::string>& names,
                                const fs::path& design) {
  std::vector<std::string> sorted = names;
  std::sort(sorted.begin(), sorted.end());
  std::string text;
  if (!design.empty()) text += std::string(kDesignLine) + escaped(design.generic_string()) + "\n";
  for (const std::string& name : sorted) text += line_of(sha256_of_file(directory / name), name);
  return text;
}

}  // namespace glissade::pipeline
