// Options that no carpenter can make.

#include "glissade/core/number_text.hpp"

#include "parts/timber/timber_frame.hpp"
#include "parts/timber/timber_trough.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace glissade {
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

void check_members(const TimberOptions& options, bool templates, Problems& problems) {
  const double width = options.member_width(templates);
  if (options.bearers.count && *options.bearers.count < 2)
    problems.add("bearers.count", std::to_string(*options.bearers.count) + " bearers carry no deck", "",
                 "2 or more");
  problems.positive("bearers.spacing", options.bearers.spacing, "600 mm");
  problems.positive("bearers.width", options.bearer_width(), "18 mm");
  problems.positive("bearers.depth", options.bearer_depth(), "200 mm");
  problems.positive("cross_members.width", width, templates ? "30 mm" : "45 mm");
  problems.positive("cross_members.height", options.cross_members.height, "70 mm");
  problems.not_negative("cross_members.cheek", options.cross_members.cheek, "60 mm");
  if (options.cross_members.spacing < 1.5 * width) {
    problems.add("cross_members.spacing",
                 length_text(options.cross_members.spacing) + " is less than 1.5 widths of a cross member",
                 "", "at least " + length_text(1.5 * width));
  }
  problems.positive("fit", options.fit, "2 mm");
  problems.not_negative("joint_step", options.joint_step, "0 mm");
  if (!options.legs) return;
  problems.positive("legs.spacing", options.legs->spacing, "2 m");
  problems.positive("legs.side", options.legs->side, "90 mm");
  problems.positive("legs.braced_from", options.legs->braced_from, "1.5 m");
  problems.positive("legs.brace_width", options.legs->brace_width, "120 mm");
  problems.positive("legs.brace_thickness", options.legs->brace_thickness, "24 mm");
  check_ground(options.legs->ground, problems);
}

void check_stock(const TimberOptions& options, Problems& problems) {
  for (Issue& issue : stock_problems(options.split.stock())) problems.issues.push_back(std::move(issue));
  problems.positive("split.longest", options.split.longest, "12 m");
  constexpr int kMostLayers = 12;
  if (options.deck.layers < 1 || options.deck.layers > kMostLayers) {
    problems.add("deck.layers", std::to_string(options.deck.layers) + " layers",
                 "They are 1 to " + std::to_string(kMostLayers) + ".", "2");
  }
  problems.positive("deck.stave_tolerance", options.deck.stave_tolerance, "2 mm");
  if (const auto& boards = options.deck.boards) {
    problems.positive("deck.boards.width", boards->width, "120 mm");
    problems.positive("deck.boards.length", boards->length, "4 m");
    problems.not_negative("deck.boards.gap", boards->gap, "5 mm");
  }
  if (options.lumber.density <= 0.0)
    problems.add("lumber.density", rounded_text(options.lumber.density, 6) + " kg/m^3 is not positive", "",
                 "420 kg/m^3");
}

/// Bearers, their splices and legs side by side.
void check_room(const TimberOptions& options, double overall, Problems& problems) {
  const double width = options.bearer_width();
  const double outer = overall - width;
  if (!(options.bearers.spacing > 0.0) || !(width > 0.0) || outer <= width) return;
  const double count = options.bearers.count ? *options.bearers.count
                                             : std::ceil(outer / options.bearers.spacing - 1e-9) + 1.0;
  if (count < 2.0) return;
  const double pitch = outer / (count - 1.0);
  const bool ribs = options.frame == TimberFrame::ribs;
  double least = ribs ? 3.0 * width : width;  // a splice on both sides of a rib
  if (options.legs) least = std::max(least, options.legs->side);
  if (pitch >= least * (1.0 + 1e-9)) return;
  const std::string key = options.bearers.count ? "bearers.count" : "bearers.spacing";
  problems.add(key,
               rounded_text(count, 9) + " bearers on a width of " + length_text(overall) + " stand " +
                   length_text(pitch, 3) + " apart",
               ribs ? "Between two ribs there is room for the splices of both" +
                          std::string(options.legs ? ", and for the legs below them." : ".")
                    : "Two beams" + std::string(options.legs ? ", and the legs below them," : "") +
                          " stand beside each other.",
               "at most " + rounded_text(std::floor(outer / least) + 1.0, 9) + " of them");
}

/// Templates reach above the floor, at least past the lowest corner of the section's outside.
void check_reach(const parts::TimberChannel& channel, const TimberOptions& options, Problems& problems) {
  if (!options.cross_members.reach) return;
  const double reach = *options.cross_members.reach;
  if (reach > 0.0 && channel.trough->seat.size() > 2) return;
  problems.add("cross_members.reach", length_text(reach) + " is no height above the floor",
               "Templates hold the walls from both sides.",
               "above 0 mm, and at most the rim's " + length_text(channel.trough->section.outside.front().y));
}

}  // namespace

std::vector<Issue> timber_problems(const section::Measures& measures, const TimberOptions& options) {
  Problems problems;
  check_stock(options, problems);
  // Staves are counted by their tolerance, templates cut off at their reach.
  const bool sound = problems.issues.empty();
  const auto channel = sound ? parts::timber_channel_of(measures, options) : std::nullopt;
  check_members(options, channel && channel->trough, problems);
  if (!sound) return problems.issues;
  if (!channel) {
    problems.issues.push_back(
        {"cross_section.kind",
         "fabrication: this " + std::string(section::kind(measures)) + " cannot be made of timber",
         "Timber makes slabs, u-channels, trapezoids, half-pipes and v-channels of one width.",
         "one of them, with one width"});
    return problems.issues;
  }
  if (channel->trough) {
    check_reach(*channel, options, problems);
    if (!problems.issues.empty()) return problems.issues;
    for (Issue& issue : parts::lining_problems(*channel, options))
      problems.issues.push_back(std::move(issue));
  }
  check_room(options, channel->overall(), problems);
  if (options.bearer_width() * 2.0 > channel->overall()) {
    problems.add("bearers.width",
                 length_text(options.bearer_width()) + " is more than half the width of " +
                     length_text(channel->overall()),
                 "Two bearers stand side by side at least.", "narrower bearers");
  }
  if (!channel->trough && channel->overall() > options.split.longest) {
    problems.add(
        "split.longest",
        length_text(options.split.longest) + " is less than the width of " + length_text(channel->overall()),
        "Cross members go from edge to edge in one piece.", "at least " + length_text(channel->overall()));
  }
  return problems.issues;
}

}  // namespace glissade
