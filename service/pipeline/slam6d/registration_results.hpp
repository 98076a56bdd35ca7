// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "service/pipeline/report/report_page.hpp"
#include "service/pipeline/results/results_folder.hpp"
#include "service/pipeline/slam6d/registration.hpp"

namespace slam6d::pipeline {

/// What a registration leaves for people to look at.
struct RegistrationPictures {
  bool drawn = true;  ///< Whether there are pictures, and a report if there is a title.
  std::optional<qwsm::pipeline::RunTitle> title{};
};

/// Writes what a registration is to leave behind: trajectory, poses for 3DTK, table, figures, the
/// merged cloud, and pictures of it before and after.
/// @throws qwsm::io::WriteError where something cannot be written.
void WriteResults(const Registration& registration,
                  const options::RegistrationOptions& options,
                  const qwsm::pipeline::ResultsFolder& folder,
                  const RegistrationPictures& pictures = {});

/// The figures of metrics.json; every name ends in its unit.
qwsm::pipeline::Json MetricsOf(const Registration& registration);

/// The figures of a registration for people, a line per fact.
std::string SummaryText(const Registration& registration);

}  // namespace slam6d::pipeline
