// What rules may bound. A new quantity is one row here and one line where it is measured (pipeline/rules.cpp for any
// track, a file of its own for a trade, parts/*_facts.cpp for what a workshop makes).

#include "glissade/trades/rules.hpp"

#include <array>

namespace glissade {
namespace {

using enum Dimension;

constexpr std::array kOfTracks = std::to_array<RuleQuantity>({
    // any track
    {"run", length, "horizontal distance from start to finish"},
    {"drop", length, "drop from start to finish"},
    {"arc_length", length, "length along the track"},
    {"mean_slope_angle", angle, "mean slope angle, over the length of the track"},
    {"steepest_slope_angle", angle, "steepest slope angle"},
    {"flattest_slope_angle", angle, "flattest slope angle"},
    {"entry_slope_angle", angle, "slope angle at the start"},
    {"exit_slope_angle", angle, "slope angle at the finish"},
    {"smallest_valley_radius", length, "smallest radius of a valley"},
    {"smallest_crest_radius", length, "smallest radius of a crest"},
    {"highest_speed", speed, "highest speed"},
    {"exit_speed", speed, "speed at the finish"},
    {"travel_time", time, "travel time"},
    {"highest_normal_load", acceleration, "highest normal load"},
    {"lowest_normal_load", acceleration, "lowest normal load"},
    {"highest_radial_acceleration", acceleration, "highest radial acceleration v^2/radius"},
    {"least_curvature", per_length, "least curvature, negative on a crest"},
    // in-runs of ski jumps
    {"hill_size", length, "hill size HS"},
    {"construction_point", length, "distance w to the construction point K"},
    {"hill_height", length, "height of the table's edge above the lowest point"},
    {"in_run_slope_angle", angle, "slope angle gamma of the straight"},
    {"table_slope_angle", angle, "slope angle alpha of the table"},
    {"table_length", length, "length t of the table"},
    {"table_time", time, "time on the table at the design speed, t/v0"},
    {"transition_radius", length, "radius r1 at the end of the transition"},
    {"design_radial_acceleration", acceleration, "radial acceleration at the design speed, v0^2/r1"},
    {"curvature_step_at_e1", per_length, "step of the curvature where the transition begins"},
    {"table_height_ratio", number, "height of the table over w, s/w"},
    {"start_area_ratio", number, "length of the start area over that of the in-run, es/e1"},
    {"gate_step_height", length, "height from one gate to the next"},
    {"track_spacing", length, "distance between the middles of the grooves"},
    {"track_groove_width", length, "width of a groove"},
    {"track_groove_depth", length, "depth of the grooves"},
    {"load_above_table_weight", acceleration,
     "highest normal load less that of a body at rest on the table, g cos(alpha)"},
    {"highest_take_off_speed", speed, "take-off speed from the highest gate"},
    {"lowest_take_off_speed", speed, "take-off speed from the lowest gate"},
    // chutes: the worst over low, nominal and high friction, and over trickle, nominal and surge flow
    {"highest_friction_angle", angle, "highest friction angle of the stream anywhere on its track"},
    {"friction_spread", angle, "highest less lowest friction angle of the stream at one place"},
    {"cases_not_arriving", number, "cases of friction and flow that do not arrive"},
    {"lowest_stream_speed", speed, "lowest speed of the stream"},
    {"stall_margin", angle, "friction angle at which the stream stops, less the highest"},
    {"slope_margin", angle, "slope angle less the highest friction angle there"},
    {"valley_angle", angle, "flattest corner between floor and wall"},
    {"landing_margin", angle, "slope of the feed's fall above that of the floor where it lands"},
    {"impact_speed_ratio", number, "speed after the feed's impact over that before"},
    {"impact_angle", angle, "angle at which the feed meets the floor"},
    {"feed_drop", length, "height from which the feed falls"},
    {"contact_reserve", number, "lowest load over that of gravity alone"},
    {"hoods", number, "number of hoods"},
    {"hood_contact", number, "least v^2/(g R cos(slope)) below the hood"},
    {"obstacles_by_flights", number, "number of obstacles, where a stream flies"},
    {"air_clearance", length, "distance of the stream in the air beyond the clearance of an obstacle"},
    {"belt_match", number, "speed along the belt over the belt's"},
    {"speed_into_belt", speed, "speed into the belt"},
    {"depth_over_wall", number, "burden depth over the wall's height"},
    {"depth_over_width", number, "burden depth over the width"},
    {"width_over_lump", number, "width over the largest lump"},
    {"speed_over_cap", number, "highest speed over what the material stands"},
    {"wear_peak", number, "highest wear of the floor over its mean"},
    {"narrowing", number, "least width over the widest before it"},
    {"corner_radius", length, "radius of the inner corners"},
    {"inspection_doors", number, "inspection doors off the wearing side"},
    {"plugged_load", number, "strength over the load of a plugged chute"},
    {"earthing_and_finish", number, "noise, earthing, finish and drainage as the plant asks"},
    {"trim_allowance", length, "trim allowance at one end"},
});

// Many are told as a multiple of something of the same part: what holds for a thin plate holds for a thick one then.
constexpr std::array kOfWorkshops = std::to_array<RuleQuantity>({
    // any part
    {"part_thickness", length, "thickness of a part"},
    {"part_density", density, "density of a part"},
    {"part_mass", mass, "mass of a part"},
    {"part_mass_share", number, "mass of a part over the heaviest that the design allows"},
    {"part_sheet_share", number, "side of a flat pattern over that of its sheet"},
    {"part_width", length, "shorter side of the least rectangle round a flat pattern"},
    {"part_clearance_margin", length,
     "distance of a part from what the design keeps clear of, less what it asks, plus the tolerance of the "
     "arcs"},
    // plates
    {"hole_thicknesses", number, "diameter of a hole over the thickness of its plate"},
    {"hole_edge_diameters", number, "distance of a hole's middle from the edge over its diameter"},
    {"hole_pitch_diameters", number, "distance of two holes' middles over their diameter"},
    {"hole_bend_thicknesses", number,
     "distance of the edge of a hole or slot from where a bend begins over the thickness of its plate"},
    {"slot_edge_diameters", number, "distance of the middles of a slot's ends from the edge over its width"},
    {"web_thicknesses", number, "width of what stands beside a hole or slot over the thickness of its plate"},
    {"tab_width", length, "width of a tab"},
    {"tab_thicknesses", number, "width of a tab over the thickness of its plate"},
    {"tab_gap", length, "distance of neighbouring tabs"},
    {"slot_clearance", length, "by how much a slot is larger than its tab"},
    {"liner_life_share", number, "time in which a tile is worn through over the life that the design asks"},
    {"bolt_pitch", length, "distance of neighbouring bolts of a frame"},
    {"rolling_radius_thicknesses", number, "radius of a rolled plate over its thickness"},
    {"angle_elongation", number, "elongation of the toe of an angle that is rolled to a flange"},
    {"bend_radius_thicknesses", number, "inner radius of a bend over the thickness of its plate"},
    {"flat", length, "flat between bends, or beside the last"},
    {"flat_thicknesses", number, "flat between bends, or beside the last, over the thickness of its plate"},
    // prints
    {"bed_share", number, "size of a segment over that of the bed"},
    {"overhang_share", number,
     "lean of an underside from upright over the lean that prints without supports"},
    {"run_surface_step_layers", number, "step of the layers on the run surface over their height"},
    {"section_walls", number, "least thickness of the section over the least wall of the printer"},
    {"hole_wall_walls", number, "wall beside a hole over the least wall of the printer"},
    {"joint_play", length, "play of pins, tongues or dovetails at a joint"},
    {"pins_at_joint", number, "pins at a joint that has no tongue"},
    {"number_bar", length, "width of the bars of a number"},
    // timber
    {"deck_radius_thicknesses", number, "radius of the deck over the thickness of a layer"},
    {"board_radius_thicknesses", number, "radius of a deck of boards over the thickness of a board"},
    {"deck_span_thicknesses", number, "distance of cross members over the thickness of the deck"},
    {"seam_member_share", number, "distance of a seam from a cross member's middle over half its width"},
    {"seam_stagger", length, "distance of seams of neighbouring layers"},
    {"bearer_spacing", length, "distance of bearers"},
    {"leg_spacing", length, "distance of legs below ribs"},
    {"unbraced_leg", length, "length of a leg without a brace"},
    {"member_length_share", number, "length of a cross member over the longest that the design allows"},
    {"deck_gap_share", number, "gap between deck and cross member over the fit of the design"},
    // joints of any process
    {"step_up", length, "step up that a body meets at a joint"},
});

}  // namespace

const std::vector<RuleQuantity>& rule_quantities() {
  static const std::vector<RuleQuantity> all = [] {
    std::vector<RuleQuantity> rows(kOfTracks.begin(), kOfTracks.end());
    for (RuleQuantity row : kOfWorkshops) {
      row.subject = RuleSubject::workshop;
      rows.push_back(row);
    }
    return rows;
  }();
  return all;
}

}  // namespace glissade
