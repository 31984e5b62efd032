// Tiles on the floor in courses, seams of one course in the middle of the next one's tiles: no gap runs on along the flow.

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/bolts.hpp"
#include "parts/corners.hpp"
#include "parts/fittings.hpp"
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
  const double heavy = liner.heaviest / (liner.material.density * liner.thickness * width);
  return std::max(1.0, std::ceil((span.to - span.from) / std::min(liner.tile_length, heavy) - 1e-9));
}

/// Where the bolts of a tile stand, as shares of the places along and across [m].
struct Bolts {
  std::vector<double> along;
  std::vector<double> across;
};

Bolts bolts_of(const LinerOptions& liner, const Span& span, double width) {
  const double hole = clearance_hole(liner.bolt, HoleFit::medium);
  const double edge = std::min(4.0 * hole, 0.25 * (span.to - span.from));
  const double side = std::min(3.0 * hole, 0.25 * width);
  Bolts bolts;
  bolts.along = {span.from + edge, span.to - edge};
  if (span.to - span.from < 6.0 * hole) bolts.along = {0.5 * (span.from + span.to)};
  bolts.across = {side, width - side};
  if (width < 6.0 * hole) bolts.across = {0.5 * width};
  return bolts;
}

/// A tile with its holes on the flat.
ShopPart tile_of(const Job& job, const Course& course, std::size_t index) {
  const LinerOptions& liner = *job.options.liner;
  const double width = course.widths[index];
  const auto outline = band(job.track, course.span, -liner.thickness, 0.0);
  ShopPart part =
      upright_plate(job, {*outline, {}, {}}, width, {-0.5 * job.channel.width + course.edges[index]});
  part.material = liner.material.name;
  part.density = liner.material.density;
  part.thickness = liner.thickness;
  const double middle = -0.5 * liner.thickness;
  const double whole = flat_from_end(job.track, course.span, middle, course.span.from);
  FlatPattern pattern;
  pattern.region.outline = rectangle({}, {whole, width});
  const Bolts bolts = bolts_of(liner, course.span, width);
  for (const double s : bolts.along) {
    for (const double y : bolts.across) {
      pattern.region.holes.push_back({{whole - flat_from_end(job.track, course.span, middle, s), y},
                                      0.5 * clearance_hole(liner.bolt, HoleFit::medium)});
    }
  }
  set_number_place(pattern, bounds(pattern.region.outline));
  part.pattern = std::move(pattern);
  part.mass = part.volume * part.density;
  return part;
}

/// The floor of a unit gets the holes of a tile.
void drill(const Job& job, const Unit& unit, const Course& course, std::size_t index, ShopPart& floor) {
  const LinerOptions& liner = *job.options.liner;
  const double middle = -liner.thickness - neutral_fibre(job) * job.channel.thickness;
  const double whole = flat_from_end(job.track, unit.span, middle, unit.span.from);
  const double beside = 0.5 * (floor_width(job) - job.channel.width);
  const Bolts bolts = bolts_of(liner, course.span, course.widths[index]);
  for (const double s : bolts.along) {
    for (const double y : bolts.across) {
      floor.pattern->region.holes.push_back(
          {{whole - flat_from_end(job.track, unit.span, middle, s), beside + course.edges[index] + y},
           0.5 * clearance_hole(liner.bolt, HoleFit::coarse)});
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
    for (const Course& course : courses_of(job, unit.span, row)) {
      ++row;
      for (std::size_t i = 0; i < course.widths.size(); ++i) drill(job, unit, course, i, unit.floor);
    }
  }
}

void add_liner(const Fitting& fitting) {
  const Job& job = fitting.job;
  if (!job.options.liner) return;
  const LinerOptions& liner = *job.options.liner;
  std::size_t bolts = 0;
  std::size_t drilled = 0;
  int row = 0;
  for (const Unit& unit : fitting.units) {
    drilled += unit.floor.pattern->region.holes.size();
    for (const Course& course : courses_of(job, unit.span, row)) {
      ++row;
      const double full = course.widths[course.widths.size() / 2];
      for (std::size_t i = 0; i < course.widths.size(); ++i) {
        ShopPart tile = tile_of(job, course, i);
        tile.name = "tile_" + std::to_string(row) + (course.widths[i] < 0.9 * full ? "_half" : "");
        bolts += tile.pattern->region.holes.size();
        for (const double s : bolts_of(liner, course.span, course.widths[i]).along)
          fitting.below.add(s - 0.015, s + 0.015);
        add_part(fitting.workshop, std::move(tile), kLinerColour);
      }
    }
  }
  if (drilled != bolts) throw InternalError({"", "holes of liner and floor do not agree", "", ""});
  const Bolt& bolt = bolt_of(liner.bolt);
  const std::string size = "M" + std::to_string(liner.bolt);
  add_item(fitting.workshop,
           {"countersunk bolt " + size + " x " +
                rounded_text(1e3 * bolt_length(bolt, liner.thickness + job.channel.thickness), 4),
            "ISO 10642 8.8", bolts, "liner"});
  add_item(fitting.workshop, {"nut " + size, "ISO 4032 8", bolts, "liner"});
  add_item(fitting.workshop, {"washer " + size, "ISO 7089 200 HV", bolts, "liner"});
  fitting.workshop.notes.emplace_back(
      "Holes of the liner's bolts are in the flat patterns of tiles and floors, the tiles' countersunk; "
      "bodies are "
      "without them.");
}

}  // namespace glissade::parts
