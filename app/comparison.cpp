#include "app/comparison.hpp"

#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/report/ride_figure.hpp"

#include "app/searched_track.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace glissade::app {
namespace {

Design of_kind(Design design, CenterlineKind kind) {
  design.centerline.kind = kind;
  return design;
}

std::vector<CenterlineKind> kinds_for(const Design& design) {
  std::vector<CenterlineKind> kinds = {CenterlineKind::fastest, CenterlineKind::constant_speed,
                                       CenterlineKind::straight, CenterlineKind::cycloid,
                                       CenterlineKind::no_curvature_load};
  const CenterlineKind own = design.centerline.kind;
  if (is_drawn(own)) kinds.insert(kinds.begin(), own);
  return kinds;
}

Entry solved(Design design, const RunContext& context) {
  return entry_of(std::move(design), [&](const Design& one) { return solve(one, context); });
}

/// Whether work goes on that was asked to end: a search has met the request.
bool goes_on(const RunContext& context) {
  return context.goes_on_after_stop != nullptr && *context.goes_on_after_stop;
}

void enter(const RunContext& context, const std::string& stage, std::size_t done, std::size_t all) {
  if (context.stop.stop_requested() && !goes_on(context)) throw Interrupted({"", "interrupted", "", ""});
  if (context.progress) context.progress(stage, static_cast<double>(done) / static_cast<double>(all));
}

/// What the closed form of the fastest track takes: no limits, no range of friction.
Design without_limits(Design design) {
  design.limits.reset();
  design.body.low_friction.reset();
  design.body.high_friction.reset();
  return design;
}

/// A free finish fixed to where a track ends.
Design finishing_like(Design design, const Track& track) {
  const CenterlinePoint end = track.centerline->at(track.centerline->length());
  design.track.start = track.placement.start();
  design.track.finish = track.placement.to_space(end.x, end.drop, 0.0);
  design.track.free_finish = FinishKind::point;
  design.track.free_start = false;
  design.track.edge.reset();
  return design;
}

bool is_searched(const Design& design) {
  return design.centerline.kind == CenterlineKind::fastest &&
         (design.limits || design.track.free_finish != FinishKind::point);
}

using Naming = std::function<std::string(const Entry&)>;

std::vector<FigureRide> rides_of(const std::vector<Entry>& entries, const std::vector<std::string>& names) {
  std::vector<FigureRide> rides;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].track) rides.push_back({names[i], &entries[i].track->motion});
  }
  return rides;
}

std::vector<FigureRide> rides_of(const std::vector<Entry>& entries, const Naming& name) {
  std::vector<FigureRide> rides;
  for (const Entry& entry : entries) {
    if (entry.track) rides.push_back({name(entry), &entry.track->motion});
  }
  return rides;
}

/// The number of an entry among all of them, from 1: a line has the style of its number in every figure.
/// @return 0: none is so called
int number_of(const std::vector<Entry>& entries, const std::string& name) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entry_name(entries[i]) == name) return static_cast<int>(i) + 1;
  }
  return 0;
}

std::string friction_name(const Entry& entry) {
  return angle_text(entry.design.body.friction.angle());
}

std::string design_name(const Entry& entry) {
  const Design& design = entry.design;
  return design.name.empty() ? design.file.stem().string() : design.name;
}

/// The last parts of where a design's file lies: "b/chute"; all of them, and the ending, where that is what counts.
/// @param parts  > 0
std::string end_of_path(const std::filesystem::path& file, std::size_t parts, bool with_ending) {
  const std::filesystem::path whole = std::filesystem::absolute(file).lexically_normal();
  const std::vector<std::filesystem::path> all(whole.begin(), whole.end());
  std::filesystem::path end;
  for (std::size_t i = all.size() - std::min(parts, all.size()); i < all.size(); ++i) end /= all[i];
  return (with_ending ? end : end.replace_extension()).generic_string();
}

/// As few last parts of each file's path as tell the files apart.
std::vector<std::string> ends_that_tell(const std::vector<std::filesystem::path>& files) {
  constexpr std::size_t kMost = 64;  // deeper no path is told apart
  std::vector<std::string> ends;
  for (std::size_t parts = 1; parts <= kMost; ++parts) {
    for (const bool with_ending : {false, true}) {
      ends.clear();
      for (const std::filesystem::path& file : files) ends.push_back(end_of_path(file, parts, with_ending));
      if (std::set<std::string>(ends.begin(), ends.end()).size() == ends.size()) return ends;
    }
  }
  return ends;
}

/// Friction angles from none to a little below the mean slope, where from rest nothing arrives any more.
std::vector<double> friction_angles_deg(const Design& design) {
  constexpr int kSteps = 40;
  constexpr double kMostOfMeanSlope = 0.98;
  constexpr double kLargest = 60.0;
  const Endpoints endpoints = endpoints_of(design);
  const double mean_slope = Angle::from_radians(math::atan2(endpoints.drop, endpoints.run)).degrees();
  const double highest = mean_slope > 0.0 ? std::min(kMostOfMeanSlope * mean_slope, kLargest) : kLargest;
  std::vector<double> angles;
  for (int step = 0; step <= kSteps; ++step) {
    // Closer together towards the end, where times grow without bound.
    const double left = 1.0 - static_cast<double>(step) / kSteps;
    angles.push_back(highest * (1.0 - left * left));
  }
  return angles;
}

/// Whether what was searched for was not found to the end: its figures would tell of the search.
bool ended_early(const Entry& entry) {
  if (!entry.track) return entry.interrupted;
  const Track& track = *entry.track;
  return (track.search && track.search->ended_early) || (track.early_hood && track.early_hood->ended_early);
}

/// The track of a design at another friction.
/// @throws InputError as with_friction(), at what the track meets
Track at_friction(const Design& design, const Friction& friction,
                  const std::function<Track(const Design&)>& make) {
  Track track = make(with_friction(design, friction, shortest_length_of(design)));
  static_cast<void>(with_friction(design, friction, track.centerline->length()));
  return track;
}

/// One kind over friction angles.
class OverFriction {
 public:
  /// @param own  the entry of the design's own centerline
  OverFriction(const Design& design, CenterlineKind kind, const Entry& own, const RunContext& context)
      : design_(of_kind(design, kind)), own_(own), context_(context) {
    context_.progress = {};
  }

  /// @return none where nothing arrives, or a search ended early; what is searched for is not, once work is to end
  std::optional<Track> at(double angle_deg) {
    if (stopped_) return {};
    const Friction friction = Friction::from_angle(Angle::from_degrees(angle_deg));
    Entry entry = entry_of(design_, [&](const Design& design) {
      return at_friction(design, friction, [this](const Design& moved) { return track_of(moved); });
    });
    if (!ended_early(entry)) return std::move(entry.track);
    ended_early_ = true;
    stopped_ = context_.stop.stop_requested();
    return {};
  }

  [[nodiscard]] bool was_cut() const { return ended_early_; }
  [[nodiscard]] bool was_interrupted() const { return stopped_; }

 private:
  /// A curve that is drawn is the same at every friction: fitting it to measured points takes its time once.
  [[nodiscard]] Track track_of(const Design& design) const {
    if (!is_drawn(design.centerline.kind) || !own_.track) return solve(design, context_);
    return ride(as_solved(design, *own_.track), own_.track->centerline);
  }

  Design design_;
  const Entry& own_;
  RunContext context_;
  bool ended_early_ = false;
  bool stopped_ = false;
};

/// A figure without a point is none.
bool is_empty(const Figure& figure) {
  return std::none_of(figure.lines.begin(), figure.lines.end(), [](const FigureLine& line) {
    return std::any_of(line.ys.begin(), line.ys.end(), [](double y) { return std::isfinite(y); });
  });
}

/// Two panels over the friction angle: travel time, and the steepest slope anywhere on the track.
/// Limits are left aside: a search for each friction would take minutes.
/// @param entries  the rides of all kinds, that of the design's own centerline first
KindsFigures over_friction(Design design, const std::vector<Entry>& entries, const RunContext& context) {
  const std::string aside = design.limits ? ", without limits" : "";
  design = without_limits(std::move(design));
  design.gates.reset();  // nobody looks at their rides
  const double missing = std::numeric_limits<double>::quiet_NaN();
  Figure time{"Travel time over friction" + aside, "friction angle [deg]", "travel time [s]", {}, {}, false};
  Figure slope{"Steepest slope over friction" + aside,
               "friction angle [deg]",
               "steepest slope angle [deg]",
               {},
               {},
               false};
  KindsFigures made;
  const std::vector<CenterlineKind> kinds = kinds_for(design);
  for (std::size_t index = 0; index < kinds.size(); ++index) {
    const CenterlineKind kind = kinds[index];
    enter(context, "travel times over friction", index, kinds.size());
    FigureLine times{std::string(word(kind)), {}, {}, false, number_of(entries, std::string(word(kind)))};
    FigureLine slopes = times;
    OverFriction tracks(design, kind, entries.front(), context);
    for (const double angle : friction_angles_deg(design)) {
      const std::optional<Track> track = tracks.at(angle);
      const bool arrives = track && track->motion.arrived() && enters(track->motion);
      times.xs.push_back(angle);
      times.ys.push_back(arrives ? track->motion.travel_time() : missing);
      slopes.xs.push_back(angle);
      slopes.ys.push_back(track ? track->steepest_slope_angle.degrees() : missing);
    }
    made.ended_early = made.ended_early || tracks.was_cut();
    made.interrupted = made.interrupted || tracks.was_interrupted();
    time.lines.push_back(std::move(times));
    slope.lines.push_back(std::move(slopes));
  }
  for (Figure* const figure : {&time, &slope}) {
    if (made.ended_early) figure->title += ", as far as searches came to their end";
    if (!made.ended_early || !is_empty(*figure)) made.figures.push_back(std::move(*figure));
  }
  return made;
}

/// @throws Interrupted if work was asked to end before any track was there
void require_any_track(const std::vector<Entry>& entries) {
  for (const Entry& entry : entries) {
    if (entry.track) return;
  }
  for (const Entry& entry : entries) {
    if (entry.interrupted) throw Interrupted({entry.design.where("limits"), entry.problem, "", ""});
  }
}

}  // namespace

Entry entry_of(Design design, const std::function<Track(const Design&)>& make) {
  Entry entry{std::move(design), {}, {}};
  try {
    entry.track = make(entry.design);
  } catch (const InputError& error) {
    entry.problem = error.issues().front().what;
  } catch (const InfeasibleError& error) {
    entry.problem = error.issues().front().what;
  } catch (const ConvergenceError& error) {
    entry.problem = error.issues().front().what;
  } catch (const Interrupted& error) {
    entry.problem = error.issues().front().what;
    entry.interrupted = true;
  }
  return entry;
}

std::string entry_name(const Entry& entry) {
  return is_searched(entry.design) ? "fastest in limits" : std::string(word(entry.design.centerline.kind));
}

std::vector<Entry> every_kind(const Design& design, const RunContext& context) {
  std::vector<Entry> entries;
  Design others = design;
  const Design searched = of_kind(design, CenterlineKind::fastest);
  if (is_searched(searched)) {
    entries.push_back(solved(searched, context));
    require_any_track(entries);
    const bool free_finish = design.track.free_finish != FinishKind::point;
    if (free_finish && !entries.back().track) return entries;
    if (free_finish) others = finishing_like(others, *entries.back().track);
  }
  for (const CenterlineKind kind : kinds_for(others)) {
    Design one = of_kind(others, kind);
    if (kind == CenterlineKind::fastest) one = without_limits(std::move(one));
    entries.push_back(solved(std::move(one), context));
  }
  require_any_track(entries);
  return entries;
}

std::vector<Entry> every_design(std::vector<Design> designs, const RunContext& context) {
  std::vector<Entry> entries;
  entries.reserve(designs.size());
  for (Design& design : designs) entries.push_back(solved(std::move(design), context));
  require_any_track(entries);
  return entries;
}

std::vector<Entry> friction_sweep(const Design& design, const std::vector<Friction>& frictions) {
  std::vector<Entry> entries;
  for (const Friction friction : frictions) {
    const Design own = of_kind(design, CenterlineKind::constant_speed);
    // The curve is there whether or not a body from rest arrives on it.
    Entry entry = entry_of(with_friction(own, friction, 0.0),
                           [](const Design& one) { return ride(one, make_centerline(one)); });
    if (entry.track) static_cast<void>(with_friction(own, friction, entry.track->centerline->length()));
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::vector<std::string> design_names(const std::vector<Entry>& entries) {
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::size_t>> by_name;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    names.push_back(design_name(entries[i]));
    by_name[names.back()].push_back(i);
  }
  for (const auto& [name, same] : by_name) {
    if (same.size() == 1) continue;
    std::vector<std::filesystem::path> files;
    for (const std::size_t i : same) files.push_back(entries[i].design.file);
    const std::vector<std::string> ends = ends_that_tell(files);
    for (std::size_t k = 0; k < same.size(); ++k) {
      const bool named = !entries[same[k]].design.name.empty();
      names[same[k]] = named ? name + " (" + ends[k] + ")" : ends[k];
    }
  }
  return names;
}

KindsFigures kinds_figures(const Design& design, const std::vector<Entry>& entries,
                           const RunContext& context) {
  const std::vector<FigureRide> rides = rides_of(entries, entry_name);
  // A free finish is by now where the track within the limits ends.
  const Design fixed = of_kind(entries.back().design, design.centerline.kind);
  KindsFigures made = over_friction(fixed, entries, context);
  std::vector<Figure> of_rides = {ride_figure(RideQuantity::profile, rides),
                                  ride_figure(RideQuantity::speed, rides)};
  for (Figure& figure : of_rides) {
    for (FigureLine& line : figure.lines) line.choice = number_of(entries, line.name);
  }
  made.figures.insert(made.figures.begin(), of_rides.begin(), of_rides.end());
  return made;
}

std::vector<Figure> sweep_figures(const std::vector<Entry>& entries) {
  const std::vector<FigureRide> rides = rides_of(entries, friction_name);
  std::vector<Figure> figures = {ride_figure(RideQuantity::profile, rides),
                                 ride_figure(RideQuantity::slope, rides)};
  figures.front().title = "Constant-speed tracks by friction angle";
  const auto& p = entries.front().design.centerline.constant_speed_p;
  if (p) figures.front().title += ", P = " + rounded_text(*p, 6) + " m\u00b2/s\u00b2";
  return figures;
}

namespace {

/// Every profile with its take-off edge at the origin.
Figure profiles_to_edge(const std::vector<Entry>& entries) {
  const std::vector<std::string> names = design_names(entries);
  Figure figure{"Profile, from the edge", "x [m]", "z [m]", {}, {}, true};
  constexpr int kPoints = 200;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    if (!entry.track) continue;
    FigureLine line;
    line.name = names[i];
    line.choice = static_cast<int>(i) + 1;
    const Centerline& track = *entry.track->centerline;
    const Endpoints end = track.endpoints();
    for (int k = 0; k <= kPoints; ++k) {
      const CenterlinePoint point = track.at(std::min(track.length() * k / kPoints, track.length()));
      line.xs.push_back(point.x - end.run);
      line.ys.push_back(end.drop - point.drop);
    }
    figure.lines.push_back(std::move(line));
  }
  return figure;
}

Figure speeds_by_gate(const std::vector<Entry>& entries) {
  const std::vector<std::string> names = design_names(entries);
  Figure figure{"Speed at the measuring place", "gate, from the lowest", "speed [m/s]", {}, {}, false};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    if (!entry.track || !entry.track->gates) continue;
    FigureLine line;
    line.name = names[i];
    line.choice = static_cast<int>(i) + 1;
    for (const GateRide& ride : entry.track->gates->conditions.front().rides) {
      line.xs.push_back(ride.gate.number);
      line.ys.push_back(ride.speed_at_measuring_place.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    figure.lines.push_back(std::move(line));
  }
  return figure;
}

}  // namespace

bool are_hills(const std::vector<Entry>& entries) {
  const auto has_track = [](const Entry& entry) { return entry.track.has_value(); };
  if (std::none_of(entries.begin(), entries.end(), has_track)) return false;
  return std::all_of(entries.begin(), entries.end(), [](const Entry& entry) {
    return !entry.track || entry.design.centerline.kind == CenterlineKind::in_run || entry.design.hill.size;
  });
}

std::vector<Figure> design_figures(const std::vector<Entry>& entries) {
  const std::vector<FigureRide> rides = rides_of(entries, design_names(entries));
  std::vector<Figure> figures;
  for (const RideQuantity quantity :
       {RideQuantity::profile, RideQuantity::slope, RideQuantity::speed, RideQuantity::load}) {
    figures.push_back(ride_figure(quantity, rides));
    // One line a design that has a track.
    std::size_t line = 0;
    for (std::size_t i = 0; i < entries.size() && line < figures.back().lines.size(); ++i) {
      if (entries[i].track) figures.back().lines[line++].choice = static_cast<int>(i) + 1;
    }
  }
  if (are_hills(entries)) {
    figures.front() = profiles_to_edge(entries);
    Figure gates = speeds_by_gate(entries);
    if (!gates.lines.empty()) figures.push_back(std::move(gates));
  }
  return figures;
}

}  // namespace glissade::app
