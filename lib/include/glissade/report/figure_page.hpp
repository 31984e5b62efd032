#pragma once

#include "glissade/report/figure.hpp"

#include <string>
#include <vector>

namespace glissade {

/// A table of a page: headings, and rows of texts.
struct PageTable {
  std::vector<std::string> headings;
  /// A row that is shorter ends with a remark over the rest. A column of bare numbers is sorted as such; "-": no value.
  std::vector<std::vector<std::string>> rows;
};

/// A page of figures above a table, for comparisons.
struct FigurePage {
  std::string title;
  std::string subtitle;
  std::vector<Figure> figures;
  PageTable table;
  /// Names that a reader may take away and bring back: lines of that FigureLine::choice, counted from 1, and the row of
  /// the table with that number. Empty: everything is shown.
  std::vector<std::string> choices = {};
};

/// The page as one self-contained file: drawings inside, no request to anywhere. Text is escaped. A script there is only
/// where there are choices: it sorts the table by a column (of numbers by their value), tells how many are shown and follows
/// one line through all figures; taking lines away needs none.
/// @throws InputError as figures_svg()
[[nodiscard]] std::string figure_page_html(const FigurePage& page);

}  // namespace glissade
