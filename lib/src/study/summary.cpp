// Ranks and their correlation: Spearman 1904, standard error after Bonett & Wright 2000, sqrt((1 + r^2/2)/(n - 3)) of the
// Fisher-transformed value. First-order indices from given data: classes of the input and a one-way analysis of variance
// (classes as Plischke, Borgonovo & Smith 2013; corrected by what the variance within them adds to that between them).

#include "glissade/study/summary.hpp"

#include "glissade/core/quantity.hpp"

#include "study/influence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <variant>

namespace glissade::study {
namespace {

constexpr std::size_t kMostCellsOfOneMap = 48;
constexpr std::size_t kMostMappedInputs = 6;
constexpr std::size_t kMostSingleValues = 48;

/// A choice of rows that is the same every time and follows no pattern that a grid could share.
bool is_kept(std::uint64_t index, std::uint64_t points) {
  if (points <= kMostKept) return true;
  std::uint64_t bits = index * 0x9E3779B97F4A7C15ULL;
  bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBULL;
  bits ^= bits >> 31U;
  return static_cast<double>(bits >> 11U) * 0x1p-53 <
         static_cast<double>(kMostKept) / static_cast<double>(points);
}

/// Mean and variance of a stream (Welford 1962), its ends, and the values that are kept.
struct Stream {
  std::uint64_t count = 0;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  double mean = 0.0;
  double squares = 0.0;

  void add(double value) {
    ++count;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
    const double step = value - mean;
    mean += step / static_cast<double>(count);
    squares += step * (value - mean);
  }
};

/// One column of the rows that are kept; not a number where a row has none.
using Kept = std::vector<double>;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

ColumnFacts facts_of(std::string name, const Stream& stream, const Kept& kept) {
  ColumnFacts facts;
  facts.name = std::move(name);
  facts.count = stream.count;
  facts.histogram.assign(kHistogramBins, 0);
  if (stream.count == 0) return facts;
  facts.lowest = stream.lowest;
  facts.highest = stream.highest;
  facts.mean = stream.mean;
  if (stream.count > 1)
    facts.standard_deviation = std::sqrt(stream.squares / static_cast<double>(stream.count - 1));
  Kept values;
  std::copy_if(kept.begin(), kept.end(), std::back_inserter(values),
               [](double value) { return !std::isnan(value); });
  std::sort(values.begin(), values.end());
  for (std::size_t index = 0; index < kQuantiles.size() && !values.empty(); ++index) {
    // Linear between order statistics, as most programs do by default (type 7 of Hyndman & Fan 1996).
    const double place = kQuantiles[index] * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    const double share = place - static_cast<double>(below);
    facts.quantiles[index] = values[below] * (1.0 - share) + values[above] * share;
  }
  return facts;
}

/// @return the SI value of one unit, in whatever dimension it is one; 1 of an empty text
double si_of(const std::string& unit) {
  constexpr int kLast = static_cast<int>(Dimension::power_per_area);
  for (int dimension = 0; dimension <= kLast && !unit.empty(); ++dimension) {
    const auto read = read_quantity("1 " + unit, static_cast<Dimension>(dimension), unit);
    if (const double* const value = std::get_if<double>(&read)) return *value;
  }
  return 1.0;
}

/// What is kept of all rows while they are read for the first time.
class FirstReading {
 public:
  explicit FirstReading(const Results& results) : results_(results) {
    for (std::size_t column = 0; column < results.inputs().size(); ++column) {
      if (results.numeric()[column]) numeric_.push_back(column);
    }
    inputs_.resize(numeric_.size());
    kept_inputs_.resize(numeric_.size());
    for (const std::size_t column : numeric_) scales_.push_back(si_of(results.units()[column]));
    words_.resize(results.inputs().size() - numeric_.size());
    kept_words_.resize(words_.size());
    quantities_.resize(results.quantities().size());
    kept_quantities_.resize(results.quantities().size());
  }

  void see(const Row& row) {
    ++summary_.points;
    ++summary_.counts[row.status];
    if (!row.reason.empty()) summary_.reasons.try_emplace(row.status, row.reason);
    const bool kept = is_kept(row.index, results_.points());
    if (kept) ++summary_.kept;
    for (std::size_t column = 0; column < numeric_.size(); ++column) {
      const double value = std::stod(row.inputs[numeric_[column]]);
      inputs_[column].add(value);
      if (kept) kept_inputs_[column].push_back(value);
    }
    if (kept) keep_words(row);
    for (std::size_t column = 0; column < quantities_.size(); ++column) {
      const std::optional<double>& value = row.quantities[column];
      if (value) quantities_[column].add(*value);
      if (kept) kept_quantities_[column].push_back(value.value_or(kNone));
    }
  }

  [[nodiscard]] Summary finish() {
    for (std::size_t column = 0; column < numeric_.size(); ++column) {
      summary_.inputs.push_back(
          facts_of(results_.inputs()[numeric_[column]], inputs_[column], kept_inputs_[column]));
    }
    for (std::size_t column = 0; column < quantities_.size(); ++column) {
      summary_.quantities.push_back(
          facts_of(results_.quantities()[column], quantities_[column], kept_quantities_[column]));
      if (summary_.quantities.back().varies() && !is_an_input(column)) summary_.varying.push_back(column);
    }
    for (std::size_t input = 0; input < numeric_.size(); ++input) {
      if (!summary_.inputs[input].varies()) continue;
      for (const std::size_t quantity : summary_.varying) {
        const bool drawn_alone = results_.independent()[numeric_[input]];
        const bool dependent = drawn_alone && dependent_among(kept_quantities_[quantity])[input];
        Influence influence =
            influence_of(kept_inputs_[input], kept_quantities_[quantity], drawn_alone && !dependent);
        influence.dependent_here = dependent;
        influence.input = input;
        influence.quantity = quantity;
        summary_.influences.push_back(influence);
      }
    }
    return std::move(summary_);
  }

  [[nodiscard]] const std::vector<std::size_t>& numeric() const { return numeric_; }
  [[nodiscard]] Axis axis(std::size_t input, std::size_t most_cells) const {
    Axis axis;
    axis.input = input;
    axis.lowest = inputs_[input].lowest;
    axis.highest = inputs_[input].highest;
    std::set<double> distinct;
    for (const double value : kept_inputs_[input]) {
      distinct.insert(value);
      if (distinct.size() > std::min(most_cells, kMostSingleValues)) break;
    }
    if (distinct.size() <= std::min(most_cells, kMostSingleValues))
      axis.values.assign(distinct.begin(), distinct.end());
    axis.cells = axis.values.empty() ? most_cells : axis.values.size();
    return axis;
  }

 private:
  /// Inputs that are words, each word by the number of its first row.
  void keep_words(const Row& row) {
    std::size_t place = 0;
    for (std::size_t column = 0; column < row.inputs.size() && place < words_.size(); ++column) {
      if (results_.numeric()[column]) continue;
      const auto known = words_[place].try_emplace(row.inputs[column], words_[place].size()).first;
      kept_words_[place++].push_back(static_cast<double>(known->second));
    }
  }

  /// Of the numeric inputs, whether another makes a difference to which of their values a quantity is told of.
  [[nodiscard]] const std::vector<bool>& dependent_among(const Kept& quantity) {
    std::vector<bool> used(quantity.size());
    std::transform(quantity.begin(), quantity.end(), used.begin(),
                   [](double value) { return !std::isnan(value); });
    const auto known = dependent_.find(used);
    if (known != dependent_.end()) return known->second;
    std::vector<Kept> inputs = kept_inputs_;
    inputs.insert(inputs.end(), kept_words_.begin(), kept_words_.end());
    std::vector<bool> dependent = dependent_inputs(inputs, used);
    return dependent_.emplace(std::move(used), std::move(dependent)).first->second;
  }

  /// Echoes of an input, such as the friction angle beside body.friction_angle, or the mass flow in kg/s beside one in t/h.
  [[nodiscard]] bool is_an_input(std::size_t column) const {
    const auto echoes = [&](const Kept& input, double scale) {
      constexpr double kRounding = 1e-12;  // rounding, of the value
      bool any = false;
      for (std::size_t row = 0; row < input.size(); ++row) {
        const double value = kept_quantities_[column][row];
        if (std::isnan(value)) continue;
        if (std::fabs(value - scale * input[row]) > kRounding * std::fabs(value)) return false;
        any = true;
      }
      return any;
    };
    for (std::size_t input = 0; input < kept_inputs_.size(); ++input) {
      if (echoes(kept_inputs_[input], 1.0) || echoes(kept_inputs_[input], scales_[input])) return true;
    }
    return false;
  }

  const Results& results_;
  Summary summary_;
  std::vector<std::size_t> numeric_;  ///< columns of inputs that are numbers
  std::vector<Stream> inputs_;
  std::vector<Stream> quantities_;
  std::vector<Kept> kept_inputs_;
  std::vector<Kept> kept_quantities_;
  std::vector<double> scales_;  ///< SI of one unit of an input
  std::vector<std::map<std::string, std::size_t>> words_;
  std::vector<Kept> kept_words_;
  std::map<std::vector<bool>, std::vector<bool>> dependent_;  ///< by the rows that are used
};

void keep_best(std::vector<BestPoint>& best, const Row& row, double value, bool low) {
  const auto better = [low](const BestPoint& a, const BestPoint& b) {
    if (a.value != b.value) return low ? a.value < b.value : a.value > b.value;
    return a.index < b.index;
  };
  if (best.size() == kBest && !better({row.index, value, {}}, best.back())) return;
  best.push_back({row.index, value, row.inputs});
  std::sort(best.begin(), best.end(), better);
  if (best.size() > kBest) best.pop_back();
}

/// Sums of the points that fall into one cell.
struct Cell {
  std::uint64_t count = 0;
  FirstPoint first;
  std::vector<Stream> quantities;

  void add(const Row& row, const std::vector<std::size_t>& varying) {
    if (count++ == 0) first = {row.index, row.inputs};
    quantities.resize(varying.size());
    for (std::size_t place = 0; place < varying.size(); ++place) {
      if (const auto& value = row.quantities[varying[place]]) quantities[place].add(*value);
    }
  }
};

/// Everything that needs the ranges of the first reading.
class SecondReading {
 public:
  SecondReading(Summary& summary, const FirstReading& first) : summary_(summary), numeric_(first.numeric()) {
    std::vector<std::size_t> varied;
    for (std::size_t input = 0; input < summary.inputs.size(); ++input) {
      if (summary.inputs[input].varies()) varied.push_back(input);
    }
    for (const std::size_t input : varied) {
      summary.bands.push_back({first.axis(input, kMostCellsOfOneMap), {}, {}, {}});
      band_cells_.emplace_back(summary.bands.back().across.cells);
    }
    varied.resize(std::min(varied.size(), kMostMappedInputs));
    const std::size_t cells = varied.size() > 3 ? kMostCellsOfOneMap / 2 : kMostCellsOfOneMap;
    for (std::size_t across = 0; across < varied.size(); ++across) {
      for (std::size_t up = across + 1; up < varied.size(); ++up) {
        summary.maps.push_back(
            {first.axis(varied[across], cells), first.axis(varied[up], cells), {}, {}, {}});
        map_cells_.emplace_back(summary.maps.back().across.cells * summary.maps.back().up.cells);
      }
    }
    summary.lowest.resize(summary.varying.size());
    summary.highest.resize(summary.varying.size());
  }

  void see(const Row& row) {
    for (std::size_t place = 0; place < summary_.quantities.size(); ++place) {
      count(summary_.quantities[place], row.quantities[place]);
    }
    std::vector<double> inputs;
    for (std::size_t input = 0; input < numeric_.size(); ++input) {
      inputs.push_back(std::stod(row.inputs[numeric_[input]]));
      count(summary_.inputs[input], inputs.back());
    }
    for (std::size_t place = 0; place < summary_.bands.size(); ++place) {
      const Axis& axis = summary_.bands[place].across;
      band_cells_[place][axis.cell_of(inputs[axis.input])].add(row, summary_.varying);
    }
    for (std::size_t place = 0; place < summary_.maps.size(); ++place) {
      const Map& map = summary_.maps[place];
      const std::size_t cell = map.up.cell_of(inputs[map.up.input]) * map.across.cells +
                               map.across.cell_of(inputs[map.across.input]);
      map_cells_[place][cell].add(row, summary_.varying);
    }
    if (row.status != Status::arrived) return;
    for (std::size_t place = 0; place < summary_.varying.size(); ++place) {
      const auto& value = row.quantities[summary_.varying[place]];
      if (!value) continue;
      keep_best(summary_.lowest[place], row, *value, true);
      keep_best(summary_.highest[place], row, *value, false);
    }
  }

  void finish() {
    for (std::size_t place = 0; place < summary_.bands.size(); ++place) {
      Band& band = summary_.bands[place];
      band.values.resize(summary_.varying.size());
      for (const Cell& cell : band_cells_[place]) {
        band.counts.push_back(cell.count);
        band.first_points.push_back(cell.first);
        for (std::size_t quantity = 0; quantity < summary_.varying.size(); ++quantity) {
          const Stream* const stream = cell.count == 0 ? nullptr : &cell.quantities[quantity];
          band.values[quantity].push_back(
              stream == nullptr || stream->count == 0
                  ? std::nullopt
                  : std::optional(std::array{stream->lowest, stream->mean, stream->highest}));
        }
      }
    }
    for (std::size_t place = 0; place < summary_.maps.size(); ++place) {
      Map& map = summary_.maps[place];
      map.means.resize(summary_.varying.size());
      for (const Cell& cell : map_cells_[place]) {
        map.counts.push_back(cell.count);
        map.first_points.push_back(cell.first);
        for (std::size_t quantity = 0; quantity < summary_.varying.size(); ++quantity) {
          const Stream* const stream = cell.count == 0 ? nullptr : &cell.quantities[quantity];
          map.means[quantity].push_back(
              stream == nullptr || stream->count == 0 ? std::nullopt : std::optional(stream->mean));
        }
      }
    }
  }

 private:
  static void count(ColumnFacts& facts, const std::optional<double>& value) {
    if (!value) return;
    const double width = facts.highest - facts.lowest;
    const double place =
        width > 0.0 ? (*value - facts.lowest) / width * static_cast<double>(kHistogramBins) : 0.0;
    ++facts.histogram[std::min(static_cast<std::size_t>(std::max(place, 0.0)), kHistogramBins - 1)];
  }

  Summary& summary_;
  std::vector<std::size_t> numeric_;
  std::vector<std::vector<Cell>> band_cells_;
  std::vector<std::vector<Cell>> map_cells_;
};

}  // namespace

bool ColumnFacts::varies() const noexcept {
  constexpr double kRounding = 1e-9;
  return count > 1 && highest - lowest > kRounding * std::max(std::fabs(lowest), std::fabs(highest));
}

std::size_t Axis::cell_of(double value) const {
  if (!values.empty()) {
    const auto at = std::lower_bound(values.begin(), values.end(), value);
    return std::min(static_cast<std::size_t>(at - values.begin()), values.size() - 1);
  }
  const double place = (value - lowest) / (highest - lowest) * static_cast<double>(cells);
  return std::min(static_cast<std::size_t>(std::max(place, 0.0)), cells - 1);
}

Summary summarise(const Results& results, const Progress& progress, const std::stop_token& stop) {
  FirstReading first(results);
  results.for_each([&](const Row& row) { first.see(row); }, progress, stop);
  Summary summary = first.finish();
  SecondReading second(summary, first);
  results.for_each([&](const Row& row) { second.see(row); }, progress, stop);
  second.finish();
  return summary;
}

}  // namespace glissade::study
