#include "app/time_budget.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "app/option_value.hpp"

#include <CLI/CLI.hpp>

namespace glissade::app {

void TimeBudget::add_to(CLI::App& command) {
  command
      .add_option("--time-budget", text_,
                  "Longest search within limits, in processor time, e.g. 10s; then the best track so far is "
                  "taken, marked so, and the exit code is 4 [default: " +
                      rounded_text(OptimizeOptions{}.time_budget, 3) + " s]")
      ->type_name("TIME")
      ->group("Options");
}

double TimeBudget::seconds() const {
  if (text_.empty()) return OptimizeOptions{}.time_budget;
  const double seconds = option_value(text_, Dimension::time, "--time-budget");
  if (seconds > 0.0) return seconds;
  throw InputError({"--time-budget", text_ + " is not positive", "A search takes some time.", "10s"});
}

}  // namespace glissade::app
