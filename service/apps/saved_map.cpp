// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/saved_map.hpp"

#include <functional>
#include <utility>

#include "qwsm/mapping/grid_survey.hpp"
#include "service/io/maps/map_file.hpp"
#include "service/io/maps/ros_map_file.hpp"
#include "service/pipeline/results/lost_and_found.hpp"
#include "service/pipeline/results/marks_list.hpp"
#include "service/pipeline/results/marks_of_map.hpp"
#include "service/pipeline/results/results_writer.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {
namespace {

/// Tells where the search stands that the log ended in. @param unplaced scans of it.
ExitCode ConcludeLost(const PlaceBelief& belief, std::size_t unplaced) {
  if (belief.verdict == PlaceVerdict::kOneOfThese) {
    messages::Error(
        "the last {} scans could not be placed: they fit at {}; --at X Y DEG says where the robot "
        "starts",
        unplaced,
        pipeline::PlacesText(belief));
  } else {
    messages::Error(
        "the last {} scans could not be placed: they were found nowhere in the map; is it the "
        "right map? --at X Y DEG says where the robot starts",
        unplaced);
  }
  return ExitCode::kFailed;
}

}  // namespace

KnownMap OpenMap(const std::filesystem::path& path) {
  const std::filesystem::path ending = path.extension();
  if (ending != ".yaml" && ending != ".yml") {
    ScanMap map = io::LoadMap(path);
    if (map.empty()) throw UsageError(path.string() + ": is a map without scans");
    return {.map = std::move(map), .marks = pipeline::MarksOfMap(path)};
  }
  ScanMap map = SurveyGrid(io::ReadRosMap(path));
  if (map.empty()) {
    throw UsageError(path.string() +
                     ": no occupied cell lies beside a free one, so there is nothing to localize "
                     "by; look at its thresholds and the picture");
  }
  return {.map = std::move(map)};
}

ExitCode FollowInMap(const std::string& task,
                     const RobotInMap& robot,
                     pipeline::ScanSource& source,
                     const options::ProgramOptions& options,
                     const RunSession& session) {
  pipeline::ResultsWriter results(session.folder(), {.pictures = session.has_pictures()});
  Localizer& localizer = robot.localizer;
  pipeline::LostAndFound lost_and_found(localizer, {&results, &robot.marks});
  const pipeline::ReplayResult end = session.Run(
      task, source, std::bind_front(&Localizer::Process, &localizer), {&lost_and_found});
  results.SetTitle(session.Title(task, end));
  results.Finish(localizer.map(), options.mapper.matcher, options.rendering);
  pipeline::WriteMarks(session.folder().path(), robot.marks.Placed({}));
  session.Summarize(results, localizer.map());
  if (end.end == pipeline::ReplayEnd::kExhausted && lost_and_found.held() > 0) {
    return ConcludeLost(localizer.belief(), lost_and_found.held());
  }
  return Conclude(end);
}

}  // namespace qwsm::apps
