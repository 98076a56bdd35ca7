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
constexpr double kLeastSigma_m = 1e-4;
constexpr double kLeastSigma_rad = 1e-5;

/// How far the scanner sees: nearly all points lie within, but for stray ones.
constexpr double kRangeShare = 0.95;

/// Only a quarter of the points lie beyond what is far off, and cubes are so many times as large as
/// the points lie apart there. (Twice as large is too large for things that stand about.)
constexpr double kFarShare = 0.75;
constexpr double kCubesPerSpacing = 1.3;

/// On the way round a loop more error gathers than from one scan to the next.
constexpr double kLoopSearchFactor = 2.0;

Matrix6d CovarianceOf(double sigma_m, double sigma_rad) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(sigma_m * sigma_m),
      Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  return variances.asDiagonal();
}

/// The distance within which this share of the points lies.
double RangeOf(const PointCloud& points, double share) {
  if (points.empty()) return 0.0;
  std::vector<double> ranges2_m2;
  ranges2_m2.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) ranges2_m2.push_back(points[i].squaredNorm());
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(points.size() - 1));
  const auto at = ranges2_m2.begin() + place;
  std::nth_element(ranges2_m2.begin(), at, ranges2_m2.end());
  return std::sqrt(*at);
}

PointCloud WithinRange(const PointCloud& scan, const SlamOptions& options) {
  const double max_range_m =
      options.max_range_m > 0.0 ? options.max_range_m : std::numeric_limits<double>::max();
  return InRange(scan, options.min_range_m, max_range_m);
}

/// How far the points lie apart where the scanner sees far.
double SpacingFarOff(const PointCloud& points, const RangeImage& image) {
  const double sr_per_point = image.seen_sr() / static_cast<double>(points.size());
  return std::sqrt(sr_per_point) * RangeOf(points, kFarShare);
}

/// Edge of the cubes by which a scan is to be thinned; 0 if it is not.
double VoxelFor(const PointCloud& points, const RangeImage& image, const SlamOptions& options) {
  const auto few = static_cast<std::size_t>(options.thin_above_points);
  if (options.reduction.voxel_m > 0.0 || few == 0 || points.size() <= few) {
    return options.reduction.voxel_m;
  }
  return kCubesPerSpacing * SpacingFarOff(points, image);
}

/// For guesses that are worse by a factor.
RegistrationOptions Widened(RegistrationOptions options, double factor) {
  OverlapOptions& search = options.guess;
  search.translation_range_m *= factor;
  search.rotation_range_rad = std::min(search.rotation_range_rad * factor, std::numbers::pi);
  options.icp.guess_sigma_m *= factor;
  options.icp.guess_sigma_rad *= factor;
  return options;
}

/// What dead reckoning may be off by from one scan to the next.
Matrix6d CovarianceOfGuess(const IcpOptions& options) {
  return CovarianceOf(options.guess_sigma_m, options.guess_sigma_rad);
}

Matrix6d CovarianceOf(const IcpResult& result) {
  return result.covariance + CovarianceOf(kLeastSigma_m, kLeastSigma_rad);
}

RegistrationOptions HowToRegister(const SlamOptions& options) {
  return {.icp = options.icp, .guess = options.guess, .evidence = options.evidence};
}

/// The same covariance along the axes of another frame.
Matrix6d Turned(const Eigen::Matrix3d& R_a_b, const Matrix6d& covariance_b) {
  const Matrix6d R = BlockRotation(R_a_b);
  return R * covariance_b * R.transpose();
}

}  // namespace

Pose3 ExtrapolateOdometry(const Pose3& T_map_last,
                          const Pose3& T_odom_last,
                          const Pose3& T_odom_scan) {
  return T_map_last * (T_odom_last.Inverse() * T_odom_scan);
}

Slam::Slam(const SlamOptions& options, const LoopCloser& closer)
    : options_(options), closer_(closer) {}

SlamStep Slam::Add(const PointCloud& scan, const Pose3& T_odom_scan) {
  const PointCloud all = WithinRange(scan, options_);
  RangeImage image(all);
  ReductionOptions reduction = options_.reduction;
  reduction.voxel_m = VoxelFor(all, image, options_);
  const PointCloud points = Reduce(all, reduction);
  SlamStep step{.T_map_scan = T_odom_scan, .voxel_m = reduction.voxel_m, .points = points.size()};
  if (!graph_.T_map_scan.empty()) {
    step.T_map_scan = ExtrapolateOdometry(graph_.T_map_scan.back(), T_odom_last_, T_odom_scan);
  }
  T_odom_last_ = T_odom_scan;
  Entry entry{.range_m = RangeOf(points, kRangeShare),
              .model = ScanModel(points, options_.tree),
              .image = std::move(image)};
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

PlacedScan Slam::Placed(std::size_t scan) const {
  const Entry& entry = *entries_[scan];
  return {.model = &entry.model, .image = &entry.image, .T_map_scan = graph_.T_map_scan[scan]};
}

Registration Slam::Register(std::span<const std::size_t> references,
                            const PlacedScan& cur,
                            const RegistrationOptions& options) const {
  std::vector<PlacedScan> placed;
  for (const std::size_t scan : references) placed.push_back(Placed(scan));
  return RegisterScan(placed, cur, options);
}

std::vector<std::size_t> Slam::LastUsable(int count) const {
  std::vector<std::size_t> scans;
  for (std::size_t scan = entries_.size(); scan-- > 0 && std::ssize(scans) < count;) {
    if (entries_[scan]) scans.push_back(scan);
  }
  return scans;
}

void Slam::Match(const Entry& entry, SlamStep& step) {
  const std::vector<std::size_t> references = LastUsable(options_.references);
  if (references.empty()) {
    step.status = SlamStatus::kFirst;
    return;
  }
  const PlacedScan cur{.model = &entry.model, .image = &entry.image, .T_map_scan = step.T_map_scan};
  const Registration match = Register(references, cur, HowToRegister(options_));
  step.match = match.icp;
  step.overlap = match.agreement.Overlap();
  step.contradiction = match.agreement.Contradiction();
  step.status = match.convinces ? SlamStatus::kMatched : SlamStatus::kDeadReckoned;
  if (match.convinces) step.T_map_scan = match.icp.T_ref_cur;
  const Matrix6d covariance =
      match.convinces ? CovarianceOf(match.icp) : CovarianceOfGuess(options_.icp);
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

/// Nüchter et al. (2007), section 3.4: hypotheses from range and pose, registered; the error of
/// each loop found is spread over all scans.
void Slam::CloseLoops(SlamStep& step) {
  const std::size_t scan = entries_.size() - 1;
  const Entry& cur = *entries_[scan];
  const RegistrationOptions how = Widened(HowToRegister(options_), kLoopSearchFactor);
  for (const std::size_t earlier : LoopHypotheses(graph_.T_map_scan, cur.range_m, options_.loop)) {
    if (!entries_[earlier]) continue;
    const Registration match = Register(std::span(&earlier, 1), Placed(scan), how);
    if (!match.convinces) continue;
    Constrain(earlier, scan, {match.icp.T_ref_cur, CovarianceOf(match.icp)});
    const Matrix6d covariance = ByLastConstraint().covariance;
    if (covariance.trace() < covariances_[scan].trace()) covariances_[scan] = covariance;
    graph_.T_map_scan = closer_.Close(graph_);
    step.loops_to.push_back(earlier);
  }
}

RefinementResult Slam::Refine(const RefinementObserver& observer) {
  if (!options_.refinement.enabled) return {.T_map_scan = graph_.T_map_scan};
  std::vector<IcpReference> scans;
  for (std::size_t scan = 0; scan < entries_.size(); ++scan) {
    const std::optional<Entry>& entry = entries_[scan];
    scans.push_back(
        {.model = entry ? &entry->model : nullptr, .T_map_ref = graph_.T_map_scan[scan]});
  }
  RefinementResult result = RefineModel(scans, options_.icp, options_.refinement, observer);
  graph_.T_map_scan = result.T_map_scan;
  return result;
}

}  // namespace slam6d
