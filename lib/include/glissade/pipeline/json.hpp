#pragma once

#include "glissade/parts/shop_part.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/redesign.hpp"
#include "glissade/pipeline/speeds.hpp"

#include <string>
#include <vector>

namespace glissade {

/// Results as JSON documents, the ones that `--json` prints: docs/json.md describes every key. Each ends with a
/// newline; bytes depend on the arguments alone.

/// A track and the ride down it.
[[nodiscard]] std::string track_json(const Design& design, const Track& track);

/// A design whose limits no track keeps: every key of track_json(), null where there is no track; what
/// contradicts each other, and what would do.
[[nodiscard]] std::string conflict_json(const Design& design, const OptimizeReport& report);

/// A track with its solid and the files.
[[nodiscard]] std::string build_json(const Design& design, const Build& build);

/// What was measured on a mesh.
[[nodiscard]] std::string mesh_json(const MeshFacts& facts);

/// One line of a comparison: a track, or why there is none.
struct ComparedTrack {
  const Design& design;
  const Track* track = nullptr;  ///< null: see `problem`
  std::string problem;
};

/// Several tracks.
/// @param common  what all of them have in common; null where each is a design of its own
[[nodiscard]] std::string comparison_json(const Design* common, const std::vector<ComparedTrack>& tracks);

/// What rules may bound, with the unit of each.
[[nodiscard]] std::string rule_quantities_json();

/// Rules as they are, without a track.
[[nodiscard]] std::string rules_json(const std::vector<RuleSet>& sets);

/// What rules say of a track, and those of the shop of its parts.
/// @param made  null where nothing is fabricated
[[nodiscard]] std::string verdicts_json(const Design& design, const Track& track,
                                        const std::vector<Judgement>& judgements,
                                        const WorkshopBuild* made = nullptr);

/// Friction and drag fitted to measured speeds.
/// @param as_designed  the same speeds with the friction and drag of their own designs
[[nodiscard]] std::string fit_json(const std::vector<SpeedReading>& readings, const SpeedFit& fit,
                                   const std::vector<SpeedResidual>& as_designed);

/// An in-run beside what the rules would allow.
[[nodiscard]] std::string redesign_json(const Design& design, const Redesign& found);

/// A track that stays as it is, ridden at several frictions.
/// @param rides  as ride_at() gives them
[[nodiscard]] std::string rides_json(const Design& design, const Track& track,
                                     const std::vector<Track>& rides);

}  // namespace glissade
