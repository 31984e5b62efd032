#pragma once

#include "glissade/io/file_set.hpp"

#include "app/interrupt.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace glissade::app {

/// The files that a command was asked for: they take their places together or not at all, also where Ctrl-C or SIGTERM ends the
/// program meanwhile. Not to live beside another Interrupt.
class OutputFiles {
 public:
  /// @param target  as an option gave it; of an empty one nothing is made
  void make(const std::string& target, const std::function<void(const std::filesystem::path&)>& write) {
    if (!target.empty()) files_.make(target, write);
  }
  [[nodiscard]] FileSet& set() noexcept { return files_; }
  void put_in_place() { files_.commit(); }

 private:
  Interrupt interrupt_;  // before the files: it outlives them
  FileSet files_;
};

}  // namespace glissade::app
