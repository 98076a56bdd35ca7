// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/mode_probability.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <numbers>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {
namespace {

// The best wrong pose explains two points of three: four of these it does not, which is less likely
// than anything a prediction makes up for.
constexpr std::size_t kManyPoints = 12;
// A point where the map has nothing, beside one on a surface: few scans show much that is new.
constexpr double kOnNothing = 0.01;
// Points beside each other are of one trunk, and scans of one trunk follow each other: each tells
// so much of what it would tell alone.
constexpr double kToldByPoint = 0.6;
// What the likelihoods of the map blur.
constexpr double kBlur_m = 0.1;
constexpr double kBlur_rad = 0.02;
constexpr double kNegligible = 1e-5;
constexpr double kSameMode_chi2 = 36.0;
constexpr int kSamples = 300;

// The n-th number of the sequence of van der Corput, which fills 0..1 evenly.
double RadicalInverse(int n, int base) {
  double digit = 1.0;
  double inverse = 0.0;
  for (; n > 0; n /= base) {
    digit /= base;
    inverse += digit * (n % base);
  }
  return inverse;
}

using Samples = std::array<Eigen::Vector3d, kSamples>;

// Of the standard normal law, spread evenly (Halton 1960; Box & Muller 1958).
Samples MakeStandardNormalSamples() {
  Samples samples;
  for (int i = 0; i < kSamples; ++i) {
    const int n = i + 1;
    const double radius = std::sqrt(-2.0 * std::log(RadicalInverse(n, 2)));
    const double angle = 2.0 * std::numbers::pi * RadicalInverse(n, 3);
    const double other_radius = std::sqrt(-2.0 * std::log(RadicalInverse(n, 5)));
    const double other_angle = 2.0 * std::numbers::pi * RadicalInverse(n, 7);
    samples[static_cast<std::size_t>(i)] = {
        radius * std::cos(angle), radius * std::sin(angle), other_radius * std::cos(other_angle)};
  }
  return samples;
}

class NormalLaw {
 public:
  explicit NormalLaw(const UncertainPose2& pose)
      : mean_(pose.T_a_b), root_(pose.covariance.llt().matrixL()) {}

  Pose2 At(const Eigen::Vector3d& standard) const {
    const Eigen::Vector3d away = root_.triangularView<Eigen::Lower>() * standard;
    return {mean_.x_m + away.x(), mean_.y_m + away.y(), NormalizeAngle(mean_.theta_rad + away.z())};
  }

  double SquaredSigmas(const Pose2& pose) const {
    return root_.triangularView<Eigen::Lower>().solve(Difference(pose, mean_)).squaredNorm();
  }

  // So many squared sigmas away from the mean, up to a factor that all laws share.
  double Density(double squared_sigmas) const {
    return std::exp(-0.5 * squared_sigmas) / root_.diagonal().prod();
  }

 private:
  Pose2 mean_;
  Eigen::Matrix3d root_;
};

NormalLaw AroundAnswer(const MatchResult& match) {
  UncertainPose2 answer = UncertainPose2::WithSigmas(match.T_ref_cur, kBlur_m, kBlur_rad);
  answer.covariance += match.covariance;
  return NormalLaw(answer);
}

// Of a point that ends in a cell of each likelihood.
using PointLikelihoods = std::array<double, 256>;

PointLikelihoods MakePointLikelihoods() {
  PointLikelihoods likelihoods;
  for (std::size_t i = 0; i < likelihoods.size(); ++i) {
    const double explained = static_cast<double>(i) / static_cast<double>(likelihoods.size() - 1);
    likelihoods[i] = std::pow(std::lerp(kOnNothing, 1.0, explained), kToldByPoint);
  }
  return likelihoods;
}

double LikelihoodOf(std::span<const ScanPoint> points,
                    const LikelihoodPyramid& map,
                    const Pose2& T_map_robot) {
  static const PointLikelihoods kOfPoint = MakePointLikelihoods();
  const RigidTransform2 to_map(T_map_robot);
  double likelihood = 1.0;
  for (const ScanPoint& point : points) {
    const GridCell cell = map.CellAt(to_map * point.p_robot_m);
    likelihood *= kOfPoint[map.LikelihoodAt(0, cell.x, cell.y)];
    if (likelihood < kNegligible) break;  // Most samples explain nothing.
  }
  return likelihood;
}

}  // namespace

double ProbabilityOfMode(const LikelihoodPyramid& map,
                         std::span<const ScanPoint> points,
                         const MatchResult& match) {
  static const Samples kStandardNormal = MakeStandardNormalSamples();
  const bool allows_others = match.predicted.covariance.determinant() > 0.0;
  if (points.size() >= kManyPoints || !allows_others) return 1.0;
  const NormalLaw predicted(match.predicted);
  const NormalLaw answer = AroundAnswer(match);
  double there = 0.0;
  double elsewhere = 0.0;
  for (const NormalLaw& law : {predicted, answer}) {
    for (const Eigen::Vector3d& standard : kStandardNormal) {
      const Pose2 pose = law.At(standard);
      const double prior = predicted.Density(predicted.SquaredSigmas(pose));
      const double from_answer = answer.SquaredSigmas(pose);
      const double weight =
          LikelihoodOf(points, map, pose) * prior / (prior + answer.Density(from_answer));
      (from_answer < kSameMode_chi2 ? there : elsewhere) += weight;
    }
  }
  return there / (there + elsewhere);
}

}  // namespace qwsm
