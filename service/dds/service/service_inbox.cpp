// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/service_inbox_definition.hpp"

namespace qwsm::dds {

template class ServiceInbox<team::RobotSession>;

}  // namespace qwsm::dds
