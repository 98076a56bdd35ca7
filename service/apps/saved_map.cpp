// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/saved_map.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "qwsm/correction/joint_correction.hpp"
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

/// Tells where the search stands that the log ended in.
ExitCode ConcludeLost(const std::string& task,
                      PlaceVerdict verdict,
                      const pipeline::LostAndFound& lost_and_found) {
  const bool can_be_told = task == "localize" && lost_and_found.is_lost_from_start();
  const std::string where = verdict == PlaceVerdict::kOneOfThese
                                ? "they may begin at " + lost_and_found.PlacesText()
                                : "they were found nowhere in the map (is it the right map?)";
  messages::Error("the last {} scans could not be placed: {}{}",
                  lost_and_found.held(),
                  where,
                  can_be_told ? "; --at X Y DEG says where the robot starts" : "");
  return ExitCode::kFailed;
}

/// Marks on a map that is corrected: each goes with the scan that was taken next to it.
std::vector<team::Mark> MovedWithScans(std::vector<team::Mark> marks,
                                       std::span<const RelevantScan> scans,
                                       std::span<const UncertainPose2> map_node) {
  for (team::Mark& mark : marks) {
    const auto away_m = [&](const RelevantScan& scan) {
      return (scan.map_robot.T_a_b.translation_m() - mark.p_map_m).norm();
    };
    const RelevantScan& next = *std::ranges::min_element(scans, {}, away_m);
    mark.p_map_m = map_node[next.id].T_a_b * (next.map_robot.T_a_b.Inverse() * mark.p_map_m);
  }
  return marks;
}

/// The map of several drives and the path of the last one, corrected together.
pipeline::CorrectedRun CorrectTogether(const ScanMap& map,
                                       std::size_t first_scan,
                                       std::span<const io::PathPose> path,
                                       const MapperOptions& options) {
  const std::vector<StampedAnswer> answers = pipeline::AnswersOf(path);
  const std::array<DriveInMap, 1> last{{{.first_scan = first_scan, .answers = answers}}};
  JointCorrection joint = CorrectJointly(map, last, options);
  joint.correction.map_robot = std::move(joint.map_robot.front());
  return {.correction = std::move(joint.correction),
          .scans = std::move(joint.scans),
          .answered_in = pipeline::FiguresOf(map),
          .epochs = {}};
}

/// The exit code of a drive that ended so; tells of a robot that is lost in the end.
ExitCode ConcludeDrive(const std::string& task,
                       const RunSession& session,
                       const pipeline::ReplayResult& end,
                       const Localizer& localizer,
                       const pipeline::LostAndFound& lost_and_found) {
  if (end.end == pipeline::ReplayEnd::kExhausted && lost_and_found.held() > 0) {
    return ConcludeLost(task, localizer.belief().verdict, lost_and_found);
  }
  if (lost_and_found.held() > 0) {
    messages::Warn("the last {} scans are not placed: the robot was still looked for",
                   lost_and_found.held());
  }
  return session.Conclude(end);
}

}  // namespace

bool IsGrid(const std::filesystem::path& path) {
  const std::filesystem::path ending = path.extension();
  return ending == ".yaml" || ending == ".yml";
}

KnownMap OpenMap(const std::filesystem::path& path) {
  if (!IsGrid(path)) {
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
  session.Summarize(results);
  return ConcludeDrive(task, session, end, localizer, lost_and_found);
}

ContinuedMap CorrectAfterFollowing(const RobotInMap& robot,
                                   const std::vector<team::Mark>& marks_before,
                                   pipeline::ScanSource& source,
                                   const options::ProgramOptions& options,
                                   const RunSession& session) {
  Localizer& localizer = robot.localizer;
  const std::size_t scans_before = localizer.map().scans().size();
  pipeline::ResultsWriter results(
      session.folder(),
      {.trajectory = pipeline::ResultFile::kLiveTrajectory, .pictures = session.has_pictures()});
  pipeline::LostAndFound lost_and_found(localizer, {&results, &robot.marks});
  const pipeline::ReplayResult end = session.Run(
      "map", source, std::bind_front(&Localizer::Process, &localizer), {&lost_and_found});
  results.SetTitle(session.Title("map", end));
  pipeline::CorrectedRun corrected =
      CorrectTogether(localizer.map(), scans_before, results.path(), options.mapper);
  results.Finish(localizer.map().scans(), options.mapper.matcher, corrected, options.rendering);
  session.Summarize(results);
  const Correction& correction = corrected.correction;
  std::vector<team::Mark> marks =
      MovedWithScans(marks_before, localizer.map().scans(), correction.map_node);
  std::ranges::move(robot.marks.Placed(correction.map_robot), std::back_inserter(marks));
  pipeline::WriteMarks(session.folder().path(), marks);
  return {.code = ConcludeDrive("map", session, end, localizer, lost_and_found),
          .scans = std::move(corrected.scans),
          .marks = std::move(marks)};
}

}  // namespace qwsm::apps
