// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "qwsm/mapping/scan_map.hpp"
#include "service/team/atlas/map_agreement.hpp"
#include "service/team/atlas/teammate_sight.hpp"

namespace qwsm::team {

/// How one map lies in another one, beyond doubt.
struct Joint {
  UncertainPose2 a_b;
  double nats = 0.0;  ///< What speaks for it, against its being a place that looks alike.
};

/// The places where one component of a team's map may lie in another one. Robots that look around
/// propose them; what decides is all that both maps show there, and whether robots saw each other
/// where they would have been in view. Maps show more of it as they grow.
class JointCandidates {
 public:
  /// Places of at least this probability, as a robot sees it, are worth being proposed.
  static constexpr double kWorthALook = 0.1;

  /// Takes a place that a robot thought of. @param T_b_robot where the robot was.
  void Propose(const UncertainPose2& a_b, const Pose2& T_b_robot);

  /// Weighs all places anew of which the maps may show more than they did.
  /// @param others all other maps of which it is not known how they lie in these.
  /// @return the place where the two lie beyond doubt, leading all others; none once it is stopped.
  std::optional<Joint> Decide(const MapAgreement& agreement,
                              const DrawnMap& a,
                              const DrawnMap& b,
                              std::span<const DrawnMap> others,
                              const std::stop_token& stop);

 private:
  struct Candidate {
    UncertainPose2 a_b;
    Pose2 T_b_robot;        // Who proposed it; turns about there move little of what was seen.
    double nats = 0.0;      // Evidence for it, against its being a place that looks alike.
    std::size_t scans = 0;  // Of both maps, when it was weighed.
    // That robots which were in view of each other there saw each other, or did not.
    double sight_nats = 0.0;
    Eigen::Vector2d least_known = Eigen::Vector2d::UnitX();
    // What is left of the evidence in a building that is as alike as the maps show it, by so many
    // scans of both.
    double nats_among_echoes = 0.0;
    std::size_t scans_among_echoes = 0;
    // Whether one of so many others may lie there as well, by so many scans of all.
    bool has_rival = false;
    std::size_t others = 0;
    std::size_t scans_among_others = 0;

    double Total() const { return nats + sight_nats; }
  };

  static void WeighOne(const MapAgreement& agreement,
                       const DrawnMap& a,
                       const DrawnMap& b,
                       Candidate& candidate,
                       const std::stop_token& stop);
  static bool IsSamePlace(const Candidate& one, const Candidate& other);
  bool Weigh(const MapAgreement& agreement,
             const DrawnMap& a,
             const DrawnMap& b,
             const std::stop_token& stop);
  bool HasLeader() const;
  static void Contest(const MapAgreement& agreement,
                      const ScanMap& a,
                      const ScanMap& b,
                      Candidate& candidate,
                      const std::stop_token& stop);
  static void LookForRivals(const MapAgreement& agreement,
                            const DrawnMap& a,
                            const DrawnMap& b,
                            std::span<const DrawnMap> others,
                            Candidate& candidate,
                            const std::stop_token& stop);
  static bool IsRival(const MapAgreement& agreement,
                      const DrawnMap& third,
                      const DrawnMap& a,
                      const DrawnMap& b,
                      const UncertainPose2& a_b,
                      double nats,
                      const std::stop_token& stop);
  void KeepBest();

  std::vector<Candidate> candidates_;  // The best one first.
};

}  // namespace qwsm::team
