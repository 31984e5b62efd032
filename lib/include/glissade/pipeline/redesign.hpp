#pragma once

#include "glissade/pipeline/solve.hpp"
#include "glissade/trades/ski_jump/redesign.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// What an in-run is redesigned for, the take-off speed or the drop being that of the certificate.
enum class RedesignGoal {
  least_drop,            ///< the lowest tower for the take-off speed
  least_length,          ///< the shortest in-run for it
  least_load,            ///< the least highest load, from the same height to the same speed
  least_curvature_rate,  ///< the most gradual bend, from the same height to the same speed
  exit_speed             ///< the highest take-off speed from the same height
};

/// @return the word of the command line: "least-drop"
[[nodiscard]] std::string_view word(RedesignGoal goal);
/// @return every goal, in the order of the enumeration
[[nodiscard]] const std::vector<RedesignGoal>& redesign_goals();

/// What a redesign is to be best in, and what it keeps.
struct RedesignOptions {
  RedesignGoal goal = RedesignGoal::least_drop;
  std::optional<double> speed;  ///< at the edge [m/s]; none: what the design gives from its highest start
  std::optional<double>
      curvature_rate;  ///< of the free shape at most [1/m^2]; none: that of the certificate's bend
};

/// One shape of in-run, ridden by the body of the design from its start.
struct RedesignShape {
  std::string name;
  CenterlinePtr track;          ///< none: see `problem`
  std::string problem;          ///< why there is none
  Endpoints ends;               ///< from start to edge [m]
  double length = 0.0;          ///< [m]
  double take_off_speed = 0.0;  ///< [m/s]
  double highest_load = 0.0;    ///< per unit mass [m/s^2]
  double highest_radial = 0.0;  ///< v^2/radius [m/s^2]
  /// Highest |d kappa/ds| between the places where curvature jumps [1/m^2]; infinite of a power curve, at E1.
  double curvature_rate = 0.0;
  double largest_jump =
      0.0;  ///< of the curvature, where it jumps most but for the end of the transition [1/m]
  std::vector<std::string>
      breaks;  ///< clearances and waypoints of the design that it does not keep: "keep_outs[0]"
  /// How far it is straight from its start on, where that is shorter than the start area: gates would lie in the bend [m].
  std::optional<double> short_straight;
  std::optional<InRunShape>
      letters;  ///< that make it; none of a free shape, and of curves that have no letters
};

/// What one letter of the certificate costs in drop, at the take-off speed.
struct LetterPrice {
  std::string letter;  ///< "gamma", "alpha", "r1", "t", "v"
  double value = 0.0;  ///< [SI, rad]
  double price = 0.0;  ///< d(drop)/d(letter), the other letters being what they are [m per SI unit]
  /// Of "v": the same where the letters that lie at rules which count with it (r1 = 0.14 v^2, t = 0.25 v) follow it; none
  /// where no letter does.
  std::optional<double> price_with_rules;
  std::vector<std::string> following;  ///< those letters
  Dimension dimension = Dimension::length;
  std::string rule;  ///< the id of the rule that the letter lies at the bound of; may be empty
  std::optional<Certainty> certainty;  ///< of that rule
  /// gamma is less steep than its rule allows, for the straight along the start area, or for any straight at all
  bool by_start_area = false;
};

/// A certificate beside what the rules would allow.
struct Redesign {
  RedesignGoal goal = RedesignGoal::least_drop;
  double start_area = 0.0;            ///< along which gates lie; 0: none is given [m]
  TakeOff take_off;                   ///< at its speed all shapes are compared, but that of highest speed
  std::vector<RedesignShape> shapes;  ///< the certificate first, the free shape last
  /// The letters of the lowest certificate within the rules; none where no letters within them give the take-off speed: the
  /// shape of that name says why.
  std::optional<InRunShape> within_rules;
  std::vector<LetterPrice> prices;  ///< of those letters; empty where there are none
  /// Of the free shape, from its start to the table. Where that ended with a worse one than a shape that is known and keeps all
  /// that was asked of it, that shape is the free one, and the message says so.
  std::optional<OptimizeReport> search;

  /// @return why the free shape is not known to be the best, or that there is none; none if it is
  [[nodiscard]] std::optional<Issue> search_problem() const;
  /// @return whether no free shape can be: what it is to keep contradicts itself, or the table alone is too fast or too high
  [[nodiscard]] bool is_infeasible() const;
  /// @return why there are no letters within the rules; none if there are some
  [[nodiscard]] std::optional<Issue> letters_problem() const;
};

/// Compares an in-run with others that give the same take-off speed: its own letters at the bounds of the rules, other
/// transitions, Zanevskyy's power curve, a load-controlled bend, and the free shape that a search finds within the
/// rules: no steeper than gamma may be, no tighter than r1, no crest, curvature growing no faster than asked, straight
/// along the start area, alpha and the table at its end. It keeps the clearances and waypoints of the design's limits, which
/// the others are held against; of its other limits the rules take the place.
///
/// Bounds of gamma, r1 and t come from the design's rules on in_run_slope_angle, transition_radius or
/// design_radial_acceleration, table_length or table_time; a letter that no rule bounds stays. alpha stays, too: the jump
/// decides it. Where the steepest gamma leaves no straight along the start area, gamma gives way. Of the other shapes it is
/// told. Where no design_speed is given the rules count with the take-off speed.
/// A search that ends early ends with the best shape so far, or known.
/// @throws InputError if the design is of another kind than in-run, InfeasibleError if the body does not arrive; Interrupted if it
///         was asked to end before any such shape was there
[[nodiscard]] Redesign redesign(const Design& design, const RedesignOptions& options,
                                const RunContext& context);

/// The free shape, or the certificate within the rules, as a design of its own.
/// @param free  the shape that the search found, of kind segments, or in-run where it has letters; otherwise of kind in-run
/// @throws ConvergenceError if no free shape was found; InfeasibleError if there can be none, or are no letters within the rules
[[nodiscard]] Design redesigned(const Design& design, const Redesign& found, bool free);

}  // namespace glissade
