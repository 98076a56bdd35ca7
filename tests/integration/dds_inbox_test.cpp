// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What is heard of robots and marks that somebody has set up wrongly.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "service/dds/entities/writer.hpp"
#include "service/dds/robot/robot_feed.hpp"
#include "service/dds/robot/shared_scan_reader.hpp"
#include "service/dds/robot/source_watch.hpp"
#include "service/dds/service/mark_exchange.hpp"
#include "service/dds/service/team_inbox.hpp"
#include "service/dds/wire/epoch_conversion.hpp"
#include "service/dds/wire/mark_conversion.hpp"
#include "service/dds/wire/planar.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/scan_conversion.hpp"
#include "service/dds/wire/transform_sample.hpp"
#include "tests/support/network.hpp"
#include "tests/support/room_drive.hpp"
#include "tests/support/room_log.hpp"

namespace qwsm::dds {
namespace {

using namespace std::chrono_literals;

TEST(SourceWatch, ToldOfThoseWhoTakeTurnsAndNotOfWhoIsStartedAgain) {
  const std::vector<Guid> guids{Guid{1}, Guid{2}, Guid{3}};
  SourceWatch restarted;
  for (const Guid& guid : guids) {
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(restarted.Note(guid));
    EXPECT_FALSE(restarted.Note(Guid{})) << "who is gone by now may be anybody";
  }
  SourceWatch several;
  for (const Guid& guid : guids) EXPECT_FALSE(several.Note(guid));
  EXPECT_TRUE(several.Note(guids[0]));
  EXPECT_FALSE(several.Note(guids[1])) << "told once";
}

/// Counts what comes through.
class CountingListener : public team::RobotListener<team::Planar> {
 public:
  bool TakeScan(std::string_view, LaserScan scan) override {
    scans.push_back(std::move(scan));
    return true;
  }
  void TakeOdometry(std::string_view, Timestamp, const Pose2&) override { ++readings; }
  void ExpectOdometry(std::string_view, bool) override {}
  void PlaceAt(std::string_view, const UncertainPose2&) override { ++places; }

  int places = 0;
  int readings = 0;
  std::vector<LaserScan> scans;
};

class DdsInbox : public ::testing::Test {
 protected:
  bool IsTold(const std::string& text) const {
    return std::ranges::any_of(
        told_, [&](const std::string& told) { return told.find(text) != std::string::npos; });
  }
  /// Does something again and again until it has an effect.
  template <class Do, class Done>
  static bool DoUntil(Do&& act, Done&& is_done) {
    for (int i = 0; i < 2000 && !is_done(); ++i) {
      act();
      std::this_thread::sleep_for(5ms);
    }
    return is_done();
  }

  test::PrivateNetwork network_;
  Participant participant_{{.interface = "lo", .tag = network_.tag()}};
  std::vector<std::string> told_;
  Refusals refusals_{[this](const std::string& text) { told_.push_back(text); }};
  CountingListener listener_;
};

TEST_F(DdsInbox, TwoRobotsOfOneNameAreTold) {
  RobotFeed feed(participant_, RobotNames("robot1"), {"scan"}, refusals_);
  const Writer<wire::Odometry> odometry(participant_, "/robot1/odom", Profile::kSensorOut);
  const Writer<wire::LaserScan> scans(participant_, "/robot1/scan", Profile::kSensorOut);
  const test::TemporaryFolder folder;
  const std::string log = folder.path() / "room.log";
  test::WriteRoomLog(log, 1000);
  const test::Daemon other(network_.Join({"replay", log, "--robot", "robot1", "--rate", "5"}));
  int i = 0;
  const auto drive = [&] {
    const Observation observation = test::ObservationInRoom(i++);
    const std::string frame = "robot1/laser";
    wire::Odometry sample{};
    sample.header = HeaderOf(observation.scan.stamp, frame);
    sample.child_frame_id = Borrow(frame);
    sample.pose.pose = ToWire(Pose2{});
    odometry.Write(sample);
    for (const char* of : {"robot1/laser", "robot1/base_link"}) {
      const std::string own = of;
      scans.Write(ToWire(observation.scan, own));
    }
    feed.Deliver(0ms, listener_);
  };
  EXPECT_TRUE(DoUntil(drive, [&] {
    return IsTold("two participants publish /robot1/odom in turns") &&
           IsTold("two participants publish /robot1/scan in the frame 'robot1/");
  }));
  EXPECT_TRUE(IsTold("each robot needs a namespace of its own"));
}

TEST_F(DdsInbox, ALaserIsTurnedOrRefusedOrTakenInTheMiddleAndThatIsTold) {
  RobotFeed feed(participant_, RobotNames("robot1"), {"scan"}, refusals_);
  const Writer<wire::TFMessage> mountings(
      participant_, kStaticTransformsTopic, Profile::kStaticTransformsOut);
  const Writer<wire::LaserScan> scans(participant_, "/robot1/scan", Profile::kSensorOut);
  const std::string robot = "robot1/base_link";
  const std::vector<std::string> frames{"upright", "upside_down", "tilted", "nowhere"};
  TransformSample told;
  wire::Pose pose = ToWire(Pose2{0.2, 0.0, 0.0});
  told.Add({}, robot, frames[0], pose);
  pose.orientation = {1.0, 0.0, 0.0, 0.0};
  told.Add({}, robot, frames[1], pose);
  pose.orientation = {0.0, std::sin(0.2), 0.0, std::cos(0.2)};
  told.Add({}, robot, frames[2], pose);
  mountings.Write(told.sample());
  int i = 0;
  const auto heard_from = [&](double x_m, float step_rad) {
    return std::ranges::any_of(listener_.scans, [&](const LaserScan& scan) {
      return scan.geometry.T_robot_laser == Pose2{x_m, 0.0, 0.0} &&
             scan.geometry.bearing_step_rad == step_rad &&
             scan.geometry.first_bearing_rad == -90.0F * step_rad;
    });
  };
  const auto drive = [&] {
    LaserScan scan = test::ObservationInRoom(i++).scan;
    scan.geometry.bearing_step_rad = 0.015625F;
    scan.geometry.first_bearing_rad = -90.0F * scan.geometry.bearing_step_rad;
    for (const std::string& frame : frames) scans.Write(ToWire(scan, frame));
    feed.Deliver(0ms, listener_);
  };
  EXPECT_TRUE(DoUntil(drive, [&] {
    return heard_from(0.2, 0.015625F) && heard_from(0.2, -0.015625F) && heard_from(0.0, 0.015625F);
  }));
  EXPECT_TRUE(
      IsTold("/robot1/scan: a sample was refused: its laser is tilted by more than 2.6 degrees"));
  EXPECT_TRUE(
      IsTold("/robot1/scan: /tf_static does not say where 'nowhere' sits on 'robot1/base_link'"));
  EXPECT_FALSE(IsTold("where 'upside_down' sits"));
  for (const LaserScan& scan : listener_.scans) {
    EXPECT_TRUE(scan.geometry.T_robot_laser.x_m == 0.2 || scan.geometry.bearing_step_rad > 0.0F);
  }
}

TEST_F(DdsInbox, APublisherOfMountingsThatKeepsNothingIsTold) {
  RobotFeed feed(participant_, RobotNames("robot1"), {"scan"}, refusals_);
  const auto deliver = [&] { feed.Deliver(0ms, listener_); };
  const Writer<wire::TFMessage> latched(
      participant_, kStaticTransformsTopic, Profile::kStaticTransformsOut);
  for (int i = 0; i < 20; ++i) deliver();
  EXPECT_TRUE(told_.empty());
  const Writer<wire::TFMessage> passing(participant_, kStaticTransformsTopic, Profile::kSensorOut);
  EXPECT_TRUE(DoUntil(deliver, [&] {
    return IsTold("/tf_static: a publisher is not heard, for it keeps nothing");
  }));
  for (int i = 0; i < 20; ++i) deliver();
  EXPECT_EQ(told_.size(), 1U);
}

TEST_F(DdsInbox, OdometryOfAnotherFrameThanTransformsTellOfIsTold) {
  RobotFeed feed(participant_, RobotNames("robot1"), {"scan"}, refusals_);
  const Writer<wire::Odometry> odometry(participant_, "/robot1/odom", Profile::kSensorOut);
  const std::string base = "base_link";
  int i = 0;
  const auto drive = [&](const std::string& frame) {
    wire::Odometry sample{};
    sample.header = HeaderOf(100ms * ++i, frame);
    sample.child_frame_id = Borrow(base);
    sample.pose.pose = ToWire(Pose2{});
    odometry.Write(sample);
    feed.Deliver(0ms, listener_);
  };
  EXPECT_TRUE(DoUntil([&] { drive("robot1/odom"); }, [&] { return listener_.readings > 20; }));
  EXPECT_TRUE(told_.empty());
  EXPECT_TRUE(
      DoUntil([&] { drive("odom"); },
              [&] { return IsTold("/robot1/odom: its frame_id is 'odom', not 'robot1/odom'"); }));
}

TEST_F(DdsInbox, ARobotThatIsStartedAgainBetweenTwoLooksIsNotLost) {
  team::TeamService service({}, team::SinkList<team::TeamSink>(std::vector<team::TeamSink*>{}));
  service.Start();
  TeamInbox inbox(participant_, {}, service, {}, refusals_);
  const auto state = [&] {
    const std::vector<team::RobotStatus> robots = service.Status().robots;
    return robots.empty() ? team::RobotState::kExpected : robots.front().state;
  };
  std::optional<Writer<wire::LaserScan>> scans;
  scans.emplace(participant_, "/robot1/scan", Profile::kSensorOut);
  const auto deliver = [&] { inbox.Deliver(0ms); };
  ASSERT_TRUE(DoUntil(deliver, [&] { return state() == team::RobotState::kUnplaced; }));
  scans.reset();
  scans.emplace(participant_, "/robot1/scan", Profile::kSensorOut);
  for (int i = 0; i < 50; ++i) {
    deliver();
    EXPECT_EQ(state(), team::RobotState::kUnplaced);
  }
  scans.reset();
  EXPECT_TRUE(DoUntil(deliver, [&] { return state() == team::RobotState::kLost; }));
  // Who is gone before anybody looked was not there.
  scans.emplace(participant_, "/robot1/scan", Profile::kSensorOut);
  scans.reset();
  for (int i = 0; i < 50; ++i) {
    deliver();
    EXPECT_EQ(state(), team::RobotState::kLost);
  }
}

TEST_F(DdsInbox, MoreRobotsThanAServiceHasRoomForAreTold) {
  team::TeamService service({}, team::SinkList<team::TeamSink>(std::vector<team::TeamSink*>{}));
  TeamInbox inbox(participant_, {}, service, {}, refusals_);
  std::vector<Writer<wire::LaserScan>> robots;
  for (std::size_t i = 0; i <= team::kMaxRobots; ++i) {
    robots.emplace_back(participant_, "/robot" + std::to_string(i) + "/scan", Profile::kSensorOut);
  }
  EXPECT_TRUE(DoUntil([&] { inbox.Deliver(0ms); }, [&] { return !told_.empty(); }));
  EXPECT_EQ(service.Status().robots.size(), team::kMaxRobots);
  for (int i = 0; i < 20; ++i) inbox.Deliver(0ms);
  ASSERT_EQ(told_.size(), 1U);
  EXPECT_TRUE(IsTold("is not answered, nor who comes later: there were 256 robots already"));
}

TEST_F(DdsInbox, APlaceInAnotherFrameIsRefused) {
  RobotFeed feed(participant_, RobotNames("robot1"), {"scan"}, refusals_);
  const Writer<wire::PoseWithCovarianceStamped> poses(
      participant_, "/robot1/initialpose", Profile::kSensorOut);
  wire::PoseWithCovarianceStamped sample{};
  sample.pose.pose = ToWire(Pose2{});
  for (const char* name : {"robot1/odom", "base_link", "", "map"}) {
    const std::string frame = name;
    sample.header = HeaderOf(1s, frame);
    poses.Write(sample);
  }
  EXPECT_TRUE(
      DoUntil([&] { feed.Deliver(0ms, listener_); }, [&] { return listener_.places == 2; }));
  EXPECT_TRUE(
      IsTold("/robot1/initialpose: a sample was refused: its frame_id is 'robot1/odom', "
             "not 'map'; in RViz, that is the Fixed Frame"));
  EXPECT_EQ(told_.size(), 2U);
}

TEST_F(DdsInbox, SharedScansAreWhereTheNewestCorrectionHasPutThem) {
  const Writer<wire::RelevantScan> scans(participant_, kSharedScansTopic, Profile::kSharedScans);
  const Writer<wire::MapEpoch> epochs(participant_, "/map_epoch", Profile::kLatched);
  const auto key_of = [](std::uint64_t sequence) {
    return team::ScanKey{.service = "base", .robot = "robot1", .sequence = sequence};
  };
  const auto share = [&](std::uint64_t sequence) {
    const team::TeamScan scan{.key = key_of(sequence),
                              .component = "robot1",
                              .scan = test::ObservationInRoom(0).scan,
                              .map_robot = UncertainPose2::WithSigmas({}, 0.1, 0.1),
                              .T_odom_robot = {}};
    const std::string frame = "map_robot1";
    scans.Write(ToWire(scan, frame));
  };
  const auto correct = [&](std::uint64_t number, double x_m) {
    team::TeamEpoch epoch{.rank = {.number = number, .service = "base"}, .stamp = 1s, .scans = {}};
    epoch.scans.push_back({.key = key_of(1),
                           .component = "",
                           .component_before = "robot1",
                           .T_map_robot_before = {},
                           .map_robot = UncertainPose2::WithSigmas({x_m, 0.0, 0.0}, 0.1, 0.1)});
    epochs.Write(EpochSample(epoch).sample());
  };
  SharedScanReader reader(participant_);
  share(1);
  share(2);
  correct(7, 3.0);
  correct(6, 9.0);  // Of a service that did not know of the other one yet.
  std::vector<team::TeamScan> heard;
  const auto hear = [&] {
    for (team::TeamScan& scan : reader.Take(10ms)) heard.push_back(std::move(scan));
  };
  ASSERT_TRUE(DoUntil(hear, [&] { return heard.size() == 2; }));
  reader.Settle(heard);
  EXPECT_EQ(heard[0].component, "");
  EXPECT_EQ(heard[0].map_robot.T_a_b, (Pose2{3.0, 0.0, 0.0}));
  EXPECT_EQ(heard[1].component, "robot1");
  EXPECT_EQ(heard[1].map_robot.T_a_b, Pose2{});
}

TEST_F(DdsInbox, AMarkOfAClockThatIsAheadCanBeChangedAndRemoved) {
  MarkExchange marks(participant_, refusals_, team::MarkJournal({}, [](const std::string&) {}));
  marks.Start();
  team::Mark mark{.id = "a", .kind = "note", .text = "of tomorrow", .p_map_m = {1.0, 2.0}};
  mark.stamp = std::chrono::system_clock::now().time_since_epoch() + 24h;
  mark.number = 1;
  const Writer<wire::Mark> writer(participant_, kMarksTopic, Profile::kMarks);
  const std::string map = kMapFrame;
  writer.Write(ToWire(mark, map));
  EXPECT_TRUE(DoUntil([] {}, [&] { return !marks.marks().empty(); }));
  mark.text = "of today";
  marks.Tell(mark);
  EXPECT_EQ(marks.marks().front().text, "of today");
  mark.is_removed = true;
  marks.Tell(mark);
  EXPECT_TRUE(marks.marks().front().is_removed);
}

}  // namespace
}  // namespace qwsm::dds
