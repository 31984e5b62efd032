#pragma once

#include "glissade/parts/master_curve.hpp"
#include "glissade/parts/nest.hpp"
#include "glissade/parts/print_piece.hpp"
#include "glissade/parts/shop_part.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace glissade {

/// The body that rides what has been built.
struct AsBuiltRide {
  bool arrives = false;
  double travel_time = 0.0;         ///< [s]
  double exit_speed = 0.0;          ///< [m/s]
  double design_travel_time = 0.0;  ///< of the track before arcs and bends took its place [s]
  double design_exit_speed = 0.0;   ///< [m/s]
  std::size_t bends = 0;            ///< kinks of the floor
  std::size_t joints = 0;           ///< between units
  double joint_step = 0.0;          ///< by which the floor drops at each of them, as asked for [m]
  double highest_step = 0.0;  ///< greatest rise of a face at one, as the parts lie, before that drop [m]
  double joint_play =
      0.0;  ///< by which the bolts of one let its units shift either way: to be held flush [m]
  /// The highest load on the floor, between kinks [m/s^2].
  double highest_load = 0.0;
  std::size_t hops = 0;      ///< off the floor and down on it again, where the load is all but nothing
  double highest_hop = 0.0;  ///< above the floor [m]
  std::string stopped;       ///< of one that does not arrive: what ends it, and where
};

/// By how much the parts hold more (or less) than the solid by design.
struct VolumeDifference {
  std::string what;     ///< "tabs", "slots", "laps"
  double volume = 0.0;  ///< [m^3]
};

/// How many pages 1:1 templates have on each paper.
struct TemplatePages {
  std::size_t a4 = 0;
  std::size_t a3 = 0;
  std::size_t roll = 0;  ///< one a part, as long as it takes
};

/// How the parts stand to the solid that they make.
struct PartsProof {
  double volume = 0.0;        ///< of all parts that make up the solid [m^3]
  double exact_volume = 0.0;  ///< of the solid along the arcs, by another route [m^3]
  /// By which `volume` departs from `exact_volume`, in closed form; none of plain plates.
  std::vector<VolumeDifference> differences;
  double added_volume = 0.0;   ///< of flanges and what else is not of the channel, holes taken off [m^3]
  double smallest_gap = 0.0;   ///< between parts that do not touch by design [m]
  std::size_t pairs = 0;       ///< of parts that were held against each other
  std::size_t bolted = 0;      ///< pairs of holes that one bolt goes through, each about one axis
  double edge_mismatch = 0.0;  ///< greatest difference of lengths between flat and finished edges [m]
};

/// Everything that a process of fabrication makes of a track, proven.
struct WorkshopBuild {
  MasterCurve master;
  Workshop workshop;
  std::vector<double> joints;  ///< arc lengths of the units' ends, first 0, last the length [m]
  AsBuiltRide ride;
  PartsProof proof;
  std::vector<PrintPiece> prints;  ///< what a printer makes, each as it lies on a bed, one of a count a piece
  std::vector<NestedSheet> nests;  ///< of what is cut from sheets; none where the design asks for no nests
  /// Of the 1:1 templates, on each paper; zeros where none are made.
  TemplatePages template_pages;
};

}  // namespace glissade
