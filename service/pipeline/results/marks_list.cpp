// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/marks_list.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <string>

#include "service/pipeline/results/result_file.hpp"

namespace qwsm::pipeline {

std::vector<io::PointOfInterest> PointsOf(std::span<const team::Mark> marks) {
  std::vector<team::Mark> sorted = team::Merged(marks);
  std::erase_if(sorted, [](const team::Mark& mark) { return mark.is_removed; });
  std::ranges::sort(sorted, {}, &team::Mark::number);
  std::vector<io::PointOfInterest> points;
  for (const team::Mark& mark : sorted) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(mark.stamp).count();
    points.push_back(
        {.id = std::to_string(mark.number),
         .time = fmt::format("{:%H:%M:%S}", fmt::gmtime(static_cast<std::time_t>(seconds))),
         .text = mark.text,
         .p_map_m = {mark.p_map_m.x(), mark.p_map_m.y(), 0.0},
         .type = mark.kind});
  }
  return points;
}

void WriteMarks(const std::filesystem::path& folder, std::span<const team::Mark> marks) {
  const std::vector<io::PointOfInterest> points = PointsOf(marks);
  if (!points.empty()) io::WritePointsOfInterest(folder / ResultFile::kMarks, {}, points);
}

}  // namespace qwsm::pipeline
