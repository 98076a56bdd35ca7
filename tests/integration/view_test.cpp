// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The page's server: who is let in, what they get, and that nobody who misbehaves costs the robots
// anything. The page itself is tested in a browser (tests/browser).
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "service/dds/entities/writer.hpp"
#include "tests/support/network.hpp"
#include "tests/support/process_state.hpp"
#include "tests/support/robot_in_room.hpp"
#include "tests/support/web_client.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

/// A service with a page.
class ViewedService {
 public:
  explicit ViewedService(const PrivateNetwork& network, std::vector<std::string> more = {})
      : service_(network.JoinService(With(std::move(more)))) {
    if (!service_.WaitUntilItSays("look at http://localhost:")) {
      throw std::runtime_error(service_.ErrorsSoFar());
    }
    const std::string said = service_.ErrorsSoFar();
    constexpr std::string_view kBefore = "http://localhost:";
    port_ = std::stoi(said.substr(said.find(kBefore) + kBefore.size()));
  }

  int port() const { return port_; }
  Daemon& daemon() { return service_; }

 private:
  static std::vector<std::string> With(std::vector<std::string> more) {
    more.insert(more.begin(), {"serve", "--verbose", "--view", "--set", "view.port=0"});
    return more;
  }

  Daemon service_;
  int port_ = 0;
};

std::size_t OpenFiles(pid_t process) {
  const auto folder = std::filesystem::path("/proc") / std::to_string(process) / "fd";
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// One who looks on: it knows which channels there are.
class Onlooker {
 public:
  explicit Onlooker(int port, int receive_buffer_bytes = 0) : client_(port, receive_buffer_bytes) {
    const std::string answer = client_.Upgrade();
    if (answer.find(" 101 ") == std::string::npos) throw std::runtime_error(answer);
  }

  WebClient& client() { return client_; }

  /// Waits until a topic is offered and subscribes to it. @returns whether it was in time.
  bool Subscribe(const std::string& topic, int subscription) {
    for (int i = 0; i < 1000 && !ids_.contains(topic); ++i) {
      const auto frame = client_.Receive();
      if (!frame) return false;
      Note(frame->payload);
    }
    return client_.SendFrame(WebClient::kText,
                             R"({"op":"subscribe","subscriptions":[{"id":)" +
                                 std::to_string(subscription) + R"(,"channelId":)" + ids_[topic] +
                                 "}]}");
  }
  /// The next sample of a subscription: what is behind its head of 13 bytes.
  std::optional<std::string> Sample(int subscription) {
    while (const auto frame = client_.Receive()) {
      Note(frame->payload);
      const bool is_sample = frame->opcode == WebClient::kBinary && frame->payload[0] == 1;
      if (is_sample && frame->payload[1] == subscription) return frame->payload.substr(13);
    }
    return std::nullopt;
  }

 private:
  /// Of each channel of an advertisement, keys come in the order of the alphabet.
  void Note(const std::string& text) {
    if (text.find(R"("op":"advertise")") == std::string::npos) return;
    for (std::size_t at = 0; (at = text.find(R"("id":)", at)) != std::string::npos; ++at) {
      const std::string id = text.substr(at + 5, text.find(',', at) - at - 5);
      const std::size_t topic = text.find(R"("topic":")", at) + 9;
      ids_[text.substr(topic, text.find('"', topic) - topic)] = id;
    }
  }

  WebClient client_;
  std::map<std::string, std::string> ids_;
};

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

TEST_F(View, TakesWhereARobotIs) {
  ViewedService service(network_);
  RobotInRoom robot(network_);
  ASSERT_FALSE(robot.DriveUntilAnswered(3).empty());
  const dds::Reader<dds::wire::PoseWithCovarianceStamped> told(
      robot.participant(), "/robot1/initialpose", dds::Profile::kSensorIn);
  Onlooker onlooker(service.port());
  ASSERT_TRUE(onlooker.Subscribe("/robot1/match_report", 1));  // By then the robot is known.
  const std::string begin = R"({"op":"advertise","channels":[{"id":5,"encoding":"cdr",)"
                            R"("schemaName":"geometry_msgs/msg/PoseWithCovarianceStamped",)";
  onlooker.client().SendFrame(WebClient::kText, begin + R"("topic":"/robot1/initialpose"}]})");
  onlooker.client().SendFrame(WebClient::kText, begin + R"("topic":"/nobody/initialpose"}]})");
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

TEST_F(View, RefusesPagesAndNamesOfOthers) {
  ViewedService service(network_, {"--set", "view.origins=https://app.example"});
  const auto answer = [&](const std::string& host, const std::string& more) {
    return WebClient(service.port()).Upgrade("/ws", host, more);
  };
  EXPECT_NE(answer("localhost", "Origin: http://localhost\r\n").find(" 101 "), std::string::npos);
  EXPECT_NE(answer("localhost", "Origin: https://app.example\r\n").find(" 101 "),
            std::string::npos);
  EXPECT_NE(answer("localhost", "Origin: https://evil.example\r\n").find(" 403 "),
            std::string::npos);
  // A name of somebody else that leads here, and the page that came from there.
  EXPECT_NE(answer("evil.example", "Origin: http://evil.example\r\n").find(" 403 "),
            std::string::npos);
  EXPECT_NE(WebClient(service.port()).Upgrade("/ws", "localhost", "", "chat").find(" 400 "),
            std::string::npos);
}

TEST_F(View, OutsideTheLoopbackNeedsAToken) {
  const Outcome open = network_.Run({"serve", "--view", "--set", "view.address=0.0.0.0"});
  EXPECT_NE(open.exit_code, 0);
  EXPECT_NE(open.errors.find("set view.token"), std::string::npos) << open.errors;

  ViewedService service(network_,
                        {"--set", "view.address=0.0.0.0", "--set", "view.token=open-sesame"});
  EXPECT_NE(WebClient(service.port()).Upgrade("/ws").find(" 401 "), std::string::npos);
  EXPECT_NE(WebClient(service.port()).Upgrade("/ws?token=open-sesamE").find(" 401 "),
            std::string::npos);
  EXPECT_NE(WebClient(service.port()).Upgrade("/ws?token=open-sesame").find(" 101 "),
            std::string::npos);
}

TEST_F(View, TellsThatThePortIsTaken) {
  ViewedService service(network_);
  const Outcome second =
      network_.Run({"serve", "--view", "--set", "view.port=" + std::to_string(service.port())});
  EXPECT_NE(second.exit_code, 0);
  EXPECT_NE(second.errors.find("view.port"), std::string::npos) << second.errors;
}

/// Anything but what the protocol wants, drawn from what comes near to it.
class Nonsense {
 public:
  std::string Text() {
    static const std::vector<std::string> kParts{R"({"op":)",
                                                 R"("subscribe")",
                                                 R"("advertise")",
                                                 ",",
                                                 "}",
                                                 "[",
                                                 R"("channels":)",
                                                 R"("subscriptions":)",
                                                 "-1",
                                                 "1e999",
                                                 "null",
                                                 "4294967296",
                                                 R"({"id":1,"channelId":1})",
                                                 "\xff\xfe",
                                                 R"("op")",
                                                 std::string(300, '['),
                                                 std::string("\0", 1)};
    std::string text;
    for (int i = Below(12); i >= 0; --i) {
      text += kParts[static_cast<std::size_t>(Below(static_cast<int>(kParts.size())))];
    }
    return text;
  }
  std::string Bytes(int most) {
    std::string bytes(static_cast<std::size_t>(Below(most)), '\0');
    for (char& byte : bytes) byte = static_cast<char>(Below(256));
    return bytes;
  }
  int Below(int end) { return std::uniform_int_distribution<int>(0, end - 1)(random_); }

 private:
  std::mt19937 random_{20};
};

TEST_F(View, NonsenseCostsTheRobotsNothing) {
  constexpr int kRounds = 100;
  constexpr int kRequests = 100;
  ViewedService service(network_);
  RobotInRoom robot(network_);
  ASSERT_FALSE(robot.DriveUntilAnswered(5).empty());
  Nonsense nonsense;
  std::size_t answered = 0;
  double before_kB = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    if (round == kRounds / 5) before_kB = ResidentKilobytes(service.daemon().process());
    WebClient requests(service.port());
    if (round % 2 == 0) {
      for (int i = 0; i < kRequests; ++i) requests.Send(nonsense.Bytes(80) + "\r\n\r\n");
    } else if (requests.Upgrade().find(" 101 ") != std::string::npos) {
      for (int i = 0; i < kRequests; ++i) {
        const bool is_frame = nonsense.Below(20) > 0;
        if (nonsense.Below(2) == 0)
          requests.SendFrame(WebClient::kText, nonsense.Text());
        else if (is_frame)
          requests.SendFrame(WebClient::kBinary, nonsense.Bytes(60));
        else
          requests.Send(nonsense.Bytes(40));
      }
    }
    answered += robot.Drive(20ms).size();
  }
  answered += robot.Hear(300ms).size();
  EXPECT_EQ(answered, static_cast<std::size_t>(kRounds));
  const double grown_kB = ResidentKilobytes(service.daemon().process()) - before_kB;
  RecordProperty("grown_kB", std::to_string(grown_kB));
  EXPECT_LT(grown_kB, 4096.0);
  EXPECT_NE(WebClient(service.port()).Get("/").find(" 200 "), std::string::npos);
  EXPECT_EQ(service.daemon().End().exit_code, 0);
}

TEST_F(View, WhoeverSaysNothingIsCutOffAndAThousandAreTurnedAway) {
  constexpr std::size_t kMostPlain = 64;
  ViewedService service(network_, {"--set", "view.max_clients=4"});
  const std::size_t at_first = OpenFiles(service.daemon().process());
  std::vector<WebClient> silent;
  for (int i = 0; i < 1000; ++i) {
    silent.emplace_back(service.port());
    silent.back().Send("GET / HTTP/1.1\r\nHost: loc");  // And never the rest.
  }
  EXPECT_TRUE(silent.back().IsClosedWithin(2s));
  EXPECT_LE(OpenFiles(service.daemon().process()), at_first + kMostPlain + 1);
  // Their time is over in five seconds, whatever they trickle; then others are heard again.
  for (int i = 0; i < 9; ++i) {
    silent.front().Send("a");
    usleep(700'000);
  }
  EXPECT_TRUE(silent.front().IsClosedWithin(1s));
  EXPECT_NE(WebClient(service.port()).Get("/").find(" 200 "), std::string::npos);
  std::vector<WebClient> sockets;
  for (int i = 0; i < 4; ++i) {
    sockets.emplace_back(service.port());
    EXPECT_NE(sockets.back().Upgrade().find(" 101 "), std::string::npos);
  }
  EXPECT_NE(WebClient(service.port()).Upgrade().find(" 503 "), std::string::npos);
}

TEST_F(View, WhoeverHangsCostsOnlyItsOwnConnection) {
  ViewedService service(network_);
  RobotInRoom robot(network_);
  ASSERT_FALSE(robot.DriveUntilAnswered(5).empty());
  Onlooker hanging(service.port(), 4096);
  for (const auto& [topic, id] : std::map<std::string, int>{
           {"/robot1/scan", 1}, {"/tf", 2}, {"/robot1/match_report", 3}, {"/map", 4}}) {
    ASSERT_TRUE(hanging.Subscribe(topic, id));
  }
  Onlooker reading(service.port());
  ASSERT_TRUE(reading.Subscribe("/robot1/match_report", 3));
  robot.DriveUntilAnswered(100);
  const double before_kB = ResidentKilobytes(service.daemon().process());
  std::size_t answered = 0;
  for (int i = 0; i < 600; ++i) answered += robot.Drive(5ms).size();
  answered += robot.Hear(300ms).size();
  EXPECT_EQ(answered, 600U);
  EXPECT_TRUE(reading.Sample(3));
  // The map grows a little; what the one who hangs misses would be some megabytes.
  EXPECT_LT(ResidentKilobytes(service.daemon().process()) - before_kB, 3072.0);
}

/// A map as a service publishes it: walls every so many cells, in both directions.
class DrawnMap {
 public:
  DrawnMap(std::uint32_t side, std::uint32_t between_walls) : cells_(std::size_t{side} * side) {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      cells_[i] = i % side % between_walls == 0 || i / side % between_walls == 0 ? 100 : 0;
    }
    sample_.header.frame_id = frame_.data();
    sample_.info = {
        .map_load_time = {}, .resolution = 0.05F, .width = side, .height = side, .origin = {}};
    const auto size = static_cast<std::uint32_t>(cells_.size());
    sample_.data = {._maximum = size, ._length = size, ._buffer = cells_.data(), ._release = false};
  }
  DrawnMap(const DrawnMap&) = delete;
  DrawnMap& operator=(const DrawnMap&) = delete;

  const dds::wire::OccupancyGrid& sample() const { return sample_; }

 private:
  std::string frame_ = "map";
  std::vector<std::int8_t> cells_;
  dds::wire::OccupancyGrid sample_{};
};

TEST_F(View, WhoeverComesLateGetsTheWholeMap) {
  constexpr std::uint32_t kSide = 2000;  // 100 m at 5 cm.
  constexpr int kTiles = 32 * 32;
  ViewedService service(network_);
  const dds::Participant participant({.interface = "lo", .tag = network_.tag()});
  const dds::Writer<dds::wire::OccupancyGrid> maps(
      participant, "/large/map", dds::Profile::kLatched);
  const DrawnMap map(kSide, 40);
  maps.Write(map.sample());
  Onlooker first(service.port());
  ASSERT_TRUE(first.Subscribe("/large/map_tiles", 1));
  ASSERT_TRUE(first.Sample(1));
  const auto begin = std::chrono::steady_clock::now();
  Onlooker late(service.port());
  ASSERT_TRUE(late.Subscribe("/large/map_tiles", 1));
  for (int i = 0; i < kTiles; ++i) ASSERT_TRUE(late.Sample(1)) << i;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::cout << "the whole map after " << took.count() << " s\n";
  EXPECT_LT(took.count(), 5.0);  // A second is what is wanted where nothing else runs.
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
  EXPECT_LT(ages_s[ages_s.size() / 2], 0.2);
}

TEST_F(View, FiveHundredConnectionsLeaveNothingBehind) {
  ViewedService service(network_);
  RobotInRoom robot(network_);
  ASSERT_FALSE(robot.DriveUntilAnswered(3).empty());
  double before_kB = 0.0;
  for (int i = 0; i < 600; ++i) {
    if (i == 100) before_kB = ResidentKilobytes(service.daemon().process());
    Onlooker onlooker(service.port());
    ASSERT_TRUE(onlooker.Subscribe("/robot1/match_report", 1));
    ASSERT_TRUE(onlooker.Subscribe("/tf", 2));
  }
  const double grown_kB = ResidentKilobytes(service.daemon().process()) - before_kB;
  std::cout << "500 connections: " << grown_kB << " kB more\n";
  EXPECT_LT(grown_kB, 1024.0);
}

TEST_F(View, MarksOutliveTheService) {
  const TemporaryFolder folder;
  const std::vector<std::string> journal{"--journal", folder.path() / "team.db"};
  const std::string advertise = R"({"op":"advertise","channels":[{"id":1,"topic":"/qwsm/marks",)"
                                R"("encoding":"cdr","schemaName":"qwsm_msgs/msg/Mark"}]})";
  // Stamp, frame, id, kind, text, author; x and y; not removed.
  std::string mark("\1\1\0\0\0\0\1\0\0", 9);
  mark += std::string(8, '\0') + std::string("\4\0\0\0map\0\3\0\0\0m1\0\0\7\0\0\0victim\0\0", 28);
  mark += std::string("\5\0\0\0Anna\0\0\0\0\2\0\0\0o\0\0\0\0\0\0\0", 24);
  const std::vector<double> place{2.0, 3.0};
  mark.append(reinterpret_cast<const char*>(place.data()), 2 * sizeof(double));
  mark += std::string(1, '\0');
  {
    ViewedService service(network_, journal);
    Onlooker onlooker(service.port());
    ASSERT_TRUE(onlooker.Subscribe("/qwsm/marks", 1));
    onlooker.client().SendFrame(WebClient::kText, advertise);
    onlooker.client().SendFrame(WebClient::kBinary, mark);
    const auto told = onlooker.Sample(1);
    ASSERT_TRUE(told);
    EXPECT_NE(told->find("Anna"), std::string::npos);
    usleep(200'000);
    service.daemon().End(SIGKILL);
  }
  ViewedService service(network_, journal);
  Onlooker onlooker(service.port());
  ASSERT_TRUE(onlooker.Subscribe("/qwsm/marks", 1));
  const auto kept = onlooker.Sample(1);
  ASSERT_TRUE(kept);
  EXPECT_NE(kept->find("Anna"), std::string::npos);
}

}  // namespace
}  // namespace qwsm::test
