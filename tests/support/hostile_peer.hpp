// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "service/dds/entities/writer.hpp"
#include "service/dds/wire/robot_names.hpp"

namespace qwsm::test {

/// Sends bytes that are no RTPS, and as many that begin like it, to ports of this host.
inline void SendGarbage(std::span<const std::uint16_t> ports, int datagrams) {
  const int out = socket(AF_INET, SOCK_DGRAM, 0);
  std::mt19937 random(7);
  std::vector<char> bytes(512);
  for (int i = 0; i < datagrams; ++i) {
    for (char& byte : bytes) byte = static_cast<char>(random());
    if (random() % 2 == 0) std::copy_n("RTPS\x02\x01", 6, bytes.begin());
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(ports[static_cast<std::size_t>(i) % ports.size()]);
    sendto(out,
           bytes.data(),
           random() % bytes.size(),
           0,
           reinterpret_cast<sockaddr*>(&to),
           sizeof(to));
  }
  close(out);
}

/// Publishes what a service takes, of the right types, with any bits
/// for numbers.
class HostilePeer {
 public:
  HostilePeer(const dds::Participant& participant, const std::string& robot)
      : names_(robot),
        scans_(participant, names_.Topic(dds::kScanTopic), dds::Profile::kSensorOut),
        odometry_(participant, names_.Topic(dds::kOdometryTopic), dds::Profile::kSensorOut),
        poses_(participant, names_.Topic(dds::kInitialPoseTopic), dds::Profile::kSensorOut),
        transforms_(participant, dds::kStaticTransformsTopic, dds::Profile::kStaticTransformsOut),
        relevant_(participant, dds::kSharedScansTopic, dds::Profile::kSharedScans) {}

  /// Whether a service listens to all of it.
  bool is_heard() const {
    return scans_.reader_count() > 0 && odometry_.reader_count() > 0 && poses_.reader_count() > 0 &&
           transforms_.reader_count() > 0 && relevant_.reader_count() > 0;
  }

  /// A sample of each type.
  void PublishAbsurdities() {
    PublishScan();
    PublishPoses();
    PublishTransforms();
    PublishRelevantScan();
  }

 private:
  template <class Number>
  Number AnyNumber() {
    using Bits = std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>;
    return std::bit_cast<Number>(static_cast<Bits>(random_()));
  }
  template <class Numbers>
  void Fill(Numbers& numbers) {
    for (auto& number : numbers) number = AnyNumber<std::decay_t<decltype(number)>>();
  }

  std::string AnyText(std::size_t longest = 2000) {
    std::string text(1 + random_() % longest, 'x');
    for (char& letter : text) letter = static_cast<char>('a' + random_() % 26);
    return text;
  }

  dds::wire::Header AnyHeader(std::string& frame) {
    frame = AnyText();
    return {.stamp = {.sec = AnyNumber<std::int32_t>(), .nanosec = AnyNumber<std::uint32_t>()},
            .frame_id = frame.data()};
  }

  dds::wire::Pose AnyPose() {
    return {
        .position = {AnyNumber<double>(), AnyNumber<double>(), AnyNumber<double>()},
        .orientation = {
            AnyNumber<double>(), AnyNumber<double>(), AnyNumber<double>(), AnyNumber<double>()}};
  }

  static dds_sequence_float Borrow(std::vector<float>& numbers) {
    const auto count = static_cast<std::uint32_t>(numbers.size());
    return {._maximum = count, ._length = count, ._buffer = numbers.data(), ._release = false};
  }

  void PublishScan() {
    std::string frame;
    std::vector<float> ranges(random_() % 5000);
    Fill(ranges);
    dds::wire::LaserScan scan{};
    scan.header = AnyHeader(frame);
    scan.angle_min = AnyNumber<float>();
    scan.angle_increment = AnyNumber<float>();
    scan.range_min = AnyNumber<float>();
    scan.range_max = AnyNumber<float>();
    scan.ranges = Borrow(ranges);
    scans_.Write(scan);
  }

  void PublishPoses() {
    std::string frame;
    std::string child = AnyText();
    dds::wire::Odometry odometry{};
    odometry.header = AnyHeader(frame);
    odometry.child_frame_id = child.data();
    odometry.pose.pose = AnyPose();
    odometry_.Write(odometry);
    dds::wire::PoseWithCovarianceStamped pose{};
    pose.header = AnyHeader(frame);
    pose.pose.pose = AnyPose();
    Fill(pose.pose.covariance);
    poses_.Write(pose);
  }

  // Half of them can be used, but for names that are too long.
  void PublishTransforms() {
    std::vector<std::string> names(600);
    for (std::string& name : names) name = AnyText(300);
    std::vector<dds::wire::TransformStamped> transforms(names.size() / 2);
    for (std::size_t i = 0; i < transforms.size(); ++i) {
      transforms[i].header.frame_id = names[2 * i].data();
      transforms[i].child_frame_id = names[2 * i + 1].data();
      transforms[i].transform.rotation.w = i % 2 == 0 ? 1.0 : AnyNumber<double>();
    }
    const auto count = static_cast<std::uint32_t>(transforms.size());
    transforms_.Write(dds::wire::TFMessage{
        .transforms = {
            ._maximum = count, ._length = count, ._buffer = transforms.data(), ._release = false}});
  }

  void PublishRelevantScan() {
    std::string frame;
    std::string origin = AnyText();
    std::string robot = AnyText();
    std::vector<float> ranges(random_() % 5000);
    Fill(ranges);
    dds::wire::RelevantScan scan{};
    scan.header = AnyHeader(frame);
    scan.origin = origin.data();
    scan.robot = robot.data();
    scan.sequence_number = random_();
    scan.pose = {AnyNumber<double>(), AnyNumber<double>(), AnyNumber<double>()};
    Fill(scan.covariance);
    scan.angle_increment = AnyNumber<float>();
    scan.range_max = AnyNumber<float>();
    scan.ranges = Borrow(ranges);
    relevant_.Write(scan);
  }

  std::mt19937_64 random_{11};
  dds::RobotNames names_;
  dds::Writer<dds::wire::LaserScan> scans_;
  dds::Writer<dds::wire::Odometry> odometry_;
  dds::Writer<dds::wire::PoseWithCovarianceStamped> poses_;
  dds::Writer<dds::wire::TFMessage> transforms_;
  dds::Writer<dds::wire::RelevantScan> relevant_;
};

}  // namespace qwsm::test
