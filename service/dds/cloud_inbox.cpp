// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/cloud_inbox.hpp"

#include "service/dds/service_inbox.inc"

namespace qwsm::dds {

template class ServiceInbox<team::Spatial, team::CloudService, CloudOutbox>;

}  // namespace qwsm::dds
