// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Who is let in to the page's server, and that nobody who misbehaves costs the robots anything.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/support/process_state.hpp"
#include "tests/support/robot_in_room.hpp"
#include "tests/support/viewed_service.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

// Their own accounts make these grow; what is lost for good, LeakSanitizer tells at the end.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kSanitizers_kB = 1e9;
#else
constexpr double kSanitizers_kB = 0.0;
#endif

class ViewAbuse : public ::testing::Test {
 protected:
  PrivateNetwork network_;
};

std::size_t OpenFiles(pid_t process) {
  const auto folder = std::filesystem::path("/proc") / std::to_string(process) / "fd";
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST_F(ViewAbuse, RefusesPagesAndNamesOfOthers) {
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

TEST_F(ViewAbuse, AnswersWhatItDoesNotTake) {
  ViewedService service(network_, {"--set", "view.address=localhost"});
  const auto answer = [&](const std::string& method, const std::string& more) {
    return WebClient(service.port())
        .Ask(method + " / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + more);
  };
  const std::string head = answer("HEAD", "\r\n");
  EXPECT_NE(head.find(" 200 "), std::string::npos) << head;
  EXPECT_TRUE(head.ends_with("\r\n\r\n")) << head;
  EXPECT_NE(answer("DELETE", "\r\n").find(" 405 "), std::string::npos);
  EXPECT_NE(answer("POST", "Content-Length: 2\r\n\r\n{}").find(" 413 "), std::string::npos);
}

TEST_F(ViewAbuse, OutsideTheLoopbackNeedsAToken) {
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

TEST_F(ViewAbuse, TellsThatThePortIsTaken) {
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

TEST_F(ViewAbuse, NonsenseCostsTheRobotsNothing) {
  constexpr int kRounds = 100;
  constexpr int kRequests = 100;
  ViewedService service(network_);
  RobotInRoom robot(network_);
  ASSERT_TRUE(robot.DriveUntilAllAreAnswered(5));
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
  EXPECT_LT(grown_kB, 4096.0 + kSanitizers_kB);
  EXPECT_NE(WebClient(service.port()).Get("/").find(" 200 "), std::string::npos);
  EXPECT_EQ(service.daemon().End().exit_code, 0);
}

TEST_F(ViewAbuse, WhoeverSaysNothingIsCutOffAndAThousandAreTurnedAway) {
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

TEST_F(ViewAbuse, WhoeverHangsCostsOnlyItsOwnConnection) {
  // Looking for loops takes memory, too, until there are as many places as are kept at hand.
  ViewedService service(network_, {"--set", "graph.enabled=false"});
  RobotInRoom robot(network_);
  ASSERT_FALSE(robot.DriveUntilAnswered(5).empty());
  Onlooker hanging(service.port(), 4096);
  for (const auto& [topic, id] : std::map<std::string, int>{
           {"/robot1/scan", 1}, {"/tf", 2}, {"/robot1/match_report", 3}, {"/map", 4}}) {
    ASSERT_TRUE(hanging.Subscribe(topic, id));
  }
  Onlooker reading(service.port());
  ASSERT_TRUE(reading.Subscribe("/robot1/match_report", 3));
  ASSERT_TRUE(robot.DriveUntilAllAreAnswered(100));
  const double before_kB = ResidentKilobytes(service.daemon().process());
  std::size_t answered = 0;
  for (int i = 0; i < 600; ++i) answered += robot.Drive(5ms).size();
  answered += robot.Hear(300ms).size();
  EXPECT_EQ(answered, 600U);
  EXPECT_TRUE(reading.Sample(3));
  // The map grows a little; what the one who hangs misses would be some megabytes.
  EXPECT_LT(ResidentKilobytes(service.daemon().process()) - before_kB, 3072.0 + kSanitizers_kB);
}

TEST_F(ViewAbuse, FiveHundredConnectionsLeaveNothingBehind) {
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
  EXPECT_LT(grown_kB, 1024.0 + kSanitizers_kB);
}

}  // namespace
}  // namespace qwsm::test
