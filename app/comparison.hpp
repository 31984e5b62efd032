#pragma once

#include "glissade/pipeline.hpp"
#include "glissade/report/figure.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace glissade::app {

/// One line of a comparison: a track, or why there is none.
struct Entry {
  Design design;
  std::optional<Track> track;
  std::string problem;
  bool interrupted = false;  ///< asked to end before there was a track
};

/// @return the kind as the design file names it; "fastest in limits" where it is searched for within them
[[nodiscard]] std::string entry_name(const Entry& entry);

/// @return what each design is called: by its name or, where it has none, its file. Of those called the same, as much of where
///         the file lies as tells them apart: "a/chute", "Chute (b/chute)"
[[nodiscard]] std::vector<std::string> design_names(const std::vector<Entry>& entries);

/// @param make  may throw what a design that cannot be built, or work that is asked to end, throws; it becomes the entry's
///              problem
[[nodiscard]] Entry entry_of(Design design, const std::function<Track(const Design&)>& make);

/// The design with a centerline of every kind that two points define, its own first where it is a drawn one.
/// With limits the fastest track comes twice: within them and, second, without; all other kinds are held
/// against them. A free finish is then where the track within the limits ends.
/// @throws Interrupted if it is asked to end before there is any track
[[nodiscard]] std::vector<Entry> every_kind(const Design& design, const RunContext& context);

/// Each design with its own track.
/// @throws Interrupted as every_kind()
[[nodiscard]] std::vector<Entry> every_design(std::vector<Design> designs, const RunContext& context);

/// The constant-speed curve of the design at each friction.
/// @throws InputError as with_friction()
[[nodiscard]] std::vector<Entry> friction_sweep(const Design& design, const std::vector<Friction>& frictions);

/// Figures, and whether a search for them ended early: its points are missing there.
struct KindsFigures {
  std::vector<Figure> figures;
  bool ended_early = false;
  bool interrupted = false;  ///< asked to; then ended_early holds, too
};

/// Shapes and speeds of every kind, travel time and steepest slope of each over friction.
/// @throws Interrupted if it is asked to end while nothing is searched for
[[nodiscard]] KindsFigures kinds_figures(const Design& design, const std::vector<Entry>& entries,
                                         const RunContext& context);

/// The curves of a friction sweep, drawn as the paper draws its figure 1.
[[nodiscard]] std::vector<Figure> sweep_figures(const std::vector<Entry>& entries);

/// @return whether every design that has a track is an in-run, or tells the size of its hill; there is one
[[nodiscard]] bool are_hills(const std::vector<Entry>& entries);

/// Profile, slope angle, speed and load of several designs; of hills the speeds from their gates, too.
[[nodiscard]] std::vector<Figure> design_figures(const std::vector<Entry>& entries);

}  // namespace glissade::app
