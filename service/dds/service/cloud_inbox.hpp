// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/dds/service/cloud_outbox.hpp"
#include "service/dds/service/service_inbox.hpp"
#include "service/team/service/cloud_service.hpp"

namespace qwsm::dds {

/// Brings the service for clouds what robots say.
using CloudInbox = ServiceInbox<team::Spatial, team::CloudService, CloudOutbox>;

extern template class ServiceInbox<team::Spatial, team::CloudService, CloudOutbox>;

}  // namespace qwsm::dds
