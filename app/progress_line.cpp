#include "app/progress_line.hpp"

#include "glissade/core/number_text.hpp"

#include "app/console.hpp"

#include <cmath>

namespace glissade::app {
namespace {

constexpr std::chrono::seconds kPatience{1};
constexpr double kTrustedFraction = 0.05;  // below, what is left cannot be told from what is done

std::string time_left(double elapsed, double fraction) {
  if (fraction < kTrustedFraction) return "";
  return ", " + rounded_text(std::ceil(elapsed * (1.0 - fraction) / fraction), 3) + " s left";
}

}  // namespace

ProgressLine::ProgressLine(const Verbosity& verbosity)
    : enabled_(verbosity.verbose() || (!verbosity.quiet() && error_is_terminal())),
      verbose_(verbosity.verbose()) {}

ProgressLine::~ProgressLine() {
  if (shown_) print_error("\r\033[K");
}

Progress ProgressLine::callback() {
  if (!enabled_) return {};
  return [this](std::string_view stage, double fraction) {
    if (verbose_) {
      tell(stage);
    } else {
      show(stage, fraction);
    }
  };
}

void ProgressLine::tell(std::string_view stage) {
  if (stage == stage_) return;
  stage_ = stage;
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  print_error("glissade: after " + rounded_text(std::round(elapsed * 100.0) / 100.0, 6) + " s: " + stage_ +
              "\n");
}

void ProgressLine::show(std::string_view stage, double fraction) {
  const Clock::time_point now = Clock::now();
  if (stage != stage_) {
    stage_ = stage;
    stage_start_ = now;
  }
  if (now - start_ < kPatience) return;
  std::string line = "\r\033[K" + stage_;
  if (fraction >= 0.0) {
    const double elapsed = std::chrono::duration<double>(now - stage_start_).count();
    line += " " + rounded_text(std::floor(fraction * 100.0), 3) + " %" + time_left(elapsed, fraction);
  }
  print_error(line);
  shown_ = true;
}

}  // namespace glissade::app
