#pragma once

#include "glissade/core/quantity.hpp"
#include "glissade/task/limits.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glissade {

/// Rules of a trade as data: what a standard, a guideline or a company asks of a track, each with where it comes
/// from and how sure that is. Rules judge a track that is there; they neither find it nor stop a build.

/// How a rule's bound is known. All but `document` and `own` are to be checked against the document before
/// anyone relies on them, and are marked wherever they show.
enum class Certainty {
  document,        ///< from the document named, which was read
  secondary,       ///< from a source named that reports the document
  derived,         ///< worked out from sourced data by a method that is said
  general_high,    ///< general knowledge, the document not read: very likely right
  general_medium,  ///< likely right
  general_low,     ///< a guess at the size
  own              ///< a user's own rule
};

/// @return the word of rule files and JSON: "document", "secondary", "derived", "general-high", ..., "own"
[[nodiscard]] std::string_view word(Certainty certainty);
/// @return every certainty, surest first
[[nodiscard]] const std::vector<Certainty>& certainties();
/// @return true for a bound that nobody read in its document
[[nodiscard]] bool needs_checking(Certainty certainty);

/// What rules judge.
enum class RuleSubject {
  track,    ///< one number for a whole track: `rules` of a design
  workshop  ///< one a place of the parts that are made of it: `fabrication: rules`
};

/// Something that rules may bound, with its place where it has one.
struct RuleQuantity {
  std::string_view key;  ///< as in rule files: "table_time"
  Dimension dimension = Dimension::number;
  std::string_view label;  ///< for people: "time on the take-off table"
  RuleSubject subject = RuleSubject::track;
};

/// @return every quantity, in the order of docs/rules.md
[[nodiscard]] const std::vector<RuleQuantity>& rule_quantities();
/// @return the quantity of that key; null if there is none
[[nodiscard]] const RuleQuantity* rule_quantity(std::string_view key);

/// A rule holds only where this quantity lies in this range.
struct RuleCondition {
  std::string quantity;
  Range range;  ///< SI, rad

  friend bool operator==(const RuleCondition&, const RuleCondition&) = default;
};

/// A rule that tracks are held against, with its source and certainty.
struct Rule {
  std::string id;        ///< unique, e.g. "fis.in-run.table-length"
  std::string sentence;  ///< what it asks, in one sentence
  std::string quantity;  ///< key of a RuleQuantity
  Range bound;           ///< SI, rad; at least one side
  bool advice = false;   ///< outside the bound it warns instead of failing
  std::vector<RuleCondition> when;
  std::string source;
  Certainty certainty = Certainty::own;

  friend bool operator==(const Rule&, const Rule&) = default;
};

/// The rules of one file.
struct RuleSet {
  std::string name;   ///< a word: "fis-in-run"
  std::string title;  ///< one line
  std::vector<Rule> rules;
};

/// A value of a quantity, with its place.
struct MeasuredValue {
  double value = 0.0;                     ///< SI, rad; may be infinite
  std::optional<double> arc_length = {};  ///< where [m]
  std::string place = {};                 ///< the same for people: "gate 49, slow"; may be empty
};

/// The extremes of a quantity over everything that has it: each ride, each gate, each case. A `lowest` of a rule is broken
/// first by the least of them, a `highest` by the greatest.
class Extremes {
 public:
  /// Of equals the first is kept. A value that is no number counts as one that is not known.
  void see(MeasuredValue value);
  /// Something has no value: a ride that does not arrive, a key that the design leaves out. What the others say is then not all.
  /// @param missing  what would have to be known, told of the first: "hill: {size: 142 m}"; may be empty
  void lack(std::string missing);

  /// @return none where nothing was seen
  [[nodiscard]] const std::optional<MeasuredValue>& least() const noexcept { return least_; }
  [[nodiscard]] const std::optional<MeasuredValue>& most() const noexcept { return most_; }
  /// @return what is missing; none where everything has a value
  [[nodiscard]] const std::optional<std::string>& missing() const noexcept { return missing_; }

 private:
  std::optional<MeasuredValue> least_;
  std::optional<MeasuredValue> most_;
  std::optional<std::string> missing_;
};

/// What was measured of the quantities that rules ask about.
class Measurements {
 public:
  /// One value more of a quantity; what was seen of it before stays.
  /// @throws InternalError if there is no quantity of that key
  void see(std::string_view key, double value, std::optional<double> arc_length = {}, std::string place = {});
  void see(std::string_view key, MeasuredValue value);
  /// As Extremes::lack().
  /// @throws InternalError as see()
  void lack(std::string_view key, std::string missing);
  /// @return null for a quantity of which nothing was told
  [[nodiscard]] const Extremes* find(std::string_view key) const;

 private:
  [[nodiscard]] Extremes& of(std::string_view key);

  std::map<std::string, Extremes, std::less<>> extremes_;
};

/// @return whether a condition is met, of a quantity that several rides have: whether what lies between its extremes meets
///         it somewhere; none where that is not known
[[nodiscard]] std::optional<bool> is_met(const RuleCondition& condition, const Measurements& measurements);

enum class RuleVerdict { pass, warn, fail, cannot_be_judged };

/// @return "pass", "warn", "fail", "cannot be judged"
[[nodiscard]] std::string_view to_text(RuleVerdict verdict);

/// A value as near to a bound as this, relative, keeps it; of a bound below 0.01 (SI) this times 0.01. A search keeps its
/// limits as well as that: what it holds at a limit is not to fail a rule of the same bound.
inline constexpr double kRuleAccuracy = 1e-6;

/// What one rule says of one track.
struct Judgement {
  Rule rule;
  RuleVerdict verdict = RuleVerdict::cannot_be_judged;
  std::optional<double> value;       ///< the extreme that is nearest to breaking the rule; SI, rad
  std::optional<double> bound;       ///< the side that it breaks or is next to
  bool bound_is_highest = true;      ///< of `bound`
  std::optional<double> margin;      ///< from the value to `bound`, negative where it is broken
  std::optional<double> arc_length;  ///< where [m]
  std::string place;                 ///< the same for people; may be empty
  std::string reason;                ///< why it cannot be judged; otherwise empty
};

/// Holds each side of each rule against the extreme that is nearest to breaking it; a rule whose condition is not met is left
/// out. One that nothing breaks cannot be judged where a value is missing.
[[nodiscard]] std::vector<Judgement> judge(const std::vector<Rule>& rules, const Measurements& measurements);

/// @return the worst verdict; pass if there is nothing to judge. A rule that cannot be judged counts less than a
///         warning.
[[nodiscard]] RuleVerdict worst(const std::vector<Judgement>& judgements);

/// @param digits  significant ones of each bound
/// @return ">= 0.25 s", "9 deg to 12 deg": a bound for people
[[nodiscard]] std::string bound_text(const Rule& rule, int digits = 4);

/// @return the digits that tell a value from the bound that it breaks; 4 where they do, or nothing is broken
[[nodiscard]] int digits_of(const Judgement& judgement);

}  // namespace glissade
