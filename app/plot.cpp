#include "glissade/core/math.hpp"
#include "glissade/core/words.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/flights.hpp"
#include "glissade/report/figure.hpp"
#include "glissade/report/figure_png.hpp"
#include "glissade/report/report.hpp"
#include "glissade/report/ride_figure.hpp"

#include "app/command_line.hpp"
#include "app/output_files.hpp"
#include "app/searched_track.hpp"
#include "app/time_budget.hpp"
#include "app/track_input.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::app {
namespace {

constexpr const char* kPlotDescription =
    "Draw a track and the ride down it as an SVG or PNG file: profile, slope, speed, load, curvature, "
    "energy.\n"
    "\n"
    "A profile shows the straight line and the fastest track beside the one that is asked for.";

constexpr const char* kPlotFooter =
    "Examples:\n"
    "  glissade plot designs/grain_chute.yaml -o chute.svg\n"
    "  glissade plot designs/grain_chute.yaml --what speed,load -o ride.png\n"
    "  glissade plot --run 10 --drop 5 --friction-angle 11deg --what energy -o energy.svg";

struct PlotArguments {
  TrackInput input{TrackInput::Scope::one_kind};
  std::vector<std::string> what = {"profile"};
  std::string output;
  TimeBudget time_budget;
  Verbosity verbosity;
};

RideQuantity quantity_named(const std::string& text) {
  if (const auto quantity = ride_quantity(text)) return *quantity;
  std::vector<std::string> words;
  for (const RideQuantity quantity : ride_quantities()) words.emplace_back(word(quantity));
  throw InputError({"--what", "'" + text + "' cannot be drawn", "", listed(words)});
}

/// A picture's format by the end of its name.
bool is_png(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".png") return true;
  if (ending == ".svg") return false;
  throw InputError({"--output", file.string() + " is neither a .svg nor a .png file",
                    "The end of the name says what is drawn.", "-o track.svg"});
}

void add_keep_outs(Figure& figure, const Design& design) {
  for (const ReportKeepOut& area : report_keep_outs(design)) {
    FigureArea drawn{area.name, {}, {}, area.clearance, area.open};
    for (const Vec2& point : area.points) {
      drawn.xs.push_back(point.x);
      drawn.ys.push_back(point.y - design.track.start.z);
    }
    figure.areas.push_back(std::move(drawn));
  }
}

/// The walls and the underside that obstacles are kept clear of, and the headroom.
void add_envelope(Figure& figure, const Design& design, const Track& track) {
  if (!design.limits) return;
  for (EnvelopeEdge& edge : envelope_edges(*track.centerline, envelope_of(design))) {
    FigureLine line{std::move(edge.name), {}, {}, edge.dashed};
    for (const Vec2 point : edge.points) {
      line.xs.push_back(point.x);
      line.ys.push_back(point.y);
    }
    figure.lines.push_back(std::move(line));
  }
}

/// A stream in the air with its thickness, its hood, and the pulley that feeds it.
void add_surroundings(Figure& figure, const Design& given, const Track& track) {
  const Design design = as_solved(given, track);
  const auto add = [&](const char* name, const std::vector<Vec2>& points, bool dashed) {
    FigureLine line{name, {}, {}, dashed};
    for (const Vec2 point : points) {
      line.xs.push_back(point.x);
      line.ys.push_back(point.y);
    }
    figure.lines.push_back(std::move(line));
  };
  if (design.hood) add("hood", hood_line(design, track), false);
  bool named = false;
  for (const StreamFlight& flight : stream_flights(design, track)) {
    add(named ? "" : "stream in the air", flight.path, true);
    add("", flight.beyond, true);
    named = true;
  }
  if (!design.feed || design.feed->kind != FeedKind::belt) return;
  const Vec2 pulley = feed_fall(design).pulley;
  std::vector<Vec2> circle;
  constexpr int kSides = 48;
  for (int i = 0; i <= kSides; ++i) {
    const double turn = 4.0 * kRightAngle * i / kSides;
    circle.push_back(pulley + design.feed->pulley_radius * Vec2{math::cos(turn), math::sin(turn)});
  }
  add("head pulley", circle, false);
}

Figure figure_of(RideQuantity quantity, const Design& design, const Track& track) {
  const std::string kind = track.search ? searched_name(design) : std::string(word(design.centerline.kind));
  std::vector<FigureRide> rides = {{kind, &track.motion}};
  if (quantity != RideQuantity::profile) return ride_figure(quantity, rides);
  if (track.optimum && kind != "fastest") {
    rides.push_back({design.limits ? "fastest without limits" : "fastest", &*track.optimum, true});
  }
  if (track.straight && kind != "straight") rides.push_back({"straight line", &*track.straight, true});
  Figure figure = ride_figure(quantity, rides);
  add_surroundings(figure, design, track);
  add_envelope(figure, design, track);
  add_keep_outs(figure, as_solved(design, track));
  return figure;
}

ExitCode plot(const PlotArguments& options) {
  const std::filesystem::path file = options.output;
  const bool png = is_png(file);
  std::vector<RideQuantity> quantities;
  for (const std::string& text : options.what) quantities.push_back(quantity_named(text));
  const Design design = options.input.design();
  const Track track = searched_track(design, options.verbosity, options.time_budget.seconds());
  std::vector<Figure> figures;
  for (const RideQuantity quantity : quantities) {
    figures.push_back(figure_of(quantity, design, track));
    if (!design.name.empty()) figures.back().title = design.name + ": " + figures.back().title;
  }
  const std::string svg = figures_svg(figures);
  OutputFiles files;
  files.make(options.output, [&](const std::filesystem::path& picture) {
    if (png) {
      write_png(picture, svg);
    } else {
      write_atomically(picture, svg);
    }
  });
  files.put_in_place();
  require_searched_through(design, track);
  return ExitCode::done;
}

}  // namespace

void add_plot(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("plot", kPlotDescription)->footer(kPlotFooter);
  const auto options = std::make_shared<PlotArguments>();
  options->input.add_to(command);
  command
      .add_option("--what", options->what,
                  "What to draw, separated by commas: profile, slope, speed, load, curvature, energy\n"
                  "[default: profile]")
      ->type_name("LIST")
      ->delimiter(',')
      ->group("Options");
  command.add_option("-o,--output", options->output, "File to write, .svg or .png")
      ->type_name("FILE")
      ->required()
      ->group("Options");
  options->time_budget.add_to(command);
  options->verbosity.add_to(command, "Show no progress");
  command.callback([options, &action] { action = [options] { return plot(*options); }; });
}

}  // namespace glissade::app
