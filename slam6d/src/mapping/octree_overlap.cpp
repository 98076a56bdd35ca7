// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/mapping/octree_overlap.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "slam6d/cloud/octree.hpp"
#include "slam6d/src/mapping/sample.hpp"

namespace slam6d {
namespace {

constexpr std::uint64_t kFree = ~std::uint64_t{0};

std::uint64_t KeyOf(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  return x | y << 21U | z << 42U;
}

/// Fibonacci hashing (Knuth 1973, section 6.4).
std::uint64_t Hash(std::uint64_t key) { return (key * 0x9e3779b97f4a7c15U) >> 20U; }

/// The occupied cubes of a level, each once.
std::vector<std::uint64_t> KeysOf(const Octree& octree, int level) {
  std::vector<std::uint64_t> keys;
  const auto shift = static_cast<unsigned>(level);
  for (std::size_t cube = 0; cube < octree.size(); ++cube) {
    const CubePlace& place = octree.place(cube);
    const std::uint64_t key = KeyOf(place[0] >> shift, place[1] >> shift, place[2] >> shift);
    // In the order of the octree the parts of a larger cube follow each other.
    if (keys.empty() || keys.back() != key) keys.push_back(key);
  }
  return keys;
}

/// The occupied cubes of one level of all references.
class Level {
 public:
  Level(std::span<const OverlapReference> references, std::size_t level) {
    for (const OverlapReference& reference : references) {
      members_.push_back({&reference.model->levels()[level], reference.T_map_ref.Inverse()});
    }
  }

  double cube_m() const { return members_.front().cubes->cube_m(); }

  /// How many of the points fall into cubes; where they are no more than `enough`, any number that
  /// is not more either.
  std::size_t Count(const std::vector<Eigen::Vector3d>& points_m,
                    const Pose3& T_map_cur,
                    std::size_t enough) const {
    std::size_t count = 0;
    std::size_t left = points_m.size();
    for (const Eigen::Vector3d& point_m : points_m) {
      if (count + left <= enough) break;
      count += Contains(T_map_cur * point_m) ? 1 : 0;
      --left;
    }
    return count;
  }

 private:
  struct Member {
    const CubeSet* cubes;
    Pose3 T_ref_map;
  };

  bool Contains(const Eigen::Vector3d& point_map_m) const {
    return std::ranges::any_of(members_, [&](const Member& member) {
      return member.cubes->Contains(member.T_ref_map * point_map_m);
    });
  }

  std::vector<Member> members_;
};

/// The best motion so far and the nested loops around it.
class Search {
 public:
  Search(const std::vector<Eigen::Vector3d>& points_m, const Pose3& T_map_cur)
      : points_m_(points_m), best_(T_map_cur) {}

  /// Tries all motions of so many steps either way along each of (x, y, z, roll, pitch, yaw).
  void TryAround(const Level& cubes, const Eigen::Array<int, 6, 1>& reach, const Vector6d& step) {
    const Pose3 center = best_;
    overlapping_ = cubes.Count(points_m_, center, 0);
    Eigen::Array<int, 6, 1> steps = -reach;
    for (int axis = 0; axis < 6;) {
      Try(cubes, center, steps.cast<double>().matrix().cwiseProduct(step));
      for (axis = 0; axis < 6 && ++steps(axis) > reach(axis); ++axis) steps(axis) = -reach(axis);
    }
  }

  const Pose3& best() const { return best_; }
  std::size_t tried() const { return tried_; }

 private:
  void Try(const Level& cubes, const Pose3& center, const Vector6d& motion) {
    // The scanner moves, then turns where it stands.
    const Pose3 T_map_cur{.rotation = RotationFromRollPitchYaw(motion.tail<3>()) * center.rotation,
                          .translation_m = center.translation_m + motion.head<3>()};
    const std::size_t count = cubes.Count(points_m_, T_map_cur, overlapping_);
    ++tried_;
    if (count <= overlapping_) return;
    overlapping_ = count;
    best_ = T_map_cur;
  }

  const std::vector<Eigen::Vector3d>& points_m_;
  Pose3 best_;
  std::size_t overlapping_ = 0;
  std::size_t tried_ = 0;
};

/// No scanner sees so many times as far as most of what it sees: the rest are stray points, which
/// count as if they were no farther off.
constexpr double kStrayRatio = 100.0;

double RadiusOf(const std::vector<Eigen::Vector3d>& means_m) {
  if (means_m.empty()) return 0.0;
  std::vector<double> ranges2_m2;
  for (const Eigen::Vector3d& mean_m : means_m) ranges2_m2.push_back(mean_m.squaredNorm());
  std::vector<double> sorted_m2 = ranges2_m2;
  const auto middle = sorted_m2.begin() + static_cast<std::ptrdiff_t>(sorted_m2.size() / 2);
  std::ranges::nth_element(sorted_m2, middle);
  const double most_m2 = kStrayRatio * kStrayRatio * *middle;
  double sum_m2 = 0.0;
  for (const double range2_m2 : ranges2_m2) sum_m2 += std::min(range2_m2, most_m2);
  return std::sqrt(sum_m2 / static_cast<double>(means_m.size()));
}

/// More steps to a side no search needs about a scanner that stands among its points. Where these
/// are in another frame, far from its origin, every turn moves them by many cubes.
constexpr double kMostSearchSteps = 1000.0;

int StepsIn(double range, double step) {
  return static_cast<int>(std::min(std::ceil(range / step), kMostSearchSteps));
}

}  // namespace

CubeSet::CubeSet(const Eigen::Vector3d& origin_m, double cube_m, std::vector<std::uint64_t> keys)
    : origin_m_(origin_m), cube_m_(cube_m) {
  table_.assign(std::bit_ceil(2 * keys.size() + 1), kFree);
  mask_ = table_.size() - 1;
  for (const std::uint64_t key : keys) {
    std::uint64_t slot = Hash(key) & mask_;
    while (table_[slot] != kFree) slot = (slot + 1) & mask_;
    table_[slot] = key;
  }
}

bool CubeSet::Contains(const Eigen::Vector3d& point_m) const {
  const Eigen::Vector3d cubes = (point_m - origin_m_) / cube_m_;
  if (!(cubes.minCoeff() >= 0.0 && cubes.maxCoeff() < Octree::kMaxCubes)) return false;
  const CubePlace place = PlaceOf(point_m, origin_m_, cube_m_);
  const std::uint64_t key = KeyOf(place[0], place[1], place[2]);
  std::uint64_t slot = Hash(key) & mask_;
  while (table_[slot] != kFree && table_[slot] != key) slot = (slot + 1) & mask_;
  return table_[slot] == key;
}

OverlapModel::OverlapModel(const PointCloud& cloud, const OverlapOptions& options) {
  const Octree octree(cloud, options.cube_m);
  for (int level = 0; level < std::max(options.levels, 1); ++level) {
    levels_.emplace_back(octree.origin_m(), octree.cube_m(level), KeysOf(octree, level));
  }
  for (std::size_t cube = 0; cube < octree.size(); ++cube) {
    const auto points = octree.points(cube);
    Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
    for (const std::uint32_t i : points) mean_m += cloud[i] / static_cast<double>(points.size());
    means_m_.push_back(mean_m);
  }
  radius_m_ = RadiusOf(means_m_);
}

double Overlap(std::span<const OverlapReference> references,
               const OverlapModel& cur,
               const Pose3& T_map_cur,
               const OverlapOptions& options) {
  if (cur.means_m().empty()) return 0.0;
  const std::vector<Eigen::Vector3d> sample =
      Sample(cur.means_m(), static_cast<std::size_t>(options.max_cubes));
  return static_cast<double>(Level(references, 0).Count(sample, T_map_cur, 0)) /
         static_cast<double>(sample.size());
}

OverlapGuess GuessByOverlap(std::span<const OverlapReference> references,
                            const OverlapModel& cur,
                            const Pose3& T_map_cur_guess,
                            const OverlapOptions& options) {
  const double overlap = Overlap(references, cur, T_map_cur_guess, options);
  OverlapGuess guess{.T_map_cur = T_map_cur_guess, .overlap = overlap};
  if (options.levels == 0 || references.empty() || !(cur.radius_m() > 0.0)) return guess;
  const std::vector<Eigen::Vector3d> sample =
      Sample(cur.means_m(), static_cast<std::size_t>(options.max_cubes));
  Search search(sample, T_map_cur_guess);
  const auto coarsest = static_cast<std::size_t>(options.levels) - 1;
  for (std::size_t level = coarsest + 1; level-- > 0;) {
    const Level cubes(references, level);
    const double turn_rad = cubes.cube_m() / cur.radius_m();
    Vector6d step;
    step << Eigen::Vector3d::Constant(cubes.cube_m()), Eigen::Vector3d::Constant(turn_rad);
    Eigen::Array<int, 6, 1> reach = Eigen::Array<int, 6, 1>::Ones();
    // The wide search is that of a robot on the ground; the finer levels look to all sides.
    if (level == coarsest) {
      const int moves = StepsIn(options.translation_range_m, cubes.cube_m());
      reach << moves, moves, 0, 0, 0, StepsIn(options.rotation_range_rad, turn_rad);
    }
    search.TryAround(cubes, reach, step);
  }
  guess.motions_tried = search.tried();
  const double found = Overlap(references, cur, search.best(), options);
  if (found <= (1.0 + options.min_gain) * overlap) return guess;
  guess.T_map_cur = search.best();
  guess.overlap = found;
  return guess;
}

}  // namespace slam6d
