#include "optimize/search/searcher.hpp"

#include "glissade/centerline/clothoid_spline.hpp"

#include "optimize/descent/least_violation.hpp"
#include "optimize/mesh/free_spans.hpp"
#include "optimize/mesh/moved_knots.hpp"
#include "optimize/mesh/refined_knots.hpp"
#include "optimize/mesh/refinement.hpp"
#include "optimize/search/starts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace glissade::optimizer {
namespace {

// Pieces of the coarse levels before the finest.
constexpr std::size_t kCoarsePieces = 12;  // taste
constexpr std::size_t kMovedLevels = 4;    // budget
// More of them while each wins as much of a share.
constexpr std::size_t kMoreLevels = 8;  // budget
constexpr double kWinsMuch = 2e-5;      // accuracy: twenty times that of a time
// By such a share a smoother track may be slower.
constexpr double kDearer = 1e-7;  // accuracy: below that of a time
// By more than such a share a track that follows a load more closely is another one.
constexpr double kElsewhere = 1e-5;  // accuracy: ten times that of a time
// By less of a share nothing is won.
constexpr double kWithoutEffect = 1e-8;  // accuracy: a hundredth of that of a time
// Pieces of the mesh on which a track is looked for that keeps the limits at all.
constexpr std::size_t kRescuePieces = 20;  // taste
// The lowest load is kept this far above its bound, in g: a body that weighs nothing at all has left the
// track.
constexpr double kContactMargin = 1e-6;  // accuracy: ten times that of a limit
constexpr int kTighteningRounds = 20;    // budget
// So many of them, short ones, once the search has been asked to end.
constexpr int kGraceRounds = 6;  // budget
constexpr int kGraceEffort = 2;  // budget
// In all of them together.
constexpr int kGraceEvaluations = 100;  // budget: an eighth of a second
// In the first of them limits are held at the places that the referee names; later they are tightened.
constexpr int kHoldingRounds = 8;  // taste
// In so many the pieces around places that are dear to hold are halved.
constexpr int kHalvingRounds = 2;  // budget
// In so many a highest load is held where it is exceeded by much more than elsewhere.
constexpr int kPeakRounds = 3;  // budget
// In so many a curvature that follows the load more closely is tried where a body lifts off.
constexpr int kFollowingRounds = 3;  // budget
// A track that then still breaks a limit at a station by more than kHopeless is given up: tighter limits are no
// easier.
constexpr int kPatientRounds = 2;  // budget
// So is one that twice breaks them by more than this, and on a finer mesh by hardly less.
constexpr double kHopeless = 1e-5;  // accuracy: a hundred times that of a limit
// A load that falls below none by less between two stations is mended by a greater margin, a deeper fall by
// holding the load there: next to a jump it is deep, and short.
constexpr double kShallow = 1e-5;  // taste
// By what is missing and a little more, since the track moves.
constexpr double kTightening = 1.3;  // taste
// A body that stalled between two stations is kept this much faster, squared, over free fall.
constexpr double kStallMargin = 1e-5;  // taste: five times what counts as lying still

CenterlinePtr track_of(const ScaledProblem& problem, const Found& found) {
  const Layout& layout = found.track->layout();
  const Mesh& mesh = found.track->mesh();
  std::vector<ClothoidSegment> segments;
  if (mesh.lead_in > 0.0) segments.push_back({mesh.lead_in * problem.chord, 0.0, 0.0});
  const std::vector<FineKnot>& fine = found.track->fine_knots();
  std::size_t next = 0;
  for (std::size_t i = 0; i + 1 < layout.knots; ++i) {
    const double length = found.track->stretch(found.z, i);
    const double scale = 1.0 / (length * problem.chord);
    double sigma = mesh.knots[i];
    double turn = found.z[layout.turn(i)];
    const auto add_up_to = [&](double to, double turn_there) {
      // Two knots at one place are a jump of the curvature.
      if (to > sigma)
        segments.push_back({(to - sigma) * length * problem.chord, turn * scale, turn_there * scale});
      sigma = to;
      turn = turn_there;
    };
    for (; next < fine.size() && fine[next].piece == i; ++next) {
      add_up_to(fine[next].sigma, found.track->fine_turn(found.z, next));
    }
    add_up_to(mesh.knots[i + 1], found.z[layout.turn(i + 1)]);
  }
  if (mesh.lead_out > 0.0) segments.push_back({mesh.lead_out * problem.chord, 0.0, 0.0});
  return std::make_shared<ClothoidSpline>(Angle::from_radians(found.z[layout.angle()]), std::move(segments));
}

bool is_travel_time(const ScaledProblem& problem) {
  return problem.speed_weight == 0.0 && problem.drop_weight == 0.0 && problem.length_weight == 0.0;
}

/// Whether the fastest track would turn down at once from where a limit on the entry holds it: a body at rest
/// loses nothing by that, the tighter the crest the better, and no crest is the tightest. How tight it may be is
/// then up to the mesh, which has to be the same there for every such problem.
bool starts_with_crest(const ScaledProblem& problem) {
  if (problem.entry_speed2 > 0.0 || problem.lead_in > 0.0) return false;
  bool held = false;
  for (const LimitSpec& limit : problem.limits) {
    if (limit.measure == Measure::curvature_rate) return false;
    held = held || (limit.measure == Measure::entry_slope_angle && limit.side >= 0);
  }
  return held;
}

/// Knots in shares of the core that do not depend on the track found: from a hundred-millionth on, each this factor
/// behind the one before.
Vector with_crest_knots(const Vector& knots) {
  constexpr double kFirst = 1e-8;  // taste
  constexpr double kFactor = 4.0;  // taste
  constexpr double kLast = 2e-3;   // taste: twice a pair of knots
  Vector result{0.0};
  double next = kFirst;
  for (; next < kLast; next *= kFactor) result.push_back(next);
  for (const double knot : knots) {
    if (knot > 0.75 * next) result.push_back(knot);
  }
  return result;
}

double entry_share(const ScaledProblem& problem, double core_length) {
  return (problem.lead_in + 0.5 * problem.entry_speed2) / core_length;
}

/// A track that follows such a limit breaks it a little in every piece, between any places where it is
/// held, since a linear curvature does not follow it. Tightening takes less than that already leaves.
bool is_highest_load(const LimitSpec& limit) {
  const bool load = limit.measure == Measure::normal_load || limit.measure == Measure::curvature_load;
  return load && limit.side > 0;
}

/// Whether a highest load binds. Not where bends ever tighter at the start win more than what is left there.
bool lies_at_highest_load(const ScaledProblem& problem, const Found& found) {
  if (starts_with_crest(problem)) return false;
  for (std::size_t i = 0; i < found.active.size(); ++i) {
    if (found.inequality[i] > 0.0 && is_highest_load(problem.limits[found.active[i].limit])) return true;
  }
  return false;
}

bool asks_for_no_more(const Found& a, const Found& b) {
  return a.rows->margins() == b.rows->margins() &&
         a.track->mesh().extra_breaks == b.track->mesh().extra_breaks;
}

/// How a highest load is exceeded: between all fine knots by about as much, and at a few places, next to jumps, by more.
struct Exceeded {
  double usual = 0.0;         ///< the most of it but for these places, in scales
  std::vector<double> peaks;  ///< arc lengths [m]
};
Exceeded exceeded(const referee::Judgement& judgement, const LimitName& limit) {
  constexpr double kMore = 3.0;  // taste: than the median
  Vector by;
  for (const referee::Broken& broken : judgement.broken) {
    if (broken.limit == limit) by.push_back(broken.violation);
  }
  Exceeded result;
  if (by.empty()) return result;
  const auto middle = by.begin() + static_cast<std::ptrdiff_t>(by.size() / 2);
  std::nth_element(by.begin(), middle, by.end());
  const double median = *middle;
  for (const referee::Broken& broken : judgement.broken) {
    if (broken.limit != limit) continue;
    if (broken.violation > kMore * median) {
      result.peaks.push_back(broken.where);
    } else {
      result.usual = std::max(result.usual, broken.violation);
    }
  }
  return result;
}

/// The same track with two pieces for each on which a body lifts off.
Found halved_at(const std::vector<LiftOff>& lifts, Found found) {
  const Mesh& mesh = found.track->mesh();
  std::vector<bool> halved(mesh.knots.size() - 1, false);
  for (const LiftOff& lift : lifts) {
    const auto above = std::upper_bound(mesh.knots.begin() + 1, mesh.knots.end() - 1, lift.sigma);
    halved[static_cast<std::size_t>(above - mesh.knots.begin()) - 1] = true;
  }
  MeshTrack finer = with_halved_pieces(*found.track, found.z, halved);
  found.track = std::make_shared<const Transcription>(finer.mesh);
  found.z = std::move(finer.z);
  return found;
}

/// Where the track from the first start is doubted: other starts, which may lead to better ones.
std::vector<GuessCurve> worth_trying(const ScaledProblem& problem, const std::vector<GuessCurve>& curves,
                                     const Found& first, bool got_lost) {
  constexpr double kDoubtful = 0.05;  // taste: slower by such a share than without limits
  std::vector<GuessCurve> more;
  // Of a track that need not be fast, but lead to speed, any detour may be the better one.
  const bool counts_speed = problem.speed_weight != 0.0;
  if (got_lost || counts_speed) more.assign(curves.begin() + 1, curves.end());
  if (!counts_speed && !is_travel_time(problem)) return more;
  if (more.empty() && first.objective > straight_time(problem)) more.assign(curves.begin() + 1, curves.end());
  const std::optional<FlyingStart> flying = flying_start(problem);
  // Where exit speed counts travel times tell nothing; the crest that is flown over at the start may pay there, too.
  const bool may_win = flying && (counts_speed || first.objective > (1.0 + kDoubtful) * flying->travel_time);
  if (may_win) more.push_back(flying->curve);
  return more;
}

/// Places at which limits are held beside the stations, of the core's length.
class HeldPlaces {
 public:
  explicit HeldPlaces(Vector places) : places_(std::move(places)) {}

  /// A place close to one that is held already takes its part: limits are touched there now.
  void add(double sigma, const Vector& knots) {
    constexpr double kClose = 0.02;  // taste
    if (!(sigma > 0.0 && sigma < 1.0)) return;
    // A place of a greatest value is known to half the digits: those that rounding makes are no reason to end elsewhere.
    constexpr int kBits = 24;  // rounding: half of a double's
    int exponent = 0;
    const double mantissa = std::frexp(sigma, &exponent);
    sigma = std::ldexp(std::round(std::ldexp(mantissa, kBits)), exponent - kBits);
    if (sigma >= knots.back()) return;
    const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, sigma);
    const double piece = *above - *(above - 1);
    for (double& place : places_) {
      if (std::fabs(place - sigma) > kClose * piece) continue;
      place = sigma;
      return;
    }
    places_.push_back(sigma);
  }
  [[nodiscard]] const Vector& places() const { return places_; }

 private:
  Vector places_;
};

}  // namespace

double Searcher::Opening::promise() const {
  return first.found && first.found->feasible(kNearlyFeasible) ? first.found->objective : HUGE_VAL;
}

Searcher::Opening Searcher::opened(const Passages& passages) {
  Opening opening;
  opening.candidate = begun(passages);
  opening.starts = starts(*opening.candidate.rough);
  if (!is_unlimited() && !opening.starts.empty())
    opening.first = coarse(*opening.candidate.rough, opening.starts.front());
  return opening;
}

Candidate Searcher::search(Opening opening, const std::optional<Candidate>& to_beat) {
  Candidate candidate = std::move(opening.candidate);
  const ScaledProblem& scaled_problem = *candidate.problem;
  begin_margins(scaled_problem);
  to_beat_.reset();
  // Of a sum of unlike things no share tells what is far behind.
  if (to_beat && to_beat->kept && problem_.objective.kind != ObjectiveKind::blend)
    to_beat_ = to_beat->found->objective;
  const bool unlimited = is_unlimited();
  std::vector<Found> others;  // that came to nothing
  // Clipped slopes are often the unclipped ones: what did not do is not tried twice, unless limits were tightened on
  // the way.
  std::vector<std::pair<GuessCurve, Vector>> tried;
  const std::vector<GuessCurve>& curves = opening.starts;
  for (const GuessCurve& start : curves) {
    const std::pair<GuessCurve, Vector> trial(start, margins_);
    if (std::find(tried.begin(), tried.end(), trial) != tried.end()) continue;
    tried.push_back(trial);
    Rough rough;
    if (unlimited) {
      rough.found = from_exact(scaled_problem, start);
    } else {
      rough = tried.size() == 1 ? std::move(opening.first) : coarse(*candidate.rough, start);
    }
    std::optional<Found>& found = rough.found;
    if (found) remember(candidate, *found);
    if (control_.stop()) candidate.stopped = true;
    if (!found || is_behind(*found, false)) continue;
    if (control_.any_track) {
      const Vector margins = margins_;
      mend_any(candidate, found->track->mesh(), found->z);
      margins_ = margins;
      if (candidate.kept || candidate.stopped) break;
      continue;
    }
    // Only of the first start: others are tried anyway.
    std::vector<GuessCurve> more;
    if (!unlimited && tried.size() == 1)
      more = worth_trying(*candidate.rough, curves, *found, rough.got_lost);
    if (more.empty() || candidate.stopped) {
      refine(candidate, *found, unlimited && scaled_problem.drag == 0.0);
      if (!candidate.kept && !candidate.stopped && candidate.found) others.push_back(std::move(*found));
    } else {
      take_best(candidate, *found, more, others);
      if (rough.got_lost) break;
    }
    // A track that keeps the limits, but is no optimum, may have lost its way: the next start is tried too.
    const bool converged = candidate.kept && candidate.found->residual <= options_.tolerance;
    if (converged || candidate.stopped) break;
  }
  to_beat_.reset();
  // Slower ones, better than none.
  for (const Found& other : others) {
    if (candidate.kept || candidate.stopped) break;
    mend_any(candidate, other.track->mesh(), other.z);
  }
  return candidate;
}

void Searcher::take_best(Candidate& candidate, Found first, const std::vector<GuessCurve>& more,
                         std::vector<Found>& others) {
  const ScaledProblem& problem = *candidate.rough;
  std::vector<Found> tracks{std::move(first)};
  const auto is_same = [](const Found& a, const Found& b) {
    constexpr double kSame = 1e-6;  // accuracy: that of a time
    return std::fabs(a.objective - b.objective) <= kSame * std::fabs(b.objective);
  };
  for (const GuessCurve& start : more) {
    if (control_.stop()) break;
    std::optional<Found> found = coarse(*candidate.rough, start).found;
    if (!found) continue;
    const bool known =
        std::any_of(tracks.begin(), tracks.end(), [&](const Found& track) { return is_same(track, *found); });
    if (!known && !is_behind(*found, false)) tracks.push_back(*std::move(found));
  }
  // Which is the best one coarse meshes don't tell: some of them have hardly begun to be fast.
  for (Found& track : tracks) track = laid_anew(problem, on_finer_meshes(problem, problem, std::move(track)));
  std::stable_sort(tracks.begin(), tracks.end(), [](const Found& a, const Found& b) {
    const bool keeps = a.feasible(kNearlyFeasible);
    return keeps != b.feasible(kNearlyFeasible) ? keeps : a.objective < b.objective;
  });
  const auto is_converged = [&](const Candidate& end) {
    return end.kept && end.found->residual <= options_.tolerance;
  };
  std::erase_if(tracks, [this](const Found& track) { return is_behind(track, true); });
  for (Found& track : tracks) {
    if (candidate.stopped) return;
    // One that has not come to its end yet may still become the best.
    const bool may_win = track.residual > options_.tolerance && track.feasible(kNearlyFeasible);
    if (is_converged(candidate) && !may_win) continue;
    Candidate end;
    end.problem = candidate.problem;
    end.rough = candidate.rough;
    begin_margins(problem);
    settle(end, track);
    if (!end.kept) others.push_back(std::move(track));
    const bool stopped = end.stopped;
    const bool counts = !is_converged(candidate) || is_converged(end);
    const bool is_better = !candidate.found || (end.kept && !candidate.kept) ||
                           (is_converged(end) && !is_converged(candidate)) ||
                           (end.kept && end.found->objective < candidate.found->objective);
    if (end.found && counts && is_better) candidate = std::move(end);
    candidate.stopped = stopped;
  }
}

Candidate Searcher::search_from(const Passages& passages, const Mesh& mesh, const Vector& z) {
  return control_.any_track ? mended(passages, mesh, z) : ended(carried_on(passages, mesh, z));
}

Searcher::Stage Searcher::carried_along(const Passages& passages, const Mesh& mesh, const Vector& z) {
  Stage stage{begun(passages), {}, mesh, z};
  const ScaledProblem& problem = *stage.candidate.rough;
  aim_at(kCoarseTolerance, 12);
  stage.found = laid_anew(problem, minimise(problem, mesh, z, margins_, control_));
  return stage;
}

Searcher::Stage Searcher::carried_on(const Passages& passages, const Mesh& mesh, const Vector& z) {
  Stage stage{begun(passages), {}, mesh, z};
  const ScaledProblem& problem = *stage.candidate.rough;
  aim_at(kCoarseTolerance, 12);
  Found found = minimise(problem, mesh, z, margins_, control_);
  stage.found = laid_anew(problem, on_finer_meshes(problem, problem, std::move(found)));
  remember(stage.candidate, stage.found);
  return stage;
}

Candidate Searcher::ended(Stage stage) {
  begin_margins(*stage.candidate.problem);
  settle(stage.candidate, std::move(stage.found));
  if (!stage.candidate.kept && !stage.candidate.stopped) mend_any(stage.candidate, stage.mesh, stage.z);
  return std::move(stage.candidate);
}

Candidate Searcher::ended_on(const Candidate& known, Found found) {
  Candidate candidate;
  candidate.problem = known.problem;
  candidate.rough = known.rough;
  margins_ = found.rows->margins();
  finer_mesh_wins_ = known.finer_mesh_wins;
  moves_promise_ = known.moves_promise;
  multipliers_ahead_ = known.multipliers_ahead;
  mend(candidate, laid_anew(*candidate.problem, std::move(found)));
  return candidate;
}

Candidate Searcher::mended(const Passages& passages, const Mesh& mesh, const Vector& z) {
  Candidate candidate = begun(passages);
  mend_any(candidate, mesh, z);
  return candidate;
}

void Searcher::mend_any(Candidate& candidate, const Mesh& mesh, const Vector& z) {
  const ScaledProblem& problem = *candidate.problem;
  const bool any = std::exchange(control_.any_track, true);
  begin_margins(problem);
  candidate.rough_found.reset();
  finer_mesh_wins_.reset();
  moves_promise_ = 0.0;
  multipliers_ahead_.clear();
  Found found = kept_on(problem, mesh, z);
  // What is left over there may be the mesh's fault.
  constexpr std::size_t kFiner[] = {32, 48};  // taste
  for (const std::size_t pieces : kFiner) {
    if (found.feasible(control_.limit_tolerance) || !found.feasible(kNearlyFeasible) || control_.stop())
      break;
    const Mesh finer =
        mesh_with(problem, refined_knots(*found.track, found.z, {}, pieces), core_length_of(found));
    found = kept_on(problem, finer, fit(curve_of(*found.track, found.z), Transcription(finer)));
  }
  mend(candidate, laid_anew(problem, std::move(found)));
  control_.any_track = any;
}

Found Searcher::kept_on(const ScaledProblem& problem, const Mesh& mesh, const Vector& beginning) {
  Relaxed relaxed =
      least_violation(problem, mesh, beginning, Elastic::all(problem.limits.size()), margins_, control_);
  relaxed.found.violation = relaxed.t;
  relaxed.found.residual = HUGE_VAL;
  return std::move(relaxed.found);
}

void Searcher::remember(const Candidate& candidate, const Found& found) {
  constexpr std::size_t kMost = 4;  // budget: of those that are mended where time is over
  if (found.stopped || !found.feasible(options_.limit_tolerance)) return;
  Candidate begun;
  begun.problem = candidate.problem;
  begun.rough = candidate.rough;
  const auto better = [](const auto& a, const auto& b) { return a.second.objective < b.second.objective; };
  std::pair<Candidate, Found> known{std::move(begun), found};
  const auto at = std::upper_bound(known_.begin(), known_.end(), known, better);
  known_.insert(at, std::move(known));
  if (known_.size() > kMost) known_.pop_back();
}

Candidate Searcher::from_known() {
  Candidate candidate;
  candidate.stopped = true;
  // Where rounds that keep a track fast come to nothing, any track will do.
  for (const bool any : {false, true}) {
    for (const auto& [begun, known] : known_) {
      if (candidate.kept) break;
      candidate = begun;
      margins_ = known.rows->margins();
      Found found = known;
      found.stopped = true;
      control_.any_track = any;
      mend(candidate, exactly(*candidate.problem, std::move(found)));
      control_.any_track = false;
    }
  }
  return candidate;
}

Candidate Searcher::begun(const Passages& passages) {
  Candidate candidate;
  candidate.problem = std::make_shared<ScaledProblem>(scaled(problem_, passages));
  candidate.rough = std::make_shared<ScaledProblem>(roughly_scaled(problem_, passages));
  begin_margins(*candidate.problem);
  return candidate;
}

Candidate Searcher::begun_again(const Candidate& known) {
  Candidate candidate;
  candidate.problem = known.problem;
  candidate.rough = known.rough;
  begin_margins(*candidate.problem);
  return candidate;
}

double least_margin(const LimitSpec& limit) {
  return limit.measure == Measure::normal_load && limit.side < 0 ? kContactMargin : 0.0;
}

void Searcher::begin_margins(const ScaledProblem& problem) {
  const std::vector<LimitSpec>& limits = problem.limits;
  margins_.assign(limits.size(), 0.0);
  for (std::size_t i = 0; i < margins_.size(); ++i) margins_[i] = least_margin(limits[i]);
}

bool Searcher::is_unlimited() const {
  Limits limits;
  return problem_.limits == limits && problem_.finish.kind == FinishKind::point &&
         problem_.body.entry_speed == 0.0 && problem_.objective.kind == ObjectiveKind::travel_time &&
         is_sliding_point(problem_.body);
}

Mesh Searcher::mesh_again(const Found& found) {
  Mesh mesh = found.track->mesh();
  if (!found.track->has_fixed_pieces()) mesh.core_length = core_length_of(found);
  return mesh;
}

Mesh Searcher::mesh_with(const ScaledProblem& problem, Vector knots, double core_length) const {
  if (starts_with_crest(problem)) knots = with_crest_knots(knots);
  return mesh_of(problem, std::move(knots), core_length);
}

std::optional<Found> Searcher::from_exact(const ScaledProblem& problem, const GuessCurve& start) {
  const auto pieces = static_cast<std::size_t>(options_.pieces);
  const Mesh mesh = mesh_with(problem, graded_knots(start, pieces, 0.0), start.length);
  aim_at(kAimed * options_.tolerance, 8);
  Found found = minimise(problem, mesh, fit(start, Transcription(mesh)), margins_, control_);
  return found;
}

Searcher::Rough Searcher::coarse(const ScaledProblem& problem, const GuessCurve& start) {
  tell("coarse track", 0.0);
  aim_at(kCoarseTolerance, 5);
  Found found = coarsely(problem, start, kCoarsePieces);
  if (found.feasible(kNearlyFeasible) || found.stopped) return {std::move(found)};
  // The descent lost its way, or the mesh is too coarse: look for any track that keeps the limits first.
  const Mesh finer = mesh_with(
      problem, graded_knots(start, kRescuePieces, entry_share(problem, start.length)), start.length);
  control_.most_rounds = 6;
  return {rescued(problem, finer, fit(start, Transcription(finer))), true};
}

Found Searcher::coarsely(const ScaledProblem& problem, const GuessCurve& start, std::size_t pieces) {
  const Mesh mesh =
      mesh_with(problem, graded_knots(start, pieces, entry_share(problem, start.length)), start.length);
  return minimise(problem, mesh, fit(start, Transcription(mesh)), margins_, control_);
}

std::optional<Found> Searcher::rescued(const ScaledProblem& problem, const Mesh& mesh,
                                       const Vector& beginning) {
  const Relaxed relaxed =
      least_violation(problem, mesh, beginning, Elastic::all(problem.limits.size()), margins_, control_);
  if (relaxed.t > kNearlyFeasible) return std::nullopt;
  Found found = minimise(problem, mesh, relaxed.found.z, margins_, control_);
  if (!found.feasible(kNearlyFeasible)) return std::nullopt;
  return found;
}

void Searcher::refine(Candidate& candidate, Found found, bool unlimited) {
  finer_mesh_wins_.reset();
  moves_promise_ = 0.0;
  multipliers_ahead_.clear();
  if (unlimited) {
    mend(candidate, std::move(found));
    return;
  }
  const ScaledProblem& problem = *candidate.rough;
  found = laid_anew(problem, on_finer_meshes(problem, problem, std::move(found)));
  if (!is_behind(found, true)) settle(candidate, std::move(found));
}

bool Searcher::is_behind(const Found& found, bool on_finest) const {
  constexpr double kFar = 0.25;     // taste: of the objective; finer meshes win some 10 % at most
  constexpr double kFinest = 0.05;  // taste
  const double tolerance = on_finest ? options_.tolerance : kCoarseTolerance;
  const bool is_optimum = found.residual <= tolerance;
  if (!to_beat_ || !found.feasible(kNearlyFeasible) || (!on_finest && !is_optimum)) return false;
  const double share = on_finest && is_optimum ? kFinest : kFar;
  return found.objective > *to_beat_ + share * std::fabs(*to_beat_);
}

void Searcher::settle(Candidate& candidate, Found found) {
  const ScaledProblem& problem = *candidate.rough;
  finer_mesh_wins_.reset();
  moves_promise_ = 0.0;
  multipliers_ahead_.clear();
  remember(candidate, found);
  if (!found.stopped) found = held_between(problem, std::move(found));
  if (!found.stopped) found = with_far_jumps_moved(problem, std::move(found));
  if (!found.stopped) found = followed(problem, std::move(found));
  remember(candidate, found);
  if (!found.stopped) found = bent_at_finish(problem, std::move(found));
  if (!found.stopped) found = halved(problem, std::move(found));
  remember(candidate, found);
  std::optional<Found> moved;
  if (is_optimum(found) && !is_smooth(problem)) moved = with_jumps_at_rest(problem, found);
  const auto mend_on = [&](Candidate& end_of, Found end) {
    if (!end.stopped) end = laid_anew(problem, std::move(end));
    end_of.rough_found = end;
    mend(end_of, exactly(*end_of.problem, std::move(end)));
  };
  if (!moved) {
    mend_on(candidate, std::move(found));
    return;
  }
  // What it wins a limit between its stations may take again, or the last digits: the better optimum counts. The other one
  // is mended only where that may be the better: what is mended gets no better.
  Candidate other;
  other.problem = candidate.problem;
  other.rough = candidate.rough;
  mend_on(other, followed(problem, *moved));
  const bool is_good = other.kept && is_optimum(*other.found);
  if (!is_good || !(other.found->objective < found.objective)) {
    begin_margins(problem);
    mend_on(candidate, std::move(found));
  }
  const bool stopped = candidate.stopped || other.stopped;
  const bool takes = is_good && (!candidate.kept || other.found->objective < candidate.found->objective);
  if (takes) candidate = std::move(other);
  if (!is_good) candidate.promising = std::move(moved);
  candidate.stopped = stopped;
}

std::optional<Found> Searcher::with_jumps_at_rest(const ScaledProblem& problem, Found& found) {
  constexpr int kMostRounds = 4;         // budget
  constexpr int kMostEvaluations = 500;  // budget: a sixth of what a hard search takes
  constexpr double kFar = 1e-4;   // taste: of the objective; jumps that win less lie on a mesh that fits them
  constexpr double kPays = 1e-5;  // accuracy: ten times that of a time
  const auto move = [&] {
    found = with_tight_corners(problem, with_short_ramps(problem, std::move(found)));
    MovedKnots moves = with_moved_knots(problem, found, options_.tolerance, control_);
    moves_promise_ = moves.promised / std::fabs(found.objective);
    return std::move(moves.found);
  };
  std::optional<Found> moved = move();
  const int begun = control_.evaluations;
  double before = found.objective;
  for (int round = 0; round < kMostRounds && moved; ++round) {
    if (control_.stop() || control_.evaluations - begun > kMostEvaluations) break;
    if (!(before - moved->objective > (round == 0 ? kFar : kPays) * std::fabs(before))) break;
    before = moved->objective;
    // Where jumps lie elsewhere other pieces are too long, and what they win may be taken again between stations.
    Found next = halved(problem, held_between(problem, followed(problem, *moved)));
    if (!is_optimum(next)) break;
    const double promised = moves_promise_;
    std::swap(found, next);
    std::optional<Found> again = move();
    if (again && again->objective < before) {
      moved = std::move(again);
    } else if (found.objective < before) {
      moved = found;
    } else {
      moves_promise_ = promised;
      found = std::move(next);
      break;
    }
  }
  return moved;
}

Found Searcher::held_between(const ScaledProblem& problem, Found found) {
  constexpr int kMostRounds = 4;  // budget
  if (!is_optimum(found) || control_.any_track) return found;
  HeldPlaces held(found.track->mesh().extra_breaks);
  for (int round = 0; round < kMostRounds && !control_.stop(); ++round) {
    const Vector places = exceeded_caps_of(problem, found, options_.limit_tolerance);
    if (places.empty()) break;
    Mesh mesh = mesh_again(found);
    for (const double place : places) held.add(place, mesh.knots);
    mesh.extra_breaks = held.places();
    aim_at(kAimed * options_.tolerance, 3);
    Found next = laid_anew(problem, on_mesh(problem, mesh, found.z, found));
    if (!is_optimum(next)) break;
    found = std::move(next);
  }
  return found;
}

// On a mesh that follows no load yet it costs little, and what follows begins in the better valley.
Found Searcher::with_far_jumps_moved(const ScaledProblem& problem, Found found) {
  if (!is_optimum(found) || !can_free_spans(problem)) return found;
  KnotMoves moves;
  moves.worth = moves.far;
  std::optional<Found> moved = with_moved_knots(problem, found, options_.tolerance, control_, moves).found;
  return moved ? std::move(*moved) : found;
}

Found Searcher::exactly(const ScaledProblem& problem, Found found) {
  if (!problem.changes.empty()) return found;  // as exact as can be
  const std::function<bool()> stop = control_.stop;
  const bool stopped = found.stopped;
  // However near the end of the time: a step or two.
  if (stopped) control_.stop = [] { return false; };
  aim_at(kAimed * options_.tolerance, stopped ? 0 : 3);
  control_.is_close = true;
  Found next = minimise(problem, mesh_again(found), found.z, margins_, control_, &found);
  control_.is_close = false;
  control_.stop = stop;
  const bool arrives = is_optimum(next);
  if (!arrives && is_optimum(found)) next = on_mesh(problem, mesh_again(found), found.z, found);
  next.stopped = stopped || control_.stop();
  return next;
}

Found Searcher::on_mesh(const ScaledProblem& problem, const Mesh& mesh, const Vector& beginning,
                        const Found& known) {
  if (control_.any_track) return kept_on(problem, mesh, beginning);
  Found next = minimise(problem, mesh, beginning, margins_, control_, &known);
  const bool is_lost = !next.feasible(kNearlyFeasible) && known.feasible(kNearlyFeasible);
  if (next.stopped || !is_lost || control_.is_close) return next;
  std::optional<Found> other = rescued(problem, mesh, beginning);
  return other ? std::move(*other) : next;
}

Found Searcher::on_finer_meshes(const ScaledProblem& problem, const ScaledProblem& rough, Found found) {
  // A track that only a finer mesh could find is not taken back to a coarser one.
  const std::size_t begun = found.track->mesh().knots.size();
  const std::size_t pieces = std::max(static_cast<std::size_t>(options_.pieces), begun - 1);
  std::vector<std::size_t> levels;
  if (begun <= kMiddlePieces && pieces > kMiddlePieces) levels.push_back(kMiddlePieces);
  if (pieces > kFinerPieces) levels.push_back(kFinerPieces);
  levels.insert(levels.end(), 1 + kMovedLevels, pieces);
  const std::size_t usual = levels.size();
  levels.insert(levels.end(), kMoreLevels, pieces);
  double done = 0.2;
  int hopeless = 0;
  bool is_rough = true;
  for (std::size_t level = 0; level < levels.size() && !found.stopped; ++level) {
    const std::vector<Switch> switches = switches_of(problem, found);
    const bool last_ones = level + kMovedLevels >= usual;
    if (last_ones && settled(switches)) break;
    tell("finer track", done);
    done = std::min(0.9, done + 0.7 / static_cast<double>(usual));
    const bool finest = levels[level] == pieces;
    aim_at(finest ? kAimed * options_.tolerance : kCoarseTolerance, finest ? 3 : 5);
    const Mesh mesh = mesh_with(problem, refined_knots(*found.track, found.z, switches, levels[level]),
                                core_length_of(found));
    Found next = on_mesh(finest ? problem : rough, mesh,
                         fit(curve_of(*found.track, found.z), Transcription(mesh)), found);
    if (!next.feasible(kNearlyFeasible) && (next.stopped || found.feasible(kNearlyFeasible))) {
      // A mesh on which the search gets lost is no reason to give a track away.
      found.stopped = next.stopped;
      // On a mesh that the same track lays once more it ends where it has ended.
      while (level + 1 < levels.size() && levels[level + 1] == levels[level]) ++level;
      continue;
    }
    constexpr double kLess = 0.7;  // taste
    hopeless += !next.feasible(kHopeless) && next.violation > kLess * found.violation ? 1 : 0;
    const double dearer = next.objective - found.objective;
    const double size = std::fabs(found.objective);
    const bool pays = is_optimum(next) && dearer <= kDearer * size;
    if (last_ones && is_optimum(found) && !pays) break;
    // Where the places at which limits change over move without effect they need not be followed.
    const bool still = last_ones && is_optimum(found) && pays && std::fabs(dearer) <= kWithoutEffect * size;
    found = std::move(next);
    is_rough = !finest;
    const bool goes_on = level + 1 < usual || (pays && -dearer > kWinsMuch * size);
    if (still || hopeless > 1 || !goes_on) break;
  }
  if (!is_rough) return found;
  aim_at(kAimed * options_.tolerance, 3);
  return minimise(problem, found.track->mesh(), found.z, margins_, control_, &found);
}

Found Searcher::followed(const ScaledProblem& problem, Found found) {
  constexpr int kMostRounds = 3;  // budget
  constexpr double kPays = 1e-7;  // accuracy: below that of a time
  for (int round = 0; round < kMostRounds; ++round) {
    const std::optional<Mesh> mesh = following_limits(problem, found);
    if (!mesh) break;
    aim_at(kAimed * options_.tolerance, 0);
    Found next = minimise(problem, *mesh, found.z, margins_, control_, &found);
    if (next.stopped || next.residual > options_.tolerance || !next.feasible(options_.limit_tolerance)) break;
    const double won = found.objective - next.objective;
    found = std::move(next);
    if (std::fabs(won) < kPays * std::fabs(found.objective)) break;
  }
  return found;
}

Found Searcher::bent_at_finish(const ScaledProblem& problem, Found found) {
  constexpr double kPays = 1e-6;  // accuracy: that of a time
  if (problem.speed_weight == 0.0 || problem.lead_out > 0.0 || is_smooth(problem) || !is_optimum(found))
    return found;
  const MeshTrack finer = with_short_pieces_at_finish(*found.track, found.z);
  const Outlook outlook =
      look_ahead(problem, finer.mesh, finer.z, margins_, control_, found, RowsAhead::near);
  if (!(outlook.won > kPays * std::fabs(found.objective))) return found;
  aim_at(kAimed * options_.tolerance, 0);
  Found next = minimise(problem, finer.mesh, finer.z, margins_, control_, &found);
  return is_optimum(next) && next.objective < found.objective ? next : found;
}

Found Searcher::halved(const ScaledProblem& problem, Found found) {
  constexpr int kMostRounds = 6;  // budget
  // Under a limit on the rate of curvature no jump tells where knots belong: halving alone makes prices exact.
  const bool smooth = is_smooth(problem);
  // Along a highest load halving wins six to forty times what one program promises.
  constexpr double kLeftLoaded = 3e-8;  // measured: what is promised where two rounds more win less than 1e-6
  const double left_at_most = smooth ? 1e-8 : lies_at_highest_load(problem, found) ? kLeftLoaded : 1e-6;
  constexpr double kLostAtMost = 5e-7;      // accuracy: half that of a time
  constexpr std::size_t kMostPieces = 120;  // budget
  constexpr double kKept = 0.1;             // taste
  constexpr int kMostIdle = 1;     // budget: halves that win nothing by themselves may let the next ones
  constexpr double kSpread = 0.5;  // taste
  constexpr double kTold = 1e-5;   // accuracy: ten times that of a time
  constexpr std::size_t kMostSpread = 80;  // budget
  int idle = 0;
  double before = HUGE_VAL;
  for (int round = 0; round < kMostRounds; ++round) {
    const Remainder left = remainder_of(problem, found, control_);
    finer_mesh_wins_ = left.objective / std::fabs(found.objective);
    multipliers_ahead_ = left.by_limit;
    // What a curvature of few pieces breaks between its stations is followed by finer ones where nothing jumps.
    const bool breaks = smooth && left.lost > kLostAtMost * std::fabs(found.objective);
    if (!breaks && left.objective <= left_at_most * std::fabs(found.objective)) break;
    // A finer mesh never has so much left: where a program promises it, its step leads away from the track.
    constexpr double kMost = 0.01;  // taste: twice what any promised that kept part of it
    if (left.objective > kMost * std::fabs(found.objective)) break;
    if (found.track->mesh().knots.size() > kMostPieces) break;
    // A few pieces that promise the most of it, and win nothing, are not where it is to be won.
    const bool spread = smooth && found.track->mesh().knots.size() <= kMostSpread &&
                        left.objective > kSpread * std::max(before, kTold * std::fabs(found.objective));
    before = left.objective;
    const MeshTrack finer = breaks || spread ? with_all_halved(*found.track, found.z)
                                             : with_halved_pieces(*found.track, found.z, worth_halving(left));
    aim_at(kAimed * options_.tolerance, 0);
    Found next = minimise(problem, finer.mesh, finer.z, margins_, control_, &found);
    if (next.stopped || next.residual > options_.tolerance || !next.feasible(options_.limit_tolerance)) break;
    next = followed(problem, std::move(next));
    const double won = found.objective - next.objective;
    found = std::move(next);
    // What is promised again and again but not won is not there; prices may gain from it all the same.
    const bool pays = won >= kKept * left_at_most * std::fabs(found.objective);
    idle = pays ? 0 : idle + 1;
    if (!smooth && idle > kMostIdle) break;
  }
  return found;
}

Found Searcher::with_short_ramps(const ScaledProblem& problem, Found found) {
  const std::optional<MeshTrack> narrow = with_narrow_jumps(*found.track, found.z);
  if (!narrow) return found;
  aim_at(kAimed * options_.tolerance, 0);
  control_.is_close = true;
  Found next = minimise(problem, narrow->mesh, narrow->z, margins_, control_, &found);
  control_.is_close = false;
  return is_optimum(next) && next.objective < found.objective ? next : found;
}

Found Searcher::with_tight_corners(const ScaledProblem& problem, Found found) {
  constexpr int kMostRounds = 4;  // budget: each wins a quarter of what the one before did
  constexpr double kPays = 5e-7;  // accuracy: half that of a time
  for (int round = 0; round < kMostRounds && !control_.stop(); ++round) {
    const std::optional<MeshTrack> tighter = with_tighter_corners(*found.track, found.z);
    if (!tighter) break;
    aim_at(kAimed * options_.tolerance, 0);
    Found next = minimise(problem, tighter->mesh, tighter->z, margins_, control_, &found);
    if (!is_optimum(next) || !(next.objective < found.objective)) break;
    const double won = found.objective - next.objective;
    found = std::move(next);
    if (won < kPays * std::fabs(found.objective)) break;
  }
  return found;
}

Found Searcher::laid_anew(const ScaledProblem& problem, Found found) {
  constexpr int kMostRounds = 6;         // budget
  constexpr double kSameLength = 1e-10;  // accuracy: a hundredth of that of a limit
  if (problem.changes.empty()) return found;
  const auto passed_by = [&](double length) {
    return std::lower_bound(problem.changes.begin(), problem.changes.end(), length) - problem.changes.begin();
  };
  const auto passes_others = [&](const Found& known) {
    const double laid = problem.lead_in + known.track->mesh().core_length;
    const double length = problem.lead_in + core_length_of(known);
    return passed_by(laid) != passed_by(length) ||
           passed_by(laid + problem.lead_out) != passed_by(length + problem.lead_out);
  };
  const auto is_off = [&](const Found& known) {
    return passes_others(known) ||
           std::fabs(core_length_of(known) / known.track->mesh().core_length - 1.0) > kSameLength;
  };
  for (int round = 0; round < kMostRounds && !found.stopped && is_off(found); ++round) {
    const MeshTrack again = relaid(problem, found);
    aim_at(kAimed * options_.tolerance, 3);
    Found next = on_mesh(problem, again.mesh, again.z, found);
    if (!next.feasible(kNearlyFeasible)) break;
    found = std::move(next);
  }
  // Of a friction that is not that of the track nothing is proved.
  if (passes_others(found)) found.residual = HUGE_VAL;
  return found;
}

MeshTrack Searcher::relaid(const ScaledProblem& problem, const Found& found) const {
  const Transcription& track = *found.track;
  const Mesh& before = track.mesh();
  const auto shares_of = [&](const Vector& places) {
    Vector shares;
    // All of it is 1: shares that add up to a last digit less would leave places behind the last knot.
    for (const double sigma : places)
      shares.push_back(sigma == 1.0 ? 1.0 : std::min(track.share_of_core(found.z, sigma), 1.0));
    return shares;
  };
  MeshTrack again;
  again.mesh = mesh_with(problem, shares_of(before.knots), core_length_of(found));
  again.mesh.extra_breaks = shares_of(before.extra_breaks);
  if (again.mesh.knots.size() != before.knots.size()) {
    again.z = fit(curve_of(track, found.z), Transcription(again.mesh));
    return again;
  }
  const Layout& layout = track.layout();
  const double length = again.mesh.core_length;
  again.mesh.fine = shares_of(before.fine);
  again.z = found.z;
  again.z[layout.length()] = length;
  for (std::size_t i = 0; i < layout.knots; ++i) {
    const std::size_t piece = std::max(i, std::size_t{1}) - 1;
    again.z[layout.turn(i)] *= length / track.stretch(found.z, piece);
  }
  for (const FineKnot& fine : track.fine_knots()) {
    again.mesh.fine_turns.push_back(fine.turn * length / track.stretch(found.z, fine.piece));
  }
  return again;
}

void Searcher::take_if_better(Candidate& candidate, const Found& found, const CenterlinePtr& track,
                              const referee::Judgement& judgement) const {
  const bool kept = judgement.arrived && judgement.worst <= options_.limit_tolerance;
  const bool better = !candidate.found || (kept && !candidate.kept) ||
                      (kept == candidate.kept && found.objective < candidate.found->objective);
  if (!better) return;
  candidate.finer_mesh_wins = finer_mesh_wins_;
  candidate.moves_promise = moves_promise_;
  candidate.multipliers_ahead = multipliers_ahead_;
  candidate.found = found;
  candidate.track = track;
  candidate.judgement = judgement;
  candidate.kept = kept;
}

void Searcher::mend(Candidate& candidate, Found found, const Vector& places) {
  const ScaledProblem& problem = *candidate.problem;
  const std::function<bool()> stop = control_.stop;
  candidate.stopped = candidate.stopped || found.stopped;
  tell("referee", 0.9);
  HeldPlaces held(places);
  int rides_to_end = 0;  // of those that end early the rest is not known
  std::optional<int> grace_ends;
  for (int round = 0; round < kTighteningRounds; ++round) {
    const CenterlinePtr track = track_of(problem, found);
    const referee::Judgement judgement = referee::judge_track(problem_, track, referee::kRefereeSamples);
    take_if_better(candidate, found, track, judgement);
    const bool kept = judgement.arrived && judgement.worst <= options_.limit_tolerance;
    if (kept) break;
    if (found.stopped) {
      // Asked to end on a track that all but keeps its limits: a little more work makes it one that does.
      if (!found.feasible(kNearlyFeasible) || round >= kGraceRounds) break;
      if (!grace_ends) grace_ends = control_.evaluations + kGraceEvaluations;
      if (control_.evaluations > *grace_ends) break;
      control_.stop = [&] { return control_.evaluations > *grace_ends; };
    }
    if (round >= kPatientRounds && !found.feasible(kHopeless)) break;
    const auto share_of = [&](double place) { return found.track->sigma_at(found.z, place / problem.chord); };
    std::vector<LiftOff> lifts;
    if (judgement.lift_off) {
      lifts = lift_offs_of(problem, found);
      lifts.push_back({share_of(*judgement.lift_off), 0.0});
      const bool may_follow = round < kFollowingRounds && !found.stopped && !control_.any_track;
      if (auto next = may_follow ? following_closely(problem, found, lifts) : std::nullopt) {
        found = std::move(*next);
        continue;
      }
    }
    tighten(problem, judgement, lifts, rides_to_end);
    if (control_.any_track && !lifts.empty()) found = halved_at(lifts, found);
    Mesh mesh = mesh_again(found);
    for (const double place : places_to_hold(problem, judgement, rides_to_end))
      held.add(share_of(place), mesh.knots);
    for (const LiftOff& lift : lifts) {
      if (lift.depth > kShallow) held.add(lift.sigma, mesh.knots);
    }
    if (judgement.arrived) ++rides_to_end;
    mesh.extra_breaks = held.places();
    aim_at(kAimed * options_.tolerance, found.stopped ? kGraceEffort : 3);
    const bool stopped = found.stopped;
    Found next = laid_anew(problem, on_mesh(problem, mesh, found.z, found));
    if (round < kHalvingRounds) next = cheaper_of(problem, std::move(next), found, mesh);
    control_.stop = stop;
    next.stopped = next.stopped || stopped;
    // Where only short ways are gone, and none was, none will be; nor where no more is asked for than the round before.
    const bool is_same = next.z == found.z;
    const bool asks_same = is_same && asks_for_no_more(next, found);
    const bool tightens = rides_to_end > kHoldingRounds;
    const bool stays =
        is_same && (control_.is_close || (asks_same && tightens)) && !found.stopped && !is_optimum(next);
    // Places that are held already are no help.
    if (asks_same && judgement.arrived) rides_to_end = std::max(rides_to_end, kHoldingRounds);
    found = std::move(next);
    if (stays) break;
  }
  candidate.stopped = candidate.stopped || found.stopped;
}

Found Searcher::cheaper_of(const ScaledProblem& problem, Found next, const Found& found,
                           const Mesh& holding) {
  constexpr double kMuch = 5e-7;  // accuracy: half that of a time
  if (control_.any_track || control_.is_close || !is_optimum(found) || !is_optimum(next)) return next;
  if (!(next.objective - found.objective > kMuch * std::fabs(found.objective))) return next;
  std::vector<LiftOff> places;
  for (const double sigma : holding.extra_breaks) places.push_back({sigma, 0.0});
  const Found halved = halved_at(places, found);
  Mesh mesh = mesh_again(halved);
  mesh.extra_breaks = holding.extra_breaks;
  Found finer = laid_anew(problem, on_mesh(problem, mesh, halved.z, found));
  return is_optimum(finer) && finer.objective < next.objective ? finer : next;
}

Candidate Searcher::with_sharper_crest(Candidate best) {
  constexpr int kMostRounds = 8;    // budget
  constexpr double kPays = 5e-7;    // accuracy: half that of a time
  constexpr double kNearly = 1e-3;  // accuracy: half its square is half that of a time
  constexpr double kMuch = 2e-6;    // taste: worth a descent that takes its time
  const ScaledProblem& problem = *best.problem;
  if (!starts_with_crest(problem) || !best.kept || best.stopped || !is_optimum(*best.found)) return best;
  // One that the last digits keep from being an optimum may lead to one that is.
  Candidate last = best;
  for (int round = 0; round < kMostRounds; ++round) {
    const Found known = *last.found;
    const MeshTrack sharper = with_shorter_beginning(*known.track, known.z);
    const auto next_from = [&](bool is_close) {
      margins_ = known.rows->margins();
      aim_at(kAimed * options_.tolerance, 0);
      control_.is_close = is_close;
      Found next = minimise(problem, sharper.mesh, sharper.z, margins_, control_, &known);
      const bool goes_on = !next.stopped && next.residual <= kNearly && next.feasible(kNearlyFeasible) &&
                           next.objective < known.objective;
      last.kept = false;
      last.found.reset();
      if (goes_on) mend(last, next, sharper.mesh.extra_breaks);
      control_.is_close = false;
      return goes_on ? (known.objective - next.objective) / std::fabs(known.objective) : 0.0;
    };
    const auto is_sharper = [&](double residual) {
      return last.kept && !last.stopped && last.found->residual <= residual &&
             last.found->objective < known.objective;
    };
    double won = next_from(true);
    if (!is_sharper(kNearly) || (!is_sharper(options_.tolerance) && won > kMuch))
      won = std::max(won, next_from(false));
    // Each quarter wins half of what is left.
    if (is_sharper(options_.tolerance)) {
      last.finer_mesh_wins = best.finer_mesh_wins;
      last.moves_promise = best.moves_promise;
      best = last;
      best.sharper_crest_wins = won;
    } else {
      best.sharper_crest_wins = std::max(best.sharper_crest_wins, 2.0 * won);
    }
    if (!is_sharper(kNearly) || won < kPays) break;
  }
  return best;
}

std::optional<Found> Searcher::following_closely(const ScaledProblem& problem, const Found& found,
                                                 const std::vector<LiftOff>& lifts) {
  Vector lifting;
  for (const LiftOff& lift : lifts) lifting.push_back(lift.sigma);
  const std::optional<Mesh> closer = following_limits(problem, found, lifting);
  if (!closer || closer->fine.size() <= found.track->mesh().fine.size()) return std::nullopt;
  // Steps of our own stay in the valley mostly. Another one may be dearer, for which the load is no reason.
  aim_at(kAimed * options_.tolerance, 0);
  Found next = minimise(problem, *closer, found.z, margins_, control_, &found);
  const bool stays = next.objective <= found.objective + kElsewhere * std::fabs(found.objective);
  const bool takes = (next.stopped || stays) && next.feasible(options_.limit_tolerance);
  return takes ? std::optional(std::move(next)) : std::nullopt;
}

void Searcher::tighten(const ScaledProblem& problem, const referee::Judgement& judgement,
                       const std::vector<LiftOff>& lifts, int round) {
  for (std::size_t i = 0; i < problem.limits.size(); ++i) {
    const LimitSpec& limit = problem.limits[i];
    if (limit.side == 0) continue;
    const bool contact = limit.measure == Measure::normal_load && limit.side < 0;
    if (contact && judgement.lift_off) {
      double shallow = 0.0;
      for (const LiftOff& lift : lifts) {
        if (lift.depth <= kShallow) shallow = std::max(shallow, lift.depth);
      }
      margins_[i] = std::max(2.0 * margins_[i], margins_[i] + kTightening * shallow);
      continue;
    }
    const bool keeps_moving = limit.measure == Measure::arrival || limit.name.id == LimitId::no_choking;
    if (keeps_moving && judgement.stall) {
      margins_[i] = std::max(kStallMargin, 2.0 * margins_[i]);
      continue;
    }
    const bool load = is_highest_load(limit);
    if (round < kHoldingRounds && !load) continue;
    const LimitCheck* check = judgement.find(limit.name);
    if (check == nullptr) continue;
    const bool holds_peaks = load && round < kPeakRounds;
    const double violation =
        holds_peaks ? exceeded(judgement, limit.name).usual : check->violation / check->scale;
    if (violation > 0.5 * options_.limit_tolerance) margins_[i] += kTightening * violation;
  }
}

/// Where the referee found the ride ending, or in the first rounds limits broken the most: holding a limit
/// exactly there costs nothing, other than tightening it as a whole.
std::vector<double> Searcher::places_to_hold(const ScaledProblem& problem,
                                             const referee::Judgement& judgement, int round) const {
  std::vector<double> places;
  if (judgement.lift_off) places.push_back(*judgement.lift_off);
  if (judgement.stall) places.push_back(*judgement.stall);
  if (round >= kHoldingRounds) return places;
  for (const LimitSpec& limit : problem.limits) {
    if (!is_highest_load(limit) || round >= kPeakRounds) continue;
    for (const double where : exceeded(judgement, limit.name).peaks) places.push_back(where);
  }
  for (const referee::Broken& broken : judgement.broken) {
    const bool load = std::any_of(problem.limits.begin(), problem.limits.end(), [&](const LimitSpec& limit) {
      return limit.name == broken.limit && is_highest_load(limit);
    });
    if (!load && broken.violation > 0.5 * options_.limit_tolerance) places.push_back(broken.where);
  }
  return places;
}

}  // namespace glissade::optimizer
