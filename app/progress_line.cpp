#include "app/progress_line.hpp"

#include "glissade/core/number_text.hpp"

#include "app/console.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace glissade::app {
namespace {

constexpr std::chrono::seconds kPatience{1};
constexpr std::chrono::milliseconds kRedrawn{250};
constexpr double kTrustedFraction = 0.01;  // below, what is left cannot be told from what is done

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// Its log keeps every line of a terminal, and nobody watches.
bool in_continuous_integration() {
  const char* const word = std::getenv("CI");
  return word != nullptr && *word != '\0';
}

}  // namespace

ProgressLine::ProgressLine(const Verbosity& verbosity)
    : enabled_(verbosity.verbose() ||
               (!verbosity.quiet() && error_is_terminal() && !in_continuous_integration())),
      verbose_(verbosity.verbose()) {
  if (!enabled_ || verbose_) return;
  drawer_ = std::jthread([this](const std::stop_token& stop) { keep_drawing(stop); });
}

ProgressLine::~ProgressLine() {
  if (drawer_.joinable()) {
    drawer_.request_stop();
    drawer_.join();
  }
  if (shown_) print_over_line("");
}

Progress ProgressLine::callback() {
  if (!enabled_) return {};
  return [this](std::string_view stage, std::optional<double> fraction) {
    if (verbose_) {
      tell(stage);
    } else {
      note(stage, fraction);
    }
  };
}

void ProgressLine::tell(std::string_view stage) {
  if (stage == stage_) return;
  stage_ = stage;
  const double elapsed = seconds(Clock::now() - start_);
  print_error("glissade: after " + rounded_text(std::round(elapsed * 100.0) / 100.0, 6) + " s: " + stage_ +
              "\n");
}

void ProgressLine::note(std::string_view stage, std::optional<double> fraction) {
  const std::scoped_lock lock(mutex_);
  const bool changed = stage != stage_;
  const Clock::time_point now = Clock::now();
  if (!fraction_ || !fraction || *fraction < *fraction_) work_start_ = now;
  stage_ = stage;
  fraction_ = fraction;
  told_ = now;
  if (changed) draw(now);
}

void ProgressLine::keep_drawing(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, stop, kRedrawn, [&] { return stop.stop_requested(); })) draw(Clock::now());
}

void ProgressLine::draw(Clock::time_point now) {
  if (now - start_ < kPatience || stage_.empty()) return;
  print_over_line(stage_ + distance_text(now));
  shown_ = true;
}

/// How far, how long still; where nobody knows, how long so far.
std::string ProgressLine::distance_text(Clock::time_point now) const {
  std::string so_far = ", " + rounded_text(std::floor(seconds(now - start_)), 6) + " s so far";
  if (!fraction_) return so_far;
  const std::string percent = ", " + rounded_text(std::floor(*fraction_ * 100.0), 3) + " %";
  if (*fraction_ < kTrustedFraction) return percent + so_far;
  const double whole = seconds(told_ - work_start_) / *fraction_;
  const double left = whole - seconds(now - work_start_);
  return percent + ", about " + rounded_text(std::max(std::ceil(left), 1.0), 6) + " s left";
}

}  // namespace glissade::app
