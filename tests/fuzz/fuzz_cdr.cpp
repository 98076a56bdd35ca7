// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "service/io/bags/messages/message_reader.hpp"
#include "service/io/bags/messages/point_cloud_message.hpp"
#include "service/io/bags/messages/ros_messages.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace qwsm::io;
using qwsm::test::Expect;

/// Whether the bytes are such a message; anything but MessageError ends the fuzzer.
template <class Decode>
bool IsMessage(Decode decode) {
  try {
    decode();
    return true;
  } catch (const MessageError& error) {
    Expect(error.what()[0] != '\0');
    return false;
  }
}

}  // namespace

/// Any bytes as any message: the first byte says of which ROS.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Encoding encoding = data[0] % 2 == 0 ? Encoding::kCdr : Encoding::kRos1;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const bool has_header = IsMessage([&] { DecodeHeader(bytes, encoding); });
  const bool is_scan = IsMessage([&] {
    Expect(DecodeLaserScan(bytes, encoding).ranges_m.size() * sizeof(float) <= bytes.size());
  });
  const bool is_odometry =
      IsMessage([&] { Expect(std::isfinite(DecodeOdometry(bytes, encoding).T_frame_child.x_m)); });
  const bool is_imu =
      IsMessage([&] { Expect(qwsm::ObjectionTo(DecodeImu(bytes, encoding).reading).empty()); });
  Expect(has_header || !(is_scan || is_odometry || is_imu));
  IsMessage([&] { DecodeTransforms(bytes, encoding); });
  IsMessage([&] { DecodePointCloud(bytes, encoding); });
  return 0;
}
