// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/mapping/slam.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace slam6d {
namespace {

/// Fewer different points leave a motion open under every metric.
constexpr std::size_t kLeastPoints = 3;

/// The covariance of a registration assumes independent errors; nothing is better than this.
constexpr double kLeastSigma_m = 1e-3;
constexpr double kLeastSigma_rad = 1e-4;

/// The search tries motions within its ranges; a registration from there may lead so many times as
/// far.
constexpr double kReachFactor = 2.0;

/// On the way round a loop more error gathers than from one scan to the next.
constexpr double kLoopSearchFactor = 2.0;

/// Where planes failed, points are first paired so many times farther off than else: a turn of 15
/// degrees moves what is 5 m away by more than the usual pair is long, and ICP stops on the way.
constexpr double kWidePairsFactor = 3.0;

Matrix6d CovarianceOf(double sigma_m, double sigma_rad) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(sigma_m * sigma_m),
      Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  return variances.asDiagonal();
}

/// How far the scanner saw: all but the last few of the points, which may be stray.
double RangeOf(const PointCloud& points) {
  if (points.empty()) return 0.0;
  std::vector<double> ranges2_m2;
  ranges2_m2.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) ranges2_m2.push_back(points[i].squaredNorm());
  const auto at = ranges2_m2.begin() + static_cast<std::ptrdiff_t>(ranges2_m2.size() * 95 / 100);
  std::nth_element(ranges2_m2.begin(), at, ranges2_m2.end());
  return std::sqrt(*at);
}

PointCloud Prepare(const PointCloud& scan, const SlamOptions& options) {
  const double max_range_m =
      options.max_range_m > 0.0 ? options.max_range_m : std::numeric_limits<double>::max();
  return Reduce(InRange(scan, options.min_range_m, max_range_m), options.reduction);
}

OverlapOptions Widened(OverlapOptions options, double factor) {
  options.translation_range_m *= factor;
  options.rotation_range_rad = std::min(options.rotation_range_rad * factor, std::numbers::pi);
  return options;
}

/// What dead reckoning may be off by from one scan to the next.
Matrix6d CovarianceOfGuess(const IcpOptions& options) {
  return CovarianceOf(options.guess_sigma_m, options.guess_sigma_rad);
}

Matrix6d CovarianceOf(const IcpResult& result) {
  return result.covariance + CovarianceOf(kLeastSigma_m, kLeastSigma_rad);
}

/// Whether a registration stayed near the guess. What slides farther found other surfaces.
bool IsWithinReach(const Pose3& T_map_guess, const Pose3& T_map_cur, const OverlapOptions& search) {
  const Pose3 T_guess_cur = T_map_guess.Inverse() * T_map_cur;
  return T_guess_cur.translation_m.norm() <= kReachFactor * search.translation_range_m &&
         RotationAngle(T_guess_cur.rotation) <= kReachFactor * search.rotation_range_rad;
}

/// The same covariance along the axes of another frame.
Matrix6d Turned(const Eigen::Matrix3d& R_a_b, const Matrix6d& covariance_b) {
  const Matrix6d R = BlockRotation(R_a_b);
  return R * covariance_b * R.transpose();
}

bool HasPose(const IcpResult& result) {
  return result.status == IcpStatus::kConverged || result.status == IcpStatus::kIterationLimit;
}

}  // namespace

std::string_view Name(SlamStatus status) {
  constexpr std::array<std::string_view, 4> kNames{"first", "matched", "dead-reckoned", "unusable"};
  return kNames[static_cast<std::size_t>(status)];
}

Pose3 ExtrapolateOdometry(const Pose3& T_map_last,
                          const Pose3& T_odom_last,
                          const Pose3& T_odom_scan) {
  return T_map_last * (T_odom_last.Inverse() * T_odom_scan);
}

Slam::Slam(const SlamOptions& options, const LoopCloser& closer)
    : options_(options), closer_(closer) {}

SlamStep Slam::Add(const PointCloud& scan, const Pose3& T_odom_scan) {
  const PointCloud points = Prepare(scan, options_);
  SlamStep step{.T_map_scan = T_odom_scan, .points = points.size()};
  if (!graph_.T_map_scan.empty()) {
    step.T_map_scan = ExtrapolateOdometry(graph_.T_map_scan.back(), T_odom_last_, T_odom_scan);
  }
  T_odom_last_ = T_odom_scan;
  Entry entry{.range_m = RangeOf(points),
              .model = ScanModel(points, options_.tree),
              .overlap = OverlapModel(points, options_.guess),
              .metric = options_.icp.metric};
  const bool usable = entry.model.tree.size() >= kLeastPoints;
  if (!graph_.T_map_scan.empty()) {
    step.covariance = covariances_.back() + CovarianceOfGuess(options_.icp);
  }
  if (usable) Match(entry, step);
  graph_.T_map_scan.push_back(step.T_map_scan);
  covariances_.push_back(step.covariance);
  entries_.emplace_back();
  if (!usable) return step;
  entries_.back() = std::move(entry);
  CloseLoops(step);
  step.T_map_scan = graph_.T_map_scan.back();
  step.covariance = covariances_.back();
  return step;
}

std::vector<IcpReference> Slam::ModelsOf(std::span<const std::size_t> scans) const {
  std::vector<IcpReference> models;
  for (const std::size_t scan : scans) {
    models.push_back({.model = &entries_[scan]->model, .T_map_ref = graph_.T_map_scan[scan]});
  }
  return models;
}

/// Nüchter et al. (2007), sections 3.2 and 3.3. ICP comes first here, and the octrees are asked for
/// a better guess only where it does not convince: they cost four times as much as all the rest of
/// a scan
/// (`slam6d register --set slam.guess.needed_below=1` asks them every time).
Slam::Registration Slam::Register(std::span<const std::size_t> references,
                                  const Entry& cur,
                                  const Pose3& T_map_cur_guess,
                                  const OverlapOptions& search,
                                  const IcpOptions& icp) const {
  const std::vector<IcpReference> models = ModelsOf(references);
  std::vector<OverlapReference> cubes;
  for (const std::size_t scan : references) {
    cubes.push_back({.model = &entries_[scan]->overlap, .T_map_ref = graph_.T_map_scan[scan]});
  }
  const auto align = [&](const Pose3& T_map_cur) {
    Registration result{.icp = Align(models, cur.model, T_map_cur, icp)};
    result.overlap = Overlap(cubes, cur.overlap, result.icp.T_ref_cur, search);
    result.trusted = HasPose(result.icp) && result.overlap >= options_.min_overlap &&
                     IsWithinReach(T_map_cur_guess, result.icp.T_ref_cur, search);
    return result;
  };
  const Registration first = align(T_map_cur_guess);
  if (first.trusted && first.overlap >= search.needed_below) return first;
  const OverlapGuess guess = GuessByOverlap(cubes, cur.overlap, T_map_cur_guess, search);
  const Registration second = align(guess.T_map_cur);
  if (first.trusted != second.trusted) return first.trusted ? first : second;
  // Sliding back along a corridor makes more cubes overlap, but fewer surfaces agree.
  const bool is_better = second.overlap > first.overlap && second.icp.pairs > first.icp.pairs;
  return is_better ? second : first;
}

/// Points find together from farther off than planes, which are asked again from there. Among
/// trees, where the little that is flat leads astray, points have the last word.
Slam::Registration Slam::RegisterByPoints(std::span<const std::size_t> references,
                                          Entry& cur,
                                          const Pose3& T_map_cur_guess,
                                          const Registration& by_planes) const {
  IcpOptions icp = options_.icp;
  icp.metric = IcpMetric::kPointToPoint;
  icp.max_distance_m *= kWidePairsFactor;
  const IcpResult coarse = Align(ModelsOf(references), cur.model, T_map_cur_guess, icp);
  const Pose3 T_map_cur = IsWithinReach(T_map_cur_guess, coarse.T_ref_cur, options_.guess)
                              ? coarse.T_ref_cur
                              : T_map_cur_guess;
  icp.max_distance_m = options_.icp.max_distance_m;
  const Registration by_points = Register(references, cur, T_map_cur, options_.guess, icp);
  if (!by_points.trusted) return by_planes;
  const Registration again =
      Register(references, cur, by_points.icp.T_ref_cur, options_.guess, options_.icp);
  if (again.trusted && again.overlap > by_points.overlap) return again;
  cur.metric = IcpMetric::kPointToPoint;
  return by_points;
}

std::vector<std::size_t> Slam::LastUsable(int count) const {
  std::vector<std::size_t> scans;
  for (std::size_t scan = entries_.size(); scan-- > 0 && std::ssize(scans) < count;) {
    if (entries_[scan]) scans.push_back(scan);
  }
  return scans;
}

void Slam::Match(Entry& entry, SlamStep& step) {
  const std::vector<std::size_t> references = LastUsable(options_.references);
  if (references.empty()) {
    step.status = SlamStatus::kFirst;
    return;
  }
  Registration match = Register(references, entry, step.T_map_scan, options_.guess, options_.icp);
  if (!match.trusted && options_.icp.metric != IcpMetric::kPointToPoint) {
    match = RegisterByPoints(references, entry, step.T_map_scan, match);
  }
  step.match = match.icp;
  step.overlap = match.overlap;
  step.status = match.trusted ? SlamStatus::kMatched : SlamStatus::kDeadReckoned;
  if (match.trusted) step.T_map_scan = match.icp.T_ref_cur;
  const Matrix6d covariance =
      match.trusted ? CovarianceOf(match.icp) : CovarianceOfGuess(options_.icp);
  Constrain(references.front(), entries_.size(), {step.T_map_scan, covariance});
  step.covariance = ByLastConstraint().covariance;
}

UncertainPose3 Slam::Uncertain(std::size_t scan) const {
  return {.T_a_b = graph_.T_map_scan[scan], .covariance = covariances_[scan]};
}

/// What the constraint found last says of the later of its scans.
UncertainPose3 Slam::ByLastConstraint() const {
  const PoseConstraint& last = graph_.constraints.back();
  return Uncertain(last.from) * UncertainPose3{last.T_from_to, last.covariance};
}

/// Keeps what was found out about the pose of scan `to` relative to that of `from`.
void Slam::Constrain(std::size_t from, std::size_t to, const UncertainPose3& T_map_to) {
  const Pose3& T_map_from = graph_.T_map_scan[from];
  graph_.constraints.push_back(
      {.from = from,
       .to = to,
       .T_from_to = T_map_from.Inverse() * T_map_to.T_a_b,
       .covariance = Turned(T_map_from.rotation.transpose(), T_map_to.covariance)});
}

/// Nüchter et al. (2007), section 3.4: hypotheses from range and pose, revised by the octrees, then
/// registered; the error of each loop found is spread over all scans.
void Slam::CloseLoops(SlamStep& step) {
  const std::size_t scan = entries_.size() - 1;
  const Entry& cur = *entries_[scan];
  const OverlapOptions search = Widened(options_.guess, kLoopSearchFactor);
  IcpOptions icp = options_.icp;
  icp.metric = cur.metric;
  for (const std::size_t earlier : LoopHypotheses(graph_.T_map_scan, cur.range_m, options_.loop)) {
    if (!entries_[earlier]) continue;
    const Registration match =
        Register(std::span(&earlier, 1), cur, graph_.T_map_scan[scan], search, icp);
    if (!match.trusted || match.overlap < options_.loop.min_overlap) continue;
    Constrain(earlier, scan, {match.icp.T_ref_cur, CovarianceOf(match.icp)});
    const Matrix6d covariance = ByLastConstraint().covariance;
    if (covariance.trace() < covariances_[scan].trace()) covariances_[scan] = covariance;
    graph_.T_map_scan = closer_.Close(graph_);
    step.loops_to.push_back(earlier);
  }
}

RefinementResult Slam::Refine(const RefinementObserver& observer) {
  if (!options_.refinement.enabled) return {.T_map_scan = graph_.T_map_scan};
  std::vector<ModelScan> scans;
  for (std::size_t scan = 0; scan < entries_.size(); ++scan) {
    ModelScan model{.scan = {.model = nullptr, .T_map_ref = graph_.T_map_scan[scan]}};
    if (entries_[scan]) {
      model.scan.model = &entries_[scan]->model;
      model.metric = entries_[scan]->metric;
    }
    scans.push_back(model);
  }
  RefinementResult result = RefineModel(scans, options_.icp, options_.refinement, observer);
  graph_.T_map_scan = result.T_map_scan;
  return result;
}

}  // namespace slam6d
