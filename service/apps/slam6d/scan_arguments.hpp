// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "service/apps/command.hpp"
#include "service/pipeline/slam6d/scan_series.hpp"

namespace slam6d::apps {

/// Adds the argument SCANS and those that say what of a bag is read: --points, --odom, --every.
void AddScanArguments(CLI::App& parser,
                      std::vector<std::filesystem::path>& scans,
                      qwsm::config::OptionSources& sources);

/// The scans that are meant; what is wrong with bags becomes messages.
/// @throws std::runtime_error where there are none.
std::vector<pipeline::ScanPlace> FindScans(const std::vector<std::filesystem::path>& scans,
                                           const io::CloudBagOptions& options);

/// Tells how bags were understood.
void TellOfBags(const std::vector<pipeline::ScanPlace>& places);

}  // namespace slam6d::apps
