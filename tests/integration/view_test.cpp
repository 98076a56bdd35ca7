// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What those who look at a service get from its page's server, and what it takes from them. The
// page itself is tested in a browser (tests/browser).
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <future>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "service/dds/entities/writer.hpp"
#include "service/dds/service/mark_exchange.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/scan_conversion.hpp"
#include "service/io/journal/journal_file.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/robot_in_room.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/viewed_service.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

/// Marks a victim called Anna at (2, 3), as the page does.
void MarkAnna(Onlooker& onlooker) {
  onlooker.client().SendFrame(WebClient::kText,
                              R"({"op":"advertise","channels":[{"id":1,"topic":"/qwsm/marks",)"
                              R"("encoding":"cdr","schemaName":"qwsm_msgs/msg/Mark"}]})");
  // Stamp, frame, id, kind, text, author; x and y; not removed.
  std::string mark("\1\1\0\0\0\0\1\0\0", 9);
  mark += std::string(8, '\0') + std::string("\4\0\0\0map\0\3\0\0\0m1\0\0\7\0\0\0victim\0\0", 28);
  mark += std::string("\5\0\0\0Anna\0\0\0\0\2\0\0\0o\0\0\0", 20);
  const std::vector<double> place{2.0, 3.0};
  mark.append(reinterpret_cast<const char*>(place.data()), 2 * sizeof(double));
  mark += std::string(1, '\0');
  onlooker.client().SendFrame(WebClient::kBinary, mark);
}

class View : public ::testing::Test {
 protected:
  PrivateNetwork network_;
};

TEST_F(View, ServesThePageAndThePosesOfARobot) {
  ViewedService service(network_, {"--set", "team.map_period_s=0.5"});
  EXPECT_NE(WebClient(service.port()).Get("/").find("<title>Q-WSM</title>"), std::string::npos);
  EXPECT_NE(WebClient(service.port()).Get("/../secret").find(" 404 "), std::string::npos);
  Onlooker onlooker(service.port());
  EXPECT_TRUE(onlooker.client().ReceiveWith("serverInfo"));
  RobotInRoom robot(network_);
  ASSERT_FALSE(robot.DriveUntilAnswered(3).empty());
  ASSERT_TRUE(onlooker.Subscribe("/robot1/match_report", 7));
  ASSERT_TRUE(onlooker.Subscribe("/map_tiles", 8));
  robot.DriveUntilAnswered(3);
  const auto report = onlooker.Sample(7);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->substr(0, 4), std::string("\0\1\0\0", 4));
  EXPECT_NE(report->find("robot1"), std::string::npos);
  // The map comes whole to whoever comes late.
  EXPECT_TRUE(onlooker.Sample(8));
  EXPECT_EQ(service.daemon().End().exit_code, 0);
}

TEST_F(View, TellsAnAddressAtWhichItListens) {
  EXPECT_TRUE(ViewedService(network_).address().starts_with("http://localhost:"));
  ViewedService other(network_, {"--set", "view.address=127.0.0.2", "--set", "view.token=secret"});
  EXPECT_TRUE(other.address().starts_with("http://127.0.0.2:")) << other.address();
  EXPECT_THROW(WebClient{other.port()}, std::runtime_error) << "nobody listens on localhost";
}

TEST_F(View, TakesWhereARobotIs) {
  ViewedService service(network_);
  RobotInRoom robot(network_);
  ASSERT_FALSE(robot.DriveUntilAnswered(3).empty());
  const dds::Reader<dds::wire::PoseWithCovarianceStamped> told(
      robot.participant(), "/robot1/initialpose", dds::Profile::kSensorIn);
  Onlooker onlooker(service.port());
  ASSERT_TRUE(onlooker.Subscribe("/robot1/match_report", 1));  // By then the robot is known.
  const std::string begin = R"({"op":"advertise","channels":[{"encoding":"cdr",)"
                            R"("schemaName":"geometry_msgs/msg/PoseWithCovarianceStamped",)";
  onlooker.client().SendFrame(WebClient::kText,
                              begin + R"("id":5,"topic":"/robot1/initialpose"}]})");
  // Foxglove offers what nobody takes, too: an error is only to publish it.
  onlooker.client().SendFrame(WebClient::kText,
                              begin + R"("id":6,"topic":"/nobody/initialpose"}]})");
  onlooker.client().SendFrame(WebClient::kBinary, std::string("\1\7\0\0\0\0", 6));
  EXPECT_TRUE(onlooker.client().ReceiveWith("channel 7 was not advertised"));
  onlooker.client().SendFrame(WebClient::kBinary, std::string("\1\6\0\0\0\0", 6));
  EXPECT_TRUE(onlooker.client().ReceiveWith("'/nobody/initialpose' is not taken"));

  std::string message("\1\5\0\0\0\0\1\0\0", 9);  // Channel 5, little-endian CDR.
  message += std::string(8, '\0') + std::string("\4\0\0\0map\0", 8);  // Stamp and frame.
  const std::vector<double> values{1.5, -0.5, 0.0, 0.0, 0.0, 0.0, 1.0};
  message.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  message += std::string(36 * sizeof(double), '\0');
  std::vector<double> heard_x;
  for (int i = 0; i < 100 && heard_x.empty(); ++i) {  // Its topic may be found a little later.
    onlooker.client().SendFrame(WebClient::kBinary, message);
    usleep(20'000);
    told.TakeAll([&](const auto& sample) { heard_x.push_back(sample.pose.pose.position.x); });
  }
  ASSERT_FALSE(heard_x.empty());
  EXPECT_EQ(heard_x.front(), 1.5);
  onlooker.client().SendFrame(WebClient::kBinary, message.substr(0, 60));
  EXPECT_TRUE(onlooker.client().ReceiveWith("the message cannot be read"));
}

TEST_F(View, WhoeverComesLateGetsTheWholeMap) {
  constexpr std::uint32_t kSide = 2000;  // 100 m at 5 cm.
  constexpr int kTiles = 32 * 32;
  ViewedService service(network_);
  const dds::Participant participant({.interface = "lo", .tag = network_.tag()});
  const dds::Writer<dds::wire::OccupancyGrid> maps(
      participant, "/large/map", dds::Profile::kLatched);
  const DrawnMap map(kSide, 40);
  const auto seconds_of_whole_map = [&] {
    const auto begin = std::chrono::steady_clock::now();
    Onlooker onlooker(service.port());
    EXPECT_TRUE(onlooker.Subscribe("/large/map_tiles", 1));
    for (int i = 0; i < kTiles && !HasFailure(); ++i) EXPECT_TRUE(onlooker.Sample(1)) << i;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  std::future<double> first = std::async(std::launch::async, seconds_of_whole_map);
  maps.Write(map.sample());
  const double first_s = first.get();
  const double late_s = seconds_of_whole_map();
  std::cout << "the whole map as it is told after " << first_s << " s, later after " << late_s
            << " s\n";
  EXPECT_LT(late_s, 2 * first_s);
}

TEST_F(View, ASlowLineHasThePosesWhileTheMapIsOnItsWay) {
  constexpr std::size_t kBytesEach20ms = 2500;  // 1 Mbit/s.
  ViewedService service(network_);
  RobotInRoom robot(network_);
  const dds::Writer<dds::wire::OccupancyGrid> maps(
      robot.participant(), "/large/map", dds::Profile::kLatched);
  const DrawnMap map(2000, 3);
  maps.Write(map.sample());
  ASSERT_FALSE(robot.DriveUntilAnswered(3).empty());
  Onlooker slow(service.port(), 2048);
  ASSERT_TRUE(slow.Subscribe("/robot1/match_report", 2));
  ASSERT_TRUE(slow.Subscribe("/large/map_tiles", 1));
  std::vector<double> ages_s;
  std::size_t tiles = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 200; ++i) {
    if (i % 5 == 0) robot.Drive(1ms);
    slow.client().ReadAtMost(kBytesEach20ms);
    while (const auto frame = slow.client().TakeFrame()) {
      if (frame->opcode != WebClient::kBinary || frame->payload[0] != 1) continue;
      std::uint64_t stamp_ns = 0;
      std::memcpy(&stamp_ns, frame->payload.data() + 5, sizeof stamp_ns);
      const auto now = std::chrono::system_clock::now().time_since_epoch();
      if (frame->payload[1] == 1)
        ++tiles;
      else
        ages_s.push_back(
            std::chrono::duration<double>(now - std::chrono::nanoseconds(stamp_ns)).count());
    }
    usleep(19'000);
  }
  ASSERT_GT(ages_s.size(), 20U);
  EXPECT_GT(tiles, 20U);
  EXPECT_LT(tiles, 1024U);  // The map was on its way all the time.
  std::ranges::sort(ages_s);
  std::cout << ages_s.size() << " poses, median " << ages_s[ages_s.size() / 2] << " s, oldest "
            << ages_s.back() << " s, beside " << tiles << " tiles\n";
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(ages_s[ages_s.size() / 2], took.count() / 20);  // All of it, behind the map.
}

TEST_F(View, ShowsALogThatIsMapped) {
  const TemporaryFolder folder;
  ViewedService mapping({"map",
                         "--sim",
                         "campus",
                         "--view",
                         "--verbose",
                         "--set",
                         "view.port=0",
                         "--output",
                         folder.path() / "run",
                         "--save-map",
                         folder.path() / "campus.qwsm"});
  Onlooker onlooker(mapping.port());
  ASSERT_TRUE(onlooker.Subscribe("/match_report", 1));
  ASSERT_TRUE(onlooker.Subscribe("/map_tiles", 2));
  EXPECT_TRUE(onlooker.Sample(1));
  EXPECT_TRUE(onlooker.Sample(2));
  // What is marked on the page is on the map that is saved.
  ASSERT_TRUE(onlooker.Subscribe("/qwsm/marks", 3));
  MarkAnna(onlooker);
  EXPECT_TRUE(onlooker.Sample(3));
  mapping.daemon().End();
  const Outcome exported =
      RunProgram({"export", folder.path() / "campus.qwsm", "--geotiff", folder.path() / "campus"});
  EXPECT_EQ(exported.exit_code, 0) << exported.errors;
  EXPECT_NE(ReadFile(folder.path() / "campus_pois.csv").find("\"Anna\""), std::string::npos);
  EXPECT_NE(ReadFile(folder.path() / "run" / "marks.csv").find("\"Anna\""), std::string::npos);
}

TEST_F(View, ShowingALogChangesNothingOfItsPath) {
  const TemporaryFolder folder;
  const auto map = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "map", "--sim", "office", "--duration", "30", "--quiet", "--output", folder.path() / name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(RunProgram(arguments).exit_code, 0);
    return ReadFile(folder.path() / name / "trajectory.tum");
  };
  const std::string path = map("unseen", {});
  EXPECT_FALSE(path.empty());
  EXPECT_EQ(map("seen", {"--view", "--set", "view.port=0"}), path);
}

TEST_F(View, ShowsASimulatorThatNobodyAnswers) {
  const TemporaryFolder folder;
  ViewedService simulator(network_.JoinSimulator({"sim",
                                                  "team",
                                                  "--view",
                                                  "--verbose",
                                                  "--page",
                                                  "port=0",
                                                  "--output",
                                                  folder.path() / "drive"}));
  Onlooker onlooker(simulator.port());
  ASSERT_TRUE(onlooker.Subscribe("/robot_1/ground_truth", 1));
  ASSERT_TRUE(onlooker.Subscribe("/robot_1/scan", 2));
  EXPECT_TRUE(onlooker.Sample(1));
  EXPECT_TRUE(onlooker.Sample(2));
  simulator.daemon().End();
}

TEST_F(View, MarksOutliveTheService) {
  const TemporaryFolder folder;
  const std::vector<std::string> journal{"--journal", folder.path() / "team.db"};
  RobotInRoom robot(network_);
  {
    ViewedService service(network_, journal);
    ASSERT_FALSE(robot.DriveUntilAnswered(8).empty());
    Onlooker onlooker(service.port());
    ASSERT_TRUE(onlooker.Subscribe("/qwsm/marks", 1));
    MarkAnna(onlooker);
    const auto told = onlooker.Sample(1);
    ASSERT_TRUE(told);
    EXPECT_NE(told->find("Anna"), std::string::npos);
    usleep(200'000);
    service.daemon().End(SIGKILL);
  }
  const std::string listed = ",\"Anna\",2.000,3.000,0.000,1,T,victim";
  const std::filesystem::path database = folder.path() / "team.db";
  const Outcome exported =
      RunProgram({"export", database, "--geotiff", folder.path() / "of_journal"});
  EXPECT_EQ(exported.exit_code, 0) << exported.errors;
  const std::string list = ReadFile(folder.path() / "of_journal_pois.csv");
  EXPECT_NE(list.find(listed), std::string::npos) << list;
  const Outcome mapped = RunProgram({"map", database, "--output", folder.path() / "mapped"});
  EXPECT_EQ(mapped.exit_code, 0) << mapped.errors;
  EXPECT_NE(ReadFile(folder.path() / "mapped" / "marks.csv").find("\"Anna\""), std::string::npos);

  ViewedService service(network_, journal);
  Onlooker onlooker(service.port());
  ASSERT_TRUE(onlooker.Subscribe("/qwsm/marks", 1));
  const auto kept = onlooker.Sample(1);
  ASSERT_TRUE(kept);
  EXPECT_NE(kept->find("Anna"), std::string::npos);
  EXPECT_NE(kept->find("robot1"), std::string::npos);  // Whose scan it stands on.
  const Outcome heard = network_.Run({"export", "--live", "--geotiff", folder.path() / "live"});
  EXPECT_EQ(heard.exit_code, 0) << heard.errors;
  EXPECT_NE(ReadFile(folder.path() / "live_pois.csv").find(listed), std::string::npos);
}

// Two services have each marked a victim 1, and hear of each other later.
TEST_F(View, ServicesThatMeetNumberTheirMarksApart) {
  const TemporaryFolder folder;
  const dds::Participant participant({.interface = "lo", .tag = network_.tag()});
  dds::Refusals refusals([](const std::string& text) { ADD_FAILURE() << text; });
  const auto journal_of = [&](const std::string& name) {
    return team::MarkJournal(folder.path() / name, [](const std::string&) {});
  };
  const auto exchange_with = [&](const std::string& name, Timestamp stamp) {
    io::JournalFile::Continue(folder.path() / name, "scans", "base");
    journal_of(name).Keep(
        {{.stamp = stamp, .id = name, .number = 1, .kind = "victim", .p_map_m = {2.0, 3.0}}});
    auto exchange = std::make_unique<dds::MarkExchange>(participant, refusals, journal_of(name));
    exchange->Start();
    return exchange;
  };
  const auto numbers_of = [](const std::vector<team::Mark>& marks) {
    std::map<std::string, std::uint32_t> numbers;
    for (const team::Mark& mark : marks) numbers[mark.id] = mark.number;
    return numbers;
  };
  const auto first = exchange_with("later", 2s);
  const auto second = exchange_with("earlier", 1s);
  const std::map<std::string, std::uint32_t> apart{{"earlier", 1}, {"later", 2}};
  for (const auto& exchange : {first.get(), second.get()}) {
    for (int i = 0; i < 200 && numbers_of(exchange->marks()) != apart; ++i) usleep(20'000);
    EXPECT_EQ(numbers_of(exchange->marks()), apart);
  }
  for (const std::string name : {"later", "earlier"}) {
    const team::MarkJournal journal = journal_of(name);
    for (int i = 0; i < 200 && numbers_of(journal.Load()) != apart; ++i) usleep(20'000);
    EXPECT_EQ(numbers_of(journal.Load()), apart) << name;
  }
}

// The disk was full when the only victim was marked.
TEST_F(View, AMarkThatCouldNotBeKeptIsKeptWithoutAnother) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "team.db";
  const dds::Participant participant({.interface = "lo", .tag = network_.tag()});
  dds::Refusals refusals([](const std::string& text) { ADD_FAILURE() << text; });
  std::promise<std::string> warned;
  dds::MarkExchange exchange(
      participant, refusals, team::MarkJournal(file, [&](const std::string& text) {
        warned.set_value(text);
      }));
  exchange.Start();
  exchange.Tell({.id = "anna", .kind = "victim", .p_map_m = {2.0, 3.0}});
  EXPECT_NE(warned.get_future().get().find("marks cannot be kept now"), std::string::npos);
  io::JournalFile::Continue(file, "scans", "base");
  const team::MarkJournal journal(file, [](const std::string&) {});
  for (int i = 0; i < 500 && journal.Load().empty(); ++i) usleep(20'000);
  ASSERT_EQ(journal.Load().size(), 1U);
  EXPECT_EQ(journal.Load().front().id, "anna");
}

TEST_F(View, AMarkMovesWithTheScanItStandsOn) {
  const dds::Participant participant({.interface = "lo", .tag = network_.tag()});
  dds::Refusals refusals([](const std::string& text) { ADD_FAILURE() << text; });
  const auto exchange_of = [&] {
    return std::make_unique<dds::MarkExchange>(
        participant, refusals, team::MarkJournal({}, [](const std::string&) {}));
  };
  auto first = exchange_of();
  const auto second = exchange_of();
  first->Start();
  second->Start();
  first->Place(std::vector<team::ScanPlace>{
      {.robot = "robot1", .stamp = 5s, .T_map_robot = {1.0, 1.0, 0.0}}});
  first->Tell({.id = "m1", .kind = "victim", .p_map_m = {2.0, 3.0}});
  first->Place(std::vector<team::ScanPlace>{
      {.robot = "robot1", .stamp = 5s, .T_map_robot = {1.5, 1.0, 0.0}}});
  const auto heard_x = [&]() -> double {
    const std::vector<team::Mark> marks = second->marks();
    return marks.empty() ? 0.0 : marks.front().p_map_m.x();
  };
  for (int i = 0; i < 200 && heard_x() != 2.5; ++i) usleep(20'000);
  EXPECT_EQ(heard_x(), 2.5);

  // A correction of the map names the scan as the services tell it.
  const dds::Writer<dds::wire::RelevantScan> scans(
      participant, dds::kSharedScansTopic, dds::Profile::kSharedScans);
  const team::ScanKey key{.service = "base", .robot = "robot1", .sequence = 3};
  const std::string frame = "map";
  const auto tell_scan = [&](const Pose2& T_map_robot) {
    scans.Write(
        dds::ToWire(team::TeamScan{.key = key,
                                   .scan = {.stamp = 5s, .geometry = {}, .ranges_m = {1.0F}},
                                   .map_robot = {.T_a_b = T_map_robot},
                                   .T_odom_robot = {}},
                    frame));
  };
  tell_scan({1.75, 1.0, 0.0});
  for (int i = 0; i < 200 && heard_x() != 2.75; ++i) usleep(20'000);
  EXPECT_EQ(heard_x(), 2.75);
  team::TeamEpoch epoch;
  epoch.scans.push_back(
      {.key = key, .T_map_robot_before = {}, .map_robot = {.T_a_b = {2.0, 1.0, 0.0}}});
  // Whichever of them has heard of the scan by now: both follow, as all services do.
  for (auto* exchange : {first.get(), second.get()}) exchange->Follow(epoch);
  for (int i = 0; i < 200 && heard_x() != 3.0; ++i) usleep(20'000);
  EXPECT_EQ(heard_x(), 3.0);
  EXPECT_THROW(first->Tell({.id = "m2", .kind = "nonsense"}), dds::MarkError);
  // Whoever comes when its maker is gone hears it of the other.
  first.reset();
  const auto late = exchange_of();
  late->Start();
  for (int i = 0; i < 200 && late->marks().empty(); ++i) usleep(20'000);
  EXPECT_EQ(late->marks().size(), 1U);
}

}  // namespace
}  // namespace qwsm::test
