// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The page's server with a certificate: who is believed, who is let in, what is told of bad files.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/certificates.hpp"
#include "tests/support/encrypted_line.hpp"
#include "tests/support/robot_in_room.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/viewed_service.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;
using Settings = std::vector<std::string>;

class ViewEncryption : public ::testing::Test {
 protected:
  ViewEncryption() {
    own_.Write(folder_.path() / "own");
    std::signal(SIGPIPE, SIG_IGN);  // OpenSSL writes to lines that are closed.
  }

  std::string File(const std::string& name) const { return folder_.path() / name; }
  static Settings Set(const Settings& settings) {
    Settings arguments;
    for (const auto& one : settings) arguments.insert(arguments.end(), {"--set", "view." + one});
    return arguments;
  }
  Settings Encrypted(Settings more = {}) const {
    more.insert(more.end(), {"certificate=" + File("own.pem"), "key=" + File("own.key")});
    return Set(more);
  }
  WebClient Connect(int port, const Certificate* as = nullptr) const {
    return WebClient(std::make_unique<EncryptedLine>(port, own_, as));
  }
  std::string WhatIsToldOf(const Settings& settings) const {
    Settings arguments{"serve", "--view", "--set", "view.port=0"};
    const Settings more = Set(settings);
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = network_.Run(arguments);
    EXPECT_NE(outcome.exit_code, 0);
    return outcome.errors;
  }

  TemporaryFolder folder_;
  Certificate own_{"localhost"};
  PrivateNetwork network_;
};

TEST_F(ViewEncryption, ServesPageAndPosesToWhoeverBelievesIt) {
  Settings settings = Encrypted({"address=0.0.0.0", "token=open-sesame"});
  settings.insert(settings.end(), {"--set", "team.map_period_s=0.5"});
  ViewedService service(network_, settings);
  EXPECT_EQ(service.address().rfind("https://localhost:", 0), 0U) << service.address();
  EXPECT_NE(Connect(service.port()).Get("/").find("<title>Q-WSM</title>"), std::string::npos);
  EXPECT_NE(Connect(service.port()).Upgrade("/ws?token=open-sesamE").find(" 401 "),
            std::string::npos);
  const std::string origin = "Origin: https://robot.lan\r\n";
  const std::string target = "/ws?token=open-sesame";
  EXPECT_NE(Connect(service.port()).Upgrade(target, "robot.lan", origin).find(" 101 "),
            std::string::npos);
  EXPECT_NE(Connect(service.port()).Upgrade(target, "robot.lan:1", origin).find(" 403 "),
            std::string::npos);

  RobotInRoom robot(network_);
  ASSERT_FALSE(robot.DriveUntilAnswered(3).empty());
  Onlooker onlooker(Connect(service.port()), target);
  ASSERT_TRUE(onlooker.Subscribe("/robot1/match_report", 7));
  ASSERT_TRUE(onlooker.Subscribe("/map_tiles", 8));
  robot.DriveUntilAnswered(20);
  EXPECT_TRUE(onlooker.Sample(7));
  EXPECT_TRUE(onlooker.Sample(8));
  EXPECT_EQ(service.daemon().End().exit_code, 0);
}

TEST_F(ViewEncryption, WhoDoesNotEncryptIsToldTo) {
  ViewedService service(network_, Encrypted());
  for (const std::string& answer :
       {WebClient(service.port()).Get("/"), WebClient(service.port()).Upgrade()}) {
    EXPECT_NE(answer.find(" 400 "), std::string::npos) << answer;
  }
  EXPECT_NE(WebClient(service.port()).Get("/").find("https://"), std::string::npos);
  EXPECT_NE(Connect(service.port()).Upgrade().find(" 101 "), std::string::npos);
  // And a client that is told to believe somebody else leaves.
  const Certificate stranger("localhost");
  EXPECT_THROW(EncryptedLine(service.port(), stranger), std::runtime_error);
}

TEST_F(ViewEncryption, OnlyThoseAreLetInForWhomTheAuthorityVouches) {
  const Certificate authority("team");
  const Certificate member("member", &authority, {});
  const Certificate expired("late", &authority, {.until = -1s});
  const Certificate stranger("stranger");
  authority.Write(folder_.path() / "team");
  ViewedService service(network_, Encrypted({"address=0.0.0.0", "client_ca=" + File("team.pem")}));
  EXPECT_NE(Connect(service.port(), &member).Upgrade().find(" 101 "), std::string::npos);
  for (const Certificate* other : {&stranger, &expired, static_cast<const Certificate*>(nullptr)}) {
    EXPECT_EQ(Connect(service.port(), other).Upgrade().find(" 101 "), std::string::npos);
  }
}

TEST_F(ViewEncryption, WhoIsSlowToAgreeOnKeysIsCutOff) {
  // The first bytes of a greeting that says that 512 will follow.
  const std::string greeting("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11);
  ViewedService service(network_, Encrypted());
  std::vector<WebClient> slow;
  for (int i = 0; i < 200; ++i) {
    slow.emplace_back(service.port());
    if (i % 2 == 0) slow.back().Send(greeting);
  }
  EXPECT_TRUE(slow.back().IsClosedWithin(2s));  // More than are heard at a time.
  for (int i = 0; i < 9; ++i) {
    slow.front().Send("a");
    usleep(700'000);
  }
  EXPECT_TRUE(slow[0].IsClosedWithin(1s));
  EXPECT_TRUE(slow[1].IsClosedWithin(1s));
  EXPECT_NE(Connect(service.port()).Upgrade().find(" 101 "), std::string::npos);
}

TEST_F(ViewEncryption, NonsenseAndManyConnectionsCostNothing) {
  ViewedService service(network_, Encrypted());
  RobotInRoom robot(network_);
  ASSERT_TRUE(robot.DriveUntilAllAreAnswered(3));
  constexpr int kRounds = 30;
  std::string nonsense("\x16\x03\x01", 3);
  nonsense.resize(200, 'x');
  std::size_t answered = 0;
  for (int i = 0; i < kRounds; ++i) {
    WebClient(service.port()).Send(nonsense);
    Onlooker onlooker(Connect(service.port()));
    ASSERT_TRUE(onlooker.Subscribe("/robot1/match_report", 1));
    answered += robot.Drive(20ms).size();
  }
  answered += robot.Hear(300ms).size();
  EXPECT_EQ(answered, static_cast<std::size_t>(kRounds));
  EXPECT_EQ(service.daemon().End().exit_code, 0);
}

TEST_F(ViewEncryption, BadFilesAreToldWithWhatAndHowToMendIt) {
  const auto expect = [&](const Settings& settings, const Settings& texts) {
    const std::string told = WhatIsToldOf(settings);
    for (const std::string& text : texts) EXPECT_NE(told.find(text), std::string::npos) << told;
  };
  const std::string certificate = "certificate=" + File("own.pem");
  const std::string key = "key=" + File("own.key");
  Certificate("other").Write(folder_.path() / "other");
  Certificate("old", nullptr, {.until = -1s}).Write(folder_.path() / "old");
  own_.WriteProtectedKey(File("locked.key"));
  std::ofstream(File("garbage")) << "not PEM\n";

  expect({certificate}, {"view.certificate", "view.key is not"});
  expect({key}, {"view.key", "view.certificate is not"});
  expect({"client_ca=" + File("own.pem")}, {"view.client_ca", "view.certificate"});
  expect({"certificate=" + File("none.pem"), key}, {"view.certificate: ", "none.pem", "No such"});
  expect({"certificate=" + folder_.path().string(), key}, {"view.certificate: ", "is no file"});
  expect({"certificate=" + File("garbage"), key}, {"view.certificate: ", "garbage", "PEM"});
  expect({"certificate=" + File("old.pem"), "key=" + File("old.key")},
         {"old.pem", "has expired on 20", "make a new one"});
  expect({certificate, "key=" + File("garbage")}, {"view.key: ", "garbage", "PEM"});
  expect({certificate, "key=" + File("own.pem")}, {"view.key: ", "no private key"});
  expect({certificate, "key=" + File("other.key")},
         {"view.key: ", "other.key", "is not the key of", "own.pem"});
  expect({certificate, "key=" + File("locked.key")}, {"view.key: ", "password", "openssl"});
  expect({certificate, key, "client_ca=" + File("garbage")}, {"view.client_ca: ", "garbage"});
  expect({certificate, key, "address=0.0.0.0"}, {"view.token", "view.client_ca"});
}

TEST_F(ViewEncryption, ACertificateOfTomorrowIsUsedAndToldOf) {
  Certificate("robot.lan", nullptr, {.from = 24h, .until = 48h}).Write(folder_.path() / "early");
  ViewedService service(network_,
                        Set({"certificate=" + File("early.pem"), "key=" + File("early.key")}));
  EXPECT_EQ(service.address().rfind("https://robot.lan:", 0), 0U) << service.address();
  EXPECT_TRUE(service.daemon().WaitUntilItSays("is this computer's clock right?"));
}

}  // namespace
}  // namespace qwsm::test
