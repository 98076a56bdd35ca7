// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "qwsm/geometry/quaternion.hpp"
#include "service/dds/entities/participant.hpp"
#include "service/dds/wire/wire_kind.hpp"

namespace qwsm::dds {

/// Holds what /tf_static says: where frames sit in their parent frames, and who says so.
/// @tparam Kind of the poses: in the plane, from which tilted frames cannot be reached, or in
/// space.
template <class Kind>
class BasicStaticTransforms {
 public:
  using Pose = typename Kind::Pose;

  using Speakers = std::function<std::set<Guid>()>;

  /// Starts with no transforms.
  /// @param speakers the participants that publish them at the moment.
  explicit BasicStaticTransforms(Speakers speakers = {}) : speakers_(std::move(speakers)) {}

  /// Takes all transforms of a message that make sense; the others are passed over.
  /// @param source the participant that says so.
  void Take(const wire::TFMessage& message, const Guid& source);

  /// Whether somebody who publishes transforms, and whose word counts, has not spoken of a frame.
  bool IsAwaited(const std::string& frame, const std::set<Guid>& own) const;

  /// Whether there are frames of which more than one participant tells.
  bool has_rivals() const { return statements_ > links_.size(); }

  /// Where a frame sits on another, over any number of steps; nothing where that is not known, or
  /// not in the plane, upright or upside down. Of several who tell of one frame the last one
  /// counts.
  /// @param own participants who count before all others.
  std::optional<Pose> Find(const std::string& ancestor,
                           const std::string& frame,
                           const std::set<Guid>& own = {}) const;

  /// How a frame is turned on another, tilted ones as well; see Find().
  std::optional<Quaternion> FindRotation(const std::string& ancestor,
                                         const std::string& frame,
                                         const std::set<Guid>& own = {}) const;

  /// How high the origin of a frame is above another's, tilted ones as well; see Find().
  std::optional<double> FindHeight_m(const std::string& ancestor,
                                     const std::string& frame,
                                     const std::set<Guid>& own = {}) const;

 private:
  /// What one participant says of a frame.
  struct Link {
    Guid source{};
    std::string parent;
    Pose T_parent_child;
    Quaternion rotation;
    Eigen::Vector3d translation_m;
    bool is_upright = true;
  };

  /// A frame on another, in space.
  struct InSpace {
    Quaternion rotation;
    Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  };

  void Take(const std::string& child, Link link);
  static InSpace Along(const std::vector<const Link*>& way);
  std::optional<std::vector<const Link*>> WayTo(const std::string& ancestor,
                                                const std::string& frame,
                                                const std::set<Guid>& own) const;

  Speakers speakers_;
  std::map<std::string, std::vector<Link>> links_;  // Links by child frame; the newest is last.
  std::size_t statements_ = 0;
};

using StaticTransforms = BasicStaticTransforms<team::Planar>;
using SpatialTransforms = BasicStaticTransforms<team::Spatial>;

extern template class BasicStaticTransforms<team::Planar>;
extern template class BasicStaticTransforms<team::Spatial>;

}  // namespace qwsm::dds
