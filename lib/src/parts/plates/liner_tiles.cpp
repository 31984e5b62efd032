// Tiles in courses along lanes, seams of one course in the middle of the next one's tiles: no gap runs on along the flow.

#include "parts/plates/liner_tiles.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "parts/plates/frame_holes.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/shop_facts.hpp"
#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace glissade::parts {
namespace {

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

/// Left edges and widths of tiles side by side in a lane.
struct Course {
  std::vector<double> edges;
  std::vector<double> widths;
  double full = 0.0;
};

Course course_of(const LinerOptions& liner, double width, bool odd) {
  const double count = std::ceil(width / liner.tile_width - 1e-9);
  Course course;
  course.full = (width - (count + 1.0) * liner.gap) / count;
  double at = liner.gap;
  const auto put = [&](double wide) {
    course.edges.push_back(at);
    course.widths.push_back(wide);
    at += wide + liner.gap;
  };
  const double half = 0.5 * (course.full - liner.gap);
  // A lane too narrow for halves has none of its gaps along the flow but those at its sides.
  const bool halves = odd && half >= kLeastTile * clearance_hole(liner.bolt, HoleFit::medium);
  if (halves) put(half);
  for (double k = halves ? 1.0 : 0.0; k < count; k += 1.0) put(course.full);
  if (halves) put(half);
  return course;
}

/// How many courses a unit has: none longer than a tile may be, none of whose tiles is too heavy.
double courses_in(const PlateOptions& options, const std::vector<double>& lanes, const Span& span) {
  const LinerOptions& liner = *options.liner;
  double width = 0.0;
  for (const double lane : lanes) width = std::max(width, lane / std::ceil(lane / liner.tile_width - 1e-9));
  const bool plain = liner.where == LinerPlaces::worn;
  const double density =
      plain ? std::max(liner.material.density, options.material.density) : liner.material.density;
  const double heavy = liner.heaviest / (density * liner.thickness * width);
  return std::max(1.0, std::ceil((span.to - span.from) / std::min(liner.tile_length, heavy) - 1e-9));
}

/// How holes stand on a tile and on the plate below it.
struct TileHoles {
  double hole = 0.0;     ///< of the tile [m]
  double edge = 0.0;     ///< least, from its middle to an edge, as the shop's rules have it [m]
  double pitch = 0.0;    ///< least, between middles, where the wider ones of the plate below are [m]
  double for_two = 0.0;  ///< tiles shorter or narrower than this have one in their middle [m]
};

TileHoles tile_holes(const PlateOptions& options) {
  TileHoles holes;
  holes.hole = clearance_hole(options.liner->bolt, HoleFit::medium);
  holes.edge = hole_edge_diameters(options.shop) * holes.hole;
  holes.pitch = hole_pitch_diameters(options.shop) * clearance_hole(options.liner->bolt, HoleFit::coarse);
  constexpr double kForTwo = 6.0;  // holes, where the rules let them stand as close
  holes.for_two = std::max(kForTwo * holes.hole, 2.0 * holes.edge + holes.pitch);
  return holes;
}

/// Where bolts stand across a tile, from its left edge.
std::vector<double> across_tile(const PlateOptions& options, double width) {
  const TileHoles holes = tile_holes(options);
  if (width < holes.for_two) return {0.5 * width};
  const double side = std::max(holes.edge, std::min(3.0 * holes.hole, 0.25 * width));
  return {side, width - side};
}

/// Where the bolts of a tile stand: places along the track, and across from its left edge [m].
void set_bolts(const PlateOptions& options, const OnOneArc& arcs, TilePlace& tile) {
  const Span& span = tile.span;
  const double whole = span.to - span.from;
  const TileHoles holes = tile_holes(options);
  const double edge = std::max(holes.edge, std::min(4.0 * holes.hole, 0.25 * whole));
  std::vector<double> wanted = {span.from + edge, span.to - edge};
  if (whole < holes.for_two) wanted = {0.5 * (span.from + span.to)};
  const double least = std::min(holes.edge, 0.5 * whole);
  for (const double about : wanted) {
    const auto place = arcs.nearest(about, {span.from + least, span.to - least});
    if (place && (tile.along.empty() || *place - tile.along.back() >= holes.pitch))
      tile.along.push_back(*place);
  }
  if (tile.along.empty()) {
    const bool bent = options.floor == FloorMake::bent;
    throw InputError(
        {"liner.bolt",
         "bolt: holes for M" + std::to_string(options.liner->bolt) + " find no place between " +
             length_text(tile.told.from, 3) + " and " + length_text(tile.told.to, 3) + " along the track",
         bent ? "They lie on one flat each, clear of where its bends begin at the height of any tile, and "
                "none "
                "there has room for a hole of " +
                    length_text(holes.hole) + "."
              : "They lie on one arc of the floor each, and none there is as long as a hole is wide, " +
                    length_text(holes.hole) + ".",
         bent ? "fewer bends (bend), a smaller bolt, or floor: rolled"
              : "a smaller bolt, a longer tile_length, or a larger arc_tolerance"});
  }
  tile.across = across_tile(options, tile.width);
}

}  // namespace

std::vector<double> bolts_across(const PlateOptions& options, double lane) {
  std::vector<double> places;
  for (const bool odd : {false, true}) {
    const Course course = course_of(*options.liner, lane, odd);
    for (std::size_t i = 0; i < course.widths.size(); ++i) {
      for (const double y : across_tile(options, course.widths[i])) places.push_back(course.edges[i] + y);
    }
  }
  return places;
}

std::vector<TilePlace> tile_places(const PlateOptions& options, const std::vector<double>& lanes,
                                   const Span& unit, const OnOneArc& arcs, int& row, const OnOneArc* seams,
                                   const std::function<double(const Span&)>& wider,
                                   const std::function<double(double)>& on_track) {
  const LinerOptions& liner = *options.liner;
  std::vector<double> widest = lanes;
  if (wider) {
    double most = 0.0;
    constexpr int kSlices = 64;
    const double slice = (unit.to - unit.from) / kSlices;
    for (int k = 0; k < kSlices; ++k)
      most = std::max(most, wider({unit.from + k * slice, unit.from + (k + 1) * slice}));
    for (double& lane : widest) lane += most;
  }
  const double count = courses_in(options, widest, unit);
  const double step = (unit.to - unit.from) / count;
  std::vector<TilePlace> tiles;
  const auto seam = [&](double k) {
    const double even = unit.from + k * step;
    return k > 0.0 && k < count && seams != nullptr ? seams->nearest(even, unit).value_or(even) : even;
  };
  for (double k = 0.0; k < count; k += 1.0) {
    const Span span{seam(k) + 0.5 * liner.gap, seam(k + 1.0) - 0.5 * liner.gap};
    // Where two seams come to lie at one place there is one course less.
    if (!(span.to > span.from)) continue;
    ++row;
    const double more = wider ? wider(span) : 0.0;
    const Span told = on_track ? Span{on_track(span.from), on_track(span.to)} : span;
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      const Course course = course_of(liner, lanes[lane] + more, row % 2 == 0);
      for (std::size_t i = 0; i < course.widths.size(); ++i) {
        TilePlace tile{span,
                       told,
                       row,
                       lane,
                       course.edges[i],
                       course.widths[i],
                       course.widths[i] < 0.9 * course.full,
                       {},
                       {},
                       more,
                       liner.gap};
        set_bolts(options, arcs, tile);
        tiles.push_back(std::move(tile));
      }
    }
  }
  return tiles;
}

namespace {

constexpr double kHour = 3600.0;

std::string hours_text(double seconds) {
  return rounded_text(seconds / kHour, 3) + " h";
}

/// Lists tiles course by course, and tells what becomes of them.
class Tiler {
 public:
  Tiler(const PlateOptions& options, const std::vector<std::string>& lanes, const MakeTile& make,
        Workshop& workshop)
      : options_(options), liner_(*options.liner), lanes_(lanes), make_(make), workshop_(workshop) {
    if (options.floor_wear.empty() && (liner_.where == LinerPlaces::worn || liner_.life))
      throw InternalError({"", "a liner for a wear that nobody told", "", ""});
  }

  /// @param first,last  tiles of one course
  void lay(std::vector<TilePlace>::const_iterator first, std::vector<TilePlace>::const_iterator last) {
    const CourseWear wear = wear_along(options_.floor_wear, first->span);
    const bool wears = liner_.where == LinerPlaces::whole || wear.share >= liner_.worn_from;
    plain_ = plain_ || !wears;
    if (wears) remember(first->told);
    std::vector<int> numbers;
    for (auto tile = first; tile != last; ++tile) {
      ShopPart part = make_(*tile, wears ? liner_.material : options_.material);
      part.name = std::string(wears ? "tile_" : "plain_tile_") + std::to_string(tile->row) +
                  lanes_[tile->lane] + (tile->half ? "_half" : "");
      bolts_ += part.pattern->region.holes.size();
      numbers.push_back(add_part(workshop_, std::move(part), kLinerColour));
    }
    if (wears && liner_.life && wear.loss_rate > 0.0) count_spares(*first, numbers, wear.loss_rate);
  }

  [[nodiscard]] std::size_t bolts() const { return bolts_; }

  void note_places() const {
    if (liner_.where != LinerPlaces::worn) return;
    std::string text = "Tiles of " + liner_.material.name + " lie where the floor wears " +
                       rounded_text(100.0 * liner_.worn_from, 3) + " % of its peak or more, " + places_ +
                       " along the track";
    text += plain_ ? "; plain ones of " + options_.material.name + ", as thick, elsewhere." : ".";
    workshop_.notes.push_back(std::move(text));
  }
  void note_life() const {
    if (!liner_.life || !(thinnest_ > 0.0)) return;
    workshop_.notes.push_back("Where it wears most the liner loses " +
                              length_text(thinnest_ * 1000.0 * kHour, 3) + " in 1000 h: for " +
                              hours_text(*liner_.life) + " without an exchange it takes " +
                              length_text(thinnest_ * *liner_.life, 3) + ".");
  }

 private:
  /// @param numbers  of a course's tiles in the list of parts
  void count_spares(const TilePlace& course, const std::vector<int>& numbers, double loss_rate) {
    thinnest_ = std::max(thinnest_, loss_rate);
    const double lasts = liner_.thickness / loss_rate;
    ShopFacts(workshop_).at("course " + std::to_string(course.row) + " of tiles, at " +
                                length_text(course.told.from, 3) + " to " + length_text(course.told.to, 3) +
                                " along the track lasts " + hours_text(lasts),
                            "liner_life_share", lasts / *liner_.life, 1.0, Dimension::number);
    constexpr double kMostSets = 1e4;
    const double sets = std::min(kMostSets, std::ceil(*liner_.life / lasts - 1e-9) - 1.0);
    if (!(sets > 0.0)) return;
    for (const int number : numbers) {
      const std::string& name = workshop_.parts[static_cast<std::size_t>(number - 1)].name;
      add_item(workshop_,
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

  const PlateOptions& options_;
  const LinerOptions& liner_;
  const std::vector<std::string>& lanes_;
  const MakeTile& make_;
  Workshop& workshop_;
  std::size_t bolts_ = 0;
  bool plain_ = false;
  std::string places_;          ///< where tiles of the wearing kind lie, for people
  std::optional<double> last_;  ///< end of the last of them [m]
  double thinnest_ = 0.0;       ///< greatest rate of loss [m/s]
};

}  // namespace

void lay_tiles(const PlateOptions& options, const std::vector<std::string>& lanes,
               const std::vector<TilePlace>& tiles, const MakeTile& make, double below, Workshop& workshop) {
  const LinerOptions& liner = *options.liner;
  Tiler tiler(options, lanes, make, workshop);
  for (auto first = tiles.begin(); first != tiles.end();) {
    const auto last =
        std::find_if(first, tiles.end(), [&](const TilePlace& tile) { return tile.row != first->row; });
    tiler.lay(first, last);
    first = last;
  }
  const std::size_t bolts = tiler.bolts();
  const std::string size = "M" + std::to_string(liner.bolt);
  add_item(workshop, {"countersunk bolt " + size + " x " +
                          rounded_text(1e3 * bolt_length(bolt_of(liner.bolt), liner.thickness + below), 4),
                      "ISO 10642 8.8", bolts, "liner"});
  add_item(workshop, {"nut " + size, "ISO 4032 8", bolts, "liner"});
  add_item(workshop, {"washer " + size, "ISO 7089 200 HV", bolts, "liner"});
  workshop.notes.emplace_back(
      "Holes of the liner's bolts are drawn cylindrical; those of the tiles are countersunk for the bolts' "
      "heads.");
  tiler.note_places();
  tiler.note_life();
}

}  // namespace glissade::parts
