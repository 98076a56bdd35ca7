// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/cloud_inbox.hpp"

#include "service/dds/service/service_inbox_definition.hpp"

namespace qwsm::dds {

template class ServiceInbox<team::CloudSession>;

}  // namespace qwsm::dds
