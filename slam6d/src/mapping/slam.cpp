// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/mapping/slam.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "slam6d/src/algebra/decompositions.hpp"

namespace slam6d {
namespace {

/// Fewer different points leave a motion open under every metric.
constexpr std::size_t kLeastPoints = 3;

/// No registration is better than this, whatever its pairs say.
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

struct ThinnedScan {
  double voxel_m = 0.0;  ///< Edge of the cubes; 0 if it was not thinned.
  PointCloud points;
  ScanModel model;
};

/// Thins a scan. Cubes that are no larger than a surface is thick leave pieces as thick as wide, of
/// which none is flat: where nobody chose them, they are doubled as long as more pieces become so.
ThinnedScan Thin(const PointCloud& all, const RangeImage& image, const SlamOptions& options) {
  ReductionOptions reduction = options.reduction;
  reduction.voxel_m = VoxelFor(all, image, options);
  const auto thin = [&](const PointCloud& cloud) {
    PointCloud points = Reduce(cloud, reduction);
    ScanModel model(points, options.tree);
    return ThinnedScan{reduction.voxel_m, std::move(points), std::move(model)};
  };
  ThinnedScan scan = thin(all);
  const bool is_chosen = reduction.voxel_m == options.reduction.voxel_m;
  while (!is_chosen) {
    reduction.voxel_m *= 2.0;
    ThinnedScan coarser = thin(scan.points);
    if (coarser.model.surfels.surfels.size() <= scan.model.surfels.surfels.size()) break;
    scan = std::move(coarser);
  }
  return scan;
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

/// What odometry may be off by at the end of a way, along the axes of the map. It goes astray in
/// its direction all along the way, a little at a time (a random walk), so the end is off by that
/// and to the side: the slope that odometry in the plane knows nothing of lifts a robot by a metre.
Matrix6d CovarianceOfOdometry(const Eigen::Vector3d& way_m, const IcpOptions& options) {
  const double variance_rad2 = options.guess_sigma_rad * options.guess_sigma_rad;
  const Eigen::Matrix3d lever = -Skew(way_m);
  Matrix6d covariance = GuessCovariance(options);
  covariance.topLeftCorner<3, 3>() += variance_rad2 / 3.0 * lever * lever.transpose();
  covariance.topRightCorner<3, 3>() = variance_rad2 / 2.0 * lever;
  covariance.bottomLeftCorner<3, 3>() = variance_rad2 / 2.0 * lever.transpose();
  return covariance;
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

/// Where the error of a scan comes from that was matched: from its references, and from the scan
/// before it by odometry, in proportion to what each of these tells.
ErrorOrigin OriginOf(const IcpResult& match,
                     std::span<const std::size_t> references,
                     std::size_t scan,
                     const Matrix6d& guess_covariance) {
  ErrorOrigin origin{.scan = scan, .shares = {}, .covariance = CovarianceOf(match)};
  const Matrix6d odometry = InverseOf(guess_covariance);
  Matrix6d sum = odometry;
  for (const Matrix6d& told : match.told_by_references) sum += told;
  const Matrix6d mean = InverseOf(sum);
  origin.shares.push_back({.of = scan - 1, .weight = mean * odometry});
  for (std::size_t i = 0; i < references.size(); ++i) {
    origin.shares.push_back({.of = references[i], .weight = mean * match.told_by_references[i]});
  }
  return origin;
}

/// The same along the scan's own axes.
ErrorOrigin AlongOwnAxes(ErrorOrigin origin_map, const Eigen::Matrix3d& R_map_scan) {
  const Eigen::Matrix3d R_scan_map = R_map_scan.transpose();
  origin_map.covariance = Turned(R_scan_map, origin_map.covariance);
  for (ErrorOrigin::Share& share : origin_map.shares) {
    share.weight = Turned(R_scan_map, share.weight);
  }
  return origin_map;
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
  ThinnedScan thinned = Thin(all, image, options_);
  SlamStep step{
      .T_map_scan = T_odom_scan, .voxel_m = thinned.voxel_m, .points = thinned.points.size()};
  Eigen::Vector3d way_m = Eigen::Vector3d::Zero();
  if (!graph_.T_map_scan.empty()) {
    const Pose3& T_map_last = graph_.T_map_scan.back();
    step.T_map_scan = ExtrapolateOdometry(T_map_last, T_odom_last_, T_odom_scan);
    way_m = step.T_map_scan.translation_m - T_map_last.translation_m;
  }
  T_odom_last_ = T_odom_scan;
  Entry entry{.range_m = RangeOf(thinned.points, kRangeShare),
              .model = std::move(thinned.model),
              .image = std::move(image)};
  const bool usable = entry.model.tree.size() >= kLeastPoints;
  const PlacedScan cur{.model = &entry.model, .image = &entry.image, .T_map_scan = step.T_map_scan};
  const Matrix6d guess_covariance = CovarianceOfOdometry(way_m, options_.icp);
  if (usable) step.status = Match(cur, guess_covariance, step);
  graph_.T_map_scan.push_back(step.T_map_scan);
  ConstrainLast(step, guess_covariance);
  entries_.emplace_back();
  if (usable) {
    entries_.back() = std::move(entry);
    CloseLoops(step);
  }
  step.T_map_scan = graph_.T_map_scan.back();
  step.covariance = recent_.Of(entries_.size() - 1);
  return step;
}

PlacedScan Slam::Placed(std::size_t scan) const {
  const Entry& entry = *entries_[scan];
  return {.model = &entry.model, .image = &entry.image, .T_map_scan = graph_.T_map_scan[scan]};
}

Registration Slam::Register(std::span<const std::size_t> references,
                            const PlacedScan& cur,
                            const Matrix6d& guess_covariance,
                            const RegistrationOptions& options) const {
  std::vector<PlacedScan> placed;
  for (const std::size_t scan : references) placed.push_back(Placed(scan));
  return RegisterScan(placed, cur, guess_covariance, options);
}

std::vector<std::size_t> Slam::LastUsable(int count) const {
  std::vector<std::size_t> scans;
  for (std::size_t scan = entries_.size(); scan-- > 0 && std::ssize(scans) < count;) {
    if (entries_[scan]) scans.push_back(scan);
  }
  return scans;
}

SlamStatus Slam::Match(const PlacedScan& cur,
                       const Matrix6d& guess_covariance,
                       SlamStep& step) const {
  const std::vector<std::size_t> references = LastUsable(options_.references);
  if (references.empty()) return SlamStatus::kFirst;
  const Registration match = Register(references, cur, guess_covariance, HowToRegister(options_));
  step.match = match.icp;
  step.overlap = match.agreement.Overlap();
  step.told = match.agreement.told();
  step.contradiction = match.agreement.Contradiction();
  step.open_motions = match.open_motions;
  if (!match.convinces) return SlamStatus::kDeadReckoned;
  step.T_map_scan = match.icp.T_ref_cur;
  return SlamStatus::kMatched;
}

/// Keeps what was found out about the pose of the last scan relative to that of `from`.
void Slam::Constrain(std::size_t from, const UncertainPose3& T_map_last) {
  const Pose3& T_map_from = graph_.T_map_scan[from];
  graph_.constraints.push_back(
      {.from = from,
       .to = graph_.T_map_scan.size() - 1,
       .T_from_to = T_map_from.Inverse() * T_map_last.T_a_b,
       .covariance = Turned(T_map_from.rotation.transpose(), T_map_last.covariance)});
}

/// Ties the last scan to those before it, and finds out how uncertain it is.
void Slam::ConstrainLast(const SlamStep& step, const Matrix6d& guess_covariance) {
  const std::size_t scan = graph_.T_map_scan.size() - 1;
  if (scan == 0) return;
  ErrorOrigin origin{.scan = scan, .shares = {{.of = scan - 1}}, .covariance = guess_covariance};
  std::size_t from = scan - 1;
  if (step.status == SlamStatus::kMatched) {
    const std::vector<std::size_t> references = LastUsable(options_.references);
    origin = OriginOf(step.match, references, scan, guess_covariance);
    from = references.front();
  }
  Constrain(from, {step.T_map_scan, origin.covariance});
  origins_.push_back(AlongOwnAxes(origin, step.T_map_scan.rotation));
  recent_ = Kept(WithNext(recent_, origins_.back(), graph_.T_map_scan), LastScans());
}

/// The scans on which the next one will hang, if the last one is usable; and the last one.
std::vector<std::size_t> Slam::LastScans() const {
  std::vector<std::size_t> scans = LastUsable(options_.references);
  scans.push_back(graph_.T_map_scan.size() - 1);
  return scans;
}

/// Nüchter et al. (2007), section 3.4: hypotheses from range and pose, registered; the error of
/// each loop found is spread over all scans.
void Slam::CloseLoops(SlamStep& step) {
  const std::size_t scan = entries_.size() - 1;
  const Entry& cur = *entries_[scan];
  const RegistrationOptions how = Widened(HowToRegister(options_), kLoopSearchFactor);
  for (const std::size_t earlier : LoopHypotheses(graph_.T_map_scan, cur.range_m, options_.loop)) {
    if (!entries_[earlier]) continue;
    const Registration match =
        Register(std::span(&earlier, 1), Placed(scan), GuessCovariance(how.icp), how);
    if (!match.convinces) continue;
    const ErrorOrigin origin{
        .scan = scan, .shares = {{.of = earlier}}, .covariance = CovarianceOf(match.icp)};
    Constrain(earlier, {match.icp.T_ref_cur, origin.covariance});
    origins_.push_back(AlongOwnAxes(origin, match.icp.T_ref_cur.rotation));
    graph_.T_map_scan = closer_.Close(graph_);
    step.loops_to.push_back(earlier);
  }
  if (step.loops_to.empty()) return;
  recent_ = CovarianceBy(origins_, graph_.T_map_scan, LastScans());
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
