// What holds timber together, counted and not drawn. None of it is a calculation of strength.

#include "parts/timber/timber_fasteners.hpp"

#include "glissade/core/number_text.hpp"

#include "parts/shop/workshop_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace glissade::parts {
namespace {

constexpr double kAtEdges = 150e-3;    // greatest distance of screws along the edges of a sheet [m]
constexpr double kInField = 300e-3;    // the same elsewhere [m]
constexpr double kFromSide = 25e-3;    // of the outer screws of a row [m]
constexpr double kFromSeam = 10e-3;    // of screws from the end of a sheet [m]
constexpr double kOneScrew = 50e-3;    // a narrower piece has one in place of two [m]
constexpr double kShortOfFace = 5e-3;  // a screw ends that far before the face that it does not pass [m]
constexpr double kTipDiameters = 6.0;  // that its tip is deep at least: EN 1995-1-1, 8.7.2
constexpr double kEdgeDiameters =
    3.0;                          // from an edge that carries no load, predrilled: EN 1995-1-1, table 8.2
constexpr double kAsGood = 1e-9;  // [m]
constexpr double kThinnestOfFrame = 6e-3;  // screw that holds members together [m]
constexpr int kBraceBolt = 10;             // of boards that brace legs [mm]

/// Screws of one diameter as they are sold.
struct Range {
  int diameter = 0;               // [mm]
  double thickest = 0.0;          // of the piece that it usually fixes [m]
  std::array<int, 16> lengths{};  // [mm]; 0: no more
};
constexpr std::array<Range, 5> kScrews = {{
    {4, 12e-3, {10, 12, 16, 20, 25, 30, 35, 40, 45, 50, 60, 70, 80}},
    {5, 20e-3, {16, 20, 25, 30, 35, 40, 45, 50, 60, 70, 80, 90, 100, 120}},
    {6, 40e-3, {30, 40, 50, 60, 70, 80, 90, 100, 120, 140, 160, 180, 200, 240, 300}},
    {8, 150e-3, {40, 50, 60, 80, 100, 120, 140, 160, 180, 200, 240, 280, 300, 400}},
    {10, 1e9, {60, 80, 100, 120, 140, 160, 180, 200, 240, 280, 300, 400, 500}},
}};

/// @return the shortest that reaches far enough and not too far, else the longest that does not reach too far; 0: none
double length_of(const Range& screws, double least, double most) {
  double longest = 0.0;
  for (const int length : screws.lengths) {
    const double metres = 1e-3 * length;
    if (length == 0 || metres > most + kAsGood) break;
    longest = metres;
    if (metres >= least - kAsGood) break;
  }
  return longest;
}

void add_screws(Workshop& workshop, const Screw& screw, std::size_t count, const std::string& where) {
  if (screw.length > 0.0) add_item(workshop, {screw.name(), "EN 14592", count, where});
}

/// Distance of screws from the edge of a member on which two ends meet.
double edge_at_seam(double member) {
  return 0.5 * member - kFromSeam;
}

/// @return screws of one piece of a row over the members below it, closer on those on which it ends
std::size_t screws_of_row(const Span& row, double width, double member,
                          const std::vector<CrossMember>& members) {
  std::size_t count = 0;
  for (const CrossMember& one : members) {
    if (one.at < row.from - 0.5 * member - kAsGood || one.at > row.to + 0.5 * member + kAsGood) continue;
    const bool at_end =
        one.at < row.from + 0.5 * member + kAsGood || one.at > row.to - 0.5 * member - kAsGood;
    count += screws_across(width, at_end ? kAtEdges : kInField);
  }
  return count;
}

/// "sheets of layer 1 to cross members", or of a single layer "sheets to cross members": columns of drawings hold no more.
std::string layer_words(std::size_t layer, int layers, const std::string& pieces,
                        const std::string& members) {
  return pieces + (layers == 1 ? "" : " of layer " + std::to_string(layer + 1)) + " to " + members;
}

/// Screws through a layer and those below it into members.
Screw through_layers(const TimberJob& job, std::size_t layer, double into) {
  const double through = job.layer() * (job.options.deck.layers - static_cast<double>(layer));
  return screw_for({job.layer(), through, into, edge_at_seam(job.member_width())});
}

}  // namespace

std::string Screw::name() const {
  return "screw " + std::to_string(diameter) + " x " + rounded_text(1e3 * length, 4);
}

Screw screw_for(const ScrewedJoint& joint) {
  const double most = joint.through + joint.into - std::min(kShortOfFace, 0.25 * joint.into);
  Screw best;
  double deepest = -1e9;  // of the tip, as a share of what it should be
  for (const Range& screws : kScrews) {
    const double diameter = 1e-3 * screws.diameter;
    if (best.diameter != 0 && kEdgeDiameters * diameter > joint.edge + kAsGood) break;
    const double tip = kTipDiameters * diameter;
    const double length = length_of(screws, joint.through + tip, most);
    const double depth = std::min(1.0, (length - joint.through) / tip);
    if (depth >= deepest - kAsGood) {
      best = {screws.diameter, length};
      deepest = depth;
    }
    if (joint.fixed <= screws.thickest + kAsGood && depth >= 1.0 - kAsGood) break;
  }
  return best;
}

std::size_t screws_across(double width, double spacing) {
  if (width < kOneScrew) return 1;
  const double between = std::max(0.0, width - 2.0 * kFromSide);
  return static_cast<std::size_t>(std::max(1.0, std::ceil(between / spacing - kAsGood))) + 1;
}

void fix_deck(const TimberJob& job, const std::vector<std::vector<DeckRow>>& rows,
              const std::vector<CrossMember>& members, Workshop& workshop) {
  const std::size_t sets = job.sets_per_layer();
  const auto strips = static_cast<std::size_t>(job.strips());
  for (std::size_t set = 0; set < rows.size(); ++set) {
    const std::size_t side = set % sets;
    const std::size_t pieces = (strips + sets - 1 - side) / sets;  // every other one
    const Screw screw = through_layers(job, set / sets, job.options.cross_members.height);
    std::size_t count = 0;
    for (const DeckRow& row : rows[set])
      count += pieces * screws_of_row(row.span, job.strip_width(), job.member_width(), members);
    add_screws(workshop, screw, count,
               layer_words(set / sets, job.options.deck.layers, job.options.deck.boards ? "boards" : "sheets",
                           "cross members"));
  }
}

void fix_lining(const TimberJob& job, const Lining& lining, const std::vector<CrossMember>& members,
                Workshop& workshop) {
  for (const LiningStrip& strip : lining_strips(job)) {
    const std::size_t layer = strip.set / job.sets_per_layer();
    const Screw screw = through_layers(job, layer, job.options.cross_members.height);
    const double width = norm(strip.plate.face_to - strip.plate.face_from);
    std::size_t count = 0;
    for (const DeckRow& row : lining.rows()[strip.set])
      count += screws_of_row(row.span, width, job.member_width(), members);
    add_screws(workshop, screw, count, layer_words(layer, job.options.deck.layers, "strips", "templates"));
  }
}

void fix_curb(const TimberJob& job, double length, std::size_t pieces, Workshop& workshop) {
  const double deck = job.channel.thickness;
  const Screw screw = screw_for({deck, deck, job.channel.curb_height, 0.5 * job.channel.curb_thickness});
  add_screws(workshop, screw, pieces * screws_across(length, kAtEdges), "curbs, from below through the deck");
}

void fix_splices(const TimberJob& job, double length, std::size_t splices, Workshop& workshop) {
  const double width = job.options.bearer_width();
  const Screw screw = screw_for({width, width, width, width});
  add_screws(workshop, screw, splices * 2 * screws_across(length, kAtEdges), "splices to ribs, in two rows");
}

void fix_frame(const TimberJob& job, const FrameCounts& counts, Workshop& workshop) {
  const std::string what = job.channel.trough ? "templates" : "cross members";
  const double height = job.options.cross_members.height + job.options.fit;
  const double edge = 0.5 * std::min(job.options.bearer_width(), job.member_width());
  if (job.channel.trough || edge < kEdgeDiameters * kThinnestOfFrame) {
    add_item(workshop,
             {"angle bracket 60 x 60", "EN 14545", counts.members * counts.bearers, what + " on bearers"});
  } else {
    const Screw screw = screw_for({height, height, job.options.bearer_depth(), edge});
    add_screws(workshop, screw, counts.members * counts.bearers * 2, what + " to beams, two askew");
  }
  if (counts.leg_rows > 0) {
    add_item(workshop, {"pair of head plates", "to the engineer's drawing", counts.leg_rows * counts.bearers,
                        "legs to bearers"});
    add_item(workshop,
             {"post base", "to the engineer's drawing", counts.leg_rows * counts.bearers, "feet of legs"});
  }
  if (counts.boards > 0) {
    const LegOptions& options = *job.options.legs;
    add_timber_bolts(workshop, kBraceBolt, options.side + options.brace_thickness, 2 * counts.boards,
                     "boards that brace legs");
  }
}

}  // namespace glissade::parts
