#include "glissade/io/workshop_tables.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/parts/bend_hits.hpp"

#include "core/least_rectangle.hpp"
#include "core/millimetres.hpp"
#include "parts/bodies/angle_bar.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace glissade {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string safe = "\"";
  for (const char c : text) {
    if (c == '"') safe += '"';
    safe += c;
  }
  return safe + "\"";
}

/// One line after the other.
class Csv {
 public:
  explicit Csv(std::string_view header) : text_(header) {}

  Csv& row() {
    text_ += '\n';
    first_ = true;
    return *this;
  }
  Csv& operator<<(const std::string& cell) {
    if (!first_) text_ += ',';
    first_ = false;
    text_ += quoted(cell);
    return *this;
  }
  Csv& operator<<(double value) { return *this << exact_text(value + 0.0); }
  Csv& operator<<(std::size_t count) { return *this << std::to_string(count); }
  Csv& operator<<(int number) { return *this << std::to_string(number); }
  [[nodiscard]] std::string text() const { return text_ + '\n'; }

 private:
  std::string text_;
  bool first_ = true;
};

/// To a thousandth of a unit of the sixth decimal: the products of units leave digits that nobody measured.
double clean(double value) {
  constexpr double kPerUnit = 1e9;
  return std::fabs(value) < 1e6 ? std::round(value * kPerUnit) / kPerUnit : value;
}

double mm(double metres) {
  return clean(core::kMillimetres * metres);
}

/// @return "underside_of_deck_plumb_mm"
std::string level_column(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name + "_plumb_mm";
}

double degrees(Angle angle) {
  return clean(angle.degrees());
}

/// Length along the bar, and its section, of a part that is sawn from a tube, an angle or a flat bar; of others nothing.
struct Bar {
  double length = 0.0;  ///< [m]
  double width = 0.0;   ///< [m]
  std::string section;  ///< "tube 60 x 60 x 4 mm"
};

std::string shown(double metres) {
  return rounded_text(core::kMillimetres * metres, 6);
}

Bar bar_of(const ShopPart& part) {
  if (const auto* const angle = std::get_if<AngleBar>(&part.body)) {
    return {parts::stock_length(*angle), angle->height,
            "angle " + shown(angle->height) + " x " + shown(angle->height) + " x " + shown(angle->thickness) +
                " mm"};
  }
  if (part.flat_bar && part.pattern) {
    const PlaneBox box = bounds(part.pattern->region.outline);
    return {box.width(), box.height(),
            "flat bar " + shown(box.height()) + " x " + shown(part.thickness) + " mm"};
  }
  const auto* const prism = std::get_if<Prism>(&part.body);
  if (prism == nullptr || part.pattern || prism->region.cutouts.empty()) return {};
  const PlaneBox box = bounds(prism->region.outline);
  return {prism->depth, std::max(box.width(), box.height()),
          "tube " + shown(box.width()) + " x " + shown(box.height()) + " x " + shown(part.thickness) + " mm"};
}

/// Length, width, length of cut, holes and bends.
void add_sizes(const ShopPart& part, const Bar& bar, Csv& csv) {
  if (part.pattern && !bar.section.empty()) {
    // Sawn and drilled.
    csv << mm(bar.length) << mm(bar.width) << "" << part.pattern->region.holes.size() << "";
    return;
  }
  if (part.pattern) {
    const PlaneRegion& region = part.pattern->region;
    const Vec2 size = core::least_size(region.outline);
    double cut = length(region.outline);
    for (const ArcPath& cutout : region.cutouts) cut += length(cutout);
    for (const Circle& hole : region.holes) cut += length(path_of(hole));
    csv << mm(size.x) << mm(size.y) << mm(cut) << region.holes.size() << bend_hits(*part.pattern);
    return;
  }
  if (bar.section.empty()) {
    csv << ""
        << "";
  } else {
    csv << mm(bar.length) << mm(bar.width);
  }
  csv << ""
      << ""
      << "";
}

/// Rise over run in percent; of what is upright, but for rounding, without bound.
double percent(Angle slope) {
  constexpr double kUpright = 1e-12;  // rounding: of slope angles in a quarter of a turn
  const double run = math::cos(slope.radians());
  const double rise = math::sin(slope.radians());
  if (std::fabs(run) < kUpright) return std::copysign(std::numeric_limits<double>::infinity(), rise);
  return clean(100.0 * rise / run);
}

}  // namespace

std::string cut_list_csv(const Workshop& workshop) {
  Csv csv(
      "number,name,material,thickness_mm,quantity,length_mm,width_mm,cut_length_mm,holes,bends,mass_kg,total_"
      "mass_kg,"
      "centre_of_gravity_x_mm,centre_of_gravity_y_mm,centre_of_gravity_z_mm,bought_in,section");
  for (const ShopPart& part : workshop.parts) {
    csv.row() << part.number << part.name << part.material << mm(part.thickness) << part.quantity();
    const Bar bar = bar_of(part);
    add_sizes(part, bar, csv);
    csv << clean(part.mass) << clean(part.mass * static_cast<double>(part.quantity()))
        << mm(part.centre_of_gravity.x) << mm(part.centre_of_gravity.y) << mm(part.centre_of_gravity.z)
        << (part.bought_in ? "yes" : "no") << bar.section;
  }
  return csv.text();
}

std::string bought_in_csv(const Workshop& workshop) {
  Csv csv("name,standard,quantity,where");
  for (const BoughtInItem& item : workshop.items) {
    csv.row() << item.name << item.standard << item.quantity << item.where;
  }
  return csv.text();
}

std::string nests_csv(const Workshop& workshop, const std::vector<NestedSheet>& sheets) {
  Csv csv(
      "sheet,material,thickness_mm,length_mm,width_mm,margin_mm,spacing_mm,pieces,parts_area_m2,"
      "utilisation_percent,parts");
  for (const NestedSheet& sheet : sheets) {
    std::map<int, std::size_t> counts;
    for (const NestedPiece& piece : sheet.pieces) ++counts[workshop.parts[piece.part].number];
    std::string parts;
    for (const auto& [number, count] : counts) {
      parts += (parts.empty() ? "" : "; ") + std::to_string(count) + " x no. " + std::to_string(number);
    }
    csv.row() << sheet.name << sheet.material << mm(sheet.thickness) << mm(sheet.stock.width)
              << mm(sheet.stock.height) << mm(sheet.stock.margin) << mm(sheet.stock.spacing)
              << sheet.pieces.size() << clean(sheet.utilisation * sheet.stock.width * sheet.stock.height)
              << clean(100.0 * sheet.utilisation) << parts;
  }
  return csv.text();
}

std::string bend_schedule_csv(const Workshop& workshop) {
  Csv csv("part,hit,distance_mm,length_mm,angle_deg,sum_deg,radius_mm,chord_error_mm");
  for (const BendStep& step : workshop.bends) {
    csv.row() << step.part << step.hit << mm(step.distance) << mm(step.length) << degrees(step.angle)
              << degrees(step.sum) << mm(step.radius) << mm(step.chord_error);
  }
  return csv.text();
}

std::string setting_out_csv(const Workshop& workshop) {
  std::string header =
      "what,arc_length_mm,run_mm,z_mm,site_x_m,site_y_m,site_z_m,slope_deg,slope_percent,radius_mm,ordinate_"
      "mm";
  for (const std::string& name : workshop.offset_names) header += "," + quoted(level_column(name));
  Csv csv(header);
  for (const SettingOutPoint& point : workshop.setting_out) {
    csv.row() << point.what << mm(point.arc_length) << mm(point.x) << mm(point.z) << clean(point.site.x)
              << clean(point.site.y) << clean(point.site.z);
    if (point.beyond_track)
      csv << ""
          << ""
          << ""
          << "";
    else
      csv << degrees(point.slope_angle) << percent(point.slope_angle) << mm(point.radius)
          << mm(point.ordinate);
    for (const std::optional<double>& level : point.offsets)
      csv << (level ? exact_text(mm(*level) + 0.0) : "");
  }
  return csv.text();
}

std::string shop_checks_csv(const Workshop& workshop) {
  Csv csv("rule,verdict,value,bound,where,source,sentence,certainty");
  for (const ShopCheck& check : workshop.checks) {
    csv.row() << check.rule << std::string(to_text(check.verdict)) << check.value << check.bound
              << check.where << check.source << check.sentence << check.certainty;
  }
  return csv.text();
}

}  // namespace glissade
