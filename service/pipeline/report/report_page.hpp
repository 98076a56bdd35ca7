// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "service/pipeline/text/json.hpp"

namespace qwsm::pipeline {

/// What a report says at its top of the run it tells of.
struct RunTitle {
  std::string command;              ///< Command that was run: "qwsm map".
  std::string version;              ///< Version of the program.
  std::vector<std::string> inputs;  ///< Names of what was read, as the user gave them.
  bool interrupted = false;         ///< Whether there would have been more.
};

/// The members of a report's data that tell of the run: `command`, `version`, `inputs`, ...
Json ReportData(const RunTitle& title);

/// A report as text of HTML, complete in itself: it fetches nothing, and can be opened from disk.
/// What stands in the data is data there, whatever it says: it is never taken for HTML.
/// @param data begun by ReportData(); the page draws itself from it.
std::string ReportPage(const RunTitle& title, const Json& data);

/// Writes ReportPage() as the file of that name. @throws io::WriteError.
void WriteReportPage(const std::filesystem::path& path, const RunTitle& title, const Json& data);

/// Bytes as text of 64 letters (RFC 4648).
std::string Base64(std::string_view bytes);
/// Numbers as Base64() of their single-precision bytes, little endian: a third of their digits.
std::string Base64(std::span<const float> numbers);

}  // namespace qwsm::pipeline
