#include "glissade/parts/timber.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/words.hpp"

#include "core/least_rectangle.hpp"
#include "core/millimetres.hpp"
#include "parts/bodies/as_built.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/bodies/clash.hpp"
#include "parts/curves/plumb.hpp"
#include "parts/plates/calm_joints.hpp"
#include "parts/plates/plate_joints.hpp"
#include "parts/plates/plate_unit.hpp"
#include "parts/shop/setting_out.hpp"
#include "parts/shop/workshop_list.hpp"
#include "parts/timber/timber_braces.hpp"
#include "parts/timber/timber_facts.hpp"
#include "parts/timber/timber_fasteners.hpp"
#include "parts/timber/timber_frame.hpp"
#include "parts/timber/timber_trough.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace glissade {

using namespace parts;

namespace {

using Colour = std::array<double, 3>;
constexpr Colour kDeckColour = {0.87, 0.72, 0.50};
constexpr Colour kCurbColour = {0.80, 0.62, 0.40};
constexpr Colour kBearerColour = {0.70, 0.50, 0.30};
constexpr Colour kMemberColour = {0.76, 0.60, 0.42};
constexpr Colour kSpliceColour = {0.60, 0.45, 0.32};
constexpr Colour kLegColour = {0.55, 0.42, 0.30};
constexpr double kSeamClear = 0.1;        // of a curb's joint from the seams of the upper layer [m]
constexpr double kThickestSheet = 50e-3;  // what is thicker is sawn, not cut from a sheet [m]
constexpr double kFoldedVolume = 1e-6;

/// A pattern that is the side view of the part as it stands.
void set_own_pattern(ShopPart& part) {
  FlatPattern pattern;
  pattern.region = std::get<Prism>(part.body).region;
  part.pattern = std::move(pattern);
}

/// @return middles of the strips of a set, from left to right
std::vector<double> middles_of(const TimberJob& job, std::size_t set) {
  const int count = job.strips();
  const std::size_t sets = job.sets_per_layer();
  const double pitch = job.strip_width() + job.gap();
  std::vector<double> middles;
  for (int i = 0; i < count; ++i) {
    if (static_cast<std::size_t>(i) % sets == set % sets)
      middles.push_back(0.5 * (job.channel.overall() - job.strip_width()) - pitch * i);
  }
  return middles;
}

std::string deck_name(const TimberJob& job, std::size_t set, std::size_t row) {
  const std::size_t sets = job.sets_per_layer();
  const std::string side = sets == 1 ? "" : set % sets == 0 ? "_even" : "_odd";
  return (sets == 1 ? "deck_" : "board_") + std::to_string(set / sets + 1) + side + "_" +
         std::to_string(row + 1);
}

double add_deck(const TimberJob& job, const std::vector<std::vector<DeckRow>>& rows, Workshop& workshop) {
  const double width = job.strip_width();
  constexpr double kNoted = 0.5e-3;  // taste: what a saw takes off anyway [m]
  if (const auto& boards = job.options.deck.boards; boards && boards->width - width > kNoted) {
    workshop.notes.push_back("Boards of " + length_text(boards->width) + " are ripped to " +
                             length_text(width, 5) + ": " + std::to_string(job.strips()) +
                             " of them lie side by side.");
  }
  double volume = 0.0;
  for (std::size_t set = 0; set < rows.size(); ++set) {
    const double top = -job.layer() * static_cast<double>(set / job.sets_per_layer());
    const std::vector<double> middles = middles_of(job, set);
    if (middles.empty()) continue;  // of a single board there are no odd ones
    for (std::size_t i = 0; i < rows[set].size(); ++i) {
      const DeckRow& row = rows[set][i];
      ShopPart part = upright_part(job, *band(job.track, row.span, top - job.layer(), top),
                                   chord_angle(job, row.span), width, middles, job.deck_material());
      part.name = deck_name(job, set, i);
      part.thickness = job.layer();
      part.bought_in = job.options.deck.boards.has_value();
      FlatPattern pattern;
      pattern.region.outline = rectangle({}, {row.flat_length, width});
      part.pattern = std::move(pattern);
      volume += part.volume * static_cast<double>(part.quantity());
      add_part(workshop, std::move(part), kDeckColour);
    }
  }
  return volume;
}

double add_lining(const Lining& lining, Workshop& workshop) {
  double volume = 0.0;
  for (ShopPart& part : lining.parts()) {
    volume += part.volume;
    add_part(workshop, std::move(part), kDeckColour);
  }
  lining.tell(workshop);
  return volume;
}

/// Whether curbs between joints are cut from the sheet; of those that fold over another check tells.
bool curbs_fit(const TimberJob& job, const std::vector<double>& joints) {
  const auto [longer, shorter] = job.options.split.sawn().room();
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    const Span span{joints[i], joints[i + 1]};
    const auto outline = band(job.track, span, 0.0, job.channel.curb_height);
    if (!outline) continue;
    const PlaneBox box = bounds(moved(*outline, PlaneMotion::turn(-chord_angle(job, span))));
    if (std::max(box.width(), box.height()) > longer) return false;
    if (std::min(box.width(), box.height()) > shorter) return false;
  }
  return true;
}

/// Joints of the curbs, apart from the seams of the upper layer.
std::vector<double> curb_joints(const TimberJob& job, const std::vector<DeckRow>& upper) {
  const TimberSplit& split = job.options.split;
  const double stock = split.sawn().room().x - 2.0 * kSeamClear;
  const bool sawn = job.channel.curb_thickness > kThickestSheet;
  const double per_metre = job.channel.curb_height * job.channel.curb_thickness *
                           (sawn ? job.options.lumber : job.options.material).density;
  const double longest =
      split.heaviest ? std::min(stock, *split.heaviest / per_metre - 2.0 * kSeamClear) : stock;
  if (!(longest > kSeamClear)) {
    throw InputError({"split.heaviest",
                      "heaviest: " + rounded_text(*split.heaviest, 4) + " kg is a curb of " +
                          length_text(*split.heaviest / per_metre, 3),
                      "Its joints keep " + length_text(kSeamClear) + " from the seams of the deck.",
                      "a larger mass, or lower curbs"});
  }
  const auto least = static_cast<std::size_t>(std::max(1.0, std::ceil(job.track.length() / longest)));
  constexpr std::size_t kMostMore = 100;  // pieces than straight ones would take
  for (std::size_t count = least; count <= least + kMostMore; ++count) {
    std::vector<double> joints = calm_joints(job.track, count, 0.0);
    for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
      for (std::size_t k = 1; k < upper.size(); ++k) {
        const double seam = upper[k].span.from;
        if (std::fabs(joints[i] - seam) < kSeamClear) joints[i] = seam + kSeamClear;
      }
    }
    if (sawn || curbs_fit(job, joints)) return joints;
  }
  throw InputError({"split.sheet",
                    "sheet: curbs of " + length_text(job.channel.curb_height) + " fit no sheet of " +
                        length_text(split.sheet.x) + " x " + length_text(split.sheet.y),
                    "Each takes its height and what its curve rises, " + length_text(split.sawn().margin) +
                        " from the edges.",
                    "a larger sheet, lower curbs, or ones of more than " + length_text(kThickestSheet) +
                        ", which are sawn"});
}

double add_curbs(const TimberJob& job, const std::vector<DeckRow>& upper, Workshop& workshop) {
  const double height = job.channel.curb_height;
  if (height == 0.0) return 0.0;
  const double thickness = job.channel.curb_thickness;
  const double middle = 0.5 * (job.channel.width + thickness);
  const std::vector<double> joints = curb_joints(job, upper);
  double volume = 0.0;
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    const auto outline = band(job.track, {joints[i], joints[i + 1]}, 0.0, height);
    if (!outline) {
      throw InputError({"cross_section",
                        "curbs of " + length_text(height) + " fold over between " + length_text(joints[i]) +
                            " and " + length_text(joints[i + 1]) + " along the track",
                        "Their tops are nearer to each other than the radius of the track there.",
                        "lower curbs, or a limit on the track's radius"});
    }
    const bool sawn = thickness > kThickestSheet;
    ShopPart part = upright_part(job, *outline, chord_angle(job, {joints[i], joints[i + 1]}), thickness,
                                 {middle, -middle}, sawn ? job.options.lumber : job.options.material);
    part.name = "curb_" + std::to_string(i + 1);
    part.bought_in = sawn;
    set_own_pattern(part);
    volume += part.volume * static_cast<double>(part.quantity());
    fix_curb(job, joints[i + 1] - joints[i], part.quantity(), workshop);
    add_part(workshop, std::move(part), kCurbColour);
  }
  return volume;
}

void add_cross_members(const TimberJob& job, const std::vector<CrossMember>& members, Workshop& workshop) {
  const CrossMemberOptions& options = job.options.cross_members;
  ShopPart part;
  part.name = "cross_member";
  part.material = job.options.lumber.name;
  part.density = job.options.lumber.density;
  const double width = job.member_width();
  part.thickness = width;
  part.body = Prism{{rectangle({}, {width, options.height}), {}, {}}, job.channel.overall()};
  for (const CrossMember& member : members) {
    const TrackFrame at = frame_at(job.track, member.at);
    const Vec2 corner = at.at - 0.5 * width * at.along + (member.top - options.height) * at.up;
    part.places.push_back(plane_of_track(job.placement, corner, math::atan2(at.along.y, at.along.x),
                                         -0.5 * job.channel.overall()));
  }
  part.bought_in = true;
  FlatPattern pattern;
  pattern.region.outline = rectangle({}, {job.channel.overall(), options.height});
  part.pattern = std::move(pattern);
  weigh(part);
  add_part(workshop, std::move(part), kMemberColour);
}

/// Templates are one part: those on a crest stand lower by what the lining bends away over their thickness.
void add_templates(const TimberJob& job, const std::vector<CrossMember>& members, Workshop& workshop) {
  ShopPart part;
  part.name = "template";
  part.material = job.options.material.name;
  part.density = job.options.material.density;
  part.thickness = job.member_width();
  part.body = Prism{template_region(job.channel, job.options), part.thickness};
  for (const CrossMember& member : members) {
    const TrackFrame at = frame_at(job.track, member.at);
    const Vec2 foot =
        at.at - 0.5 * part.thickness * at.along + (member.top - job.options.cross_members.height) * at.up;
    const Vec3 to_left = across(job.placement);
    part.places.push_back({in_space(job.placement, foot) - 0.5 * job.channel.overall() * to_left, to_left,
                           direction_in_space(job.placement, at.up),
                           direction_in_space(job.placement, at.along)});
  }
  set_own_pattern(part);
  weigh(part);
  add_part(workshop, std::move(part), kMemberColour);
}

void add_splices(const TimberJob& job, const std::vector<double>& joints, const std::vector<double>& across,
                 const std::string& name, Workshop& workshop) {
  const double width = job.options.bearer_width();
  const double depth = job.options.bearer_depth();
  std::vector<double> middles;
  for (const double middle : across) {
    middles.push_back(middle + width);
    middles.push_back(middle - width);
  }
  for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
    const double reach =
        std::min({1.25 * depth, 0.4 * (joints[i] - joints[i - 1]), 0.4 * (joints[i + 1] - joints[i])});
    const auto outline = band(job.track, {joints[i] - reach, joints[i] + reach},
                              job.bearer_bottom() + 0.1 * depth, job.bearer_top() - 0.1 * depth);
    if (!outline) continue;
    ShopPart part = upright_part(job, *outline, chord_angle(job, {joints[i] - reach, joints[i] + reach}),
                                 width, middles, job.options.material);
    part.name = name + "_" + std::to_string(i);
    set_own_pattern(part);
    fix_splices(job, 2.0 * reach, part.quantity(), workshop);
    add_part(workshop, std::move(part), kSpliceColour);
  }
}

void add_bearer_row(const TimberJob& job, const std::vector<double>& joints,
                    const std::vector<double>& across, const std::string& name, Workshop& workshop) {
  const bool ribs = job.options.frame == TimberFrame::ribs;
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    ShopPart part =
        upright_part(job, *band(job.track, {joints[i], joints[i + 1]}, job.bearer_bottom(), job.bearer_top()),
                     chord_angle(job, {joints[i], joints[i + 1]}), job.options.bearer_width(), across,
                     ribs ? job.options.material : job.options.lumber);
    part.name = name + "_" + std::to_string(i + 1);
    part.bought_in = !ribs;
    set_own_pattern(part);
    add_part(workshop, std::move(part), kBearerColour);
  }
}

void add_bearers(const TimberJob& job, const BearerPlan& plan, Workshop& workshop) {
  std::vector<double> even;
  std::vector<double> odd;
  for (std::size_t i = 0; i < plan.across.size(); ++i) (i % 2 == 0 ? even : odd).push_back(plan.across[i]);
  const bool ribs = job.options.frame == TimberFrame::ribs;
  const std::string name = ribs ? "rib" : "beam";
  add_bearer_row(job, plan.joints, even, name, workshop);
  if (!odd.empty()) add_bearer_row(job, plan.shifted, odd, name + "_shifted", workshop);
  const std::size_t joints = even.size() * (plan.joints.size() - 2) + odd.size() * (plan.shifted.size() - 2);
  if (ribs) {
    add_splices(job, plan.joints, even, "splice", workshop);
    if (!odd.empty()) add_splices(job, plan.shifted, odd, "splice_shifted", workshop);
  } else if (joints > 0) {
    workshop.items.push_back(
        {"slotted-in plate, dowels", "to the engineer's drawing", joints, "at the joints of the beams"});
  }
}

void add_legs(const TimberJob& job, const std::vector<Leg>& legs, const BearerPlan& plan,
              Workshop& workshop) {
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const Leg& leg = legs[i];
    ArcPath outline;
    outline.closed = true;
    for (const Vec2 corner :
         {Vec2{leg.top_left.x, leg.ground}, Vec2{leg.top_right.x, leg.ground}, leg.top_right, leg.top_left}) {
      outline.vertices.push_back({corner, 0.0});
    }
    ShopPart part =
        upright_part(job, outline, kRightAngle, job.options.legs->side, plan.across, job.options.lumber);
    part.name = "leg_" + std::to_string(i + 1);
    part.stands = true;
    part.bought_in = true;
    set_own_pattern(part);
    add_part(workshop, std::move(part), kLegColour);
  }
}

/// @return how many boards brace the legs
std::size_t add_boards(const TimberJob& job, const std::vector<Leg>& legs, const BearerPlan& plan,
                       Workshop& workshop) {
  std::size_t boards = 0;
  if (legs.empty()) return boards;
  for (ShopPart& part : brace_parts(job, legs, plan, workshop)) {
    boards += part.quantity();
    add_part(workshop, std::move(part), kLegColour);
  }
  return boards;
}

/// Says which legs and boards are longer than what lumber comes in.
void tell_long_lumber(const TimberJob& job, Workshop& workshop) {
  std::vector<std::string> names;
  double most = 0.0;
  for (const ShopPart& part : workshop.parts) {
    if (!part.stands) continue;
    // Braces lie at a slant in their patterns.
    const double length = core::least_size(part.pattern->region.outline).x;
    if (length <= job.options.split.longest) continue;
    names.push_back(part.name + " (" + length_text(length, 3) + ")");
    most = std::max(most, length);
  }
  if (names.empty()) return;
  constexpr double kDigits = 0.1;  // taste: of what is told [m]
  add_shortfall({"split.longest",
                 "longest: " + listed(names) + (names.size() == 1 ? " is" : " are") + " longer than " +
                     length_text(job.options.split.longest) + ", and to be spliced",
                 "No splice of legs and their boards is designed here: it weakens them where it is.",
                 "longest: " + length_text(kDigits * std::ceil(most / kDigits), 6) +
                     " if the lumber comes so long, a higher ground, or splices of your own"},
                workshop);
}

/// Heights of the lines that are set out below the floor, plumb below it, and where they end: square to the track, where no
/// plumb line from its own ends meets them.
void add_offsets(const TimberJob& job, Workshop& workshop) {
  const bool ribs = job.options.frame == TimberFrame::ribs;
  const std::string bearers = ribs ? "ribs" : "beams";
  workshop.offset_names = {"underside of deck", "top of " + bearers, "underside of " + bearers};
  const std::array<double, 3> heights = {-job.channel.thickness, job.bearer_top(), job.bearer_bottom()};
  const auto in_mm = [](double metres) { return rounded_text(core::kMillimetres * metres, 6); };
  const auto place = [&](Vec2 at) { return in_mm(at.x) + " and " + in_mm(at.y); };
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const auto line = offset_line(job.track, {0.0, job.track.length()}, heights[i]);
    for (SettingOutPoint& point : workshop.setting_out)
      point.offsets.push_back(line && !point.beyond_track ? level_below(*line, {point.x, point.z})
                                                          : std::nullopt);
    if (!line) continue;
    workshop.notes.push_back("Ends of the " + workshop.offset_names[i] +
                             ", run and z in mm: " + place(line->vertices.front().at) + " at the start, " +
                             place(line->vertices.back().at) + " at the finish.");
  }
}

/// Joints of every other bearer, and legs: beside what every track has in its table.
void set_out_frame(const TimberJob& job, const BearerPlan& bearers, const std::vector<Leg>& legs,
                   Workshop& workshop) {
  const auto add_row = [&](const std::vector<double>& joints, const std::string& what, double s) {
    workshop.setting_out.push_back(
        setting_out_point(job.track, segment_at(joints, s), job.placement, what, s));
  };
  if (bearers.across.size() > 1) {
    for (std::size_t i = 1; i + 1 < bearers.shifted.size(); ++i)
      add_row(bearers.shifted, "shifted joint " + std::to_string(i), bearers.shifted[i]);
  }
  for (std::size_t i = 0; i < legs.size(); ++i)
    workshop.setting_out.push_back(
        setting_out_point(job.track, bearers.joints, job.placement,
                          {"leg " + std::to_string(i + 1), legs[i].x, legs[i].ground, legs[i].at}));
  in_order(workshop.setting_out);
  std::string middles;
  for (const double middle : bearers.across)
    middles += (middles.empty() ? "" : ", ") + rounded_text(core::kMillimetres * middle, 6);
  const char* const name = job.options.frame == TimberFrame::ribs ? "ribs" : "beams";
  workshop.notes.push_back("Middles of " + std::string(name) + " to the left of the axis, in mm: " + middles +
                           ".");
  if (bearers.across.size() > 1 && bearers.shifted.size() > 2)
    workshop.notes.push_back("The second, fourth, ... of them have the shifted joints.");
}

AsBuiltRide ride_deck(const TimberJob& job, const std::vector<DeckRow>& upper, const Motion& design,
                      const Body& body, double gravity) {
  std::vector<std::shared_ptr<const ArcSpline>> floors;
  for (const DeckRow& row : upper)
    floors.push_back(std::make_shared<ArcSpline>(rolled_face(job.track, row.span).line));
  return ride_units(floors, job.options.joint_step, design, body, gravity);
}

/// Volume of deck and curbs along the arcs by the section's area and first moment, or where curbs fold by their lengths.
double exact_volume(const TimberJob& job, bool& folded) {
  const ArcSpline& track = job.track;
  const double length = track.length();
  const double turned = track.direction(0.0).slope_angle - track.direction(length).slope_angle;
  const double thickness = job.channel.thickness;
  // Less the gaps between boards.
  const double deck_width = job.channel.overall() - job.gap() * (job.strips() - 1);
  double volume = deck_width * (thickness * length + 0.5 * thickness * thickness * turned);
  const double height = job.channel.curb_height;
  const double across = 2.0 * job.channel.curb_thickness;
  folded = height > 0.0 && folds(track, {0.0, length}, height);
  if (folded) {
    constexpr int kPanels = 400;
    for (int k = 0; k < kPanels; ++k) {
      const auto line = offset_line(track, {0.0, length}, height * (k + 0.5) / kPanels);
      if (line) volume += across * (height / kPanels) * glissade::length(*line);
    }
  } else {
    volume += across * (height * length - 0.5 * height * height * turned);
  }
  return volume;
}

/// Lengths of sheets against the lines they lie on.
double deck_mismatch(const TimberJob& job, const std::vector<std::vector<DeckRow>>& rows) {
  double most = 0.0;
  for (std::size_t set = 0; set < rows.size(); ++set) {
    const double depth = (static_cast<double>(set / job.sets_per_layer()) + 0.5) * job.layer();
    for (const DeckRow& row : rows[set]) {
      const double fibre = length(*offset_line(job.track, row.span, -depth));
      most = std::max(most, std::fabs(fibre - row.flat_length));
    }
  }
  return most;
}

/// @param lining  of a trough; else there is a deck
PartsProof prove_timber(const TimberJob& job, double made, const std::vector<CrossMember>& members,
                        const std::vector<std::vector<DeckRow>>& rows, const Lining* lining,
                        const Workshop& workshop) {
  PartsProof proof;
  proof.volume = made;
  for (const ShopPart& part : workshop.parts)
    proof.added_volume += part.volume * static_cast<double>(part.quantity());
  proof.added_volume -= made;
  bool folded = false;
  proof.exact_volume = lining ? lining->exact_volume() : exact_volume(job, folded);
  const double allowed = folded ? 1e3 * kFoldedVolume : kPartsVolumeAccuracy;
  if (!(std::fabs(proof.volume - proof.exact_volume) <= allowed * proof.exact_volume)) {
    throw InternalError({"",
                         (lining ? "the lining holds " : "deck and curbs hold ") +
                             rounded_text(proof.volume, 12) + " m^3, the section " +
                             rounded_text(proof.exact_volume, 12) + " m^3",
                         "", ""});
  }
  proof.smallest_gap = job.options.fit;
  for (const CrossMember& member : members)
    proof.smallest_gap = std::min(proof.smallest_gap, job.options.fit - member.sagitta);
  proof.edge_mismatch = lining ? lining->edge_mismatch() : deck_mismatch(job, rows);
  if (!(proof.edge_mismatch <= 1e-9)) {
    throw InternalError({"",
                         "sheets of the deck differ by " + length_text(proof.edge_mismatch, 3) +
                             " from the lines they lie on",
                         "", ""});
  }
  proof.pairs = require_no_clash(workshop);
  return proof;
}

}  // namespace

WorkshopBuild make_timber(const Centerline& track, const section::Measures& measures,
                          const MasterCurveOptions& fit, const TimberOptions& options,
                          const Placement& placement, const Body& body, double gravity) {
  std::vector<Issue> problems = timber_problems(measures, options);
  if (!problems.empty()) throw InputError(std::move(problems));
  WorkshopBuild build;
  build.master = fit_arcs(track, fit);
  const TimberJob job{*build.master.spline, *timber_channel_of(measures, options), options, placement};
  const Motion smooth(CenterlinePtr(CenterlinePtr(), &track), body, gravity);
  std::optional<Lining> lining;
  if (job.channel.trough) lining.emplace(job);
  const std::vector<std::vector<DeckRow>> rows = lining ? lining->rows() : deck_rows(job);
  const std::vector<CrossMember> members = cross_members(job, rows);
  const BearerPlan bearers = plan_bearers(job);
  const std::vector<Leg> legs = plan_legs(job, build.workshop);
  Workshop& workshop = build.workshop;
  workshop.tolerance = "Cut to 1 mm; edges of the running surface broken";
  double made = 0.0;
  if (lining) {
    made = add_lining(*lining, workshop);
    fix_lining(job, *lining, members, workshop);
    add_templates(job, members, workshop);
  } else {
    fix_deck(job, rows, members, workshop);
    made = add_deck(job, rows, workshop) + add_curbs(job, rows.front(), workshop);
    add_cross_members(job, members, workshop);
  }
  add_bearers(job, bearers, workshop);
  add_legs(job, legs, bearers, workshop);
  const std::size_t boards = add_boards(job, legs, bearers, workshop);
  tell_long_lumber(job, workshop);
  fix_frame(job, {members.size(), bearers.across.size(), legs.size(), boards}, workshop);
  workshop.setting_out = setting_out(job.track, bearers.joints, placement);
  set_out_frame(job, bearers, legs, workshop);
  add_offsets(job, workshop);
  for (const DeckRow& row : rows.front()) build.joints.push_back(row.span.from);
  build.joints.push_back(job.track.length());
  build.ride = ride_deck(job, rows.front(), smooth, body, gravity);
  measure_timber(job, rows, members, bearers, legs, workshop);
  build.proof = prove_timber(job, made, members, rows, lining ? &*lining : nullptr, workshop);
  return build;
}

}  // namespace glissade
