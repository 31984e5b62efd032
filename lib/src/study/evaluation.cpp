#include "study/evaluation.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "study/table_file.hpp"

#include <algorithm>
#include <exception>
#include <map>
#include <set>
#include <utility>

namespace glissade::study {
namespace {

/// Far beyond what any search takes: a row must not depend on how fast the machine is.
constexpr double kNoTimeBudget = 1e9;

/// Of a ride that does not arrive.
Status status_of(RideEnd end) {
  switch (end) {
    case RideEnd::arrived:
      return Status::arrived;
    case RideEnd::stalled:
      return Status::stalled;
    case RideEnd::lifted_off:
      return Status::left_track;
    case RideEnd::does_not_fit:
      return Status::does_not_fit;
    case RideEnd::choked:
      return Status::choked;
    case RideEnd::flies_over_start:
      return Status::flies_over;
    case RideEnd::stands_at_start:
      return Status::stands;
  }
  throw InternalError({"", "a ride that ended in no known way", "", ""});
}

std::string one_line(const Issue& issue) {
  std::string text = issue.what;
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::vector<Override> joined(std::vector<Override> base, const std::vector<Override>& values) {
  base.insert(base.end(), values.begin(), values.end());
  return base;
}

void require_known(const std::vector<std::string>& wanted, const std::vector<std::string>& known) {
  for (const std::string& column : wanted) {
    if (std::find(known.begin(), known.end(), column) != known.end()) continue;
    std::string list;
    for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
    throw InputError({"--columns", "'" + column + "' is no quantity of this design",
                      "There are " + list + ".", "names of that list, separated by commas"});
  }
}

/// Keys that a frozen track has been shaped by.
void require_rideable(const Plan& plan) {
  for (const Input& input : plan.inputs()) {
    if (!input.key.starts_with("track") && !input.key.starts_with("centerline")) continue;
    throw InputError({"--frozen", input.key + " shapes the track, which is frozen",
                      "The track of the design is found once, and every point rides it.",
                      "body, limits or gravity to vary; or no --frozen"});
  }
}

/// The fastest track there is, limits aside, is one figure of a row; rows without it need not find it.
bool needs_optimum(const std::vector<std::string>& columns) {
  return columns.empty() ||
         std::find(columns.begin(), columns.end(), "optimum_travel_time_s") != columns.end();
}

std::string shown_input(const Input& input, const std::string& text) {
  if (!input.numeric) return as_cell(text);
  const auto quantity = split_quantity(text);
  return quantity ? exact_text(quantity->number) : as_cell(text);
}

}  // namespace

std::string table_heading(const Plan& plan, const std::vector<std::string>& columns) {
  std::string line = "index";
  for (const Input& input : plan.inputs()) line += "," + as_cell(input.column());
  line += ",status,reason";
  for (const std::string& column : columns) line += "," + as_cell(column);
  return line;
}

namespace {

/// A key of which every value tried is refused: one error at once instead of a million rows.
void require_settable(const Study& study) {
  for (const Factor& factor : study.plan.factors()) {
    std::set<std::uint64_t> tried = {0, factor.size / 2, factor.size - 1};
    for (std::size_t column = 0; column < factor.inputs.size(); ++column) {
      std::exception_ptr refusal;
      bool accepted = false;
      for (const std::uint64_t setting : tried) {
        try {
          (void)study.source.with(
              joined(study.base, {{factor.inputs[column].key, factor.at(setting)[column]}}), ReachCheck::no);
          accepted = true;
        } catch (const InputError&) {
          if (!refusal) refusal = std::current_exception();
        } catch (const FileError&) {
          if (!refusal) refusal = std::current_exception();
        }
      }
      if (!accepted && refusal) std::rethrow_exception(refusal);
    }
  }
}

}  // namespace

void check(const Study& study) {
  if (study.frozen) require_rideable(study.plan);
  require_settable(study);
}

Evaluation::Evaluation(const Study& study, const std::stop_token& stop) : study_(study) {
  if (study.frozen) {
    const Design design = study.source.with(study.base);
    RunContext context;
    context.stop = stop;
    context.time_budget = kNoTimeBudget;
    Track track = solve(design, context);
    frozen_ = std::move(track.centerline);
    frozen_hood_ = std::move(track.hood);
    if (stop.stop_requested()) throw Interrupted({"", "interrupted, no point was computed", "", ""});
  }
  const std::vector<std::string> known = known_columns(stop);
  if (!known.empty()) require_known(study.columns, known);
  columns_ = study.columns.empty() ? known : study.columns;
}

/// The figures of the first track there is: of the design itself, else of a point.
std::vector<std::string> Evaluation::known_columns(const std::stop_token& stop) const {
  constexpr std::uint64_t kMostTried = 1000;
  std::vector<Quantity> found = outcome(study_.base).quantities;
  const std::uint64_t last = std::min(study_.plan.count(), kMostTried);
  for (std::uint64_t index = 0; found.empty() && index < last; ++index) {
    if (stop.stop_requested()) throw Interrupted({"", "interrupted, no point was computed", "", ""});
    found = outcome(joined(study_.base, study_.plan.point(index))).quantities;
  }
  std::vector<std::string> names;
  names.reserve(found.size());
  for (Quantity& quantity : found) names.push_back(std::move(quantity.first));
  return names;
}

Track Evaluation::track_of(const Design& design) const {
  RunContext context;
  context.time_budget = kNoTimeBudget;
  context.measures_optimum = needs_optimum(study_.columns);
  if (frozen_) {
    Design below = design;
    if (below.hood && !below.hood->settled()) below.hood = frozen_hood_;
    return ride(below, frozen_, context);
  }
  return solve(design, context);
}

Evaluation::Outcome Evaluation::outcome(const std::vector<Override>& values) const {
  Outcome outcome;
  try {
    const Design design = study_.source.with(values, frozen_ ? ReachCheck::no : ReachCheck::yes);
    const Track track = track_of(design);
    outcome.status = Status::arrived;
    outcome.quantities = study_.quantities(design, track);
    if (const auto problem = ride_problem(design, track)) {
      outcome.status = status_of(ride_end(*ride_that_fails(track).value().motion));
      outcome.reason = one_line(*problem);
    } else if (const auto broken = limits_problem(design, track)) {
      outcome.status = Status::limits_broken;
      outcome.reason = one_line(*broken);
    } else if (const auto early = search_problem(design, track)) {
      outcome.reason = one_line(*early);
    }
  } catch (const InfeasibleError& error) {
    outcome.status = Status::infeasible;
    outcome.reason = one_line(error.issues().front());
  } catch (const ConvergenceError& error) {
    outcome.status = Status::none_found;
    outcome.reason = one_line(error.issues().front());
  } catch (const InputError& error) {
    outcome.status = Status::invalid;
    outcome.reason = one_line(error.issues().front());
  } catch (const FileError& error) {
    outcome.status = Status::invalid;
    outcome.reason = one_line(error.issues().front());
  }
  return outcome;
}

std::string Evaluation::row(std::uint64_t index) const {
  const std::vector<Override> values = study_.plan.point(index);
  const Outcome outcome = this->outcome(joined(study_.base, values));
  std::string line = std::to_string(index);
  for (std::size_t column = 0; column < values.size(); ++column) {
    line += "," + shown_input(study_.plan.inputs()[column], values[column].value);
  }
  line += "," + std::string(word(outcome.status)) + "," + as_cell(outcome.reason);
  // Nearly always the same names in the same order: looked for from where the last one was found.
  std::size_t place = 0;
  const auto& quantities = outcome.quantities;
  for (const std::string& name : columns_) {
    line += ',';
    for (std::size_t tried = 0; tried < quantities.size(); ++tried) {
      const Quantity& quantity = quantities[(place + tried) % quantities.size()];
      if (quantity.first != name) continue;
      if (quantity.second) line += exact_text(*quantity.second);
      place += tried + 1;
      break;
    }
  }
  return line;
}

}  // namespace glissade::study
