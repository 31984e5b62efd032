#pragma once

#include "glissade/design/design.hpp"
#include "glissade/study/distribution.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::study {

/// One column of a study's inputs: a key of the design file and how its values are written.
struct Input {
  std::string key;   ///< as for --set, e.g. "body.friction_angle"
  std::string unit;  ///< of all its values, e.g. "deg"; empty for plain numbers and for words
  bool numeric = true;

  /// @return the heading of its column: the key and the unit in letters, e.g. "body.friction_angle_deg"
  [[nodiscard]] std::string column() const;
};

/// Values of one unit at equal steps.
struct Grid {
  double from = 0.0;
  double to = 0.0;  ///< the last value, exactly
  std::uint64_t count = 1;

  /// @param index  0 <= index < count
  /// @return a finite value; `from` of a single one
  [[nodiscard]] double at(std::uint64_t index) const;
};

/// Inputs that change together: the values of one --vary, the rows of a file of points, or samples.
///
/// Shape: `size` settings of `inputs.size()` values each.
struct Factor {
  std::vector<Input> inputs;
  std::uint64_t size = 0;  ///< >= 1
  /// One row a setting: texts as for --set; empty for grids and samples, whose values are made when they are asked for.
  std::vector<std::vector<std::string>> values;
  std::optional<Grid> grid;                 ///< of a grid; `size` values of the one input
  std::vector<Distribution> distributions;  ///< of samples, one an input
  UnitCube cube;                            ///< of samples
  std::string text;                         ///< that says all of this again, for the manifest

  /// @param setting  0 <= setting < size
  /// @return the texts of its values, one an input
  /// @throws InternalError if there is no such setting
  [[nodiscard]] std::vector<std::string> at(std::uint64_t setting) const;
};

/// The values that one key takes.
/// @param text  KEY=FROM:TO:N, N values at equal steps, both ends among them; KEY=A,B,C, a list. Commas within brackets,
///              braces or quotes belong to a value.
/// @throws InputError if the text is of neither form, a grid's ends differ in unit, or N is not within 1 to 1e9
[[nodiscard]] Factor vary(std::string_view text);

/// The rows of a table: a line of keys, each with its unit in brackets where its cells have none ("body.friction_angle
/// [deg]"), then a line a point.
/// @throws FileError if it cannot be read; InputError with the line where a row is not as long as the heading, a cell is
///         empty or a key appears twice
[[nodiscard]] Factor read_points(const std::filesystem::path& file);

/// @param text  of a factor, as a manifest has it
/// @return the name of the table that it was read from; none of factors of other kinds
[[nodiscard]] std::optional<std::string> points_file_of(std::string_view text);

/// Values that scatter independently of each other.
/// @param texts  KEY=DISTRIBUTION each, e.g. "body.friction_angle=normal(17deg,1.5deg)"
/// @throws InputError as Distribution::parse(), or if a key scatters twice or there are more than
///         UnitCube::kMostDimensions
[[nodiscard]] Factor scatter(const std::vector<std::string>& texts, Sampling sampling, std::uint64_t samples,
                             std::uint64_t seed);

/// All combinations of the settings of some factors, numbered from 0; the last factor varies fastest.
class Plan {
 public:
  /// @throws InputError if there is no factor, a key occurs in two of them, or there are more than kMostPoints
  explicit Plan(std::vector<Factor> factors);

  static constexpr std::uint64_t kMostPoints = 1'000'000'000;

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] const std::vector<Factor>& factors() const noexcept { return factors_; }
  /// @return the inputs of all factors in their order
  [[nodiscard]] const std::vector<Input>& inputs() const noexcept { return inputs_; }

  /// @param index  0 <= index < count()
  /// @return the values of that point as --set would give them, in the order of inputs()
  /// @throws InternalError if there is no such point
  [[nodiscard]] std::vector<Override> point(std::uint64_t index) const;

 private:
  std::vector<Factor> factors_;
  std::vector<Input> inputs_;
  std::uint64_t count_ = 1;
};

/// A number with its unit, split: "10deg" is 10 and "deg".
struct SplitQuantity {
  double number = 0.0;
  std::string unit;
};

/// @return none if the text does not begin with a finite decimal number
[[nodiscard]] std::optional<SplitQuantity> split_quantity(std::string_view text);

/// Puts them together again, so that they are told apart: "0.31m", but "0.01 1/m".
[[nodiscard]] std::string joined_quantity(std::string number, std::string_view unit);

}  // namespace glissade::study
