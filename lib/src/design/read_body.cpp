#include "design/read_body.hpp"

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/air.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/design/body_design.hpp"

#include "design/map_reader.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace glissade::design_file {
namespace {

std::optional<double> read_as(const Node& node, Dimension dimension) {
  if (node.kind != Node::Kind::scalar) return {};
  try {
    return parse_quantity(node.scalar, dimension, "");
  } catch (const InputError&) {
    return {};
  }
}

bool is_share(const Node& node) {
  return node.scalar.ends_with('%');
}

// Larger numbers without a unit are degrees that nobody wrote.
constexpr double kLargestCoefficient = 2.0;  // taste

/// The key for the other way to say a friction; empty where there is none.
std::string_view other_friction_key(std::string_view key) {
  if (key == "friction_angle") return "friction_coefficient";
  if (key == "friction_coefficient") return "friction_angle";
  if (key == "angle") return "coefficient";
  return key == "coefficient" ? "angle" : "";
}

/// Whether a value says a friction in the other way.
bool says_the_other_way(const Node& node, Dimension dimension) {
  if (read_as(node, dimension)) return false;
  if (dimension == Dimension::number) return read_as(node, Dimension::angle).has_value();
  const auto number = read_as(node, Dimension::number);
  return number && (is_share(node) || (*number > 0.0 && *number <= kLargestCoefficient));
}

/// A friction angle or coefficient: one value, or a range with a nominal value.
struct FrictionValues {
  std::optional<double> low;
  std::optional<double> nominal;
  std::optional<double> high;
};

FrictionValues read_friction_values(const Value& value, Dimension dimension, Findings& findings) {
  FrictionValues values;
  if (value.node->kind != Node::Kind::map) {
    values.nominal = as_friction(value, dimension, findings);
    return values;
  }
  MapReader map(value, "A friction range", "", findings);
  map.expect({"low", "nominal", "high"});
  values.nominal =
      map.needed_quantity("nominal", dimension, "nominal: the value that the objective is taken at");
  values.low = map.quantity("low", dimension);
  values.high = map.quantity("high", dimension);
  map.refuse_unknown_keys();
  return values;
}

/// What is wrong with a friction, by the key that people wrote: "rolling_resistance", "friction_angle.low".
Issue friction_beyond(double value, bool by_coefficient, const std::string& key_path) {
  std::string key = key_path.substr(key_path.rfind('.') + 1);
  if (key == "low" || key == "high") key = key_path.substr(key_path.find('.') + 1);
  if (by_coefficient) {
    return out_of_range(key, value, Dimension::number, {0.0, kRoughest},
                        "It lies between 0 and 10000: beyond, closed forms lose their digits.",
                        key.starts_with("rolling_resistance")
                            ? "0.002 to 0.05 of most wheels and balls"
                            : "the tangent of the friction angle, often 0.02 to 0.8");
  }
  constexpr int kDigits =
      6;  // rounding: below it the angle of kRoughest, 89.99427 deg, would be shown as a larger one
  const auto text = [](double radians, int digits) {
    return angle_text(Angle::from_radians(radians), digits);
  };
  return {
      "", key + ": " + text_beyond(value, {0.0, kRightAngle}, text, kDigits) + " is out of range",
      "It lies between 0 deg and 89.994 deg, a coefficient of 10000: beyond, closed forms lose their digits.",
      "the angle at which the material just starts to slide on the track, often 10 to 40 deg"};
}

std::optional<Friction> friction_of_coefficient(double mu) {
  if (!(mu >= 0.0 && mu <= kRoughest)) return {};
  return Friction::from_coefficient(mu);
}

std::optional<Friction> to_friction(const std::optional<double>& value, bool by_coefficient,
                                    const std::string& key_path, Findings& findings) {
  if (!value) return {};
  const std::optional<Friction> friction =
      by_coefficient ? friction_of_coefficient(*value) : friction_of_angle(*value);
  if (!friction)
    findings.add(findings.position(key_path), key_path, friction_beyond(*value, by_coefficient, key_path));
  return friction;
}

/// The same as values of the schema; none where a value is missing or bad.
struct FrictionRange {
  std::optional<Friction> low;
  std::optional<Friction> nominal;
  std::optional<Friction> high;
};

FrictionRange to_range(const FrictionValues& values, bool by_coefficient, const std::string& path,
                       Findings& findings) {
  return {to_friction(values.low, by_coefficient, path + ".low", findings),
          to_friction(values.nominal, by_coefficient, path, findings),
          to_friction(values.high, by_coefficient, path + ".high", findings)};
}

void set_friction(const FrictionRange& range, BodyDesign& body) {
  body.friction = range.nominal.value_or(Friction{});
  body.low_friction = range.low;
  body.high_friction = range.high;
}

/// @param needed  a missing friction is a problem
FrictionRange read_friction(MapReader& map, bool needed, Findings& findings) {
  const bool by_coefficient = map.has("friction_coefficient");
  if (by_coefficient && map.has("friction_angle")) {
    findings.add(findings.position(map.path_of("")), map.path_of("friction_angle"),
                 {"", "both friction_angle and friction_coefficient are given",
                  "They say the same: the coefficient is the tangent of the angle.", "one of the two"});
  }
  const auto coefficient = map.find("friction_coefficient");
  const auto angle =
      by_coefficient || !needed ? map.find("friction_angle")
      : map.has_misspelt("friction_coefficient")
          ? std::nullopt
          : map.need("friction_angle", "friction_angle: 17 deg, or friction_coefficient: 0.306");
  if (coefficient && angle) static_cast<void>(read_friction_values(*angle, Dimension::angle, findings));
  const std::optional<Value>& value = coefficient ? coefficient : angle;
  if (!value) return {};
  const FrictionValues values =
      read_friction_values(*value, coefficient ? Dimension::number : Dimension::angle, findings);
  return to_range(values, by_coefficient, value->key_path, findings);
}

/// One entry of a list of frictions: from where on, and which.
std::optional<FrictionFrom> read_friction_from(const Value& value, Findings& findings) {
  MapReader map(value, "A friction along the track", "{from: 0 m, angle: 4 deg}", findings);
  map.expect({"from", "angle", "coefficient"});
  FrictionFrom change;
  const auto from = map.needed_quantity("from", Dimension::length, "from: 12 m, along the track");
  const bool by_coefficient = map.has("coefficient");
  const auto angle =
      by_coefficient ? map.find("angle") : map.need("angle", "angle: 4 deg, or coefficient: 0.07");
  const auto coefficient = map.find("coefficient");
  if (angle && coefficient) {
    findings.add(value.node->at, value.key_path,
                 {"", value.key + ": both angle and coefficient are given",
                  "They say the same: the coefficient is the tangent of the angle.", "one of the two"});
  }
  std::optional<Friction> friction;
  if (const auto& given = coefficient ? coefficient : angle) {
    const auto number = as_friction(*given, coefficient ? Dimension::number : Dimension::angle, findings);
    friction = to_friction(number, coefficient.has_value(), given->key_path, findings);
  }
  map.refuse_unknown_keys();
  if (!from || !friction) return {};
  return FrictionFrom{*from, *friction};
}

/// A range of friction with the keys that it has, whatever those are that were written: "{low: 0.08, nominal: 0.12, high: 0.16}".
/// @pre it has values, and each is one of the dimension
std::string range_meant(const Node& node, Dimension dimension, const std::string& unit) {
  const auto value_of = [&](const Entry& entry) { return *read_as(entry.value, dimension); };
  const auto [low, high] =
      std::minmax_element(node.entries.begin(), node.entries.end(),
                          [&](const Entry& a, const Entry& b) { return value_of(a) < value_of(b); });
  const auto between = std::find_if(node.entries.begin(), node.entries.end(), [&](const Entry& entry) {
    return entry.key == "nominal" || (&entry != &*low && &entry != &*high);
  });
  const double middle = 0.5 * (value_of(*low) + value_of(*high));
  const bool is_angle = dimension == Dimension::angle;
  const std::string nominal = between != node.entries.end() ? between->value.scalar + unit
                              : is_angle                    ? quantity_text(middle, dimension)
                                                            : rounded_text(middle, 4) + unit;
  return "{low: " + low->value.scalar + unit + ", nominal: " + nominal + ", high: " + high->value.scalar +
         unit + "}";
}

/// One value under a key of the list's items, as the key for the whole track has it: "friction_angle: 3 deg". Empty where it is
/// none.
std::string friction_of_key(const Entry& entry) {
  const bool number = read_as(entry.value, Dimension::number).has_value();
  if (!number && !read_as(entry.value, Dimension::angle)) return {};
  const bool by_coefficient = number && (entry.key == "coefficient" || is_share(entry.value));
  return (by_coefficient ? "friction_coefficient: " : "friction_angle: ") + entry.value.scalar +
         (number && !by_coefficient ? " deg" : "");
}

/// A friction for the whole track that was given under the key of a list, as its own key has it: "friction_coefficient: 0.3".
/// Empty where it is none.
std::string friction_meant(const Node& node) {
  const bool range = node.kind == Node::Kind::map;
  const auto is_friction = [](const Entry& entry) {
    return entry.key == "angle" || entry.key == "coefficient";
  };
  // One of the list's own items, without the list; alone, without its place, it is that of the whole track.
  if (node.entries.size() == 1 && is_friction(node.entries.front()))
    return friction_of_key(node.entries.front());
  if (std::any_of(node.entries.begin(), node.entries.end(), is_friction)) return {};
  std::vector<const Node*> values;
  if (!range) values.push_back(&node);
  for (const Entry& entry : node.entries) values.push_back(&entry.value);
  const auto all = [&](const auto& is_one) {
    return !values.empty() && std::all_of(values.begin(), values.end(), is_one);
  };
  const bool numbers = all([](const Node* one) { return read_as(*one, Dimension::number).has_value(); });
  if (!numbers && !all([](const Node* one) { return read_as(*one, Dimension::angle).has_value(); }))
    return {};
  const bool coefficients =
      numbers && all([](const Node* one) {
        return is_share(*one) || *read_as(*one, Dimension::number) <= kLargestCoefficient;
      });
  const std::string unit = numbers && !coefficients ? " deg" : "";
  const std::string shown = node.entries.size() > 1
                                ? range_meant(node, numbers ? Dimension::number : Dimension::angle, unit)
                                : values.front()->scalar + unit;
  return (coefficients ? "friction_coefficient: " : "friction_angle: ") + shown;
}

void read_friction_list(const Value& value, BodyDesign& body, Findings& findings) {
  constexpr std::string_view kExample = "[{from: 0 m, angle: 3 deg}, {from: 40 m, angle: 8 deg}]";
  // Whoever writes one value means the whole track.
  const std::string meant = friction_meant(*value.node);
  const std::string example = (meant.empty() ? "" : meant + ", or friction: ") + std::string(kExample);
  for (const Value& item : as_list(value, example, findings, {.least = 1})) {
    if (const auto change = read_friction_from(item, findings)) body.friction_changes.push_back(*change);
  }
  if (body.friction_changes.empty()) {
    if (value.node->kind != Node::Kind::sequence || !value.node->items.empty()) return;
    findings.add(
        value.node->at, value.key_path,
        {"", "friction: the list is empty", "A track rubs from its start on.", std::string(kExample)});
    return;
  }
  // The first holds from the start; check_body() asks that it says so.
  body.friction = body.friction_changes.front().friction;
}

/// The keys of a kind of body, without those that every body has.
class BodyKeys {
 public:
  void resistance(const char* key, const char*) { keys_.emplace_back(key); }
  void length(const char* key, double, double, double, const char*, const char*) { keys_.emplace_back(key); }
  void angle(const char* key, Angle, Angle, const char*, const char*) { keys_.emplace_back(key); }
  void grip(const std::optional<Friction>&, const char*) const {}

  [[nodiscard]] const std::vector<std::string_view>& keys() const { return keys_; }

 private:
  std::vector<std::string_view> keys_;
};

std::vector<std::string_view> keys_of(const BodyKind& kind) {
  BodyKeys keys;
  std::visit([&](const auto& one) { one.visit(one, keys); }, kind);
  return keys.keys();
}

template <std::size_t... kIndex>
std::vector<BodyKind> all_kinds(std::index_sequence<kIndex...> /*indices*/) {
  return {BodyKind(std::in_place_index<kIndex>)...};
}

const std::vector<BodyKind>& all_kinds() {
  static const std::vector<BodyKind> kinds =
      all_kinds(std::make_index_sequence<std::variant_size_v<BodyKind>>());
  return kinds;
}

std::string_view word_of(const BodyKind& kind) {
  return std::visit([](const auto& one) { return one.kKind; }, kind);
}

/// Keys of the kinds that do not slide, each with the hint that names its kind.
const std::vector<std::pair<std::string_view, std::string>>& keys_of_others() {
  static const std::vector<std::pair<std::string_view, std::string>> all = [] {
    std::vector<std::pair<std::string_view, std::string>> found;
    for (const BodyKind& kind : all_kinds()) {
      const std::vector<std::string_view> keys = keys_of(kind);
      std::string list;
      for (std::size_t i = 0; i < keys.size(); ++i) {
        list += (i == 0 ? "" : i + 1 < keys.size() ? ", " : " and ") + std::string(keys[i]);
      }
      for (const std::string_view key : keys) {
        found.emplace_back(key, "kind: " + std::string(word_of(kind)) + ", which has " + list);
      }
    }
    return found;
  }();
  return all;
}

void read_sliding(MapReader& map, bool friction_may_follow, BodyDesign& body, Findings& findings) {
  for (const auto& [key, hint] : keys_of_others()) map.add_stranger(key, hint);
  const auto list = map.find("friction");
  const bool given = list || map.has("friction_angle") || map.has("friction_coefficient");
  body.friction_given = given || !friction_may_follow;
  const FrictionRange range = read_friction(map, !list && !friction_may_follow, findings);
  if (!list) return set_friction(range, body);
  if (map.has("friction_angle") || map.has("friction_coefficient")) {
    findings.add(list->node->at, list->key_path,
                 {"", "friction: a list, and a friction for the whole track beside it", "",
                  "the list alone, from 0 m on"});
  }
  read_friction_list(*list, body, findings);
}

/// Reads each measure of a kind under its key.
class KindReader {
 public:
  KindReader(MapReader& map, BodyDesign& body, Findings& findings)
      : map_(map), body_(body), findings_(findings) {}

  void resistance(const char* key, const char* example) {
    const auto value = map_.need(key, std::string(key) + ": " + example);
    if (!value) return;
    const FrictionValues values = read_friction_values(*value, Dimension::number, findings_);
    set_friction(to_range(values, true, value->key_path, findings_), body_);
  }
  void length(const char* key, double& value, double, double, const char*, const char* example) {
    value = map_.needed_quantity(key, Dimension::length, std::string(key) + ": " + example).value_or(0.0);
  }
  void angle(const char* key, Angle& value, Angle most, const char*, const char*) {
    const auto given = map_.quantity(key, Dimension::angle);
    value = given ? Angle::from_radians(*given) : most;
  }
  void grip(std::optional<Friction>& value, const char* why) {
    const FrictionRange grip = read_friction(map_, false, findings_);
    value = grip.nominal;
    if (!grip.low && !grip.high) return;
    const std::string does(std::visit([](const auto& kind) { return kind.kDoes; }, body_.kind));
    const std::string resistance(std::visit([](const auto& kind) { return kind.kResistance; }, body_.kind));
    const std::string key = map_.has("friction_coefficient") ? "friction_coefficient" : "friction_angle";
    findings_.add(findings_.position(map_.path_of(key)), map_.path_of(key),
                  {"", key + ": a range, of a body that " + does, why,
                   "one value, the lowest; a range of " + resistance});
  }

 private:
  MapReader& map_;
  BodyDesign& body_;
  Findings& findings_;
};

/// A body that does not slide.
void read_kind(MapReader& map, BodyDesign& body, Findings& findings) {
  map.add_stranger("friction", "kind: sliding, which has a friction that changes along the track");
  KindReader reader(map, body, findings);
  std::visit([&](auto& kind) { kind.visit(kind, reader); }, body.kind);
}

void read_air(const Value& value, DragDesign& drag, Findings& findings) {
  MapReader map(value, "The air", "{altitude: 1200 m, temperature: -5 degC}", findings);
  map.expect({"altitude", "temperature", "density"});
  drag.density = map.quantity("density", Dimension::density);
  drag.altitude = map.quantity("altitude", Dimension::length).value_or(0.0);
  drag.temperature = map.quantity("temperature", Dimension::temperature);
  if (drag.density && (map.has("altitude") || map.has("temperature"))) {
    findings.add(value.node->at, value.key_path,
                 {"", "air: a density, and what it follows from beside it",
                  "The density follows from altitude and temperature.", "density alone, or the other two"});
  }
  map.refuse_unknown_keys();
}

void read_drag(MapReader& map, BodyDesign& body, Findings& findings) {
  const auto drag = map.quantity("drag", Dimension::per_length);
  const bool by_area = map.has("drag_area");
  const auto area = map.quantity("drag_area", Dimension::area);
  const auto mass =
      by_area ? map.needed_quantity("mass", Dimension::mass, "mass: 85 kg, with all that moves along")
              : map.quantity("mass", Dimension::mass);
  const auto air = map.find("air");
  DragDesign by_parts;
  if (air) read_air(*air, by_parts, findings);
  body.drag_per_metre = drag.value_or(0.0);
  if (!by_area) {
    if (map.has_misspelt("drag_area")) return;
    for (const char* const key : {"mass", "air"}) {
      if (!map.has(key)) continue;
      findings.add(findings.position(map.path_of(key)), map.path_of(key),
                   {"", std::string(key) + ": without a drag_area it changes nothing",
                    "How a body slides does not depend on its mass, nor on air that does not hold it back.",
                    "drag_area: 0.25 m^2, drag coefficient x frontal area"});
    }
    return;
  }
  if (drag) {
    findings.add(findings.position(map.path_of("drag_area")), map.path_of("drag_area"),
                 {"", "both drag and drag_area are given", "drag = air density x drag_area / (2 x mass).",
                  "one of the two"});
  }
  by_parts.drag_area = area.value_or(0.0);
  by_parts.mass = mass.value_or(0.0);
  body.drag = by_parts;
  // Of air that there is not the check tells.
  const bool in_reach = by_parts.altitude >= kLowestAltitude && by_parts.altitude <= kHighestAltitude &&
                        by_parts.temperature.value_or(1.0) > 0.0;
  if (by_parts.density || in_reach) body.drag_per_metre = by_parts.drag_per_metre();
}

}  // namespace

namespace {

/// Keys of every body, behind those of its kind.
const std::vector<std::string_view>& keys_of_all() {
  static const std::vector<std::string_view> keys = {"centre_height", "entry_speed", "drag",     "drag_area",
                                                     "mass",          "air",         "head_wind"};
  return keys;
}

/// The keys of a body of some kind, in the order in which messages list them.
std::vector<std::string_view> keys_of_body(const BodyKind& kind) {
  std::vector<std::string_view> keys{"kind"};
  const std::vector<std::string_view> own = keys_of(kind);
  const bool slides = std::holds_alternative<SlidingDesign>(kind);
  if (slides) keys.insert(keys.end(), {"friction_angle", "friction_coefficient", "friction"});
  keys.insert(keys.end(), own.begin(), own.end());
  keys.push_back("centre_height");
  if (!slides) keys.insert(keys.end(), {"friction_coefficient", "friction_angle"});
  keys.insert(keys.end(), keys_of_all().begin() + 1, keys_of_all().end());
  return keys;
}

}  // namespace

const std::vector<std::string_view>& body_keys() {
  static const std::vector<std::string_view> keys = [] {
    std::vector<std::string_view> all{"kind", "friction_angle", "friction_coefficient", "friction"};
    for (const BodyKind& kind : all_kinds()) {
      const std::vector<std::string_view> own = keys_of(kind);
      all.insert(all.end(), own.begin(), own.end());
    }
    all.insert(all.end(), keys_of_all().begin(), keys_of_all().end());
    return all;
  }();
  return keys;
}

std::optional<double> as_friction(const Value& value, Dimension dimension, Findings& findings) {
  const std::string other(other_friction_key(value.key));
  if (other.empty() || !says_the_other_way(*value.node, dimension))
    return as_quantity(value, dimension, findings);
  Issue issue = std::get<Issue>(read_quantity(value.node->scalar, dimension, value.key));
  issue.hint = other + ": " + value.node->scalar + (issue.hint.empty() ? "" : ", or " + issue.hint);
  findings.add(value.node->at, value.key_path, std::move(issue));
  return {};
}

std::optional<Friction> friction_of_angle(double angle) {
  if (!(angle >= 0.0 && angle <= math::atan(kRoughest))) return {};
  // tan(atan(kRoughest)) may lie a rounding above it.
  return Friction::from_coefficient(
      std::min(Friction::from_angle(Angle::from_radians(angle)).coefficient(), kRoughest));
}

BodyDesign read_body(MapReader& top, bool friction_may_follow, Findings& findings) {
  BodyDesign body;
  const std::optional<Value> value = top.need("body", "body: {friction_angle: 17 deg}");
  if (!value) return body;
  MapReader map(*value, "A body", "{friction_angle: 17 deg}", findings);
  std::vector<std::pair<std::string_view, BodyKind>> kinds;
  for (const BodyKind& kind : all_kinds()) kinds.emplace_back(word_of(kind), kind);
  if (const auto word = map.find("kind")) {
    const auto kind = map.choice(*word, kinds);
    if (!kind) return body;
    body.kind = *kind;
  }
  map.expect(keys_of_body(body.kind));
  if (body.slides()) {
    read_sliding(map, friction_may_follow, body, findings);
  } else {
    map.rename(std::visit([](const auto& kind) { return kind.kNoun; }, body.kind));
    read_kind(map, body, findings);
  }
  body.centre_height = map.quantity("centre_height", Dimension::length);
  body.entry_speed = map.quantity("entry_speed", Dimension::speed).value_or(0.0);
  read_drag(map, body, findings);
  body.head_wind = map.quantity("head_wind", Dimension::speed).value_or(0.0);
  map.refuse_unknown_keys();
  return body;
}

}  // namespace glissade::design_file
