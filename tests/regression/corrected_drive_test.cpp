// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Corrected paths of simulated robots, against the truth.
#include <gtest/gtest.h>

#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/correction/self_correcting_mapper.hpp"
#include "qwsm/metrics/nees.hpp"
#include "sim/simulation.hpp"
#include "tests/support/mapped_drive.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace qwsm::test {
namespace {

std::vector<FoundPose> Corrected(const sim::ScenarioOptions& scenario) {
  sim::Simulation simulation(scenario);
  SelfCorrectingMapper mapper;
  std::vector<Pose2> T_world_robot;
  while (const std::optional<sim::Reading> reading = simulation.Next()) {
    mapper.Process(sim::ObservationOf(*reading));
    T_world_robot.push_back(reading->T_world_robot);
  }
  const std::vector<UncertainPose2> map_robot = mapper.Correct().map_robot;
  const Pose2 T_map_world = map_robot.front().T_a_b * T_world_robot.front().Inverse();
  std::vector<FoundPose> poses;
  for (std::size_t i = 0; i < map_robot.size(); ++i) {
    poses.push_back({.T_map_true = T_map_world * T_world_robot[i], .map_robot = map_robot[i]});
  }
  return poses;
}

double MeanNees(std::span<const FoundPose> poses) {
  std::vector<double> values;
  for (const FoundPose& pose : poses.subspan(1)) {
    if (const auto nees = Nees(pose.map_robot, pose.T_map_true)) values.push_back(*nees);
  }
  return SummarizeNees(values).mean;
}

double LastError_m(std::span<const FoundPose> poses) {
  const FoundPose& last = poses.back();
  return (last.map_robot.T_a_b.translation_m() - last.T_map_true.translation_m()).norm();
}

void LookOneWay(sim::LaserOptions& laser) {
  laser.beams = 181;
  laser.field_of_view_rad = std::numbers::pi;
}

// A campus by a laser that sees hardly more than one side of a street.
sim::ScenarioOptions CampusSeenTo(double range_m, int seed) {
  sim::ScenarioOptions campus = sim::testing::Drive(sim::LayoutKind::kCampus, seed);
  sim::RobotOptions& robot = campus.robots.front();
  robot.drive.max_speed_mps = 2.0;
  robot.laser.beams = 361;
  robot.laser.rate_hz = 5.0;
  robot.laser.useful_range_m = range_m;
  robot.driver.speed_mps = 1.0;
  return campus;
}

// An office in which people walk, by a laser of small robots.
sim::ScenarioOptions OfficeByASmallLaser(int seed) {
  sim::ScenarioOptions office = sim::testing::Drive(sim::LayoutKind::kOffice, seed);
  office.layout.office.persons = 3;
  sim::LaserOptions& laser = office.robots.front().laser;
  laser.beams = 682;
  laser.field_of_view_rad = 240.0 * std::numbers::pi / 180.0;
  laser.rate_hz = 10.0;
  laser.useful_range_m = 5.6;
  return office;
}

// One drive has one drift: three together tell more.
TEST(CorrectedDrive, IsAsWrongAsItsCovariancesTell) {
  constexpr int kSeeds = 3;
  double sum = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    sum += MeanNees(Corrected(sim::testing::Drive(sim::LayoutKind::kOffice, seed)));
  }
  EXPECT_GT(sum / kSeeds, 0.7);
  EXPECT_LT(sum / kSeeds, 4.5);
}

// A loop is told by one submap, and an answer by all that was seen before: a path that is right
// must not be bent by loops. All others that saw the same, later too, make up for most of it: 1.23
// instead of 1.47 times the error of the answers is left by them (RefinedPath).
TEST(CorrectedDrive, IsHardlyBentWhereTheAnswersAreRight) {
  double answered_m = 0.0;
  double corrected_m = 0.0;
  for (int seed = 1; seed <= 6; ++seed) {
    const sim::ScenarioOptions office = sim::testing::Drive(sim::LayoutKind::kOffice, seed);
    answered_m += MappedDrive(office).AteRmse_m();
    corrected_m += AteRmse_m(Corrected(office));
  }
  EXPECT_LT(corrected_m, 1.35 * answered_m);
}

// On wet grass wheels turn further than the robot goes. That is learned from the matches, so that
// whoever has no gyro does next to as well as with one; before it was, he did half as well.
TEST(CorrectedDrive, IsAsGoodByWheelsAsWithAGyro) {
  constexpr int kDrives = 12;
  double with_gyro_m = 0.0;
  double by_wheels_m = 0.0;
  for (int seed = 11; seed < 11 + kDrives; ++seed) {
    sim::ScenarioOptions park = sim::testing::Park(seed);
    by_wheels_m += AteRmse_m(Corrected(park)) / kDrives;
    park.robots.front().gyro.enabled = true;
    with_gyro_m += AteRmse_m(Corrected(park)) / kDrives;
  }
  EXPECT_LT(with_gyro_m, 0.04);
  EXPECT_LT(by_wheels_m, 1.5 * with_gyro_m);
}

// Among these trees the robot turns twice with none in view, and comes back more than eight metres
// beside, as its covariance tells.
TEST(CorrectedDrive, IsRecognisedAsFarOffAsItMayBe) {
  EXPECT_LT(LastError_m(Corrected(sim::testing::Park(95))), 0.2);
}

// Where these trees leave the view and others come into it, the wheels have not slipped.
TEST(CorrectedDrive, TakesNoTreeForAnother) {
  EXPECT_LT(AteRmse_m(Corrected(sim::testing::Park(43))), 0.2);
}

// Between blocks of houses that are alike the robot drifts by a metre or two before it comes back,
// and what it sees there contradicts what it had mapped: it has drifted, and was not carried a
// street farther on. Where it is lost nevertheless and found again, it is as uncertain as the part
// of the map that it sees.
TEST(CorrectedDrive, IsNotLostWhereItHasDrifted) {
  constexpr int kSeeds = 3;
  for (const double range_m : {12.0, 20.0}) {
    double nees = 0.0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      SCOPED_TRACE(testing::Message() << range_m << " m, seed " << seed);
      const std::vector<FoundPose> poses = Corrected(CampusSeenTo(range_m, seed));
      EXPECT_LT(AteRmse_m(poses), 0.15);
      nees += MeanNees(poses) / kSeeds;
    }
    EXPECT_LT(nees, 15.0) << range_m;
  }
}

// Here a loop closes where the map was drawn beside.
TEST(CorrectedDrive, IsNotLostWhereALoopCloses) {
  sim::ScenarioOptions campus = CampusSeenTo(10.0, 7);
  sim::LaserOptions& laser = campus.robots.front().laser;
  laser.beams = 360;
  laser.field_of_view_rad = 2.0 * std::numbers::pi;
  laser.rate_hz = 5.5;
  EXPECT_LT(AteRmse_m(Corrected(campus)), 0.15);
}

// And here a single surface in view is taken for another one.
TEST(CorrectedDrive, IsNotLostWhereItSeesNextToNothing) {
  for (const int seed : {3, 7}) {
    SCOPED_TRACE(seed);
    sim::ScenarioOptions campus = CampusSeenTo(12.0, seed);
    LookOneWay(campus.robots.front().laser);
    EXPECT_LT(AteRmse_m(Corrected(campus)), 0.3);
  }
}

// At the corner of a street a few points of a wall that is new fit another one, two metres and
// forty degrees beside; and where a loop closes, the scans after it stay with what was seen long
// before.
TEST(CorrectedDrive, IsNotTurnedIntoAnotherStreet) {
  for (const int seed : {5, 19}) {
    SCOPED_TRACE(seed);
    EXPECT_LT(AteRmse_m(Corrected(CampusSeenTo(10.0, seed))), 0.5);
  }
}

// For half a kilometre odometry tells of turns that are nothing but noise. At the first corner next
// to nothing is in view that the map knows, and the robot goes by what was learned of its wheels.
TEST(CorrectedDrive, TurnsByAsMuchAsItsWheelsTellAfterALongStreet) {
  constexpr int kDrives = 6;
  double ate_m = 0.0;
  for (int seed = 1; seed <= kDrives; ++seed) {
    SCOPED_TRACE(seed);
    sim::ScenarioOptions street = CampusSeenTo(20.0, seed);
    street.layout.campus = {.columns = 1,
                            .rows = 1,
                            .block_length_m = 500.0,
                            .block_width_m = 200.0,
                            .street_width_m = 8.0};
    LookOneWay(street.robots.front().laser);
    const std::vector<FoundPose> poses = Corrected(street);
    const double of_drive_m = AteRmse_m(poses);
    ate_m += of_drive_m / kDrives;
    EXPECT_LT(of_drive_m, 5.0);
    EXPECT_LT(MeanNees(poses), 10.0);
  }
  EXPECT_LT(ate_m, 2.0);
}

// What comes into view beside it is seen from one side: what is alike is compared, or every match
// errs the same way.
TEST(CorrectedDrive, IsGoodToADecimetreByALaserThatLooksBack) {
  constexpr int kDrives = 3;
  double ate_m = 0.0;
  double nees = 0.0;
  for (int seed = 1; seed <= kDrives; ++seed) {
    SCOPED_TRACE(seed);
    sim::ScenarioOptions office = sim::testing::Drive(sim::LayoutKind::kOffice, seed);
    office.layout.office.rooms_per_side = 20;
    office.layout.office.persons = 0;
    sim::LaserOptions& laser = office.robots.front().laser;
    LookOneWay(laser);
    laser.useful_range_m = 8.0;
    laser.mount_heading_rad = std::numbers::pi;
    const std::vector<FoundPose> poses = Corrected(office);
    ate_m += AteRmse_m(poses) / kDrives;
    nees += MeanNees(poses) / kDrives;
  }
  EXPECT_LT(ate_m, 0.1);
  EXPECT_LT(nees, 70.0);
}

// In a corridor whoever walks there is all that tells of the way along it, if the laser sees no
// farther.
TEST(CorrectedDrive, IsTakenAlongByNobodyWhoWalksInACorridor) {
  for (int seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<FoundPose> poses = Corrected(OfficeByASmallLaser(seed));
    EXPECT_LT(AteRmse_m(poses), 0.1);
    EXPECT_LT(MeanNees(poses), 100.0);
  }
}

// Among these trees the robot turns with none in view, and the one that comes into view then is
// like another: its sigmas were one thirtieth of its errors.
TEST(CorrectedDrive, IsNoSurerThanASingleTrunkTells) {
  for (const int seed : {77, 98, 197}) {
    SCOPED_TRACE(seed);
    EXPECT_LT(MeanNees(Corrected(sim::testing::Park(seed))), 15.0);
  }
}

}  // namespace
}  // namespace qwsm::test
