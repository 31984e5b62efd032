#pragma once

#include "glissade/core/progress.hpp"
#include "glissade/study/study.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace glissade::study {

/// How the values of one column are spread over the points that have one.
struct ColumnFacts {
  std::string name;
  std::uint64_t count = 0;
  double lowest = 0.0;
  double highest = 0.0;
  double mean = 0.0;
  double standard_deviation = 0.0;       ///< of the sample (divided by count - 1); 0 of a single value
  std::array<double, 5> quantiles = {};  ///< at kQuantiles
  std::vector<std::uint64_t>
      histogram;  ///< kHistogramBins equal parts from lowest to highest; all of them counted

  /// @return whether the values differ by more than rounding
  [[nodiscard]] bool varies() const noexcept;
};

inline constexpr std::array<double, 5> kQuantiles = {0.05, 0.25, 0.5, 0.75, 0.95};
inline constexpr std::size_t kHistogramBins = 60;

/// What one input does to one quantity, over the points that have both.
struct Influence {
  std::size_t input = 0;                ///< of Summary::inputs
  std::size_t quantity = 0;             ///< of Summary::quantities
  double rank_correlation = 0.0;        ///< Spearman's, -1 to 1
  double rank_correlation_error = 0.0;  ///< its standard error
  /// First-order Sobol index: the share of the quantity's variance that this input alone explains; from an analysis of
  /// variance over classes of the input, corrected for their finite size. None where inputs are not independent: as the
  /// study draws them, or among the points that have the quantity.
  std::optional<double> first_order;
  /// Whether the input is independent of the others as the study draws it, but not among the points that have the quantity.
  bool dependent_here = false;
  double first_order_error = 0.0;  ///< its standard error, by a delete-a-group jackknife
};

/// The range of one axis of a map, in cells: single values where there are few, else equal parts.
struct Axis {
  std::size_t input = 0;       ///< of Summary::inputs
  std::vector<double> values;  ///< the single values, ascending; empty: equal parts
  double lowest = 0.0;
  double highest = 0.0;
  std::size_t cells = 0;

  [[nodiscard]] std::size_t cell_of(double value) const;
};

/// The first point of a cell.
struct FirstPoint {
  std::uint64_t index = 0;
  std::vector<std::string> inputs;  ///< texts of all its inputs, without their units
};

/// Two inputs against every quantity that varies.
struct Map {
  Axis across;
  Axis up;
  /// One an each cell, row by row of `up`: how many points, the first of them, and the mean of each quantity.
  std::vector<std::uint64_t> counts;
  std::vector<FirstPoint> first_points;
  std::vector<std::vector<std::optional<double>>> means;  ///< [quantity][cell]
};

/// One input against every quantity that varies.
struct Band {
  Axis across;
  std::vector<std::uint64_t> counts;
  std::vector<FirstPoint> first_points;
  std::vector<std::vector<std::optional<std::array<double, 3>>>>
      values;  ///< [quantity][cell]: lowest, mean, highest
};

/// The point of a study at which a quantity is best.
struct BestPoint {
  std::uint64_t index = 0;
  double value = 0.0;
  std::vector<std::string> inputs;
};

/// What the rows of a study say.
///
/// Accuracy: counts, lowest, highest, mean, histograms, maps, bands and best points are of all rows. Quantiles,
///   correlations and indices are of all rows up to kMostKept of them, else of a random choice of about that many; the
///   same choice every time.
struct Summary {
  std::map<Status, std::uint64_t> counts;
  std::map<Status, std::string> reasons;  ///< the reason of the first point of each status
  std::uint64_t points = 0;
  std::uint64_t kept = 0;
  std::vector<ColumnFacts> inputs;      ///< those that are numbers
  std::vector<ColumnFacts> quantities;  ///< all of them
  std::vector<std::size_t> varying;   ///< of quantities: those that vary and are no input under another name
  std::vector<Influence> influences;  ///< of every input on every varying quantity
  std::vector<Band> bands;            ///< one an input; quantities in the order of `varying`
  std::vector<Map> maps;              ///< one a pair of inputs
  /// [place in `varying`]: the kBest points with the lowest and those with the highest value, of all that arrived.
  std::vector<std::vector<BestPoint>> lowest;
  std::vector<std::vector<BestPoint>> highest;
};

inline constexpr std::uint64_t kMostKept = 200'000;
inline constexpr std::size_t kBest = 10;

/// Reads all rows, twice.
/// @throws FileError as Results::for_each(); Interrupted
[[nodiscard]] Summary summarise(const Results& results, const Progress& progress = {},
                                const std::stop_token& stop = {});

/// @return the summary as one page that needs no network: counts, histograms, bands, maps, influences, best points, and
///         the command that builds each point again
[[nodiscard]] std::string summary_page(const Results& results, const Summary& summary);

}  // namespace glissade::study
