#include "study/influence.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace glissade::study {
namespace {

/// Two values of one row.
struct Pair {
  double input;
  double quantity;
};

/// Ranks from 1, the mean of their places for values that are equal.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t from = 0; from < order.size();) {
    std::size_t to = from;
    while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
    for (std::size_t place = from; place < to; ++place) {
      ranks[order[place]] = 0.5 * static_cast<double>(from + 1 + to);
    }
    from = to;
  }
  return ranks;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto count = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / count;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / count;
  double both = 0.0;
  double squares_a = 0.0;
  double squares_b = 0.0;
  for (std::size_t row = 0; row < a.size(); ++row) {
    both += (a[row] - mean_a) * (b[row] - mean_b);
    squares_a += (a[row] - mean_a) * (a[row] - mean_a);
    squares_b += (b[row] - mean_b) * (b[row] - mean_b);
  }
  if (!(squares_a > 0.0) || !(squares_b > 0.0)) return 0.0;
  return std::clamp(both / std::sqrt(squares_a * squares_b), -1.0, 1.0);
}

void add_rank_correlation(const std::vector<Pair>& pairs, Influence& influence) {
  std::vector<double> inputs;
  std::vector<double> quantities;
  for (const Pair& pair : pairs) {
    inputs.push_back(pair.input);
    quantities.push_back(pair.quantity);
  }
  const double r = correlation(ranks_of(inputs), ranks_of(quantities));
  influence.rank_correlation = r;
  const auto count = static_cast<double>(pairs.size());
  influence.rank_correlation_error =
      count > 3.0 ? (1.0 - r * r) * std::sqrt((1.0 + 0.5 * r * r) / (count - 3.0)) : 1.0;
}

/// Classes of the input: its single values where they are few, else equally many rows each. Rows of one value are never
/// parted.
/// @return the end of each class in the sorted rows
std::vector<std::size_t> classes_of(const std::vector<Pair>& sorted) {
  constexpr std::size_t kMostSingleValues = 64;
  std::vector<std::size_t> ends;
  for (std::size_t row = 1; row <= sorted.size(); ++row) {
    if (row == sorted.size() || sorted[row].input != sorted[row - 1].input) ends.push_back(row);
  }
  if (ends.size() <= kMostSingleValues && 2 * ends.size() <= sorted.size()) return ends;
  // As many classes as the cube root of the rows, which balances what a class hides against its noise.
  const auto wanted = static_cast<std::size_t>(
      std::max(2.0, std::round(2.0 * math::cbrt(static_cast<double>(sorted.size())))));
  std::vector<std::size_t> merged;
  for (const std::size_t end : ends) {
    const std::size_t due = (merged.size() + 1) * sorted.size() / wanted;
    if (end >= due || end == sorted.size()) merged.push_back(end);
  }
  return merged;
}

/// @param sorted  by input
/// @param skip    rows whose number leaves this rest are left out; groups = 0: none is
std::optional<double> explained_share(const std::vector<Pair>& sorted, const std::vector<std::size_t>& ends,
                                      std::size_t groups, std::size_t skip) {
  double count = 0.0;
  double sum = 0.0;
  double within = 0.0;
  double between_raw = 0.0;  // sum over classes of n mean^2
  std::size_t classes = 0;
  std::size_t row = 0;
  for (const std::size_t end : ends) {
    double n = 0.0;
    double mean = 0.0;
    double squares = 0.0;
    for (; row < end; ++row) {
      if (groups != 0 && row % groups == skip) continue;
      n += 1.0;
      const double step = sorted[row].quantity - mean;
      mean += step / n;
      squares += step * (sorted[row].quantity - mean);
    }
    if (n == 0.0) continue;
    ++classes;
    count += n;
    sum += n * mean;
    within += squares;
    between_raw += n * mean * mean;
  }
  const auto k = static_cast<double>(classes);
  if (k < 2.0 || count <= k) return {};
  const double mean = sum / count;
  within /= count - k;
  // The classes are all there are, each with its share of the rows; their means scatter by the variance within them too.
  const double explained = (between_raw - count * mean * mean - (k - 1.0) * within) / count;
  const double total = explained + within;
  if (!(total > 0.0)) return {};
  return std::clamp(explained / total, 0.0, 1.0);
}

void add_first_order(std::vector<Pair> pairs, Influence& influence) {
  constexpr std::size_t kFewest = 30;
  if (pairs.size() < kFewest) return;
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.input < b.input; });
  const std::vector<std::size_t> ends = classes_of(pairs);
  influence.first_order = explained_share(pairs, ends, 0, 0);
  if (!influence.first_order) return;
  constexpr std::size_t kGroups = 20;
  double mean = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t group = 0; group < kGroups; ++group) {
    const auto share = explained_share(pairs, ends, kGroups, group);
    if (!share) continue;
    count += 1.0;
    const double step = *share - mean;
    mean += step / count;
    squares += step * (*share - mean);
  }
  influence.first_order_error = count > 1.0 ? std::sqrt((count - 1.0) / count * squares) : 0.0;
}

/// Rows and used rows in classes of two inputs.
struct PairCounts {
  std::size_t classes = 0;
  std::vector<double> all;
  std::vector<double> used;

  PairCounts(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b,
             const std::vector<bool>& use, std::size_t count)
      : classes(count), all(count * count, 0.0), used(count * count, 0.0) {
    for (std::size_t row = 0; row < a.size(); ++row) {
      const std::size_t cell = a[row] * classes + b[row];
      all[cell] += 1.0;
      if (use[row]) used[cell] += 1.0;
    }
  }
};

/// The used rows of each cell if their share were a factor of one input times a factor of the other: the factors that keep
/// the sums over both, by proportional fitting (Deming & Stephan 1940).
std::vector<double> fitted_product(const PairCounts& counts) {
  constexpr int kRounds = 200;  // budget: of up to 128 sums each
  const std::size_t n = counts.classes;
  std::vector<double> fitted = counts.all;
  for (int round = 0; round < kRounds; ++round) {
    for (const bool rows : {true, false}) {
      for (std::size_t i = 0; i < n; ++i) {
        double is = 0.0;
        double wanted = 0.0;
        for (std::size_t j = 0; j < n; ++j) {
          const std::size_t cell = rows ? i * n + j : j * n + i;
          is += fitted[cell];
          wanted += counts.used[cell];
        }
        for (std::size_t j = 0; is > 0.0 && j < n; ++j) fitted[rows ? i * n + j : j * n + i] *= wanted / is;
      }
    }
  }
  return fitted;
}

bool are_dependent(const PairCounts& counts) {
  const std::vector<double> fitted = fitted_product(counts);
  double chi_squared = 0.0;
  for (std::size_t cell = 0; cell < fitted.size(); ++cell) {
    if (counts.all[cell] == 0.0) continue;
    const double miss = counts.used[cell] - fitted[cell];
    // Binomial; where all rows or none are used a single row says nothing.
    const double variance = std::max(fitted[cell] * (1.0 - fitted[cell] / counts.all[cell]), 1.0);
    chi_squared += miss * miss / variance;
  }
  const auto freedom = static_cast<double>((counts.classes - 1) * (counts.classes - 1));
  // The cube root of a chi-squared over its degrees is nearly normal (Wilson & Hilferty 1931).
  const double spread = 2.0 / (9.0 * freedom);
  // Told dependent by chance: one of 30 000 pairs.
  constexpr double kSurprise = 4.0;  // taste, in standard errors
  return (math::cbrt(chi_squared / freedom) - (1.0 - spread)) / std::sqrt(spread) > kSurprise;
}

}  // namespace

std::vector<bool> dependent_inputs(const std::vector<std::vector<double>>& inputs,
                                   const std::vector<bool>& used) {
  std::vector<bool> dependent(inputs.size(), false);
  if (std::find(used.begin(), used.end(), false) == used.end()) return dependent;
  constexpr double kRowsOfCell = 10.0;  // theory: chi-squared wants some 5 to 10 in a cell
  constexpr double kMostClasses = 8.0;  // taste
  const auto classes = static_cast<std::size_t>(
      std::clamp(std::floor(std::sqrt(static_cast<double>(used.size()) / kRowsOfCell)), 2.0, kMostClasses));
  std::vector<std::vector<std::size_t>> class_of;
  for (const std::vector<double>& input : inputs) {
    class_of.emplace_back();
    for (const double rank : ranks_of(input)) {
      class_of.back().push_back(static_cast<std::size_t>(rank * static_cast<double>(classes) /
                                                         (static_cast<double>(used.size()) + 1.0)));
    }
  }
  for (std::size_t a = 0; a < inputs.size(); ++a) {
    for (std::size_t b = a + 1; b < inputs.size(); ++b) {
      if (!are_dependent(PairCounts(class_of[a], class_of[b], used, classes))) continue;
      dependent[a] = true;
      dependent[b] = true;
    }
  }
  return dependent;
}

Influence influence_of(const std::vector<double>& input, const std::vector<double>& quantity,
                       bool independent) {
  std::vector<Pair> pairs;
  for (std::size_t row = 0; row < input.size(); ++row) {
    if (!std::isnan(quantity[row])) pairs.push_back({input[row], quantity[row]});
  }
  Influence influence;
  if (pairs.size() < 2) return influence;
  add_rank_correlation(pairs, influence);
  if (independent) add_first_order(std::move(pairs), influence);
  return influence;
}

}  // namespace glissade::study
