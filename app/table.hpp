#pragma once

#include <string>
#include <utility>
#include <vector>

namespace glissade::app {

/// Text in columns: the first one to the left, the others to the right, so that digits stand below digits.
class Table {
 public:
  explicit Table(std::vector<std::string> headings) : rows_{std::move(headings)} {}

  /// A row shorter than the headings ends with a remark that may be as long as it likes.
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  /// @return the headings and then the rows
  [[nodiscard]] const std::vector<std::vector<std::string>>& rows() const { return rows_; }

  [[nodiscard]] std::string text() const;
  /// @return the same as comma-separated values, quoted where a cell needs it
  [[nodiscard]] std::string csv() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// @return a number with so many digits behind the point, as columns want it: "-0.50"
[[nodiscard]] std::string fixed_text(double value, int decimals);

/// @return "  Label          text" with the texts of several lines below each other
[[nodiscard]] std::string labelled(const std::string& label, const std::string& text);

}  // namespace glissade::app
