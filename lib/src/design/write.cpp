#include "glissade/design/write.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/task/limit_catalogue.hpp"

#include "design/read_in_run.hpp"
#include "design/read_rules.hpp"
#include "design/write_body.hpp"
#include "design/write_fabrication.hpp"
#include "design/write_rules.hpp"
#include "design/write_stream.hpp"
#include "design/written_text.hpp"

#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <variant>

namespace glissade {

using namespace design_file;

namespace {

std::string points(const std::vector<Vec2>& at) {
  return list_of(at, point);
}

std::string range(const Range& range, Dimension dimension) {
  Group group;
  group.add("lowest", range.lowest, dimension);
  group.add("highest", range.highest, dimension);
  return group.inlined();
}

std::string track(const TrackDesign& design) {
  Group start;
  start.add("x", design.start.x, Dimension::length);
  start.add("y", design.start.y, Dimension::length);
  start.add("z", design.start.z, Dimension::length);
  Group group;
  if (design.edge) {
    Group edge;
    edge.add("x", design.edge->x, Dimension::length);
    edge.add("y", design.edge->y, Dimension::length);
    edge.add("z", design.edge->z, Dimension::length);
    group.add("edge", edge.inlined());
  } else {
    group.add("start", start.inlined());
  }
  group.add_unless(0.0, "azimuth", design.azimuth.radians(), Dimension::angle);
  if (design.edge && design.finish_given) {
    const Vec3& at = design.start;
    const bool free = design.free_start;
    Group above;
    above.add("x", free && !fixes_run(design.free_finish) ? "free" : length(at.x));
    if (!free || fixes_run(design.free_finish)) above.add("y", at.y, Dimension::length);
    above.add("z", free && !fixes_drop(design.free_finish) ? "free" : length(at.z));
    group.add("start", above.inlined());
    return group.lines();
  }
  if (!design.finish_given) return group.lines();
  const auto free = [](const Range& within) {
    return within.limited() ? range(within, Dimension::length) : std::string("free");
  };
  const bool anywhere = design.free_finish == FinishKind::anywhere;
  Group finish;
  finish.add("x", fixes_run(design.free_finish) ? length(design.finish.x) : free(design.free_range));
  finish.add("y", design.finish.y, Dimension::length);
  finish.add("z", fixes_drop(design.free_finish) ? length(design.finish.z)
                                                 : free(anywhere ? design.free_height : design.free_range));
  group.add("finish", finish.inlined());
  return group.lines();
}

/// A curvature by its radius where that reads as the very same.
void add_bend(Group& group, const std::string& end, double curvature) {
  const double radius = 1.0 / curvature;
  if (std::isfinite(radius) && 1.0 / radius == curvature) {
    group.add(end + "radius", radius, Dimension::length);
  } else {
    group.add(end + "curvature", curvature, Dimension::per_length);
  }
}

std::string segment(const SegmentDesign& design) {
  Group group;
  group.add("length", design.length, Dimension::length);
  if (design.to_point) group.add("to_point", point(*design.to_point));
  if (design.to_slope_angle) {
    group.add("to_slope_angle", design.to_slope_angle->radians(), Dimension::angle);
  }
  if (design.bend == SegmentBend::cubic) {
    group.add("bend", "cubic");
    if (design.entry_curvature != 0.0) add_bend(group, "entry_", design.entry_curvature);
    if (design.exit_curvature != 0.0) add_bend(group, "exit_", design.exit_curvature);
  } else if (design.entry_curvature != design.exit_curvature) {
    group.add("entry_curvature", design.entry_curvature, Dimension::per_length);
    group.add("exit_curvature", design.exit_curvature, Dimension::per_length);
  } else if (design.entry_curvature != 0.0) {
    add_bend(group, "", design.entry_curvature);
  }
  return group.inlined();
}

void add_in_run(const InRunDesign& design, Group& group) {
  group.add("gamma", design.gamma.radians(), Dimension::angle);
  group.add("alpha", design.alpha.radians(), Dimension::angle);
  group.add("r1", design.r1, Dimension::length);
  group.add("t", design.t, Dimension::length);
  group.add("e1", design.e1, Dimension::length);
  group.add("e2", design.e2, Dimension::length);
  group.add("es", design.es, Dimension::length);
  if (design.counts_to_edge) group.add("e_counts_to", "edge");
  group.add("transition", std::string(design_file::word(design.transition)));
  if (design.transition == InRunTransition::two_radii) {
    group.add("first_radius", design.first_radius, Dimension::length);
  }
}

std::string hill(const HillDesign& design) {
  Group group;
  group.add("size", design.size, Dimension::length);
  group.add("construction_point", design.construction_point, Dimension::length);
  group.add("table_height", design.table_height, Dimension::length);
  group.add("height", design.height, Dimension::length);
  group.add("design_speed", design.design_speed, Dimension::speed);
  return group.lines();
}

std::string condition(const ConditionDesign& design) {
  Group group;
  if (design.friction) group.add("friction_coefficient", exact_text(design.friction->coefficient()));
  group.add("drag", design.drag_per_metre, Dimension::per_length);
  group.add("drag_area", design.drag_area, Dimension::area);
  group.add("head_wind", design.head_wind, Dimension::speed);
  return group.inlined();
}

std::string gates(const GatesDesign& design) {
  Group group;
  if (design.count) group.add("count", std::to_string(*design.count));
  group.add("step", design.step, Dimension::length);
  group.add("vertical_step", design.vertical_step, Dimension::length);
  group.add("start_area", design.start_area, Dimension::length);
  group.add("measuring_place", design.measuring_place, Dimension::length);
  if (design.slow) group.add("slow", condition(*design.slow));
  if (design.fast) group.add("fast", condition(*design.fast));
  return group.lines();
}

std::string centerline(const CenterlineDesign& design, const std::filesystem::path& file) {
  const auto unit = [](LengthUnit of) { return std::string(unit_symbol(of)); };
  Group group;
  group.add("kind", std::string(word(design.kind)));
  group.add("p", design.constant_speed_p, Dimension::specific_energy);
  if (design.kind == CenterlineKind::segments) {
    group.add("entry_slope_angle", design.entry_slope_angle.radians(), Dimension::angle);
    group.add("segments", list_of(design.segments, segment));
  }
  if (design.kind == CenterlineKind::in_run) add_in_run(design.in_run, group);
  if (design.kind == CenterlineKind::points) {
    const std::filesystem::path beside = design.points_file.lexically_relative(file.parent_path());
    group.add("file", in_quotes((beside.empty() ? design.points_file : beside).generic_string()));
    std::vector<std::string> columns = {design.points_distance_column, design.points_height_column};
    if (!design.points_curvature_column.empty()) {
      columns.insert(columns.end(), {design.points_slope_angle_column, design.points_curvature_column});
    }
    group.add("columns", list_of(columns, in_quotes));
    group.add("unit", unit(design.points_unit));
    group.add("max_deviation", design.points_max_deviation, Dimension::length);
  }
  return group.lines();
}

/// A line of the half-plane: the points that it was given by, or else two far enough apart for its direction to survive their
/// rounding.
std::string half_plane(const HalfPlane& plane) {
  const double away = 1.0 + std::fabs(plane.point.x) + std::fabs(plane.point.y);
  const double far = std::ldexp(1.0, std::ilogb(away) + 1);
  const Vec2 along{plane.forbidden.y * far, -plane.forbidden.x * far};
  const bool upright = plane.forbidden.y == 0.0;
  const bool positive = upright ? plane.forbidden.x > 0.0 : plane.forbidden.y > 0.0;
  Group group;
  group.add("line", points({plane.point, plane.second.value_or(plane.point + along)}));
  group.add("stay", upright ? (positive ? "left" : "right") : (positive ? "below" : "above"));
  group.add_unless(0.0, "clearance", plane.clearance, Dimension::length);
  return group.inlined();
}

std::string keep_out(const KeepOut& area) {
  Group group;
  group.add("outline", points(area.outline));
  group.add_unless(0.0, "clearance", area.clearance, Dimension::length);
  if (area.passage != Passage::either) group.add("pass", area.passage == Passage::above ? "above" : "below");
  return group.inlined();
}

std::string profile(const Profile& profile) {
  Group group;
  group.add("line", points(profile.line));
  group.add_unless(0.0, "clearance", profile.clearance, Dimension::length);
  return group.inlined();
}

void add_number(const LimitEntry& entry, const Limits& limits, Group& group) {
  const bool has_start = entry.id == LimitId::speed && limits.lowest_speed_from != 0.0;
  if (entry.range != nullptr && ((limits.*entry.range).limited() || has_start)) {
    const Range& bounds = limits.*entry.range;
    Group ends;
    ends.add("lowest", bounds.lowest, entry.dimension);
    ends.add("highest", bounds.highest, entry.dimension);
    if (entry.id == LimitId::speed) {
      ends.add_unless(0.0, "lowest_from", limits.lowest_speed_from, Dimension::length);
    }
    const bool fixed = bounds.is_fixed() && entry.fixable;
    group.add(entry.key, fixed ? written_quantity(*bounds.lowest, entry.dimension) : ends.inlined());
  }
  if (entry.value != nullptr && limits.*entry.value != Limits{}.*entry.value) {
    const std::optional<double>& value = limits.*entry.value;
    group.add(entry.key, value ? written_quantity(*value, entry.dimension) : "none");
  }
  if (entry.length != nullptr) group.add_unless(0.0, entry.key, limits.*entry.length, entry.dimension);
  if (entry.id == LimitId::concave && limits.concave) group.add(entry.key, "true");
}

std::string objective(const Objective& objective) {
  Group group;
  switch (objective.kind) {
    case ObjectiveKind::travel_time:
      group.add("kind", "travel_time");
      break;
    case ObjectiveKind::exit_speed:
      group.add("kind", "exit_speed");
      break;
    case ObjectiveKind::least_wear:
      group.add("kind", "least_wear");
      break;
    case ObjectiveKind::least_peak_wear:
      group.add("kind", "least_peak_wear");
      break;
    case ObjectiveKind::even_speed:
      group.add("kind", "even_speed");
      break;
    case ObjectiveKind::least_drop:
      group.add("kind", "least_drop");
      break;
    case ObjectiveKind::least_length:
      group.add("kind", "least_length");
      break;
    case ObjectiveKind::least_load:
      group.add("kind", "least_load");
      break;
    case ObjectiveKind::least_curvature_rate:
      group.add("kind", "least_curvature_rate");
      break;
    case ObjectiveKind::blend:
      group.add("kind", "blend");
      group.add("exit_speed_weight", objective.exit_speed_weight, Dimension::time_per_speed);
      break;
  }
  if (objective.worst_case) group.add("worst_case", "true");
  return group.inlined();
}

std::string limits(const Limits& design, const Objective& aim) {
  Group group;
  for (const LimitEntry& entry : limit_catalogue()) add_number(entry, design, group);
  if (design.match_belt) {
    Group match;
    match.add("speed", design.match_belt->speed, Dimension::speed);
    match.add_unless(0.0, "direction", design.match_belt->direction.radians(), Dimension::angle);
    match.add("within", exact_text(design.match_belt->within));
    group.add("match_belt", match.inlined());
  }
  if (design.clearances_from == ClearancesFrom::centerline) group.add("clearances_from", "centerline");
  group.add_unless(0.0, "headroom", design.envelope.headroom, Dimension::length);
  if (!design.half_planes.empty()) group.add("half_planes", list_of(design.half_planes, half_plane));
  if (!design.keep_outs.empty()) group.add("keep_outs", list_of(design.keep_outs, keep_out));
  if (!design.stay_above.empty()) group.add("stay_above", list_of(design.stay_above, profile));
  if (!design.stay_below.empty()) group.add("stay_below", list_of(design.stay_below, profile));
  if (!design.waypoints.empty()) group.add("waypoints", points(design.waypoints));
  if (aim != Objective{}) group.add("objective", objective(aim));
  return group.lines();
}

/// Writes each measure of a kind under its key.
class MeasureWriter {
 public:
  explicit MeasureWriter(Group& group) : group_(group) {}

  void width(const char* key, const WidthLaw& law, const char* example) {
    if (law.knots().size() == 1) return length(key, law.narrowest(), example);
    group_.add(key, list_of(law.knots(), [](const WidthAt& knot) {
                 Group place;
                 place.add("at", knot.at, Dimension::length);
                 place.add("width", knot.width, Dimension::length);
                 return place.inlined();
               }));
  }
  void length(const char* key, double value, const char*) { group_.add(key, value, Dimension::length); }
  void optional_length(const char* key, double value) {
    group_.add_unless(0.0, key, value, Dimension::length);
  }
  void angle(const char* key, Angle value, const char*) {
    group_.add(key, value.radians(), Dimension::angle);
  }
  void corners(const char* key, const std::vector<Vec2>& values, const char*) {
    group_.add(key, points(values));
  }
  void misnomer(const char*, const char*) const {}

 private:
  Group& group_;
};

std::string cross_section(const CrossSectionDesign& design) {
  Group group;
  group.add("kind", std::string(section::kind(design)));
  section::visit_measures(design, MeasureWriter(group));
  return group.lines();
}

std::string probe(const ProbeDesign& design) {
  Group group;
  if (!design.name.empty()) group.add("name", in_quotes(design.name));
  switch (design.origin) {
    case ProbeOrigin::start:
      group.add("from_start", design.at, Dimension::length);
      break;
    case ProbeOrigin::finish:
      group.add("from_finish", design.at, Dimension::length);
      break;
    case ProbeOrigin::x:
      group.add("x", design.at, Dimension::length);
      break;
  }
  return group.inlined();
}

std::string mesh(const MeshDesign& design) {
  Group group;
  group.add("tolerance", design.tolerance, Dimension::length);
  if (design.largest_kink) group.add("largest_kink", design.largest_kink->radians(), Dimension::angle);
  return group.lines();
}

}  // namespace

std::string design_text(const Design& design) {
  std::string text = "glissade: 1\n";
  if (!design.name.empty()) text += "name: " + in_quotes(design.name) + "\n";
  text += "track:" + track(design.track);
  text += "body:" + written_body(design.body);
  if (design.stream) text += "stream:" + written_stream(*design.stream);
  if (design.feed) text += "feed:" + written_feed(*design.feed);
  if (design.hood) text += "hood:" + written_hood(*design.hood);
  if (design.discharge) text += "discharge:" + written_discharge(*design.discharge);
  if (!design.materials.empty())
    text += "materials: " + list_of(design.materials, written_bulk_material) + "\n";
  if (design.gravity != kDefaultGravity) {
    text += "gravity: " + written_quantity(design.gravity, Dimension::acceleration) + "\n";
  }
  text += "centerline:" + centerline(design.centerline, design.file);
  if (design.limits) text += "limits:" + limits(*design.limits, design.objective);
  if (!design.probes.empty()) text += "probes: " + list_of(design.probes, probe) + "\n";
  if (design.hill != HillDesign{}) text += "hill:" + hill(design.hill);
  if (design.gates) text += "gates:" + gates(*design.gates);
  if (are_given(design.rules)) text += "rules:" + written_rules(design.rules).lines();
  if (design.cross_section) text += "cross_section:" + cross_section(*design.cross_section);
  if (design.fabrication) text += "fabrication:" + written_fabrication(*design.fabrication);
  text += "mesh:" + mesh(design.mesh);
  return text + "export:" + written_exports(design.exports);
}

Design moved_to(Design design, const std::filesystem::path& file) {
  const auto whole = [](const std::filesystem::path& path) {
    return std::filesystem::absolute(path).lexically_normal();
  };
  const std::filesystem::path from = design.file.parent_path();
  const std::filesystem::path there = whole(file);
  const auto move = [&](RulesDesign& rules) {
    if (!rules.sets) return;
    for (std::string& set : *rules.sets) {
      const bool stays = !is_rule_file(set) || std::filesystem::path(set).is_absolute();
      if (!stays) set = whole(from / set).lexically_relative(there.parent_path()).generic_string();
    }
  };
  move(design.rules);
  if (design.fabrication) move(design.fabrication->rules);
  std::filesystem::path& points = design.centerline.points_file;
  if (!points.empty()) points = whole(points);
  design.file = there;
  return design;
}

}  // namespace glissade
