#include "app/table.hpp"

#include <algorithm>
#include <cstddef>

namespace glissade::app {
namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char letter : cell) {
    if (letter == '"') text += '"';
    text += letter;
  }
  return text + '"';
}

}  // namespace

std::string Table::text() const {
  constexpr std::size_t kGap = 2;
  const std::size_t columns = rows_.front().size();
  std::vector<std::size_t> widths(columns, 0);
  for (const auto& row : rows_) {
    // The remark of a short row takes no part in the widths.
    const std::size_t counted = row.size() == columns ? columns : row.size() - 1;
    for (std::size_t column = 0; column < counted; ++column) {
      widths[column] = std::max(widths[column], row[column].size());
    }
  }
  std::string text;
  for (const auto& row : rows_) {
    std::string line = "  ";
    for (std::size_t column = 0; column < row.size(); ++column) {
      const std::string& cell = row[column];
      const bool remark = row.size() != columns && column + 1 == row.size();
      const std::size_t padding = remark ? 0 : widths[column] - cell.size();
      if (column != 0) line.append(kGap, ' ');
      if (column != 0) line.append(padding, ' ');
      line += cell;
      if (column == 0) line.append(padding, ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

std::string Table::csv() const {
  std::string text;
  for (const auto& row : rows_) {
    for (std::size_t column = 0; column < row.size(); ++column) {
      if (column != 0) text += ',';
      text += quoted(row[column]);
    }
    text += '\n';
  }
  return text;
}

std::string fixed_text(double value, int decimals) {
  double scale = 1.0;
  for (int i = 0; i < decimals; ++i) scale *= 10.0;
  // Rounded away from zero at a half; columns hold nothing near the range of an integer.
  const auto units = static_cast<long long>(value * scale + (value < 0.0 ? -0.5 : 0.5));
  std::string digits = std::to_string(units < 0 ? -units : units);
  const auto behind = static_cast<std::size_t>(decimals);
  if (digits.size() <= behind) digits.insert(0, behind + 1 - digits.size(), '0');
  digits.insert(digits.size() - behind, ".");
  return (units < 0 ? "-" : "") + digits;
}

std::string labelled(const std::string& label, const std::string& text) {
  constexpr std::size_t kTextColumn = 20;
  std::string lines = "  " + label;
  lines.append(kTextColumn - std::min(kTextColumn - 2, lines.size()), ' ');
  for (const char letter : text) {
    lines += letter;
    if (letter == '\n') lines.append(kTextColumn, ' ');
  }
  return lines + '\n';
}

}  // namespace glissade::app
