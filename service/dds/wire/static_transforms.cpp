// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/static_transforms.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <utility>

#include "qwsm/geometry/position.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "slam6d/geometry/position.hpp"

namespace qwsm::dds {
namespace {

constexpr std::size_t kMaxStatements = 10'000;  // Of any sane team; more is an attack.

bool IsName(const char* frame) { return strnlen(frame, kMaxNameLength + 1) <= kMaxNameLength; }

}  // namespace

template <class Kind>
void BasicStaticTransforms<Kind>::Take(const wire::TFMessage& message, const Guid& source) {
  for (std::uint32_t i = 0; i < message.transforms._length; ++i) {
    const wire::TransformStamped& transform = message.transforms._buffer[i];
    const auto& p = transform.transform.translation;
    const wire::Quaternion& rotation = transform.transform.rotation;
    const Pose T_parent_child = OnWire<Kind>::PoseOf({{p.x, p.y, p.z}, rotation});
    if (!IsName(transform.header.frame_id) || !IsName(transform.child_frame_id)) continue;
    if (!IsPosition(T_parent_child) || !OnWire<Kind>::IsRotation(rotation)) continue;
    Take(transform.child_frame_id,
         {.source = source,
          .parent = transform.header.frame_id,
          .T_parent_child = T_parent_child,
          .rotation = {rotation.x, rotation.y, rotation.z, rotation.w},
          .translation_m = {p.x, p.y, p.z},
          .is_upright = OnWire<Kind>::IsUpright(rotation)});
  }
}

template <class Kind>
void BasicStaticTransforms<Kind>::Take(const std::string& child, Link link) {
  const auto known = links_.find(child);
  if (known != links_.end()) {
    statements_ -=
        std::erase_if(known->second, [&](const Link& old) { return old.source == link.source; });
  }
  if (statements_ >= kMaxStatements) return;
  links_[child].push_back(std::move(link));
  ++statements_;
}

template <class Kind>
bool BasicStaticTransforms<Kind>::IsAwaited(const std::string& frame,
                                            const std::set<Guid>& own) const {
  const auto told = links_.find(frame);
  const auto has_spoken = [&](const Guid& source) {
    return told != links_.end() &&
           std::ranges::find(told->second, source, &Link::source) != told->second.end();
  };
  const std::set<Guid> speakers = speakers_ ? speakers_() : std::set<Guid>{};
  return std::ranges::any_of(
      own, [&](const Guid& source) { return speakers.contains(source) && !has_spoken(source); });
}

/// The links from a frame up to its ancestor; nothing where there is no such way.
template <class Kind>
auto BasicStaticTransforms<Kind>::WayTo(const std::string& ancestor,
                                        const std::string& frame,
                                        const std::set<Guid>& own) const
    -> std::optional<std::vector<const Link*>> {
  std::vector<const Link*> way;
  const std::string* current = &frame;
  // A circle of frames ends after as many steps as there are frames.
  for (std::size_t step = 0; step <= links_.size(); ++step) {
    if (*current == ancestor) return way;
    const auto told = links_.find(*current);
    if (told == links_.end()) return std::nullopt;
    const std::vector<Link>& links = told->second;
    const auto by_own = std::find_if(links.rbegin(), links.rend(), [&own](const Link& link) {
      return own.contains(link.source);
    });
    way.push_back(by_own != links.rend() ? &*by_own : &links.back());
    current = &way.back()->parent;
  }
  return std::nullopt;
}

template <class Kind>
std::optional<typename Kind::Pose> BasicStaticTransforms<Kind>::Find(
    const std::string& ancestor, const std::string& frame, const std::set<Guid>& own) const {
  const auto way = WayTo(ancestor, frame, own);
  if (!way) return std::nullopt;
  if (!std::ranges::all_of(*way, &Link::is_upright)) {
    const InSpace place = Along(*way);
    const Eigen::Vector3d& p = place.origin_m;
    const Quaternion& q = place.rotation;
    const wire::Pose pose{.position = {p.x(), p.y(), p.z()}, .orientation = {q.x, q.y, q.z, q.w}};
    if (!OnWire<Kind>::IsLevel(pose.orientation)) return std::nullopt;
    return OnWire<Kind>::PoseOf(pose);
  }
  std::optional<Pose> T_current_frame;
  for (const Link* link : *way) {
    // One step is taken as it is: a product would round.
    const Pose& T_parent_current = link->T_parent_child;
    T_current_frame = T_current_frame ? T_parent_current * *T_current_frame : T_parent_current;
  }
  return T_current_frame.value_or(Pose{});
}

template <class Kind>
std::optional<Quaternion> BasicStaticTransforms<Kind>::FindRotation(
    const std::string& ancestor, const std::string& frame, const std::set<Guid>& own) const {
  const auto way = WayTo(ancestor, frame, own);
  if (!way) return std::nullopt;
  return Along(*way).rotation;
}

template <class Kind>
std::optional<double> BasicStaticTransforms<Kind>::FindHeight_m(const std::string& ancestor,
                                                                const std::string& frame,
                                                                const std::set<Guid>& own) const {
  const auto way = WayTo(ancestor, frame, own);
  if (!way) return std::nullopt;
  return Along(*way).origin_m.z();
}

template <class Kind>
auto BasicStaticTransforms<Kind>::Along(const std::vector<const Link*>& way) -> InSpace {
  InSpace place;
  for (const Link* link : way) {
    const Quaternion& q = link->rotation;
    const Eigen::Quaterniond turn = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
    place.origin_m = turn * place.origin_m + link->translation_m;
    place.rotation = q * place.rotation;
  }
  return place;
}

template class BasicStaticTransforms<team::Planar>;
template class BasicStaticTransforms<team::Spatial>;

}  // namespace qwsm::dds
