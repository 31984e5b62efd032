#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/task/limits.hpp"
#include "glissade/task/objective.hpp"

#include <compare>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glissade {

/// Which side of its bound a value is kept on.
enum class Bound {
  highest,  ///< value <= bound
  lowest,   ///< value >= bound
  exactly   ///< value == bound
};

/// How a limit is given.
enum class LimitForm {
  range,     ///< lowest, highest or both; a Range of Limits
  value,     ///< one number, on the side that its entry says; an optional number of Limits
  length,    ///< one length, 0 if it is left out; a number of Limits
  flag,      ///< true or false
  list,      ///< a list of shapes or points; a check names each by its number
  of_group,  ///< a group of keys of its own
  of_task,   ///< not under `limits`
  of_search  ///< not asked for
};

/// What is known of one limit, whatever a task asks for.
struct LimitEntry {
  LimitId id;
  std::string_view key;  ///< as in the design file under `limits`, and in every message
  LimitForm form;
  Bound bound;  ///< of every form but a range, which may have several
  Dimension dimension;
  double least;               ///< least value that a bound may have [SI, rad]
  double most;                ///< greatest
  bool above_least = false;   ///< `least` itself is refused; as the lowest of a range it says nothing
  bool fixable = false;       ///< of a range: a number alone stands for both ends, and is met exactly
  std::string_view label;     ///< as people call it
  std::string_view met = {};  ///< in place of a number, where the limit has none and is kept: "no crest"

  Range Limits::*range = nullptr;                  ///< of a range
  std::optional<double> Limits::*value = nullptr;  ///< of a value
  double Limits::*length = nullptr;                ///< of a length
};

/// @return every entry, in the order of LimitId
[[nodiscard]] std::span<const LimitEntry> limit_catalogue();
[[nodiscard]] const LimitEntry& entry_of(LimitId id);

/// @return what a limit given as a range asks for: without a lowest value that every value exceeds
[[nodiscard]] Range range_of(const LimitEntry& entry, const Limits& limits);

/// One side of one limit of a task: what a check, a price or a conflict is about.
struct LimitName {
  LimitId id = LimitId::finish;
  Bound bound = Bound::exactly;
  std::size_t index = 0;  ///< of a list: which of its items

  /// @return as in the design file: "slope_angle.highest", "exit_speed" (of one value), "keep_outs[0]"
  [[nodiscard]] std::string key() const;
  /// @return for people, who count from one: "slope angle", "keep-out 1"
  [[nodiscard]] std::string label() const;
  /// @return [SI, rad] of its bound
  [[nodiscard]] Dimension dimension() const { return entry_of(id).dimension; }
  [[nodiscard]] bool is_radius() const {
    return id == LimitId::smallest_valley_radius || id == LimitId::smallest_crest_radius;
  }

  friend auto operator<=>(const LimitName&, const LimitName&) = default;
};

/// @param price  units of the objective for one SI unit of the bound
/// @return for one unit that people use: a degree where the bound is an angle
[[nodiscard]] double price_for_people(double price, const LimitName& limit);
/// @return "s per deg", "m/s per m"
[[nodiscard]] std::string price_unit(const LimitName& limit, const Objective& objective);
/// @return "0.0123 s per deg"
[[nodiscard]] std::string price_text(double price, const LimitName& limit, const Objective& objective);

/// A bound that its limit does not allow.
struct LimitFault {
  std::string key;  ///< as LimitName::key()
  Issue issue;      ///< `where` left empty
};

/// @return every number among the limits that lies outside its bounds in the catalogue, and every range the
///         wrong way round
[[nodiscard]] std::vector<LimitFault> limit_faults(const Limits& limits);

}  // namespace glissade
