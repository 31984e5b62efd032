#pragma once

namespace CLI {
class App;
}

namespace glissade::app {

/// How much a command says on standard error while it works.
class Verbosity {
 public:
  /// Adds --quiet and --verbose, which exclude each other.
  /// @param quiet_help  what --quiet leaves out of this command
  void add_to(CLI::App& command, const char* quiet_help);
  [[nodiscard]] bool quiet() const { return quiet_; }
  [[nodiscard]] bool verbose() const { return verbose_; }

 private:
  bool quiet_ = false;
  bool verbose_ = false;
};

}  // namespace glissade::app
