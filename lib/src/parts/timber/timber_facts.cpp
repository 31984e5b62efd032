// What rules of the shop (lib/data/rules/shop-timber.yaml) may bound of timber. A step up at a seam is not among it: both
// sheets of a seam lie on one cross member and on one layer below, so how they are made leaves none.

#include "parts/timber/timber_facts.hpp"

#include "glissade/core/number_text.hpp"

#include "parts/shop/shop_facts.hpp"
#include "parts/timber/timber_braces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace glissade::parts {
namespace {

std::string at_text(double s) {
  return length_text(s, 3) + " along the track";
}

void measure_members(const TimberJob& job, const std::vector<CrossMember>& members, ShopFacts& facts) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    const std::string where = at_text(members[i].at);
    facts.at(where, "deck_gap_share", members[i].sagitta, job.options.fit);
    if (i + 1 < members.size())
      facts.at(where, "deck_span_thicknesses", members[i + 1].at - members[i].at, job.channel.thickness);
  }
  const Vec2 sheet = job.options.split.sheet;
  if (job.channel.trough)
    facts.at("templates", "member_length_share", job.channel.overall(), std::max(sheet.x, sheet.y));
  else
    facts.at("cross members", "member_length_share", job.channel.overall(), job.options.split.longest);
}

void measure_seams(const TimberJob& job, const std::vector<std::vector<DeckRow>>& rows,
                   const std::vector<CrossMember>& members, ShopFacts& facts) {
  const std::size_t above = job.sets_per_layer();
  for (std::size_t layer = 0; layer < rows.size(); ++layer) {
    for (std::size_t i = 1; i < rows[layer].size(); ++i) {
      const double at = rows[layer][i].span.from;
      double nearest = std::numeric_limits<double>::infinity();
      for (const CrossMember& member : members) nearest = std::min(nearest, std::fabs(member.at - at));
      facts.at(at_text(at), "seam_member_share", nearest, 0.5 * job.member_width());
      if (layer < above) continue;
      for (std::size_t k = 1; k < rows[layer - above].size(); ++k)
        facts.at(at_text(at), "seam_stagger", std::fabs(rows[layer - above][k].span.from - at));
    }
  }
}

void measure_legs(const TimberJob& job, const std::vector<Leg>& legs, const BearerPlan& bearers,
                  ShopFacts& facts) {
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const std::string where = "leg " + std::to_string(i + 1);
    if (!is_braced(job, legs[i], bearers)) facts.at(where, "unbraced_leg", legs[i].length());
    if (i > 0 && job.options.frame == TimberFrame::ribs)
      facts.at(where, "leg_spacing", legs[i].x - legs[i - 1].x);
  }
}

}  // namespace

void measure_timber(const TimberJob& job, const std::vector<std::vector<DeckRow>>& rows,
                    const std::vector<CrossMember>& members, const BearerPlan& bearers,
                    const std::vector<Leg>& legs, Workshop& workshop) {
  ShopFacts facts(workshop);
  facts.parts(job.options.split.heaviest);
  for (const TrackArc& arc : job.track.arcs()) {
    if (arc.curvature == 0.0) continue;
    facts.at(at_text(arc.start),
             job.options.deck.boards ? "board_radius_thicknesses" : "deck_radius_thicknesses",
             1.0 / std::fabs(arc.curvature), job.layer());
  }
  measure_members(job, members, facts);
  measure_seams(job, rows, members, facts);
  for (std::size_t i = 1; i < bearers.across.size(); ++i)
    facts.at("bearer " + std::to_string(i + 1), "bearer_spacing", bearers.across[i - 1] - bearers.across[i]);
  measure_legs(job, legs, bearers, facts);
}

}  // namespace glissade::parts
