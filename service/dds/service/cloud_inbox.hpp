// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/dds/service/service_inbox.hpp"
#include "service/team/service/cloud_session.hpp"

namespace qwsm::dds {

/// Brings the service for clouds what robots say.
using CloudInbox = ServiceInbox<team::CloudSession>;

extern template class ServiceInbox<team::CloudSession>;

}  // namespace qwsm::dds
