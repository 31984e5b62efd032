#include "glissade/report/figure.hpp"

#include "glissade/core/error.hpp"
#include "glissade/report/figure_png.hpp"

#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <regex>

using namespace glissade;

namespace {

Figure ramp() {
  Figure figure;
  figure.title = "Ramp";
  figure.x_label = "run x [m]";
  figure.y_label = "height z [m]";
  figure.lines = {{"straight", {0.0, 10.0}, {5.0, 0.0}, false},
                  {"bent", {0.0, 2.0, 10.0}, {5.0, 1.0, 0.0}, true}};
  return figure;
}

/// Points of the n-th line of an SVG, in its coordinates.
std::vector<std::pair<double, double>> points_of_line(const std::string& svg, int n) {
  static const std::regex kLine("<path class=\"line\"[^>]* d=\"([^\"]*)\"><title>");
  auto match = std::sregex_iterator(svg.begin(), svg.end(), kLine);
  std::advance(match, n);
  const std::string path = (*match)[1];
  static const std::regex kPoint("[ML]([-0-9.]+) ([-0-9.]+)");
  std::vector<std::pair<double, double>> points;
  for (auto point = std::sregex_iterator(path.begin(), path.end(), kPoint); point != std::sregex_iterator();
       ++point) {
    points.emplace_back(std::stod((*point)[1]), std::stod((*point)[2]));
  }
  return points;
}

}  // namespace

TEST_CASE("figure: one metre on x is one metre on y where it is to scale") {
  Figure figure = ramp();
  figure.to_scale = true;
  const auto points = points_of_line(figures_svg({figure}), 0);
  REQUIRE(points.size() == 2);
  const double dx = points[1].first - points[0].first;
  const double dy = points[1].second - points[0].second;
  CHECK(dx / dy == Approx(10.0 / 5.0).epsilon(1e-3));
}

/// Every text of a class, as it stands in the markup, with its place.
struct Placed {
  double x = 0.0;
  double y = 0.0;
  std::string text;
};
std::vector<Placed> texts_of(const std::string& svg, const std::string& attributes) {
  const std::regex pattern("<text" + attributes + " x=\"([-0-9.]+)\" y=\"([-0-9.]+)\">([^<]*)</text>");
  std::vector<Placed> found;
  for (auto one = std::sregex_iterator(svg.begin(), svg.end(), pattern); one != std::sregex_iterator(); ++one)
    found.push_back({std::stod((*one)[1]), std::stod((*one)[2]), (*one)[3]});
  return found;
}

TEST_CASE("figure: a long title and long names stand in lines within the picture, to the last word") {
  const std::string words =
      "Materialrutsche unter dem Becherwerk, Bauabschnitt zwei, mit Absperrschieber und Verschleissblechen, "
      "Achse 14";
  const std::string one_word(200, 'W');
  for (const double width : {348.0, 540.0, 800.0}) {
    for (const std::string& name :
         {std::string("Short"), words, words + " " + words.substr(0, 80), one_word}) {
      INFO(width << " " << name);
      Figure figure = ramp();
      figure.title = name + ": normal load";
      figure.lines[0].name = name;
      const std::string svg = figures_svg({figure}, width);
      std::string title;
      for (const Placed& line : texts_of(svg, " class=\"title\"")) {
        // What letters of the bold font of the pictures are wide at least, on average.
        double ems = 0.0;
        for (const char letter : line.text) ems += letter == 'W' ? 1.1 : 0.62;
        CHECK(line.x + 15.0 * ems < width);
        title += (title.empty() || line.text.front() == 'W' ? "" : " ") + line.text;
      }
      CHECK(title.ends_with(": normal load"));
      CHECK(title.size() >= figure.title.size() - 1);
      const auto titles = texts_of(svg, " class=\"title\"");
      const std::regex frame("class=\"frame\" x=\"[0-9.]+\" y=\"([0-9.]+)\"");
      std::smatch top;
      REQUIRE(std::regex_search(svg, top, frame));
      CHECK(std::stod(top[1]) == Approx(titles.back().y + 16.0));
      const std::regex height("<svg [^>]* height=\"([0-9]+)\"");
      std::smatch whole;
      REQUIRE(std::regex_search(svg, whole, height));
      for (const Placed& line : texts_of(svg, "")) {
        CHECK(line.y < std::stod(whole[1]));
        if (line.text != "bent" && name != one_word)
          CHECK(line.x + 12.0 * 0.55 * static_cast<double>(line.text.size()) < width);
      }
    }
  }
}

TEST_CASE("figure: the names of panels and lines are escaped") {
  Figure figure = ramp();
  figure.title = "<b>&\"";
  figure.lines[0].name = "<script>alert(1)</script>";
  const std::string svg = figures_svg({figure});
  CHECK(svg.find("<script") == std::string::npos);
  CHECK(svg.find("&lt;script&gt;alert(1)&lt;/script&gt;") != std::string::npos);
  CHECK(svg.find("&lt;b&gt;&amp;&quot;") != std::string::npos);
}

TEST_CASE("figure: the legend names areas, each name once") {
  Figure figure = ramp();
  const FigureArea area{"keep-out", {0.0, 1.0, 1.0}, {0.0, 0.0, 1.0}};
  figure.areas = {area, area};
  const std::string svg = figures_svg({figure});
  const std::size_t first = svg.find(">keep-out</text>");
  REQUIRE(first != std::string::npos);
  CHECK(svg.find(">keep-out</text>", first + 1) == std::string::npos);
}

TEST_CASE("figure: a value that is not finite interrupts its line") {
  Figure figure = ramp();
  figure.lines[1] = {"gap", {0.0, 1.0, 2.0, 3.0}, {0.0, std::nan(""), 1.0, 2.0}, false};
  const std::string svg = figures_svg({figure});
  CHECK(points_of_line(svg, 1).size() == 3);
  CHECK(svg.find("nan") == std::string::npos);
}

TEST_CASE("figure: panels stand one below the other and ticks are round numbers") {
  const std::string svg = figures_svg({ramp(), ramp()});
  CHECK(std::regex_search(svg, std::regex("translate\\(0 0\\.00\\)")));
  CHECK(std::regex_search(svg, std::regex("translate\\(0 [1-9][0-9]+\\.")));
  CHECK(svg.find(">10</text>") != std::string::npos);
  CHECK(figures_svg({ramp()}) == figures_svg({ramp()}));
}

TEST_CASE("figure: nothing to draw and lines of unequal columns are refused with their names") {
  Figure empty = ramp();
  empty.lines.clear();
  CHECK_THROWS_WITH(figures_svg({empty}), Catch::Matchers::Contains("Ramp: the figure has no point to draw"));
  Figure uneven = ramp();
  uneven.lines[0].ys.push_back(1.0);
  CHECK_THROWS_WITH(figures_svg({uneven}),
                    Catch::Matchers::Contains("line \"straight\" has 2 x and 3 y values"));
}

TEST_CASE("figure: a PNG of the stated size appears whole, and text that is no SVG is refused") {
  const TempDir folder;
  write_png(folder / "ramp.png", figures_svg({ramp()}, 400.0), 2.0);
  std::ifstream file(folder / "ramp.png", std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  REQUIRE(bytes.size() > 2000);
  CHECK(bytes.substr(1, 3) == "PNG");
  // Width is the big-endian number at byte 16 of the header chunk.
  const auto width = static_cast<unsigned char>(bytes[18]) * 256 + static_cast<unsigned char>(bytes[19]);
  CHECK(width == 800);
  CHECK_THROWS_AS(write_png(folder / "none.png", "not a drawing"), InputError);
  CHECK(folder.names() == std::vector<std::string>{"ramp.png"});
}
