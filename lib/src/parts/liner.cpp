// Tiles on the floor in courses, seams of one course in the middle of the next one's tiles: no gap runs on along the flow.

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "parts/bolts.hpp"
#include "parts/corners.hpp"
#include "parts/fittings.hpp"
#include "parts/shop_facts.hpp"
#include "parts/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace glissade::parts {
namespace {

/// Tiles side by side: left edges and widths from the left side of the floor.
struct Course {
  Span span;
  std::vector<double> edges;
  std::vector<double> widths;
};

/// What a stream does to the floor along a course, the most of it.
struct CourseWear {
  double share = 0.0;
  double loss_rate = 0.0;  ///< [m/s]
};

CourseWear wear_along(const std::vector<FloorWear>& wear, const Span& span) {
  CourseWear most;
  const auto see = [&](double share, double loss_rate) {
    most.share = std::max(most.share, share);
    most.loss_rate = std::max(most.loss_rate, loss_rate);
  };
  for (std::size_t i = 0; i < wear.size(); ++i) {
    if (wear[i].at >= span.from && wear[i].at <= span.to) see(wear[i].share, wear[i].loss_rate);
    if (i == 0) continue;
    // At the ends of the course, between two places.
    const FloorWear& a = wear[i - 1];
    const FloorWear& b = wear[i];
    for (const double end : {span.from, span.to}) {
      if (!(a.at <= end && end <= b.at && a.at < b.at)) continue;
      const double t = (end - a.at) / (b.at - a.at);
      see(a.share + t * (b.share - a.share), a.loss_rate + t * (b.loss_rate - a.loss_rate));
    }
  }
  return most;
}

Course course_of(const Job& job, const Span& span, bool odd) {
  const LinerOptions& liner = *job.options.liner;
  const double width = job.channel.width;
  const double count = std::ceil(width / liner.tile_width - 1e-9);
  const double full = (width - (count + 1.0) * liner.gap) / count;
  Course course{{span.from + 0.5 * liner.gap, span.to - 0.5 * liner.gap}, {}, {}};
  double at = liner.gap;
  const auto put = [&](double wide) {
    course.edges.push_back(at);
    course.widths.push_back(wide);
    at += wide + liner.gap;
  };
  const double half = 0.5 * (full - liner.gap);
  if (odd) put(half);
  for (double k = odd ? 1.0 : 0.0; k < count; k += 1.0) put(full);
  if (odd) put(half);
  return course;
}

/// Lengths of the courses of a unit: none longer than a tile may be, none of whose tiles is too heavy.
double courses_in(const Job& job, const Span& span) {
  const LinerOptions& liner = *job.options.liner;
  const double width = job.channel.width / std::ceil(job.channel.width / liner.tile_width - 1e-9);
  const bool plain = liner.where == LinerPlaces::worn;
  const double density =
      plain ? std::max(liner.material.density, job.options.material.density) : liner.material.density;
  const double heavy = liner.heaviest / (density * liner.thickness * width);
  return std::max(1.0, std::ceil((span.to - span.from) / std::min(liner.tile_length, heavy) - 1e-9));
}

/// @return the place on the track of one along the face of a floor below it
double on_track(const Job& job, const Unit& unit, double along_face) {
  double left = along_face;
  for (const TrackArc& arc : job.track.arcs()) {
    const double from = std::max(unit.span.from, arc.start);
    const double to = std::min(unit.span.to, arc.start + arc.length);
    if (!(to > from)) continue;
    const double stretch = 1.0 + arc.curvature * floor_depth(job);
    if (left <= (to - from) * stretch) return from + left / stretch;
    left -= (to - from) * stretch;
  }
  return unit.span.to;
}

/// Places at which bolts go through liner and floor of a unit: on one arc each, beside tabs and slots.
OnOneArc bolt_arcs(const Job& job, const Unit& unit) {
  const LinerOptions& liner = *job.options.liner;
  std::vector<double> breaks;
  const double slack = 0.5 * job.options.corners.clearance;
  for (const Span& tab : unit.tabs) {
    for (const double along_face : {tab.from - slack, tab.to + slack})
      breaks.push_back(on_track(job, unit, along_face));
  }
  return {job.track,
          0.5 * clearance_hole(liner.bolt, HoleFit::coarse),
          {-liner.thickness - job.channel.thickness, 0.0},
          breaks};
}

/// Where the bolts of a tile stand: places along the track, and across from its left edge [m].
struct Bolts {
  std::vector<double> along;
  std::vector<double> across;
};

Bolts bolts_of(const LinerOptions& liner, const OnOneArc& arcs, const Span& span, double width) {
  const double hole = clearance_hole(liner.bolt, HoleFit::medium);
  const double edge = std::min(4.0 * hole, 0.25 * (span.to - span.from));
  const double side = std::min(3.0 * hole, 0.25 * width);
  std::vector<double> wanted = {span.from + edge, span.to - edge};
  if (span.to - span.from < 6.0 * hole) wanted = {0.5 * (span.from + span.to)};
  const double least = std::min(1.2 * hole, 0.5 * (span.to - span.from));
  Bolts bolts;
  for (const double about : wanted) {
    const auto place = arcs.nearest(about, {span.from + least, span.to - least});
    constexpr double kLeastPitch = 2.4;  // hole diameters
    if (place && (bolts.along.empty() || *place - bolts.along.back() >= kLeastPitch * hole))
      bolts.along.push_back(*place);
  }
  if (bolts.along.empty()) {
    throw InputError({"liner.bolt",
                      "bolt: holes for M" + std::to_string(liner.bolt) + " find no place between " +
                          length_text(span.from, 3) + " and " + length_text(span.to, 3) + " along the track",
                      "They lie on one arc of the floor each, and none there is as long as a hole is wide, " +
                          length_text(hole) + ".",
                      "a smaller bolt, a longer tile_length, or a larger arc_tolerance"});
  }
  bolts.across = {side, width - side};
  if (width < 6.0 * hole) bolts.across = {0.5 * width};
  return bolts;
}

/// A tile with its holes.
ShopPart tile_of(const Job& job, const OnOneArc& arcs, const Course& course, std::size_t index,
                 const StockMaterial& material) {
  const LinerOptions& liner = *job.options.liner;
  const double width = course.widths[index];
  const auto outline = band(job.track, course.span, -liner.thickness, 0.0);
  ShopPart part =
      upright_plate(job, {*outline, {}, {}}, width, {-0.5 * job.channel.width + course.edges[index]});
  part.material = material.name;
  part.density = material.density;
  part.thickness = liner.thickness;
  const double middle = -0.5 * liner.thickness;
  const double whole = flat_from_end(job.track, course.span, middle, course.span.from);
  const double radius = 0.5 * clearance_hole(liner.bolt, HoleFit::medium);
  FlatPattern pattern;
  pattern.region.outline = rectangle({}, {whole, width});
  std::vector<Circle> holes;
  const Bolts bolts = bolts_of(liner, arcs, course.span, width);
  for (const double s : bolts.along) {
    for (const double y : bolts.across) {
      holes.push_back({{s, y}, radius});
      pattern.region.holes.push_back({{whole - flat_from_end(job.track, course.span, middle, s), y}, radius});
    }
  }
  set_number_place(pattern, bounds(pattern.region.outline));
  part.pattern = std::move(pattern);
  drill_plate(job, course.span, 0.0, width, holes, part);
  return part;
}

/// The floor of a unit gets the holes of a tile.
/// @param holes  of the finished floor: along its face and across
void drill(const Job& job, const Unit& unit, const OnOneArc& arcs, const Course& course, std::size_t index,
           FlatPattern& pattern, std::vector<Circle>& holes) {
  const LinerOptions& liner = *job.options.liner;
  const double middle = -liner.thickness - neutral_fibre(job) * job.channel.thickness;
  const double whole = flat_from_end(job.track, unit.span, middle, unit.span.from);
  const double face = flat_from_end(job.track, unit.span, -liner.thickness, unit.span.from);
  const double beside = 0.5 * (floor_width(job) - job.channel.width);
  const double radius = 0.5 * clearance_hole(liner.bolt, HoleFit::coarse);
  const Bolts bolts = bolts_of(liner, arcs, course.span, course.widths[index]);
  for (const double s : bolts.along) {
    for (const double y : bolts.across) {
      const double across = beside + course.edges[index] + y;
      pattern.region.holes.push_back(
          {{whole - flat_from_end(job.track, unit.span, middle, s), across}, radius});
      holes.push_back({{face - flat_from_end(job.track, unit.span, -liner.thickness, s), across}, radius});
    }
  }
}

}  // namespace

namespace {

/// Every course of a unit.
/// @param row  of the first one, counted over all units
std::vector<Course> courses_of(const Job& job, const Span& span, int row) {
  std::vector<Course> courses;
  const double count = courses_in(job, span);
  const double step = (span.to - span.from) / count;
  for (double k = 0.0; k < count; k += 1.0) {
    courses.push_back(course_of(job, {span.from + k * step, span.from + (k + 1.0) * step}, (row++) % 2 == 1));
  }
  return courses;
}

}  // namespace

void drill_floors(const Job& job, std::vector<Unit>& units) {
  if (!job.options.liner) return;
  int row = 0;
  for (Unit& unit : units) {
    const OnOneArc arcs = bolt_arcs(job, unit);
    std::vector<Circle> holes;
    for (const Course& course : courses_of(job, unit.span, row)) {
      ++row;
      for (std::size_t i = 0; i < course.widths.size(); ++i)
        drill(job, unit, arcs, course, i, *unit.floor.pattern, holes);
    }
    drill_floor(job, unit.face, unit.tabs, std::move(holes), unit.floor);
  }
}

namespace {

constexpr double kHour = 3600.0;

std::string hours_text(double seconds) {
  return rounded_text(seconds / kHour, 3) + " h";
}

/// Lays the courses of all units, and tells what becomes of them.
class Tiler {
 public:
  explicit Tiler(const Fitting& fitting) : fitting_(fitting), liner_(*fitting.job.options.liner) {
    if (fitting.job.options.floor_wear.empty() && (liner_.where == LinerPlaces::worn || liner_.life))
      throw InternalError({"", "a liner for a wear that nobody told", "", ""});
  }

  void lay() {
    int row = 0;
    for (const Unit& unit : fitting_.units) {
      drilled_ += unit.floor.pattern->region.holes.size();
      const OnOneArc arcs = bolt_arcs(fitting_.job, unit);
      for (const Course& course : courses_of(fitting_.job, unit.span, row)) lay(course, arcs, ++row);
    }
    if (drilled_ != bolts_) throw InternalError({"", "holes of liner and floor do not agree", "", ""});
  }

  [[nodiscard]] std::size_t bolts() const { return bolts_; }

  void note_places() const {
    if (liner_.where != LinerPlaces::worn) return;
    std::string text = "Tiles of " + liner_.material.name + " lie where the floor wears " +
                       rounded_text(100.0 * liner_.worn_from, 3) + " % of its peak or more, " + places_ +
                       " along the track";
    text += plain_ ? "; plain ones of " + fitting_.job.options.material.name + ", as thick, elsewhere." : ".";
    fitting_.workshop.notes.push_back(std::move(text));
  }
  void note_life() const {
    if (!liner_.life || !(thinnest_ > 0.0)) return;
    fitting_.workshop.notes.push_back("Where it wears most the liner loses " +
                                      length_text(thinnest_ * 1000.0 * kHour, 3) + " in 1000 h: for " +
                                      hours_text(*liner_.life) + " without an exchange it takes " +
                                      length_text(thinnest_ * *liner_.life, 3) + ".");
  }

 private:
  void lay(const Course& course, const OnOneArc& arcs, int row) {
    const CourseWear wear = wear_along(fitting_.job.options.floor_wear, course.span);
    const bool wears = liner_.where == LinerPlaces::whole || wear.share >= liner_.worn_from;
    plain_ = plain_ || !wears;
    if (wears) remember(course.span);
    const double full = course.widths[course.widths.size() / 2];
    const std::string name = (wears ? "tile_" : "plain_tile_") + std::to_string(row);
    std::vector<int> numbers;
    for (std::size_t i = 0; i < course.widths.size(); ++i) {
      ShopPart tile =
          tile_of(fitting_.job, arcs, course, i, wears ? liner_.material : fitting_.job.options.material);
      tile.name = name + (course.widths[i] < 0.9 * full ? "_half" : "");
      bolts_ += tile.pattern->region.holes.size();
      for (const double s : bolts_of(liner_, arcs, course.span, course.widths[i]).along)
        fitting_.below.add(s - 0.015, s + 0.015);
      numbers.push_back(add_part(fitting_.workshop, std::move(tile), kLinerColour));
    }
    if (wears && liner_.life && wear.loss_rate > 0.0) count_spares(course, row, numbers, wear.loss_rate);
  }

  /// @param numbers  of its tiles in the list of parts
  void count_spares(const Course& course, int row, const std::vector<int>& numbers, double loss_rate) {
    thinnest_ = std::max(thinnest_, loss_rate);
    const double lasts = liner_.thickness / loss_rate;
    ShopFacts(fitting_.workshop)
        .at("course " + std::to_string(row) + " of tiles, at " + length_text(course.span.from, 3) + " to " +
                length_text(course.span.to, 3) + " along the track lasts " + hours_text(lasts),
            "liner_life_share", lasts / *liner_.life, 1.0, Dimension::number);
    constexpr double kMostSets = 1e4;
    const double sets = std::min(kMostSets, std::ceil(*liner_.life / lasts - 1e-9) - 1.0);
    if (!(sets > 0.0)) return;
    for (const int number : numbers) {
      const std::string& name = fitting_.workshop.parts[static_cast<std::size_t>(number - 1)].name;
      add_item(fitting_.workshop,
               {"spare " + name + ", " + liner_.material.name + ", " + length_text(liner_.thickness, 3),
                "as the part", static_cast<std::size_t>(sets), "liner, within " + hours_text(*liner_.life)});
    }
  }

  void remember(const Span& span) {
    const bool joins = last_ && span.from - *last_ <= 2.0 * liner_.gap;
    if (joins)
      places_.resize(places_.rfind(" to "));
    else
      places_ += (places_.empty() ? "" : ", ") + length_text(span.from, 3);
    places_ += " to " + length_text(span.to, 3);
    last_ = span.to;
  }

  const Fitting& fitting_;
  const LinerOptions& liner_;
  std::size_t bolts_ = 0;
  std::size_t drilled_ = 0;
  bool plain_ = false;
  std::string places_;          ///< where tiles of the wearing kind lie, for people
  std::optional<double> last_;  ///< end of the last of them [m]
  double thinnest_ = 0.0;       ///< greatest rate of loss [m/s]
};

}  // namespace

void add_liner(const Fitting& fitting) {
  const Job& job = fitting.job;
  if (!job.options.liner) return;
  const LinerOptions& liner = *job.options.liner;
  Tiler tiler(fitting);
  tiler.lay();
  const std::size_t bolts = tiler.bolts();
  const Bolt& bolt = bolt_of(liner.bolt);
  const std::string size = "M" + std::to_string(liner.bolt);
  add_item(fitting.workshop,
           {"countersunk bolt " + size + " x " +
                rounded_text(1e3 * bolt_length(bolt, liner.thickness + job.channel.thickness), 4),
            "ISO 10642 8.8", bolts, "liner"});
  add_item(fitting.workshop, {"nut " + size, "ISO 4032 8", bolts, "liner"});
  add_item(fitting.workshop, {"washer " + size, "ISO 7089 200 HV", bolts, "liner"});
  fitting.workshop.notes.emplace_back(
      "Holes of the liner's bolts are drawn cylindrical; those of the tiles are countersunk for the bolts' "
      "heads.");
  tiler.note_places();
  tiler.note_life();
}

}  // namespace glissade::parts
