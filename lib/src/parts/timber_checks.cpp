// Rules of carpentry as data, with who says so; and options that no carpenter can make.

#include "parts/timber_checks.hpp"

#include "glissade/core/number_text.hpp"

#include "parts/shop_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace glissade {
namespace parts {
namespace {

constexpr ShopRule kBendingRule{"bending radius of a deck layer", true, ShopVerdict::warn,
                                "plywood practice, uncertain: 100 thicknesses; thinner layers bend tighter"};
constexpr ShopRule kSpanRule{"span of the deck between cross members", false, ShopVerdict::warn,
                             "ramp builders: 400 mm below a deck of 24 mm; others in proportion, uncertain"};
constexpr ShopRule kSeamRule{"seam from the middle of a cross member", false, ShopVerdict::warn,
                             "ramp builders: support under every seam"};
constexpr ShopRule kStaggerRule{"seams of neighbouring layers apart", true, ShopVerdict::warn,
                                "ramp builders: seams staggered between layers"};
constexpr ShopRule kBearerRule{"distance of bearers", false, ShopVerdict::warn,
                               "spacing of the design, at most 0.8 m"};
constexpr ShopRule kLegRule{"distance of legs", false, ShopVerdict::warn,
                            "ramp builders: 2.4 m is too long a span of a rib"};
constexpr ShopRule kBraceRule{"leg without brace", false, ShopVerdict::warn,
                              "practice: braces from 1.5 m on"};
constexpr ShopRule kMemberRule{"length of a cross member", false, ShopVerdict::fail, "longest of the design"};
constexpr ShopRule kMassRule{"mass of a part", false, ShopVerdict::fail, "heaviest of the design"};
constexpr ShopRule kFitRule{"gap beside a cross member", false, ShopVerdict::fail, "fit of the design"};
constexpr ShopRule kStepRule{"step up at a seam", false, ShopVerdict::fail,
                             "downstream edge never higher than upstream edge"};

std::string as_length(double metres) {
  return length_text(metres, 3);
}
std::string as_mass(double kilograms) {
  return rounded_text(kilograms, 3) + " kg";
}
std::string at_text(double s) {
  return length_text(s, 3) + " along the track";
}

void check_deck(const TimberJob& job, const std::vector<std::vector<DeckRow>>& rows,
                const std::vector<CrossMember>& members, std::vector<ShopCheck>& checks) {
  ShopCase bending(kBendingRule), span(kSpanRule), seam(kSeamRule), stagger(kStaggerRule), fit(kFitRule);
  constexpr double kThicknesses = 100.0;
  constexpr double kSpan = 0.4 / 24e-3;  // of the deck's thickness
  for (const TrackArc& arc : job.track.arcs()) {
    if (arc.curvature == 0.0) continue;
    bending.see(1.0 / std::fabs(arc.curvature), kThicknesses * job.layer(), at_text(arc.start), as_length);
  }
  for (std::size_t i = 0; i + 1 < members.size(); ++i)
    span.see(members[i + 1].at - members[i].at, kSpan * job.channel.thickness, at_text(members[i].at),
             as_length);
  for (const CrossMember& member : members)
    fit.see(member.sagitta, job.options.fit, at_text(member.at), as_length);
  for (std::size_t layer = 0; layer < rows.size(); ++layer) {
    for (std::size_t i = 1; i < rows[layer].size(); ++i) {
      const double at = rows[layer][i].span.from;
      double nearest = std::numeric_limits<double>::infinity();
      for (const CrossMember& member : members) nearest = std::min(nearest, std::fabs(member.at - at));
      seam.see(nearest, 0.5 * job.options.cross_members.width, at_text(at), as_length);
      if (layer == 0) continue;
      for (std::size_t k = 1; k < rows[layer - 1].size(); ++k)
        stagger.see(std::fabs(rows[layer - 1][k].span.from - at), 0.3, at_text(at), as_length);
    }
  }
  for (const ShopCase* one : {&bending, &span, &seam, &stagger, &fit}) one->add_to(checks);
}

}  // namespace

std::vector<ShopCheck> timber_checks(const TimberJob& job, const std::vector<std::vector<DeckRow>>& rows,
                                     const std::vector<CrossMember>& members, const BearerPlan& bearers,
                                     const std::vector<Leg>& legs, const Workshop& workshop) {
  std::vector<ShopCheck> checks;
  check_deck(job, rows, members, checks);
  if (bearers.across.size() > 1)
    add_check(checks, kBearerRule, bearers.across[0] - bearers.across[1], 0.8, "all bearers", as_length);
  ShopCase leg_span(kLegRule), brace(kBraceRule), mass(kMassRule);
  const double leg_bound =
      job.options.frame == TimberFrame::ribs ? 2.4 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (i > 0 && std::isfinite(leg_bound))
      leg_span.see(legs[i].x - legs[i - 1].x, leg_bound, "leg " + std::to_string(i + 1), as_length);
    brace.see(legs[i].length(), 1.5, "leg " + std::to_string(i + 1), as_length);
  }
  leg_span.add_to(checks);
  brace.add_to(checks);
  add_check(checks, kMemberRule, job.channel.overall(), job.options.split.longest, "cross members",
            as_length);
  if (job.options.split.heaviest) {
    for (const ShopPart& part : workshop.parts)
      mass.see(part.mass, *job.options.split.heaviest, part.name, as_mass);
    mass.add_to(checks);
  }
  add_check(checks, kStepRule, 0.0 - job.options.joint_step, 0.0, "all seams", as_length);
  return checks;
}

}  // namespace parts

namespace {

class Problems {
 public:
  void positive(const std::string& key, double value, const std::string& hint) {
    if (value > 0.0) return;
    add(key, length_text(value) + " is not positive", "", hint);
  }
  void not_negative(const std::string& key, double value, const std::string& hint) {
    if (value >= 0.0) return;
    add(key, length_text(value) + " is negative", "", hint);
  }
  void add(const std::string& key, const std::string& what, const std::string& why, const std::string& hint) {
    issues.push_back({key, key.substr(key.rfind('.') + 1) + ": " + what, why, hint});
  }

  std::vector<Issue> issues;
};

void check_ground(const std::vector<Vec2>& ground, Problems& problems) {
  if (ground.empty()) {
    problems.add("legs.ground", "there is none", "Legs stand on it.", "ground: -2 m, below the start");
    return;
  }
  for (std::size_t i = 0; i + 1 < ground.size(); ++i) {
    if (ground[i + 1].x > ground[i].x) continue;
    problems.add("legs.ground",
                 "point " + std::to_string(i + 2) + " is not to the right of the one before it",
                 "Points go from left to right.", "another order");
  }
}

void check_members(const TimberOptions& options, Problems& problems) {
  if (options.bearers.count && *options.bearers.count < 2)
    problems.add("bearers.count", std::to_string(*options.bearers.count) + " bearers carry no deck", "",
                 "2 or more");
  problems.positive("bearers.spacing", options.bearers.spacing, "600 mm");
  problems.positive("bearers.width", options.bearer_width(), "18 mm");
  problems.positive("bearers.depth", options.bearer_depth(), "200 mm");
  problems.positive("cross_members.width", options.cross_members.width, "45 mm");
  problems.positive("cross_members.height", options.cross_members.height, "70 mm");
  if (options.cross_members.spacing < 1.5 * options.cross_members.width) {
    problems.add("cross_members.spacing",
                 length_text(options.cross_members.spacing) + " is less than 1.5 widths of a cross member",
                 "", "at least " + length_text(1.5 * options.cross_members.width));
  }
  problems.positive("fit", options.fit, "2 mm");
  problems.not_negative("joint_step", options.joint_step, "0 mm");
  if (!options.legs) return;
  problems.positive("legs.spacing", options.legs->spacing, "2 m");
  problems.positive("legs.side", options.legs->side, "90 mm");
  check_ground(options.legs->ground, problems);
}

void check_stock(const TimberOptions& options, Problems& problems) {
  for (const double side : {options.split.sheet.x, options.split.sheet.y})
    problems.positive("split.sheet", side, "sheet: [2.5 m, 1.25 m]");
  problems.positive("split.longest", options.split.longest, "12 m");
  constexpr int kMostLayers = 12;
  if (options.deck.layers < 1 || options.deck.layers > kMostLayers) {
    problems.add("deck.layers", std::to_string(options.deck.layers) + " layers",
                 "They are 1 to " + std::to_string(kMostLayers) + ".", "2");
  }
  if (options.lumber.density <= 0.0)
    problems.add("lumber.density", rounded_text(options.lumber.density, 6) + " kg/m^3 is not positive", "",
                 "420 kg/m^3");
}

}  // namespace

std::vector<Issue> timber_problems(const section::Measures& measures, const TimberOptions& options) {
  Problems problems;
  check_stock(options, problems);
  check_members(options, problems);
  const auto channel = parts::timber_channel_of(measures);
  if (!channel) {
    problems.issues.push_back(
        {"cross_section.kind",
         "fabrication: this " + std::string(section::kind(measures)) + " cannot be made of timber",
         "Timber makes a flat floor of one width with upright curbs or walls, or none.",
         "kind: slab or u-channel with one width"});
    return problems.issues;
  }
  if (options.bearer_width() * 2.0 > channel->overall()) {
    problems.add("bearers.width",
                 length_text(options.bearer_width()) + " is more than half the width of " +
                     length_text(channel->overall()),
                 "Two bearers stand side by side at least.", "narrower bearers");
  }
  if (channel->overall() > options.split.longest) {
    problems.add(
        "split.longest",
        length_text(options.split.longest) + " is less than the width of " + length_text(channel->overall()),
        "Cross members go from edge to edge in one piece.", "at least " + length_text(channel->overall()));
  }
  return problems.issues;
}

}  // namespace glissade
