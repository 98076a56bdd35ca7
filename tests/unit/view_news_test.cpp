// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Which samples are worth sending to a page.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "service/io/bags/writing/cdr_writer.hpp"
#include "service/view/streams/news.hpp"

namespace qwsm::view {
namespace {

using namespace std::chrono_literals;

/// The samples of one topic, one after the other.
class Topic {
 public:
  explicit Topic(std::string_view type) : filter_(NewsFilterOf(type)) {}
  bool IsNews(const std::string& bytes, Clock::duration at = 1s) {
    return filter_->IsNews(
        {.owner = {}, .bytes = bytes, .stamp_ns = 0, .arrived = Clock::time_point(at)});
  }

 private:
  std::unique_ptr<NewsFilter> filter_;
};

void AddHead(io::CdrWriter& writer) {
  writer.Add(std::uint32_t{12});
  writer.Add(std::uint32_t{34});
  writer.Add(std::string_view("frame"));
}

std::string Report(double x_m, double variance_m2 = 1e-4, std::string_view reason = "") {
  io::CdrWriter writer;
  AddHead(writer);
  writer.Add(std::string_view("robot1"));
  for (const double value : {x_m, 2.0, 3.0}) writer.Add(value);
  for (int i = 0; i < 9; ++i) writer.Add(i == 0 || i == 4 ? variance_m2 : 0.0);
  writer.Add(std::uint8_t{1});
  writer.Add(reason);
  return writer.bytes();
}

std::string Scan(const std::vector<float>& ranges_m) {
  io::CdrWriter writer;
  AddHead(writer);
  for (int i = 0; i < 7; ++i) writer.Add(0.0F);
  writer.Add(static_cast<std::uint32_t>(ranges_m.size()));
  for (const float range_m : ranges_m) writer.Add(range_m);
  return writer.bytes();
}

std::string Health(std::string_view state, std::string_view count) {
  io::CdrWriter writer;
  AddHead(writer);
  writer.Add(std::uint32_t{1});
  writer.Add(std::uint8_t{0});
  for (const std::string_view text :
       {std::string_view("qwsm: robot1"), state, std::string_view()}) {
    writer.Add(text);
  }
  writer.Add(std::uint32_t{1});
  writer.Add(std::string_view("scans"));
  writer.Add(count);
  return writer.bytes();
}

TEST(News, ARobotThatStandsIsReportedNowAndThen) {
  Topic topic("qwsm_msgs/msg/MatchReport");
  EXPECT_TRUE(topic.IsNews(Report(1.0)));
  int told = 0;
  for (int i = 1; i <= 100; ++i)
    told += topic.IsNews(Report(1.0 + 0.002 * (i % 3)), 1s + i * 100ms);
  EXPECT_EQ(told, 6);
}

TEST(News, WhatChangesSlowlyAddsUp) {
  Topic topic("qwsm_msgs/msg/MatchReport");
  EXPECT_TRUE(topic.IsNews(Report(1.0)));
  int told = 0;
  for (int i = 1; i <= 30; ++i) told += topic.IsNews(Report(1.0 + 0.004 * i), 1s + i * 1ms);
  EXPECT_EQ(told, 10);
}

TEST(News, DoubtAndWordsAreToldAtOnce) {
  Topic topic("qwsm_msgs/msg/MatchReport");
  EXPECT_TRUE(topic.IsNews(Report(1.0)));
  EXPECT_FALSE(topic.IsNews(Report(1.0, 1.1e-4)));
  EXPECT_TRUE(topic.IsNews(Report(1.0, 9e-4)));
  EXPECT_TRUE(topic.IsNews(Report(1.0, 9e-4, "too few pairs")));
}

TEST(News, NoiseAndFlickerOfAScanAreNone) {
  Topic topic("sensor_msgs/msg/LaserScan");
  std::vector<float> room(360, 4.0F);
  for (int i = 180; i < 360; ++i) room[i] = 9.0F;  // Behind the edge of a door.
  EXPECT_TRUE(topic.IsNews(Scan(room)));
  for (std::size_t i = 0; i < room.size(); ++i) room[i] += i % 2 == 0 ? 0.06F : -0.06F;
  room[180] = 4.0F;
  EXPECT_FALSE(topic.IsNews(Scan(room), 1h));
}

TEST(News, SomebodyInFrontOfALaserIsSeen) {
  Topic topic("sensor_msgs/msg/LaserScan");
  std::vector<float> room(360, 4.0F);
  EXPECT_TRUE(topic.IsNews(Scan(room)));
  for (int i = 100; i < 112; ++i) room[i] = 2.5F;
  EXPECT_TRUE(topic.IsNews(Scan(room)));
  EXPECT_FALSE(topic.IsNews(Scan(room)));
  room.resize(180);
  EXPECT_TRUE(topic.IsNews(Scan(room)));
}

TEST(News, OfHealthTheWordsCount) {
  Topic topic("diagnostic_msgs/msg/DiagnosticArray");
  EXPECT_TRUE(topic.IsNews(Health("tracked", "1")));
  EXPECT_FALSE(topic.IsNews(Health("tracked", "2"), 5s));
  EXPECT_TRUE(topic.IsNews(Health("lost", "2"), 5s));
  EXPECT_TRUE(topic.IsNews(Health("lost", "3"), 11s));
}

TEST(News, WhatCannotBeReadIsForItsReaderToTell) {
  Topic topic("sensor_msgs/msg/LaserScan");
  EXPECT_TRUE(topic.IsNews("nonsense"));
  EXPECT_TRUE(topic.IsNews("nonsense"));
  EXPECT_EQ(NewsFilterOf("tf2_msgs/msg/TFMessage"), nullptr);
}

}  // namespace
}  // namespace qwsm::view
