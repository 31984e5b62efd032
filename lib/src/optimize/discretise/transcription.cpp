// A mesh cut into panels and stations, and the vectors over which derivatives are told.

#include "optimize/discretise/transcription.hpp"

#include "glissade/core/math.hpp"

#include "optimize/algebra/quadrature.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

// Panels grow at most by this factor in r, so that six nodes resolve the start from rest.
constexpr double kPanelGrowth = 2.5;  // taste

// And by at most this share of the whole track's r, so that a long first piece is resolved too.
constexpr double kLargestPanel = 1.0 / 14.0;  // taste

}  // namespace

double count_pieces(const Vector& knots, double sigma) {
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, sigma);
  const auto i = static_cast<std::size_t>(above - knots.begin()) - 1;
  return static_cast<double>(i) + std::clamp((sigma - knots[i]) / (knots[i + 1] - knots[i]), 0.0, 1.0);
}

Transcription::Transcription(const Mesh& mesh) : mesh_(mesh) {
  layout_.knots = mesh.knots.size();
  if (!mesh.change_knots.empty()) {
    fixed_share_ = mesh.change_knots.back().sigma;
    const auto last = std::find(mesh.knots.begin(), mesh.knots.end(), fixed_share_);
    fixed_pieces_ = static_cast<std::size_t>(last - mesh.knots.begin());
  }
  add_spans();
  if (mesh.lead_in > 0.0) add_straight(Part::lead_in);
  add_fine_knots();
  add_core();
  if (mesh.lead_out > 0.0) add_straight(Part::lead_out);

  add_sections();
  station_turn_.assign(stations_.size(), 0.0);
  station_angle_.assign(stations_.size(), 0.0);
  local_dzeta_.resize(stations_.size());
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (stations_[i].watched) watched_.push_back(i);
    local_dzeta_[i] = local_dzeta(stations_[i]);
  }
  held_from_ = station_held_from();
  if (!fine_.empty()) add_fine_to_stations();
}

std::optional<std::size_t> Transcription::station_held_from() const {
  const double length = mesh_.core_length;
  const double from = mesh_.held_from;
  const bool is_on_track = from > 0.0 && from < stations_.back().arc_length(length);
  if (!is_on_track || !mesh_.borders.empty()) return std::nullopt;
  std::size_t nearest = watched_.front();
  for (const std::size_t station : watched_) {
    const double away = std::fabs(stations_[station].arc_length(length) - from);
    if (away < std::fabs(stations_[nearest].arc_length(length) - from)) nearest = station;
  }
  return nearest;
}

void Transcription::add_spans() {
  layout_.spans = 1 + mesh_.borders.size();
  span_begins_.push_back(0.0);
  span_begins_.insert(span_begins_.end(), mesh_.borders.begin(), mesh_.borders.end());
  span_begins_.push_back(1.0);
  span_of_.assign(mesh_.knots.size() - 1, 0);
  if (mesh_.borders.empty()) return;
  // What lies between the two knots of a border is nothing; it goes with what lies before it.
  std::size_t span = 0;
  for (std::size_t piece = 0; piece < span_of_.size(); ++piece) {
    while (mesh_.knots[piece + 1] > span_begins_[span + 1]) ++span;
    span_of_[piece] = span;
  }
}

void Transcription::add_fine_to_stations() {
  // Stations come in the order of their places, so that the fine knots before each need not be looked for.
  std::size_t knot = 0;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const double sigma = stations_[i].sigma;
    while (knot + 2 < own_sigma_.size() && own_sigma_[knot + 1] <= sigma) ++knot;
    station_turn_[i] = own_turn(sigma, knot);
    station_angle_[i] =
        own_angle_[knot] - 0.5 * (sigma - own_sigma_[knot]) * (own_turn_[knot] + station_turn_[i]);
  }
}

void Transcription::add_fine_knots() {
  if (mesh_.fine.empty()) return;
  std::size_t next = 0;
  for (std::size_t piece = 0; piece + 1 < mesh_.knots.size(); ++piece) {
    const double from = mesh_.knots[piece];
    const double to = mesh_.knots[piece + 1];
    own_sigma_.push_back(from);
    own_turn_.push_back(0.0);
    for (; next < mesh_.fine.size() && mesh_.fine[next] < to; ++next) {
      const double sigma = mesh_.fine[next];
      fine_.push_back({sigma, piece, (sigma - from) / (to - from), mesh_.fine_turns[next]});
      own_sigma_.push_back(sigma);
      own_turn_.push_back(mesh_.fine_turns[next]);
    }
  }
  own_sigma_.push_back(mesh_.knots.back());
  own_turn_.push_back(0.0);
  own_angle_.assign(own_sigma_.size(), 0.0);
  for (std::size_t i = 0; i + 1 < own_sigma_.size(); ++i) {
    const double width = own_sigma_[i + 1] - own_sigma_[i];
    own_angle_[i + 1] = own_angle_[i] - 0.5 * width * (own_turn_[i] + own_turn_[i + 1]);
  }
}

double Transcription::own_turn(double sigma) const {
  if (own_sigma_.empty()) return 0.0;
  const auto above = std::upper_bound(own_sigma_.begin() + 1, own_sigma_.end() - 1, sigma);
  return own_turn(sigma, static_cast<std::size_t>(above - own_sigma_.begin()) - 1);
}

double Transcription::own_turn(double sigma, std::size_t knot) const {
  const double share = (sigma - own_sigma_[knot]) / (own_sigma_[knot + 1] - own_sigma_[knot]);
  return own_turn_[knot] + share * (own_turn_[knot + 1] - own_turn_[knot]);
}

double Transcription::own_angle(double sigma) const {
  if (own_sigma_.empty()) return 0.0;
  const auto above = std::upper_bound(own_sigma_.begin() + 1, own_sigma_.end() - 1, sigma);
  const auto i = static_cast<std::size_t>(above - own_sigma_.begin()) - 1;
  return own_angle_[i] - 0.5 * (sigma - own_sigma_[i]) * (own_turn_[i] + own_turn(sigma));
}

double Transcription::fine_turn(const Vector& z, std::size_t fine_knot) const {
  const FineKnot& fine = fine_[fine_knot];
  return (1.0 - fine.share) * z[layout_.turn(fine.piece)] + fine.share * z[layout_.turn(fine.piece + 1)] +
         fine.turn;
}

void Transcription::add_sections() {
  if (mesh_.lead_in > 0.0) sections_.push_back({Part::lead_in, 0});
  for (std::size_t piece = 0; piece + 1 < mesh_.knots.size(); ++piece) {
    section_of_piece_.push_back(sections_.size());
    if (mesh_.knots[piece + 1] > mesh_.knots[piece])
      sections_.push_back({Part::core, piece, span_of_[piece]});
  }
  if (mesh_.lead_out > 0.0) sections_.push_back({Part::lead_out, mesh_.knots.size() - 2, layout_.spans - 1});
  for (Station& station : stations_) station.section = section_of(station.part, station.piece);
  for (Panel& panel : panels_) panel.section = stations_[panel.first].section;
  dzeta_starts_ = Matrix(sections_.size(), layout_.size());
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    double* row = dzeta_starts_.row(s);
    row[layout_.angle()] = 1.0;
    // The straight behind the core begins where its last piece ends.
    const std::size_t knots = sections_[s].piece + (sections_[s].part == Part::lead_out ? 1 : 0);
    for (std::size_t p = 0; p < knots; ++p) {
      const double width = mesh_.knots[p + 1] - mesh_.knots[p];
      row[layout_.turn(p)] -= 0.5 * width;
      row[layout_.turn(p + 1)] -= 0.5 * width;
    }
  }
}

std::size_t Transcription::section_of(Part part, std::size_t piece) const {
  switch (part) {
    case Part::lead_in:
      return 0;
    case Part::core:
      return section_of_piece_[piece];
    case Part::lead_out:
      return sections_.size() - 1;
  }
  return 0;
}

LocalRow Transcription::local_dzeta(const Station& station) const {
  LocalRow row{};
  row[kZeta] = 1.0;
  if (station.part != Part::core) return row;
  const double width = mesh_.knots[station.piece + 1] - mesh_.knots[station.piece];
  row[kFirst] = -width * station.share * (1.0 - 0.5 * station.share);
  row[kSecond] = -width * 0.5 * station.share * station.share;
  return row;
}

void Transcription::turning_row(const Station& station, double* row) const {
  std::fill_n(row, layout_.size(), 0.0);
  expand(local_dzeta(station), section_of(station.part, station.piece), nullptr, row);
}

void Transcription::expand(const LocalRow& row, std::size_t section, const double* own, double* out) const {
  const std::size_t n = layout_.size();
  if (own != nullptr && row[kOwn] != 0.0) add_scaled(out, row[kOwn], own, n);
  const std::size_t piece = sections_[section].piece;
  // No angle knows of the knots behind it.
  if (row[kZeta] != 0.0) add_scaled(out, row[kZeta], dzeta_starts_.row(section), layout_.turn(piece + 2));
  out[layout_.turn(piece)] += row[kFirst];
  out[layout_.turn(piece + 1)] += row[kSecond];
  out[layout_.length(sections_[section].span)] += row[kLength];
}

void Transcription::add_dzeta(std::size_t station, double factor, double* out) const {
  const LocalRow& row = local_dzeta_[station];
  const std::size_t section = stations_[station].section;
  const std::size_t piece = sections_[section].piece;
  add_scaled(out, factor, dzeta_starts_.row(section), layout_.turn(piece + 2));
  out[layout_.turn(piece)] += factor * row[kFirst];
  out[layout_.turn(piece + 1)] += factor * row[kSecond];
}

void Transcription::add(const Derivatives& derivatives, std::size_t station, double factor,
                        double* out) const {
  LocalRow row = derivatives.local[station];
  for (double& entry : row) entry *= factor;
  const std::size_t section = stations_[station].section;
  expand(row, section, derivatives.starts.row(section), out);
}

Derivatives Transcription::no_derivatives() const {
  return {std::vector<LocalRow>(stations_.size(), LocalRow{}), Matrix(sections_.size(), layout_.size())};
}

bool Transcription::begins_section(std::size_t panel) const {
  return panel == 0 || panels_[panel - 1].section != panels_[panel].section;
}

void Transcription::carry_over(std::size_t panel, Derivatives& derivatives) const {
  if (panel == 0 || !begins_section(panel)) return;
  add(derivatives, start_station(panel), 1.0, derivatives.starts.row(panels_[panel].section));
}

LocalRow Transcription::at_start(std::size_t panel, const Derivatives& derivatives) const {
  if (!begins_section(panel)) return derivatives.local[start_station(panel)];
  LocalRow row{};
  row[kOwn] = 1.0;
  return row;
}

LocalRow Transcription::dzeta_at_start(std::size_t panel) const {
  if (!begins_section(panel)) return local_dzeta_[start_station(panel)];
  LocalRow row{};
  row[kZeta] = 1.0;
  return row;
}

Vector Transcription::section_angles(const Vector& z) const {
  Vector angles;
  angles.reserve(sections_.size());
  double angle = z[layout_.angle()];
  for (const Section& section : sections_) {
    angles.push_back(angle);
    if (section.part != Part::core) continue;
    const double width = mesh_.knots[section.piece + 1] - mesh_.knots[section.piece];
    angle -= 0.5 * width * (z[layout_.turn(section.piece)] + z[layout_.turn(section.piece + 1)]);
  }
  return angles;
}

double Transcription::angle_at(const Vector& z, const Vector& section_angles, std::size_t station) const {
  const LocalRow& row = local_dzeta_[station];
  const std::size_t section = stations_[station].section;
  const std::size_t piece = sections_[section].piece;
  return section_angles[section] + row[kFirst] * z[layout_.turn(piece)] +
         row[kSecond] * z[layout_.turn(piece + 1)] + station_angle_[station];
}

double Transcription::core_length(const Vector& z) const {
  double length = fixed_share_ * mesh_.core_length;
  for (std::size_t span = 0; span < layout_.spans; ++span)
    length += core_by_length(span) * z[layout_.length(span)];
  return length;
}

void Transcription::add_core_length(double factor, double* out) const {
  for (std::size_t span = 0; span < layout_.spans; ++span)
    out[layout_.length(span)] += factor * core_by_length(span);
}

double Transcription::arc_length(const Vector& z, const Station& station) const {
  double length = station.fixed_length;
  for (std::size_t span = 0; span < station.span; ++span)
    length += core_by_length(span) * z[layout_.length(span)];
  return length + station.by_length * z[layout_.length(station.span)];
}

double Transcription::arc_length(const Vector& z, double sigma) const {
  const double fixed = std::min(sigma, fixed_share_);
  double length = mesh_.lead_in + fixed * mesh_.core_length;
  std::size_t span = 0;
  for (; span + 1 < layout_.spans && sigma > span_begins_[span + 1]; ++span)
    length += core_by_length(span) * z[layout_.length(span)];
  const double from = span == 0 ? fixed : span_begins_[span];
  return length + (sigma - from) * z[layout_.length(span)];
}

double Transcription::sigma_at(const Vector& z, double arc_length) const {
  const double along = arc_length - mesh_.lead_in;
  const double fixed = fixed_share_ * mesh_.core_length;
  if (along < fixed) return along / mesh_.core_length;
  double rest = along - fixed;
  std::size_t span = 0;
  for (; span + 1 < layout_.spans; ++span) {
    const double whole = core_by_length(span) * z[layout_.length(span)];
    if (rest <= whole) break;
    rest -= whole;
  }
  return (span == 0 ? fixed_share_ : span_begins_[span]) + rest / z[layout_.length(span)];
}

std::size_t Transcription::zone_at(double arc_length) const {
  const auto above = std::upper_bound(mesh_.changes.begin(), mesh_.changes.end(), arc_length);
  return static_cast<std::size_t>(above - mesh_.changes.begin());
}

void Transcription::add_core() {
  Vector breaks = mesh_.extra_breaks;
  breaks.insert(breaks.end(), mesh_.knots.begin(), mesh_.knots.end());
  breaks.insert(breaks.end(), mesh_.fine.begin(), mesh_.fine.end());
  // Next to another one it is that.
  constexpr double kNext = 1e-7;  // taste
  const double held = (mesh_.held_from - mesh_.lead_in) / mesh_.core_length;
  const bool is_new = std::none_of(breaks.begin(), breaks.end(),
                                   [&](double sigma) { return std::fabs(sigma - held) < kNext; });
  if (is_new && held > 0.0 && held < 1.0) breaks.push_back(held);
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  stations_.reserve(stations_.size() + (kNodes + 1) * (breaks.size() + 1));
  panels_.reserve(panels_.size() + breaks.size() + 1);
  Stretch stretch;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    stretch.from = breaks[i];
    stretch.to = breaks[i + 1];
    while (stretch.from >= mesh_.knots[stretch.piece + 1]) ++stretch.piece;
    // A panel without length, for what curvature is behind a border.
    if (std::binary_search(mesh_.borders.begin(), mesh_.borders.end(), stretch.from)) {
      Stretch behind = stretch;
      behind.to = behind.from;
      add_panels(behind);
    }
    add_panels(stretch);
  }
}

// The straight before the core lies still; of the one behind it the ends move with the core, the changes of friction
// do not.
void Transcription::add_straight(Part part) {
  const bool before = part == Part::lead_in;
  const double begin = before ? 0.0 : mesh_.lead_in + mesh_.core_length;
  const double whole = before ? mesh_.lead_in : mesh_.lead_out;
  const double end_fixed = before ? 0.0 : mesh_.lead_in + fixed_share_ * mesh_.core_length;
  const double end_by_length = before ? 0.0 : core_by_length(layout_.spans - 1);
  Stretch stretch;
  stretch.part = part;
  stretch.piece = before ? 0 : mesh_.knots.size() - 2;
  stretch.fixed[1] = end_fixed;
  stretch.by_length[1] = end_by_length;
  const auto go_on_to = [&](double to, double fixed, double by_length) {
    stretch.from = stretch.to;
    stretch.fixed[0] = stretch.fixed[1];
    stretch.by_length[0] = stretch.by_length[1];
    stretch.to = to;
    stretch.fixed[1] = fixed;
    stretch.by_length[1] = by_length;
    add_panels(stretch);
  };
  Vector places = mesh_.changes;
  places.insert(std::upper_bound(places.begin(), places.end(), mesh_.held_from), mesh_.held_from);
  for (const double place : places) {
    const double along = place - begin;
    if (along > stretch.to && along < whole) go_on_to(along, place, 0.0);
  }
  go_on_to(whole, end_fixed + whole, end_by_length);
}

void Transcription::add_station(double at, const Stretch& stretch, std::size_t zone) {
  Station station;
  station.part = stretch.part;
  station.piece = stretch.piece;
  station.zone = zone;
  if (stretch.part == Part::core) {
    const double from = mesh_.knots[stretch.piece];
    const double to = mesh_.knots[stretch.piece + 1];
    const bool stretches = this->stretches(stretch.piece);
    station.span = span_of_[stretch.piece];
    station.before = span_begins_[station.span];
    station.fixed_length = mesh_.lead_in + (stretches ? fixed_share_ : at) * mesh_.core_length;
    station.by_length = stretches ? at - (station.span == 0 ? fixed_share_ : station.before) : 0.0;
    station.sigma = at;
    station.share = at == to ? 1.0 : (at - from) / (to - from);
    stations_.push_back(station);
    return;
  }
  const double share = (at - stretch.from) / (stretch.to - stretch.from);
  station.fixed_length = stretch.by_length[0] == stretch.by_length[1]
                             ? stretch.fixed[0] + (at - stretch.from)
                             : stretch.fixed[0] + share * (stretch.fixed[1] - stretch.fixed[0]);
  station.by_length = stretch.by_length[0] + share * (stretch.by_length[1] - stretch.by_length[0]);
  if (stretch.part == Part::lead_out) {
    station.span = layout_.spans - 1;
    station.before = span_begins_[station.span];
    station.sigma = 1.0;
    station.share = 1.0;
  }
  stations_.push_back(station);
}

Transcription::Panel Transcription::panel_of(const Stretch& stretch) const {
  Panel panel;
  panel.part = stretch.part;
  const double middle = 0.5 * (stretch.from + stretch.to);
  double before = 0.0;
  if (stretch.part == Part::core) {
    before = mesh_.lead_in;
    panel.span = span_of_[stretch.piece];
    panel.zone = zone_at(mesh_.lead_in + middle * mesh_.core_length);
    if (stretches(stretch.piece)) return panel;
    panel.fixed_scale = mesh_.core_length;
    panel.by_length = 0.0;
    return panel;
  }
  if (stretch.part == Part::lead_out) {
    before = mesh_.lead_in + mesh_.core_length;
    panel.span = layout_.spans - 1;
  }
  panel.zone = zone_at(before + middle);
  const double whole = stretch.to - stretch.from;
  const bool moves_as_one = stretch.by_length[0] == stretch.by_length[1];
  panel.by_length = moves_as_one ? 0.0 : (stretch.by_length[1] - stretch.by_length[0]) / whole;
  panel.fixed_scale = moves_as_one ? 1.0 : (stretch.fixed[1] - stretch.fixed[0]) / whole;
  return panel;
}

void Transcription::add_panels(const Stretch& stretch) {
  const PanelRule& rule = panel_rule();
  const double a = stretch.from;
  const double b = stretch.to;
  const Part part = stretch.part;
  const double unit = part == Part::core ? mesh_.core_length : 1.0;
  const Panel same = panel_of(stretch);
  if (stations_.empty()) add_station(a, stretch, 0);
  // s + s_0 = r^2 with s_0 = v_0/2: the length of free fall to the entry speed.
  double before = 0.5 * mesh_.entry_speed2;
  if (part != Part::lead_in) before += mesh_.lead_in;
  if (part == Part::lead_out) before += mesh_.core_length;
  const double shift = before / unit;
  const double r_first = std::sqrt(a + shift);
  const double r_last = std::sqrt(b + shift);
  int count = 1;
  if (r_first > 0.0 && r_last > kPanelGrowth * r_first) {
    const double growth = math::log(r_last / r_first) / math::log(kPanelGrowth);
    count = std::max(1, static_cast<int>(std::ceil(growth - 1e-9)));
  }
  const double whole =
      std::sqrt((0.5 * mesh_.entry_speed2 + mesh_.lead_in + mesh_.core_length + mesh_.lead_out) / unit);
  count = std::max(count, static_cast<int>(std::ceil((r_last - r_first) / (kLargestPanel * whole) - 1e-9)));
  const bool geometric = r_first > 0.0 && r_last > kPanelGrowth * r_first;
  const auto r_at = [&](int i) {
    const double share = static_cast<double>(i) / count;
    if (i == count) return r_last;
    return geometric ? r_first * math::pow(r_last / r_first, share) : r_first + share * (r_last - r_first);
  };
  for (int i = 0; i < count; ++i) {
    const double from = i == 0 ? r_first : r_at(i);
    const double to = r_at(i + 1);
    Panel panel = same;
    panel.first = stations_.size();
    for (std::size_t k = 0; k < kNodes; ++k) {
      const double r = from + (to - from) * rule.node[k];
      panel.ds[k] = 2.0 * r * (to - from);
      add_station(a == b ? a : r * r - shift, stretch, panel.zone);
      // The two middle nodes; the outer ones lie next to the ends of the panel.
      stations_.back().watched = a < b && (2 * k + 2 == kNodes || 2 * k == kNodes);
    }
    panels_.push_back(panel);
    add_station(i + 1 == count ? b : to * to - shift, stretch, panel.zone);
  }
}

std::size_t Transcription::start_station(std::size_t panel) const {
  return panels_[panel].first - 1;
}

double Transcription::curvature(const Vector& z, std::size_t index) const {
  const Station& station = stations_[index];
  if (station.part != Part::core) return 0.0;
  const double c = (1.0 - station.share) * z[layout_.turn(station.piece)] +
                   station.share * z[layout_.turn(station.piece + 1)] + station_turn_[index];
  return c / stretch(z, station.piece);
}

bool Transcription::is_track(const Vector& z) const {
  constexpr double kSteepest = 3.0;    // theory: below pi
  constexpr double kLongest = 100.0;   // taste: above any track
  constexpr double kTightest = 0.999;  // curvature times height; theory: at 1 the body does not fit in
  const double core = core_length(z);
  const bool turns_round = std::any_of(z.begin() + static_cast<std::ptrdiff_t>(layout_.length()), z.end(),
                                       [](double length) { return !(length > 0.0); });
  if (!(core > kShortestCore && core < kLongest) || turns_round) return false;
  // Of the straight behind the core no part is turned round.
  for (const Panel& panel : panels_) {
    if (!(scale_of(panel, z) > 0.0)) return false;
  }
  for (std::size_t i = 0; i < layout_.knots; ++i) {
    const std::size_t before = std::max(i, std::size_t{1}) - 1;
    const double least = std::min(stretch(z, before), stretch(z, std::min(i, layout_.knots - 2)));
    if (!(z[layout_.turn(i)] * mesh_.centre_height < kTightest * least)) return false;
  }
  for (std::size_t i = 0; i < fine_.size(); ++i) {
    if (!(fine_turn(z, i) * mesh_.centre_height < kTightest * stretch(z, fine_[i].piece))) return false;
  }
  const Vector angles = section_angles(z);
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (!(std::fabs(angle_at(z, angles, i)) < kSteepest)) return false;
  }
  return true;
}

}  // namespace glissade::optimizer
