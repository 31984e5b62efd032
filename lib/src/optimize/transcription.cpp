#include "optimize/transcription.hpp"

#include "glissade/core/math.hpp"

#include "optimize/quadrature.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

constexpr std::size_t kNodes = PanelRule::kNodes;

// Panels grow at most by this factor in r, so that six nodes resolve the start from rest.
constexpr double kPanelGrowth = 2.5;  // taste

// And by at most this share of the whole track's r, so that a long first piece is resolved too.
constexpr double kLargestPanel = 1.0 / 14.0;  // taste

// What a second weighs beside a second of speed that is off by all of itself: enough for one optimum to be left.
constexpr double kFasterOfTwo = 1e-3;  // taste

// Below this share of free fall a body counts as not arriving.
constexpr double kSlowest = 2e-6;  // theory: twice what counts as lying still

}  // namespace

Slowness slowness(double v, double floor) {
  if (v >= floor) {
    const double root = 1.0 / std::sqrt(v);
    return {root, -0.5 * root / v, 0.75 * root / (v * v)};
  }
  const double root = 1.0 / std::sqrt(floor);
  const double first = -0.5 * root / floor;
  const double second = 0.75 * root / (floor * floor);
  const double below = v - floor;
  return {root + below * (first + 0.5 * below * second), first + below * second, second};
}

Slowness evenness(double v, double floor, double even_speed) {
  // ((1 + epsilon u0 w + v w^2 ...) written in 1/u = w: (v/u0^2 - 2 u/u0 + 1)/u0 + epsilon w.
  const double u0 = even_speed;
  const Slowness slow = slowness(v, floor);
  const double at = std::max(v, floor);
  const double u = std::sqrt(at);
  const double below = v - at;
  // u and its derivatives, continued as slowness() is.
  const double first = 0.5 / u;
  const double second = -0.25 / (u * at);
  const double speed = u + below * (first + 0.5 * below * second);
  const double speed_first = first + below * second;
  const double share = 1.0 / (u0 * u0 * u0);
  return {share * v - 2.0 / (u0 * u0) * speed + 1.0 / u0 + kFasterOfTwo * slow.value,
          share - 2.0 / (u0 * u0) * speed_first + kFasterOfTwo * slow.first,
          -2.0 / (u0 * u0) * second + kFasterOfTwo * slow.second};
}

Slowness pace_of(const Ride& ride, double v, double floor) {
  return ride.even_speed > 0.0 ? evenness(v, floor, ride.even_speed) : slowness(v, floor);
}

Transcription::Transcription(const Mesh& mesh) : mesh_(mesh) {
  layout_.knots = mesh.knots.size();
  if (!mesh.change_knots.empty()) {
    fixed_share_ = mesh.change_knots.back().sigma;
    const auto last = std::find(mesh.knots.begin(), mesh.knots.end(), fixed_share_);
    fixed_pieces_ = static_cast<std::size_t>(last - mesh.knots.begin());
  }
  if (mesh.lead_in > 0.0) add_straight(Part::lead_in);
  add_fine_knots();
  add_core();
  if (mesh.lead_out > 0.0) add_straight(Part::lead_out);

  add_sections();
  station_turn_.resize(stations_.size());
  station_angle_.resize(stations_.size());
  local_dzeta_.resize(stations_.size());
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    local_dzeta_[i] = local_dzeta(stations_[i]);
    station_turn_[i] = own_turn(stations_[i].sigma);
    station_angle_[i] = own_angle(stations_[i].sigma);
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
  const auto i = static_cast<std::size_t>(above - own_sigma_.begin()) - 1;
  const double share = (sigma - own_sigma_[i]) / (own_sigma_[i + 1] - own_sigma_[i]);
  return own_turn_[i] + share * (own_turn_[i + 1] - own_turn_[i]);
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
  for (std::size_t piece = 0; piece + 1 < mesh_.knots.size(); ++piece)
    sections_.push_back({Part::core, piece});
  if (mesh_.lead_out > 0.0) sections_.push_back({Part::lead_out, mesh_.knots.size() - 2});
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
  const std::size_t before = mesh_.lead_in > 0.0 ? 1 : 0;
  switch (part) {
    case Part::lead_in:
      return 0;
    case Part::core:
      return before + piece;
    case Part::lead_out:
      return before + mesh_.knots.size() - 1;
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
  if (row[kZeta] != 0.0) add_scaled(out, row[kZeta], dzeta_starts_.row(section), n);
  const std::size_t piece = sections_[section].piece;
  out[layout_.turn(piece)] += row[kFirst];
  out[layout_.turn(piece + 1)] += row[kSecond];
  out[layout_.length()] += row[kLength];
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
  return fixed_share_ * mesh_.core_length + (1.0 - fixed_share_) * z[layout_.length()];
}

double Transcription::arc_length(const Vector& z, double sigma) const {
  const double fixed = std::min(sigma, fixed_share_);
  return mesh_.lead_in + fixed * mesh_.core_length + (sigma - fixed) * z[layout_.length()];
}

double Transcription::sigma_at(const Vector& z, double arc_length) const {
  const double along = arc_length - mesh_.lead_in;
  const double fixed = fixed_share_ * mesh_.core_length;
  if (along < fixed) return along / mesh_.core_length;
  return fixed_share_ + (along - fixed) / z[layout_.length()];
}

std::size_t Transcription::zone_at(double arc_length) const {
  const auto above = std::upper_bound(mesh_.changes.begin(), mesh_.changes.end(), arc_length);
  return static_cast<std::size_t>(above - mesh_.changes.begin());
}

void Transcription::add_core() {
  Vector breaks = mesh_.extra_breaks;
  breaks.insert(breaks.end(), mesh_.knots.begin(), mesh_.knots.end());
  breaks.insert(breaks.end(), mesh_.fine.begin(), mesh_.fine.end());
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  Stretch stretch;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    stretch.from = breaks[i];
    stretch.to = breaks[i + 1];
    while (stretch.from >= mesh_.knots[stretch.piece + 1]) ++stretch.piece;
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
  const double end_by_length = before ? 0.0 : 1.0 - fixed_share_;
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
  for (const double change : mesh_.changes) {
    const double along = change - begin;
    if (along > 0.0 && along < whole) go_on_to(along, change, 0.0);
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
    station.fixed_length = mesh_.lead_in + (stretches ? fixed_share_ : at) * mesh_.core_length;
    station.by_length = stretches ? at - fixed_share_ : 0.0;
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
    panel.zone = zone_at(mesh_.lead_in + middle * mesh_.core_length);
    if (stretches(stretch.piece)) return panel;
    panel.fixed_scale = mesh_.core_length;
    panel.by_length = 0.0;
    return panel;
  }
  if (stretch.part == Part::lead_out) before = mesh_.lead_in + mesh_.core_length;
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
  if (r_first > 0.0) {
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
      add_station(r * r - shift, stretch, panel.zone);
      // The two middle nodes; the outer ones lie next to the ends of the panel.
      stations_.back().watched = 2 * k + 2 == kNodes || 2 * k == kNodes;
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
  constexpr double kShortest = 0.01;   // taste: below any track
  constexpr double kLongest = 100.0;   // taste: above any track
  constexpr double kTightest = 0.999;  // curvature times height; theory: at 1 the body does not fit in
  const double length = z[layout_.length()];
  const double core = core_length(z);
  if (!(core > kShortest && core < kLongest && length > 0.0)) return false;
  // Of the straight behind the core no part is turned round.
  for (const Panel& panel : panels_) {
    if (!(panel.scale(length) > 0.0)) return false;
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

void Transcription::shape(const Vector& z, Shape& out, bool derivatives) const {
  const PanelRule& rule = panel_rule();
  const std::size_t count = stations_.size();
  const double length = z[layout_.length()];
  out.zeta.resize(count);
  out.sin.resize(count);
  out.cos.resize(count);
  out.curvature.resize(count);
  out.x.assign(count, 0.0);
  out.y.assign(count, 0.0);
  const Vector angles = section_angles(z);
  for (std::size_t i = 0; i < count; ++i) {
    out.zeta[i] = angle_at(z, angles, i);
    const auto [sine, cosine] = math::sine_cosine(out.zeta[i]);
    out.sin[i] = sine;
    out.cos[i] = cosine;
    out.curvature[i] = curvature(z, i);
  }
  out.dx = derivatives ? no_derivatives() : Derivatives{};
  out.dy = out.dx;
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    const Panel& panel = panels_[p];
    const std::size_t start = start_station(p);
    const double scale = panel.scale(length);
    for (std::size_t q = 0; q <= kNodes; ++q) {
      double sum_x = 0.0;
      double sum_y = 0.0;
      for (std::size_t k = 0; k < kNodes; ++k) {
        const double part = (q < kNodes ? rule.to_node[q][k] : rule.weight[k]) * panel.ds[k];
        sum_x += part * out.cos[panel.first + k];
        sum_y += part * out.sin[panel.first + k];
      }
      out.x[panel.first + q] = out.x[start] + scale * sum_x;
      out.y[panel.first + q] = out.y[start] + scale * sum_y;
    }
    if (derivatives) differentiate_shape(z, p, out);
  }
}

void Transcription::count_from_finish(Shape& shape) const {
  const std::size_t last = stations_.size() - 1;
  for (Vector* const places : {&shape.x, &shape.y}) {
    const double finish = places->back();
    for (double& place : *places) place -= finish;
  }
  if (shape.dx.empty()) return;
  const std::size_t n = layout_.size();
  for (Derivatives* const derivatives : {&shape.dx, &shape.dy}) {
    Vector finish(n, 0.0);
    add(*derivatives, last, 1.0, finish.data());
    // Every station's derivatives are those of where its section begins and more; the start, where nothing moved so far,
    // has had none.
    derivatives->local.front()[kOwn] = 1.0;
    for (std::size_t i = 0; i < sections_.size(); ++i)
      add_scaled(derivatives->starts.row(i), -1.0, finish.data(), n);
  }
}

void Transcription::differentiate_shape(const Vector& z, std::size_t p, Shape& out) const {
  const PanelRule& rule = panel_rule();
  const Panel& panel = panels_[p];
  const double scale = panel.scale(z[layout_.length()]);
  carry_over(p, out.dx);
  carry_over(p, out.dy);
  const LocalRow dx_start = at_start(p, out.dx);
  const LocalRow dy_start = at_start(p, out.dy);
  const std::size_t start = start_station(p);
  for (std::size_t q = 0; q <= kNodes; ++q) {
    const std::size_t at = panel.first + q;
    LocalRow& dx = out.dx.local[at];
    LocalRow& dy = out.dy.local[at];
    dx = dx_start;
    dy = dy_start;
    for (std::size_t k = 0; k < kNodes; ++k) {
      const double part = scale * (q < kNodes ? rule.to_node[q][k] : rule.weight[k]) * panel.ds[k];
      const LocalRow& dz = local_dzeta_[panel.first + k];
      for (const std::size_t j : {kZeta, kFirst, kSecond}) {
        dx[j] -= part * out.sin[panel.first + k] * dz[j];
        dy[j] += part * out.cos[panel.first + k] * dz[j];
      }
    }
    if (panel.by_length == 0.0) continue;
    dx[kLength] += panel.by_length * (out.x[at] - out.x[start]) / scale;
    dy[kLength] += panel.by_length * (out.y[at] - out.y[start]) / scale;
  }
}

Foot Transcription::between(const Vector& z, const Shape& shape, std::size_t base, std::size_t towards,
                            double share) const {
  const PanelRule& rule = panel_rule();
  const double length = z[layout_.length()];
  const Station& from = stations_[base];
  // The piece that lies between the two is that of the later one.
  const Station& later = stations_[std::max(base, towards)];
  const Station& to = stations_[towards];
  Foot foot;
  foot.base = base;
  foot.towards = towards;
  foot.share = share;
  foot.at = later;
  foot.at.fixed_length = from.fixed_length + share * (to.fixed_length - from.fixed_length);
  foot.at.by_length = from.by_length + share * (to.by_length - from.by_length);
  foot.at.sigma = from.sigma + share * (to.sigma - from.sigma);
  double curvature_from = 0.0;
  double curvature_slope = 0.0;
  if (later.part == Part::core) {
    const double knot = mesh_.knots[later.piece];
    const double width = mesh_.knots[later.piece + 1] - knot;
    foot.at.share = (foot.at.sigma - knot) / width;
    const double from_share = (from.sigma - knot) / width;
    const double stretch = this->stretch(z, later.piece);
    const double c0 = z[layout_.turn(later.piece)] / stretch;
    const double c1 = z[layout_.turn(later.piece + 1)] / stretch;
    curvature_from = c0 + (c1 - c0) * from_share + station_turn_[base] / stretch;
    curvature_slope = (c1 - c0) / (width * stretch);
    const double gap = (to.sigma - from.sigma) * stretch;
    if (!fine_.empty() && gap != 0.0) {
      curvature_slope += (station_turn_[towards] - station_turn_[base]) / (gap * stretch);
    }
  }
  const double ds = foot.at.arc_length(length) - from.arc_length(length);
  const auto angle = [&](double s) {
    return shape.zeta[base] - s * (curvature_from + 0.5 * s * curvature_slope);
  };
  foot.x = shape.x[base];
  foot.y = shape.y[base];
  for (std::size_t k = 0; k < kNodes; ++k) {
    const auto [sine, cosine] = math::sine_cosine(angle(ds * rule.node[k]));
    foot.x += rule.weight[k] * ds * cosine;
    foot.y += rule.weight[k] * ds * sine;
  }
  const auto [sine, cosine] = math::sine_cosine(angle(ds));
  foot.cos = cosine;
  foot.sin = sine;
  return foot;
}

Foot Transcription::foot(const Vector& z, const Shape& shape, double target_x, double target_y) const {
  std::size_t nearest = 0;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const double distance = math::hypot(shape.x[i] - target_x, shape.y[i] - target_y);
    if (distance < least) {
      least = distance;
      nearest = i;
    }
  }
  return foot(z, shape, target_x, target_y, nearest);
}

Foot Transcription::foot(const Vector& z, const Shape& shape, double target_x, double target_y,
                         std::size_t nearest) const {
  const double along =
      (target_x - shape.x[nearest]) * shape.cos[nearest] + (target_y - shape.y[nearest]) * shape.sin[nearest];
  const bool forward = along > 0.0;
  if ((!forward && nearest == 0) || (forward && nearest + 1 == stations_.size())) {
    Foot foot;
    foot.at = stations_[nearest];
    foot.base = nearest;
    foot.towards = nearest;
    foot.x = shape.x[nearest];
    foot.y = shape.y[nearest];
    foot.sin = shape.sin[nearest];
    foot.cos = shape.cos[nearest];
    foot.end = true;
    return foot;
  }
  const std::size_t towards = forward ? nearest + 1 : nearest - 1;
  const double gap =
      stations_[towards].arc_length(z[layout_.length()]) - stations_[nearest].arc_length(z[layout_.length()]);
  double share = std::min(1.0, std::fabs(along / gap));
  Foot foot = between(z, shape, nearest, towards, share);
  for (int step = 0; step < 8; ++step) {
    const double rest = (target_x - foot.x) * foot.cos + (target_y - foot.y) * foot.sin;
    if (std::fabs(rest) < 1e-15) break;
    share = std::clamp(share + rest / gap, 0.0, 1.0);
    foot = between(z, shape, nearest, towards, share);
  }
  return foot;
}

void Transcription::foot_derivatives(const Vector& z, const Shape& shape, const Foot& foot, Vector& dx,
                                     Vector& dy) const {
  const PanelRule& rule = panel_rule();
  const std::size_t n = layout_.size();
  const double length = z[layout_.length()];
  const Station& from = stations_[foot.base];
  dx.assign(n, 0.0);
  dy.assign(n, 0.0);
  add(shape.dx, foot.base, 1.0, dx.data());
  add(shape.dy, foot.base, 1.0, dy.data());
  const double d_sigma = foot.at.sigma - from.sigma;
  const double by_length = foot.at.by_length - from.by_length;
  const double ds = foot.at.arc_length(length) - from.arc_length(length);
  if (ds == 0.0) return;
  const std::size_t section = section_of(foot.at.part, foot.at.piece);
  const std::size_t piece = sections_[section].piece;
  const double angle = section_angles(z)[section];
  LocalRow local_dx{};
  LocalRow local_dy{};
  for (std::size_t k = 0; k < kNodes; ++k) {
    Station node = foot.at;
    node.sigma = from.sigma + d_sigma * rule.node[k];
    if (node.part == Part::core) {
      const double knot = mesh_.knots[node.piece];
      node.share = (node.sigma - knot) / (mesh_.knots[node.piece + 1] - knot);
    }
    const LocalRow row = local_dzeta(node);
    const double zeta = angle + row[kFirst] * z[layout_.turn(piece)] +
                        row[kSecond] * z[layout_.turn(piece + 1)] + own_angle(node.sigma);
    const auto [sine, cosine] = math::sine_cosine(zeta);
    for (const std::size_t j : {kZeta, kFirst, kSecond}) {
      local_dx[j] -= rule.weight[k] * ds * sine * row[j];
      local_dy[j] += rule.weight[k] * ds * cosine * row[j];
    }
    local_dx[kLength] += rule.weight[k] * by_length * cosine;
    local_dy[kLength] += rule.weight[k] * by_length * sine;
  }
  expand(local_dx, section, nullptr, dx.data());
  expand(local_dy, section, nullptr, dy.data());
}

double Transcription::slowest(const Ride& ride, std::size_t station) const {
  return kSlowest * (stations_[station].arc_length(mesh_.core_length) + 0.5 * ride.entry_speed2);
}

void Transcription::flow(const Vector& z, const Shape& shape, const Ride& ride, Flow& out,
                         bool derivatives) const {
  out.v.assign(stations_.size(), 0.0);
  out.growth.assign(stations_.size(), 1.0);
  out.time = 0.0;
  out.dv = derivatives ? no_derivatives() : Derivatives{};
  if (derivatives) out.dtime.assign(layout_.size(), 0.0);
  if (ride.sliding_point()) {
    out.v[0] = ride.entry_speed2;
  } else {
    out.growth.clear();
    enter(shape, ride, out);
  }
  LocalRow by_time{};  // of the section
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    if (derivatives) carry_over(p, out.dv);
    if (ride.sliding_point()) {
      flow_through(z, shape, ride, p, out, derivatives ? &by_time : nullptr);
    } else {
      law_flow_through(z, shape, ride, p, out, derivatives ? &by_time : nullptr);
    }
    if (!derivatives || (p + 1 < panels_.size() && !begins_section(p + 1))) continue;
    const std::size_t section = panels_[p].section;
    expand(by_time, section, out.dv.starts.row(section), out.dtime.data());
    by_time = {};
  }
}

// Angles count from the entry and arc lengths from the start of each panel, so that the exponents stay small; v
// carries over from panel to panel.
void Transcription::flow_through(const Vector& z, const Shape& shape, const Ride& ride, std::size_t p,
                                 Flow& out, LocalRow* by_time) const {
  const PanelRule& rule = panel_rule();
  const Panel& panel = panels_[p];
  const std::size_t start = start_station(p);
  const double length = z[layout_.length()];
  const double mu = ride.friction_in(panel.zone);
  const double scale = panel.scale(length);
  const LocalRow dz_start = dzeta_at_start(p);
  double f[kNodes] = {};
  std::array<LocalRow, kNodes> df{};
  for (std::size_t q = 0; q <= kNodes; ++q) {
    const std::size_t at = panel.first + q;
    const double s = stations_[at].arc_length(length) - stations_[start].arc_length(length);
    out.growth[at] = math::exp(2.0 * mu * (shape.zeta[at] - shape.zeta[start]) - 2.0 * ride.drag * s);
    if (q == kNodes) break;
    const double weight = panel.ds[q] / out.growth[at];
    const double drive = 2.0 * (shape.sin[at] - mu * shape.cos[at]);
    f[q] = drive * weight;
    if (by_time == nullptr) continue;
    const double by_zeta = (2.0 * (shape.cos[at] + mu * shape.sin[at]) - 2.0 * mu * drive) * weight;
    const double by_start = 2.0 * mu * f[q];
    const LocalRow& dz = local_dzeta_[at];
    for (const std::size_t j : {kZeta, kFirst, kSecond}) {
      df[q][j] = scale * (by_zeta * dz[j] + by_start * dz_start[j]);
    }
    const double ds_dlength = stations_[at].by_length - stations_[start].by_length;
    df[q][kLength] = panel.by_length * f[q] + scale * f[q] * 2.0 * ride.drag * ds_dlength;
  }
  const LocalRow dv_start = by_time != nullptr ? at_start(p, out.dv) : LocalRow{};
  for (std::size_t q = 0; q <= kNodes; ++q) {
    const std::size_t at = panel.first + q;
    const double* row = q < kNodes ? rule.to_node[q].data() : rule.weight.data();
    double w = out.v[start];
    for (std::size_t k = 0; k < kNodes; ++k) w += scale * row[k] * f[k];
    out.v[at] = w * out.growth[at];
    if (by_time != nullptr) {
      LocalRow& dv = out.dv.local[at];
      dv = dv_start;
      for (std::size_t k = 0; k < kNodes; ++k) {
        for (std::size_t j = kZeta; j <= kLength; ++j) dv[j] += row[k] * df[k][j];
      }
      for (double& entry : dv) entry *= out.growth[at];
      const double turning = 2.0 * mu * out.v[at];
      const LocalRow& dz = local_dzeta_[at];
      for (const std::size_t j : {kZeta, kFirst, kSecond}) dv[j] += turning * (dz[j] - dz_start[j]);
      dv[kLength] -= 2.0 * ride.drag * out.v[at] * (stations_[at].by_length - stations_[start].by_length);
    }
    if (q == kNodes) continue;
    const Slowness slow = slowness(out.v[at], slowest(ride, at));
    const double part = rule.weight[q] * panel.ds[q];
    out.time += scale * part * slow.value;
    if (by_time == nullptr) continue;
    for (std::size_t j = 0; j < by_time->size(); ++j) {
      (*by_time)[j] += scale * part * slow.first * out.dv.local[at][j];
    }
    (*by_time)[kLength] += panel.by_length * part * slow.value;
  }
}

}  // namespace glissade::optimizer
