// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "service/pipeline/report/report_page.hpp"
#include "service/pipeline/slam6d/registration.hpp"

namespace slam6d::pipeline {

/// Writes the report of a registration as one page of HTML that needs no other file, with up to
/// 150 000 of the points, evenly taken from all scans. @throws qwsm::io::WriteError.
void WriteRegistrationPage(const std::filesystem::path& path,
                           const qwsm::pipeline::RunTitle& title,
                           const Registration& registration);

}  // namespace slam6d::pipeline
