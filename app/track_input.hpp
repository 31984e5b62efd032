#pragma once

#include "glissade/design/design.hpp"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace glissade::app {

/// --set KEY=VALUE, any number of times.
class Overrides {
 public:
  void add_to(CLI::App& command);
  /// @throws InputError if one has no "="
  [[nodiscard]] std::vector<Override> values() const;
  [[nodiscard]] bool empty() const { return texts_.empty(); }

 private:
  std::vector<std::string> texts_;
};

/// The design file that a command works on, and what --set replaces in it.
class DesignInput {
 public:
  /// @param what  told of the file in the help
  void add_to(CLI::App& command, const char* what = "Design file");
  /// @throws as read_design()
  [[nodiscard]] Design read() const;

 private:
  std::string file_;
  Overrides overrides_;
};

/// Where a track comes from: a design file, or the options that say the same in one line.
class TrackInput {
 public:
  /// What a command works on: one track, or one of every kind.
  enum class Scope { one_kind, every_kind };

  explicit TrackInput(Scope scope) : scope_(scope) {}

  void add_to(CLI::App& command);

  /// @param default_friction  taken where no option gives any; none: then one is needed
  /// @return the design that was given; its locations name the options where there is no file
  /// @throws InputError if the options are incomplete, contradict each other or have wrong values; else as
  ///         read_design()
  [[nodiscard]] Design design(const std::optional<Friction>& default_friction = {}) const;
  /// @return what --set replaces, in every design of the command
  [[nodiscard]] std::vector<Override> overrides() const { return overrides_.values(); }

 private:
  [[nodiscard]] Design from_options(const std::optional<Friction>& default_friction) const;
  [[nodiscard]] Friction friction(const std::optional<Friction>& default_friction) const;
  [[nodiscard]] std::vector<std::string> options_given() const;

  Scope scope_;
  std::string file_;
  Overrides overrides_;
  std::string run_;
  std::string drop_;
  std::string friction_angle_;
  std::string friction_coefficient_;
  std::string entry_speed_;
  std::string drag_;
  std::string gravity_;
  std::string centerline_;
  std::string p_;
};

}  // namespace glissade::app
