#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/parts/nest_stock.hpp"
#include "glissade/parts/plate_options.hpp"
#include "glissade/section/measures.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

namespace glissade {

/// What runs along the track below the deck.
enum class TimberFrame {
  ribs,  ///< templates cut from sheets
  beams  ///< glued laminated beams, set out by ordinates
};

/// Ribs or beams.
struct BearerOptions {
  std::optional<int> count;     ///< none: as many as `spacing` asks for, at least 2
  double spacing = 0.6;         ///< greatest distance of their middles [m]
  std::optional<double> width;  ///< across [m]; none: 18 mm of ribs, 120 mm of beams
  std::optional<double> depth;  ///< square to the track [m]; none: 200 mm of ribs, 400 mm of beams

  friend bool operator==(const BearerOptions&, const BearerOptions&) = default;
};

/// Boards of lumber that lie along the track, in place of sheets.
struct BoardOptions {
  double width = 120e-3;  ///< greatest; all are of one width [m]
  double length = 4.0;    ///< along their middle, before they are bent [m]
  double gap = 0.0;       ///< between two of them [m]

  friend bool operator==(const BoardOptions&, const BoardOptions&) = default;
};

/// The floor: sheets bent over the cross members, in layers whose seams are apart. Of a trough: its lining of strips.
struct DeckOptions {
  int layers = 2;                      ///< as thick together as the section's floor
  double stave_tolerance = 2e-3;       ///< greatest distance of flat strips from a round section [m]; > 0
  std::optional<BoardOptions> boards;  ///< none: sheets

  friend bool operator==(const DeckOptions&, const DeckOptions&) = default;
};

/// Battens on the bearers that carry the deck: one below every seam, others between. Of a trough: templates across the track,
/// cut from sheets, whose upper edge is the section.
struct CrossMemberOptions {
  std::optional<double> width;  ///< along the track [m]; none: 45 mm of battens, 30 mm of templates
  double height = 70e-3;        ///< below the floor [m]
  double spacing = 0.4;         ///< greatest distance of their middles [m]
  double cheek = 60e-3;         ///< of templates: beside the section at their top [m]
  std::optional<double> reach;  ///< of templates: height above the floor line [m]; none: to the rim

  friend bool operator==(const CrossMemberOptions&, const CrossMemberOptions&) = default;
};

/// Posts below every bearer.
struct LegOptions {
  std::vector<Vec2> ground;     ///< (x, height above the start), from left to right; one point: level [m]
  double spacing = 2.0;         ///< greatest distance along the run [m]
  double side = 90e-3;          ///< of their square section [m]
  double braced_from = 1.5;     ///< length of a leg from which boards brace it, across and along the run [m]
  double brace_width = 120e-3;  ///< of those boards [m]
  double brace_thickness = 24e-3;  ///< [m]

  friend bool operator==(const LegOptions&, const LegOptions&) = default;
};

/// Stock that pieces are cut from, and what none may exceed.
struct TimberSplit {
  double longest = 12.0;  ///< of a beam or cross member [m]
  Vec2 sheet{2.5,
             1.25};  ///< stock of deck, ribs and curbs; of the deck its longer side lies along the track [m]
  std::optional<double> heaviest;  ///< mass of a part [kg]
  /// Of the sheet's edges that stays free of parts [m]; >= 0. Sheets of the deck are the stock less both margins.
  double margin = 0.0;
  double spacing = 4e-3;  ///< between parts on one sheet, for the saw [m]; >= 0

  [[nodiscard]] NestStock stock() const { return NestStock::of(sheet, margin, spacing); }
  /// Its margin is that of outlines which are sawn out of a sheet: 5 mm at least.
  [[nodiscard]] NestStock sawn() const { return NestStock::of(sheet, std::max(margin, 5e-3), spacing); }

  friend bool operator==(const TimberSplit&, const TimberSplit&) = default;
};

/// How a track is built of timber.
struct TimberOptions {
  static constexpr std::string_view kProcess = "timber";
  static constexpr double kArcTolerance = 1e-3;  ///< [m]

  StockMaterial material{"birch plywood", 680.0};  ///< of sheets: deck, ribs, curbs
  StockMaterial lumber{"C24", 420.0};              ///< of beams, cross members, legs
  TimberFrame frame = TimberFrame::ribs;
  BearerOptions bearers;
  DeckOptions deck;
  CrossMemberOptions cross_members;
  std::optional<LegOptions> legs;
  TimberSplit split;
  double fit = 2e-3;  ///< greatest gap between flat members and the curved ones that they bear [m]
  double joint_step =
      0.0;  ///< by which the floor may drop at a seam of the upper layer, downstream [m]; >= 0

  /// @param templates  of a trough, else battens
  [[nodiscard]] double member_width(bool templates) const {
    return cross_members.width.value_or(templates ? 30e-3 : 45e-3);
  }
  [[nodiscard]] double bearer_width() const {
    return bearers.width.value_or(frame == TimberFrame::ribs ? 18e-3 : 120e-3);
  }
  [[nodiscard]] double bearer_depth() const {
    return bearers.depth.value_or(frame == TimberFrame::ribs ? 0.2 : 0.4);
  }

  friend bool operator==(const TimberOptions&, const TimberOptions&) = default;
};

/// Measures and options that no carpenter can make, whatever the track is: all of them.
/// @return issues whose `where` is the key: "deck.layers", "bearers.count"; of the section "cross_section.kind"
[[nodiscard]] std::vector<Issue> timber_problems(const section::Measures& measures,
                                                 const TimberOptions& options);

}  // namespace glissade
