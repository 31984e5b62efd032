#include "optimize/transcription.hpp"

#include "glissade/core/math.hpp"

#include "optimize/quadrature.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {
namespace {

constexpr std::size_t kNodes = PanelRule::kNodes;

// Panels grow at most by this factor in r, so that six nodes resolve the start from rest.
constexpr double kPanelGrowth = 2.5;

// And by at most this share of the whole track's r, so that a long first piece is resolved too.
constexpr double kLargestPanel = 1.0 / 14.0;

// What a second weighs beside a second of speed that is off by all of itself: enough for one optimum to be left.
constexpr double kFasterOfTwo = 1e-3;

// Below this share of free fall a body counts as not arriving.
constexpr double kSlowest = 2e-6;

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
  const std::size_t last_piece = mesh.knots.size() - 2;
  add_station(0.0, mesh.lead_in > 0.0 ? Part::lead_in : Part::core, 0);
  if (mesh.lead_in > 0.0) add_panels(0.0, mesh.lead_in, Part::lead_in, 0);
  add_fine_knots();
  Vector breaks = mesh.extra_breaks;
  breaks.insert(breaks.end(), mesh.knots.begin(), mesh.knots.end());
  breaks.insert(breaks.end(), mesh.fine.begin(), mesh.fine.end());
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  std::size_t piece = 0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    while (breaks[i] >= mesh.knots[piece + 1]) ++piece;
    add_panels(breaks[i], breaks[i + 1], Part::core, piece);
  }
  if (mesh.lead_out > 0.0) add_panels(0.0, mesh.lead_out, Part::lead_out, last_piece);

  dzeta_ = Matrix(stations_.size(), layout_.size());
  station_turn_.resize(stations_.size());
  station_angle_.resize(stations_.size());
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    turning_row(stations_[i], dzeta_.row(i));
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

void Transcription::turning_row(const Station& station, double* row) const {
  std::fill_n(row, layout_.size(), 0.0);
  row[layout_.angle()] = 1.0;
  if (station.part == Part::lead_in) return;
  for (std::size_t p = 0; p <= station.piece; ++p) {
    const double width = mesh_.knots[p + 1] - mesh_.knots[p];
    const double share = p < station.piece ? 1.0 : station.share;
    row[layout_.turn(p)] -= width * share * (1.0 - 0.5 * share);
    row[layout_.turn(p + 1)] -= width * 0.5 * share * share;
  }
}

void Transcription::add_station(double at, Part part, std::size_t piece) {
  Station station;
  station.part = part;
  station.piece = piece;
  switch (part) {
    case Part::lead_in:
      station.fixed_length = at;
      break;
    case Part::core: {
      const double from = mesh_.knots[piece];
      const double to = mesh_.knots[piece + 1];
      station.fixed_length = mesh_.lead_in;
      station.sigma = at;
      station.share = at == to ? 1.0 : (at - from) / (to - from);
      break;
    }
    case Part::lead_out:
      station.fixed_length = mesh_.lead_in + at;
      station.sigma = 1.0;
      station.share = 1.0;
      break;
  }
  stations_.push_back(station);
}

void Transcription::add_panels(double a, double b, Part part, std::size_t piece) {
  const PanelRule& rule = panel_rule();
  const double unit = part == Part::core ? mesh_.core_length : 1.0;
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
    Panel panel;
    panel.first = stations_.size();
    panel.part = part;
    panel.columns = part == Part::core ? layout_.turn(piece + 2)
                                       : (part == Part::lead_out ? layout_.length() : std::size_t{1});
    for (std::size_t k = 0; k < kNodes; ++k) {
      const double r = from + (to - from) * rule.node[k];
      panel.ds[k] = 2.0 * r * (to - from);
      add_station(r * r - shift, part, piece);
      // The two middle nodes; the outer ones lie next to the ends of the panel.
      stations_.back().watched = 2 * k + 2 == kNodes || 2 * k == kNodes;
    }
    panels_.push_back(panel);
    add_station(i + 1 == count ? b : to * to - shift, part, piece);
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
  return c / z[layout_.length()];
}

bool Transcription::is_track(const Vector& z) const {
  constexpr double kSteepest = 3.0;
  constexpr double kShortest = 0.01;
  constexpr double kLongest = 100.0;
  constexpr double kTightest = 0.999;  // curvature times height: at 1 the body does not fit in
  const double length = z[layout_.length()];
  if (!(length > kShortest && length < kLongest)) return false;
  for (std::size_t i = 0; i < layout_.knots; ++i) {
    if (!(z[layout_.turn(i)] * mesh_.centre_height < kTightest * length)) return false;
  }
  for (std::size_t i = 0; i < fine_.size(); ++i) {
    if (!(fine_turn(z, i) * mesh_.centre_height < kTightest * length)) return false;
  }
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const double zeta = dot(dzeta_.row(i), z.data(), layout_.size()) + station_angle_[i];
    if (!(std::fabs(zeta) < kSteepest)) return false;
  }
  return true;
}

void Transcription::shape(const Vector& z, Shape& out, bool derivatives) const {
  const PanelRule& rule = panel_rule();
  const std::size_t count = stations_.size();
  const std::size_t n = layout_.size();
  const double length = z[layout_.length()];
  out.zeta.resize(count);
  out.sin.resize(count);
  out.cos.resize(count);
  out.curvature.resize(count);
  out.x.assign(count, 0.0);
  out.y.assign(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    out.zeta[i] = dot(dzeta_.row(i), z.data(), n) + station_angle_[i];
    const auto [sine, cosine] = math::sine_cosine(out.zeta[i]);
    out.sin[i] = sine;
    out.cos[i] = cosine;
    out.curvature[i] = curvature(z, i);
  }
  if (derivatives) {
    out.dx = Matrix(count, n);
    out.dy = Matrix(count, n);
  }
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    const Panel& panel = panels_[p];
    const std::size_t start = start_station(p);
    const bool is_core = panel.part == Part::core;
    const double scale = is_core ? length : 1.0;
    for (std::size_t q = 0; q <= kNodes; ++q) {
      double sum_x = 0.0;
      double sum_y = 0.0;
      for (std::size_t k = 0; k < kNodes; ++k) {
        const double part = (q < kNodes ? rule.to_node[q][k] : rule.weight[k]) * panel.ds[k];
        sum_x += part * out.cos[panel.first + k];
        sum_y += part * out.sin[panel.first + k];
      }
      const std::size_t at = panel.first + q;
      out.x[at] = out.x[start] + scale * sum_x;
      out.y[at] = out.y[start] + scale * sum_y;
      if (!derivatives) continue;
      double* dx = out.dx.row(at);
      double* dy = out.dy.row(at);
      std::copy_n(out.dx.row(start), n, dx);
      std::copy_n(out.dy.row(start), n, dy);
      for (std::size_t k = 0; k < kNodes; ++k) {
        const double part = scale * (q < kNodes ? rule.to_node[q][k] : rule.weight[k]) * panel.ds[k];
        const double* dz = dzeta_.row(panel.first + k);
        add_scaled(dx, -part * out.sin[panel.first + k], dz, panel.columns);
        add_scaled(dy, part * out.cos[panel.first + k], dz, panel.columns);
      }
      if (is_core) {
        dx[layout_.length()] += sum_x;
        dy[layout_.length()] += sum_y;
      }
    }
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
  foot.at.sigma = from.sigma + share * (to.sigma - from.sigma);
  double curvature_from = 0.0;
  double curvature_slope = 0.0;
  if (later.part == Part::core) {
    const double knot = mesh_.knots[later.piece];
    const double width = mesh_.knots[later.piece + 1] - knot;
    foot.at.share = (foot.at.sigma - knot) / width;
    const double from_share = (from.sigma - knot) / width;
    const double c0 = z[layout_.turn(later.piece)] / length;
    const double c1 = z[layout_.turn(later.piece + 1)] / length;
    curvature_from = c0 + (c1 - c0) * from_share + station_turn_[base] / length;
    curvature_slope = (c1 - c0) / (width * length);
    const double gap = (to.sigma - from.sigma) * length;
    if (!fine_.empty() && gap != 0.0) {
      curvature_slope += (station_turn_[towards] - station_turn_[base]) / (gap * length);
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
  dx.assign(shape.dx.row(foot.base), shape.dx.row(foot.base) + n);
  dy.assign(shape.dy.row(foot.base), shape.dy.row(foot.base) + n);
  const double d_sigma = foot.at.sigma - from.sigma;
  const double ds = foot.at.arc_length(length) - from.arc_length(length);
  if (ds == 0.0) return;
  Vector row(n);
  for (std::size_t k = 0; k < kNodes; ++k) {
    Station node = foot.at;
    node.sigma = from.sigma + d_sigma * rule.node[k];
    if (node.part == Part::core) {
      const double knot = mesh_.knots[node.piece];
      node.share = (node.sigma - knot) / (mesh_.knots[node.piece + 1] - knot);
    }
    turning_row(node, row.data());
    const auto [sine, cosine] = math::sine_cosine(dot(row.data(), z.data(), n) + own_angle(node.sigma));
    add_scaled(dx.data(), -rule.weight[k] * ds * sine, row.data(), n);
    add_scaled(dy.data(), rule.weight[k] * ds * cosine, row.data(), n);
    dx[layout_.length()] += rule.weight[k] * d_sigma * cosine;
    dy[layout_.length()] += rule.weight[k] * d_sigma * sine;
  }
}

double Transcription::slowest(const Ride& ride, std::size_t station) const {
  return kSlowest * (stations_[station].arc_length(mesh_.core_length) + 0.5 * ride.entry_speed2);
}

void Transcription::flow(const Vector& z, const Shape& shape, const Ride& ride, Flow& out,
                         bool derivatives) const {
  if (!ride.sliding_point()) return law_flow(z, shape, ride, out, derivatives);
  const PanelRule& rule = panel_rule();
  const std::size_t count = stations_.size();
  const std::size_t n = layout_.size();
  const std::size_t at_length = layout_.length();
  const double length = z[at_length];
  const double mu = ride.friction;
  out.v.assign(count, 0.0);
  out.time = 0.0;
  if (derivatives) {
    out.dv = Matrix(count, n);
    out.dtime.assign(n, 0.0);
  }
  // Angles count from the entry and arc lengths from the start of each panel, so that the exponents stay
  // small; v carries over from panel to panel.
  Vector dw(n, 0.0);
  std::vector<Vector> df(kNodes, Vector(n, 0.0));
  double f[kNodes] = {};
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    const Panel& panel = panels_[p];
    const std::size_t start = start_station(p);
    const double zeta_start = shape.zeta[start];
    const double s_start = stations_[start].arc_length(length);
    const bool is_core = panel.part == Part::core;
    const double scale = is_core ? length : 1.0;
    for (std::size_t k = 0; k < kNodes; ++k) {
      const std::size_t at = panel.first + k;
      const double s = stations_[at].arc_length(length) - s_start;
      const double turned = shape.zeta[at] - zeta_start;
      const double weight = math::exp(-2.0 * mu * turned + 2.0 * ride.drag * s);
      const double drive = 2.0 * (shape.sin[at] - mu * shape.cos[at]);
      f[k] = drive * weight * panel.ds[k];
      if (!derivatives) continue;
      Vector& d = df[k];
      const double by_zeta =
          (2.0 * (shape.cos[at] + mu * shape.sin[at]) - 2.0 * mu * drive) * weight * panel.ds[k];
      const double by_start = 2.0 * mu * f[k];
      const double* dz = dzeta_.row(at);
      const double* dz0 = dzeta_.row(start);
      for (std::size_t j = 0; j < panel.columns; ++j) d[j] = scale * (by_zeta * dz[j] + by_start * dz0[j]);
      for (std::size_t j = panel.columns; j < n; ++j) d[j] = 0.0;
      const double ds_dlength = stations_[at].sigma - stations_[start].sigma;
      d[at_length] = (is_core ? f[k] : 0.0) + scale * f[k] * 2.0 * ride.drag * ds_dlength;
    }
    const double v_start = p == 0 ? ride.entry_speed2 : out.v[start];
    if (p == 0) out.v[start] = v_start;
    for (std::size_t q = 0; q <= kNodes; ++q) {
      const std::size_t at = panel.first + q;
      const double* row = q < kNodes ? rule.to_node[q].data() : rule.weight.data();
      double sum = 0.0;
      for (std::size_t k = 0; k < kNodes; ++k) sum += row[k] * f[k];
      const double s = stations_[at].arc_length(length) - s_start;
      const double turned = shape.zeta[at] - zeta_start;
      const double back = math::exp(2.0 * mu * turned - 2.0 * ride.drag * s);
      const double w = v_start + scale * sum;
      out.v[at] = w * back;
      if (derivatives) {
        double* dv = out.dv.row(at);
        std::copy_n(out.dv.row(start), n, dv);
        for (std::size_t k = 0; k < kNodes; ++k) {
          add_scaled(dv, row[k], df[k].data(), panel.columns);
          dv[at_length] += row[k] * df[k][at_length] * (panel.columns > at_length ? 0.0 : 1.0);
        }
        const double* dz = dzeta_.row(at);
        const double* dz0 = dzeta_.row(start);
        const double angle_part = 2.0 * mu * out.v[at];
        for (std::size_t j = 0; j < n; ++j) dv[j] *= back;
        for (std::size_t j = 0; j < panel.columns && j < at_length; ++j)
          dv[j] += angle_part * (dz[j] - dz0[j]);
        dv[at_length] -= 2.0 * ride.drag * out.v[at] * (stations_[at].sigma - stations_[start].sigma);
      }
      if (q == kNodes) continue;
      const double floor = kSlowest * (stations_[at].arc_length(mesh_.core_length) + 0.5 * ride.entry_speed2);
      const Slowness slow = slowness(out.v[at], floor);
      const double part = rule.weight[q] * panel.ds[q];
      out.time += scale * part * slow.value;
      if (derivatives) {
        add_scaled(out.dtime.data(), scale * part * slow.first, out.dv.row(at), n);
        if (is_core) out.dtime[at_length] += part * slow.value;
      }
    }
  }
}

void Transcription::add_shape_parts(const Vector& z, const Shape& shape, const StationWeights& weights,
                                    HessianParts& parts) const {
  const PanelRule& rule = panel_rule();
  const double length = z[layout_.length()];
  double later_x = 0.0;
  double later_y = 0.0;
  for (std::size_t p = panels_.size(); p-- > 0;) {
    const Panel& panel = panels_[p];
    const bool is_core = panel.part == Part::core;
    const double scale = is_core ? length : 1.0;
    const std::size_t end = panel.first + kNodes;
    later_x += weights.x[end];
    later_y += weights.y[end];
    for (std::size_t k = 0; k < kNodes; ++k) {
      const std::size_t at = panel.first + k;
      double sum_x = rule.weight[k] * later_x;
      double sum_y = rule.weight[k] * later_y;
      for (std::size_t q = 0; q < kNodes; ++q) {
        sum_x += rule.to_node[q][k] * weights.x[panel.first + q];
        sum_y += rule.to_node[q][k] * weights.y[panel.first + q];
      }
      sum_x *= panel.ds[k];
      sum_y *= panel.ds[k];
      parts.zeta_zeta[at] -= scale * (shape.cos[at] * sum_x + shape.sin[at] * sum_y);
      if (is_core) {
        add_scaled(parts.length.data(), -shape.sin[at] * sum_x + shape.cos[at] * sum_y, dzeta_.row(at),
                   panel.columns);
      }
    }
    for (std::size_t q = 0; q < kNodes; ++q) {
      later_x += weights.x[panel.first + q];
      later_y += weights.y[panel.first + q];
    }
  }
}

void Transcription::add_flow_parts(const Vector& z, const Shape& shape, const Ride& ride, const Flow& flow,
                                   const StationWeights& weights, std::size_t index,
                                   HessianParts& parts) const {
  // v = e^phi w with phi = 2 mu zeta - 2 k s, w' = drive e^-phi. phi is linear in the unknowns:
  // d2v = e^phi d2w + dv dphi + dphi dv - v dphi dphi, dphi = 2 mu dzeta - 2 k sigma e_L in the core.
  const PanelRule& rule = panel_rule();
  const std::size_t n = layout_.size();
  const std::size_t at_length = layout_.length();
  const double length = z[at_length];
  const double mu = ride.friction;
  const double drag = ride.drag;
  const auto exponent = [&](std::size_t at) {
    return 2.0 * mu * shape.zeta[at] - 2.0 * drag * stations_[at].arc_length(length);
  };
  double later = 0.0;  // dL/dw of everything after the panel
  for (std::size_t p = panels_.size(); p-- > 0;) {
    const Panel& panel = panels_[p];
    const bool is_core = panel.part == Part::core;
    const double scale = is_core ? length : 1.0;
    double by_w[kNodes + 1] = {};
    for (std::size_t q = 0; q <= kNodes; ++q) {
      const std::size_t at = panel.first + q;
      double by_v = weights.v[index][at];
      const double* dv = flow.dv.row(at);
      if (q < kNodes && weights.time[index] != 0.0) {
        const double floor =
            kSlowest * (stations_[at].arc_length(mesh_.core_length) + 0.5 * ride.entry_speed2);
        const Slowness slow = slowness(flow.v[at], floor);
        const double part = weights.time[index] * rule.weight[q] * panel.ds[q];
        by_v += scale * part * slow.first;
        parts.v_v[index][at] += scale * part * slow.second;
        if (is_core) add_scaled(parts.length.data(), part * slow.first, dv, n);
      }
      if (by_v == 0.0) continue;
      parts.zeta_v[index][at] += 2.0 * mu * by_v;
      parts.zeta_zeta[at] -= 4.0 * mu * mu * by_v * flow.v[at];
      if (drag > 0.0) {
        const double reach = 2.0 * drag * stations_[at].sigma;
        add_scaled(parts.length.data(), -reach * by_v, dv, n);
        add_scaled(parts.length.data(), 2.0 * mu * reach * by_v * flow.v[at], dzeta_.row(at), at_length);
        parts.length[at_length] -= 0.5 * reach * reach * by_v * flow.v[at];
      }
      by_w[q] = by_v * math::exp(exponent(at));
    }
    later += by_w[kNodes];
    for (std::size_t k = 0; k < kNodes; ++k) {
      const std::size_t at = panel.first + k;
      double sum = rule.weight[k] * later;
      for (std::size_t q = 0; q < kNodes; ++q) sum += rule.to_node[q][k] * by_w[q];
      if (sum == 0.0) continue;
      sum *= panel.ds[k] * math::exp(-exponent(at));
      const double drive = 2.0 * (shape.sin[at] - mu * shape.cos[at]);
      const double drive1 = 2.0 * (shape.cos[at] + mu * shape.sin[at]);
      const double f1 = drive1 - 2.0 * mu * drive;
      parts.zeta_zeta[at] += scale * sum * (-drive - 4.0 * mu * drive1 + 4.0 * mu * mu * drive);
      const double reach = 2.0 * drag * stations_[at].sigma;
      add_scaled(parts.length.data(), sum * f1 * ((is_core ? 1.0 : 0.0) + scale * reach), dzeta_.row(at),
                 panel.columns);
      parts.length[at_length] += sum * drive * reach * ((is_core ? 1.0 : 0.0) + 0.5 * scale * reach);
    }
    for (std::size_t q = 0; q < kNodes; ++q) later += by_w[q];
  }
  // What the body brings along: w = v_0 e^(-2 mu zeta_0).
  parts.zeta_zeta[0] += later * 4.0 * mu * mu * ride.entry_speed2 * math::exp(-exponent(0));
}

Matrix Transcription::hessian(const Vector& z, const Shape& shape, const std::vector<Ride>& rides,
                              const std::vector<Flow>& flows, const StationWeights& weights) const {
  const std::size_t n = layout_.size();
  const std::size_t at_length = layout_.length();
  HessianParts parts;
  parts.zeta_zeta = weights.zeta_zeta;
  parts.zeta_v.assign(rides.size(), Vector(stations_.size(), 0.0));
  parts.v_v = weights.v_v;
  parts.length.assign(n, 0.0);
  add_shape_parts(z, shape, weights, parts);
  for (std::size_t r = 0; r < rides.size(); ++r) {
    if (flows[r].dv.rows() == 0) continue;
    if (rides[r].sliding_point()) {
      add_flow_parts(z, shape, rides[r], flows[r], weights, r, parts);
    } else {
      add_law_parts(z, shape, rides[r], flows[r], weights, r, parts);
    }
  }

  Matrix h(n, n);
  const auto add_station = [&](std::size_t at, std::size_t columns) {
    columns = std::min(columns, at_length);
    const double* dz = dzeta_.row(at);
    for (std::size_t i = 0; i < columns; ++i) add_scaled(h.row(i), parts.zeta_zeta[at] * dz[i], dz, i + 1);
    for (std::size_t r = 0; r < rides.size(); ++r) {
      const double zeta_v = parts.zeta_v[r][at];
      const double v_v = parts.v_v[r][at];
      if (zeta_v == 0.0 && v_v == 0.0) continue;
      const double* dv = flows[r].dv.row(at);
      for (std::size_t i = 0; i < columns; ++i) {
        add_scaled(h.row(i), zeta_v * dv[i], dz, i + 1);
        add_scaled(h.row(i), zeta_v * dz[i] + v_v * dv[i], dv, i + 1);
      }
      add_scaled(h.row(at_length), zeta_v * dv[at_length], dz, columns);
      add_scaled(h.row(at_length), v_v * dv[at_length], dv, columns);
      h(at_length, at_length) += v_v * dv[at_length] * dv[at_length];
    }
  };
  add_station(0, 1);
  for (const Panel& panel : panels_) {
    for (std::size_t q = 0; q <= kNodes; ++q) add_station(panel.first + q, panel.columns);
  }
  for (std::size_t j = 0; j < n; ++j) h(at_length, j) += parts.length[j];
  h(at_length, at_length) += parts.length[at_length];
  for (std::size_t i = 0; i < parts.curvature.rows(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) h(i, j) += parts.curvature(i, j) + parts.curvature(j, i);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) h(j, i) = h(i, j);
  }
  return h;
}

}  // namespace glissade::optimizer
