#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/report/figure.hpp"

#include "report/line_style.hpp"
#include "report/markup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace glissade {

using namespace report;

namespace {

// Lightness differs from one to the next, so that the lines stay apart in grey.
constexpr double kLeft = 74.0;
constexpr double kRight = 20.0;
constexpr double kTop = 38.0;
constexpr double kBottom = 50.0;
constexpr double kLegendLine = 20.0;
constexpr double kLegendSample = 34.0;  // taste: with its gap
constexpr double kTitleSize = 15.0;     // taste: as the style says
constexpr double kTitleLine = 19.0;     // taste
constexpr double kTextSize = 12.0;      // taste: as the style says

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double span() const { return high - low; }
};

double round_step(double span, double count) {
  const double rough = span / count;
  const double decade = math::decade_of(rough);
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= rough) return factor * decade;
  }
  return 10.0 * decade;
}

/// No "-0" on an axis.
double tick(double count, double step) {
  return count == 0.0 ? 0.0 : count * step;
}

std::string points_text(const std::vector<double>& xs, const std::vector<double>& ys, auto&& to_x,
                        auto&& to_y) {
  std::string path;
  bool pen_down = false;
  for (std::size_t i = 0; i < xs.size(); ++i) {
    if (!std::isfinite(xs[i]) || !std::isfinite(ys[i])) {
      pen_down = false;
      continue;
    }
    path += fmt::format("{}{:.2f} {:.2f}", pen_down ? "L" : "M", to_x(xs[i]), to_y(ys[i]));
    pen_down = true;
  }
  return path;
}

/// @param first  byte of a character
/// @return no less than how wide it is over the size of the font, in a bold sans-serif font
double width_of(char first) {
  // All measured: DejaVu Sans Bold, the widest of the usual ones.
  constexpr std::string_view kNarrow = " !'(),-./:;I[]fijlrt|";
  constexpr std::string_view kWide = "#%&+<=>@MW^mw~";
  const auto byte = static_cast<unsigned char>(first);
  if (kNarrow.find(first) != std::string_view::npos) return 0.5;
  if (kWide.find(first) != std::string_view::npos) return 1.11;
  if (byte >= 0x80) return byte == 0xC3 ? 1.09 : 1.2;  // the letters of western Europe, and all others
  return first >= 'A' && first <= 'Z' ? 0.86 : 0.73;
}

std::size_t bytes_of(char first) {
  const auto byte = static_cast<unsigned char>(first);
  return byte < 0xC0 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}

/// @return a text as lines that fit a room, broken between words, a longer word between its characters
std::vector<std::string> lines_within(const std::string& text, double size, double room) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  std::optional<std::size_t> gap;
  double width = 0.0;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == ' ' && i > begin) gap = i;
    width += size * width_of(text[i]);
    if (width > room && i > begin) {
      const std::size_t end = gap.value_or(i);
      lines.push_back(text.substr(begin, end - begin));
      begin = gap ? end + 1 : end;
      i = begin;
      gap.reset();
      width = 0.0;
      continue;
    }
    i += std::min(bytes_of(text[i]), text.size() - i);
  }
  lines.push_back(text.substr(begin));
  return lines;
}

/// One panel, laid out for a given width; its top edge is at y = 0.
class Panel {
 public:
  Panel(const Figure& figure, double width) : figure_(figure), width_(width) {
    for (const FigureLine& line : figure.lines) include(line.xs, line.ys, line.name);
    for (const FigureArea& area : figure.areas) include(area.xs, area.ys, area.name);
    if (!(x_.low <= x_.high && y_.low <= y_.high)) {
      throw InputError(
          {figure.title, "the figure has no point to draw", "", "a track that the body can ride"});
    }
    widen(x_);
    widen(y_);
    inner_width_ = width - kLeft - kRight;
    inner_height_ = 0.42 * width;
    constexpr double kClear = 6.0;  // taste
    title_ = lines_within(figure.title, kTitleSize, width - kLeft - kClear);
    top_ = kTop + kTitleLine * static_cast<double>(title_.size() - 1);
    if (figure.to_scale) fit_scale();
  }

  [[nodiscard]] double height() const {
    return top_ + inner_height_ + kBottom + kLegendLine * legend_rows() + 8.0;
  }

  [[nodiscard]] std::string svg(double top) const {
    std::string text = fmt::format("<g transform=\"translate(0 {:.2f})\" role=\"group\" aria-label=\"{}\">\n",
                                   top, escaped_markup(figure_.title));
    for (std::size_t i = 0; i < title_.size(); ++i) {
      text += fmt::format("<text class=\"title\" x=\"{:.2f}\" y=\"{:.0f}\">{}</text>\n", kLeft,
                          22.0 + kTitleLine * static_cast<double>(i), escaped_markup(title_[i]));
    }
    text += axes();
    text += fmt::format(
        "<svg x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" overflow=\"hidden\" "
        "viewBox=\"{:.2f} {:.2f} {:.2f} {:.2f}\">\n",
        kLeft, top_, inner_width_, inner_height_, kLeft, top_, inner_width_, inner_height_);
    const auto to_x = [this](double x) { return at_x(x); };
    const auto to_y = [this](double y) { return at_y(y); };
    for (const FigureArea& area : figure_.areas) {
      const std::string path = points_text(area.xs, area.ys, to_x, to_y) + (area.open ? "" : "Z");
      const std::string name = escaped_markup(area.name);
      if (area.margin > 0.0 && figure_.to_scale) {
        text += fmt::format(
            "<path class=\"margin\" stroke-width=\"{:.2f}\" d=\"{}\"><title>{}: clearance</title></path>\n",
            2.0 * (to_x(area.margin) - to_x(0.0)), path, name);
      }
      text += fmt::format("<path class=\"{}\" d=\"{}\"><title>{}</title></path>\n",
                          area.open ? "line border" : "area", path, name);
    }
    for (std::size_t i = 0; i < figure_.lines.size(); ++i) {
      const FigureLine& line = figure_.lines[i];
      text += fmt::format("<path class=\"line{}\" {} d=\"{}\"><title>{}</title></path>\n", choice_class(line),
                          stroke(i), points_text(line.xs, line.ys, to_x, to_y), escaped_markup(line.name));
    }
    return text + "</svg>\n" + legend() + "</g>\n";
  }

 private:
  void include(const std::vector<double>& xs, const std::vector<double>& ys, const std::string& name) {
    if (xs.size() != ys.size()) {
      throw InputError({figure_.title,
                        "line \"" + name + "\" has " + std::to_string(xs.size()) + " x and " +
                            std::to_string(ys.size()) + " y values",
                        "Each point needs both.", ""});
    }
    for (std::size_t i = 0; i < xs.size(); ++i) {
      if (!std::isfinite(xs[i]) || !std::isfinite(ys[i])) continue;
      x_.include(xs[i]);
      y_.include(ys[i]);
    }
  }

  static void widen(Range& range) {
    const double margin =
        range.span() > 0.0 ? 0.04 * range.span() : std::max(0.5 * std::fabs(range.low), 0.5);
    range.low -= margin;
    range.high += margin;
  }

  void fit_scale() {
    const double natural = inner_width_ * y_.span() / x_.span();
    inner_height_ = std::clamp(natural, 0.2 * width_, 1.2 * width_);
    const double per_pixel = std::max(x_.span() / inner_width_, y_.span() / inner_height_);
    grow(x_, per_pixel * inner_width_);
    grow(y_, per_pixel * inner_height_);
  }

  static void grow(Range& range, double span) {
    const double extra = 0.5 * (span - range.span());
    range.low -= extra;
    range.high += extra;
  }

  [[nodiscard]] double at_x(double x) const { return kLeft + inner_width_ * (x - x_.low) / x_.span(); }
  [[nodiscard]] double at_y(double y) const { return top_ + inner_height_ * (y_.high - y) / y_.span(); }

  [[nodiscard]] std::string axes() const {
    const double right = kLeft + inner_width_;
    const double bottom = top_ + inner_height_;
    std::string text;
    const double x_step = round_step(x_.span(), inner_width_ / 90.0);
    for (double k = std::ceil(x_.low / x_step); k * x_step <= x_.high; ++k) {
      const double x = at_x(k * x_step);
      text += fmt::format(
          "<path class=\"grid\" d=\"M{0:.2f} {1:.2f}V{2:.2f}\"/><text x=\"{0:.2f}\" y=\"{3:.2f}\" "
          "text-anchor=\"middle\">{4}</text>\n",
          x, top_, bottom, bottom + 18.0, rounded_text(tick(k, x_step), 6));
    }
    const double y_step = round_step(y_.span(), inner_height_ / 50.0);
    for (double k = std::ceil(y_.low / y_step); k * y_step <= y_.high; ++k) {
      const double y = at_y(k * y_step);
      text += fmt::format(
          "<path class=\"grid\" d=\"M{0:.2f} {1:.2f}H{2:.2f}\"/><text x=\"{3:.2f}\" y=\"{4:.2f}\" "
          "text-anchor=\"end\">{5}</text>\n",
          kLeft, y, right, kLeft - 8.0, y + 4.0, rounded_text(tick(k, y_step), 6));
    }
    text +=
        fmt::format("<rect class=\"frame\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/>\n",
                    kLeft, top_, inner_width_, inner_height_);
    text += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{}</text>\n",
                        0.5 * (kLeft + right), bottom + 40.0, escaped_markup(figure_.x_label));
    text +=
        fmt::format("<text transform=\"translate(18 {:.2f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                    0.5 * (top_ + bottom), escaped_markup(figure_.y_label));
    return text;
  }

  [[nodiscard]] std::string stroke(std::size_t index) const {
    const bool dashed = figure_.lines[index].dashed;
    const bool marked = std::any_of(figure_.lines.begin(), figure_.lines.end(),
                                    [](const FigureLine& line) { return line.dashed; });
    if (!marked && figure_.lines[index].choice > 0) return choice_stroke(figure_.lines[index].choice);
    // Where the caller marks none, lines that lie on each other stay visible through the gaps.
    return line_stroke(index, dashed ? 1 + index % 3 : marked ? 0 : index);
  }

  static std::string choice_class(const FigureLine& line) {
    return line.choice > 0 ? " choice-" + std::to_string(line.choice) : "";
  }

  /// What a legend names: a line, or all areas of one name.
  struct LegendEntry {
    const std::string* name;
    std::optional<std::size_t> line;
  };

  [[nodiscard]] std::vector<LegendEntry> legend_entries() const {
    std::vector<LegendEntry> entries;
    // The title names a line that is alone.
    if (!figure_.legend || (figure_.lines.size() == 1 && figure_.areas.empty())) return entries;
    for (std::size_t i = 0; i < figure_.lines.size(); ++i) {
      if (!figure_.lines[i].name.empty()) entries.push_back({&figure_.lines[i].name, i});
    }
    for (const FigureArea& area : figure_.areas) {
      const bool named = std::any_of(entries.begin(), entries.end(), [&](const LegendEntry& entry) {
        return !entry.line && *entry.name == area.name;
      });
      if (!named) entries.push_back({&area.name, {}});
    }
    return entries;
  }

  /// Places legend entries left to right, top to bottom; returns the rows, and calls `place` for each line of an entry.
  int lay_out_legend(auto&& place) const {
    double x = 0.0;
    int row = 0;
    const std::vector<LegendEntry> entries = legend_entries();
    for (const LegendEntry& entry : entries) {
      const double needed = 48.0 + 7.2 * static_cast<double>(entry.name->size());
      if (x > 0.0 && x + needed > inner_width_) {
        x = 0.0;
        ++row;
      }
      const std::vector<std::string> lines =
          lines_within(*entry.name, kTextSize, inner_width_ - kLegendSample);
      for (std::size_t i = 0; i < lines.size(); ++i) {
        if (i > 0) ++row;
        place(entry, kLeft + x, row, i == 0, lines[i]);
      }
      x += lines.size() > 1 ? inner_width_ : needed;
    }
    return entries.empty() ? 0 : row + 1;
  }

  [[nodiscard]] int legend_rows() const {
    return lay_out_legend([](const LegendEntry&, double, int, bool, const std::string&) {});
  }

  [[nodiscard]] std::string sample(const LegendEntry& entry, double x, double y) const {
    return entry.line ? fmt::format(R"(<path class="line{}" {} d="M{:.2f} {:.2f}h28"/>)",
                                    choice_class(figure_.lines[*entry.line]), stroke(*entry.line), x, y - 4.0)
                      : fmt::format(R"(<path class="area" d="M{:.2f} {:.2f}h28v10h-28Z"/>)", x, y - 9.0);
  }

  [[nodiscard]] std::string legend() const {
    std::string text;
    const double top = top_ + inner_height_ + kBottom + 12.0;
    lay_out_legend([&](const LegendEntry& entry, double x, int row, bool first, const std::string& words) {
      const double y = top + kLegendLine * row;
      if (first) text += sample(entry, x, y);
      text += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n", x + kLegendSample, y,
                          escaped_markup(words));
    });
    return text;
  }

  const Figure& figure_;
  double width_;
  Range x_;
  Range y_;
  std::vector<std::string> title_;
  double top_ = kTop;  // of the axes
  double inner_width_ = 0.0;
  double inner_height_ = 0.0;
};

}  // namespace

std::string figures_svg(const std::vector<Figure>& figures, double width) {
  std::string body;
  double height = 0.0;
  for (const Figure& figure : figures) {
    const Panel panel(figure, width);
    body += panel.svg(height);
    height += panel.height();
  }
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
             "{0:.0f} {1:.0f}\" "
             "role=\"img\" font-family=\"DejaVu Sans, sans-serif\" font-size=\"12\" fill=\"#16202a\">\n"
             "<style>.title{{font-size:15px;font-weight:bold}}.grid{{stroke:#dfe4e8;fill:none}}.frame{{"
             "stroke:#7b8794;fill:none}}"
             ".line{{fill:none;stroke-width:2;stroke-linejoin:round}}.area{{fill:#c0282d;fill-opacity:.18;"
             "stroke:#c0282d}}.margin{{fill:none;stroke:#c0282d;stroke-opacity:.12;stroke-linejoin:round;"
             "stroke-linecap:round}}.border{{stroke:#c0282d}}</style>\n"
             "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
             width, std::ceil(height)) +
         body + "</svg>\n";
}

}  // namespace glissade
