#pragma once

#include <string>
#include <vector>

namespace glissade {

/// One line of a figure. A value that is not finite interrupts the line.
struct FigureLine {
  std::string name;        ///< for the legend; lines without a name stay out of it
  std::vector<double> xs;  ///< in the unit that the figure's label names
  std::vector<double> ys;  ///< as many as xs
  bool dashed = false;
  /// The number, from 1, of what the line tells of in several figures: it has one style in all of them, and a page that
  /// lets its reader choose what is shown hides it by that number; 0: a style by its place in the figure, always shown.
  int choice = 0;
};

/// A closed area, filled, or an open line; for keep-outs.
struct FigureArea {
  std::string name;
  std::vector<double> xs;
  std::vector<double> ys;
  double margin = 0.0;  ///< a paler band of this width around it, in the figure's unit; figures to scale only
  bool open = false;
};

/// One panel: axes with round ticks, lines, a legend.
struct Figure {
  std::string title;
  std::string x_label;  ///< with its unit, "run x [m]"
  std::string y_label;
  std::vector<FigureLine> lines;
  std::vector<FigureArea> areas;
  bool to_scale = false;  ///< one length on x is the same length on y
  bool legend = true;     ///< names its lines
};

/// A drawing of panels one below the other; `width` in CSS pixels (96 per inch), each panel about 0.55 of it
/// high (or as high as its scale needs, at most 1.4 of it). Text is escaped, colours read in grey print, line
/// styles differ as well as colours; bytes depend on the arguments alone.
/// @throws InputError if a panel has no finite point, or a line's xs and ys differ in number
[[nodiscard]] std::string figures_svg(const std::vector<Figure>& figures, double width = 800.0);

}  // namespace glissade
