// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>

#include "service/dds/wire/wire_kind.hpp"

namespace qwsm::dds {

/// What /tf_static says: where frames sit in their parent frames.
/// @tparam Kind of the poses: in the plane, from which tilted frames cannot be reached, or in
/// space.
template <class Kind>
class BasicStaticTransforms {
 public:
  using Pose = typename Kind::Pose;

  /// Takes all that makes sense; transforms that do not are passed over.
  void Take(const wire::TFMessage& message);

  /// Where a frame sits on another, over any number of steps; nothing where that is not known, or
  /// not in the plane.
  std::optional<Pose> Find(const std::string& ancestor, const std::string& frame) const;

 private:
  struct Link {
    std::string parent;
    Pose T_parent_child;
    bool is_usable = true;
  };

  std::map<std::string, Link> links_;  // By child.
};

using StaticTransforms = BasicStaticTransforms<team::Planar>;
using SpatialTransforms = BasicStaticTransforms<team::Spatial>;

extern template class BasicStaticTransforms<team::Planar>;
extern template class BasicStaticTransforms<team::Spatial>;

}  // namespace qwsm::dds
