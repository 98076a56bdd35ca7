// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/mounting_reader.hpp"

#include <string>
#include <utility>

#include "service/dds/wire/robot_names.hpp"

namespace qwsm::dds {

template <class Kind>
BasicMountingReader<Kind>::BasicMountingReader(const Participant& participant, Refusals& refusals)
    : refusals_(refusals),
      reader_(participant, kStaticTransformsTopic, Profile::kStaticTransforms) {}

template <class Kind>
void BasicMountingReader<Kind>::Take() {
  reader_.TakeAllWithSource([this](const wire::TFMessage& message, const Guid& source) {
    transforms_.Take(message, source);
  });
  if (is_told_ || reader_.unheard_writer_count() == 0) return;
  is_told_ = true;
  refusals_.Tell(std::string(kStaticTransformsTopic) +
                 ": a publisher is not heard, for it keeps nothing for those who come later: its "
                 "QoS has to be reliable and transient local, as that of ROS 2's "
                 "static_transform_publisher is");
}

template class BasicMountingReader<team::Planar>;
template class BasicMountingReader<team::Spatial>;

}  // namespace qwsm::dds
