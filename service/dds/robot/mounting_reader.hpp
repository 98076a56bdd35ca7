// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/dds/entities/reader.hpp"
#include "service/dds/wire/refusals.hpp"
#include "service/dds/wire/static_transforms.hpp"

namespace qwsm::dds {

/// Hears what /tf_static says.
/// @tparam Kind of the poses, see BasicStaticTransforms.
template <class Kind>
class BasicMountingReader {
 public:
  /// @param participant and refusals outlive this.
  BasicMountingReader(const Participant& participant, Refusals& refusals);

  /// Takes what has arrived, and tells once of publishers that are not heard.
  void Take();
  const BasicStaticTransforms<Kind>& transforms() const { return transforms_; }
  Entity::Handle handle() const { return reader_.handle(); }

 private:
  Refusals& refusals_;
  Reader<wire::TFMessage> reader_;
  BasicStaticTransforms<Kind> transforms_{[this] { return reader_.Participants(); }};
  bool is_told_ = false;
};

extern template class BasicMountingReader<team::Planar>;
extern template class BasicMountingReader<team::Spatial>;

}  // namespace qwsm::dds
