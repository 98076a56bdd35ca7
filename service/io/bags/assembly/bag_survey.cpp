// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/assembly/bag_survey.hpp"

#include <set>
#include <utility>

#include "service/io/bags/containers/chunk_codec.hpp"
#include "service/io/bags/messages/message_reader.hpp"

namespace qwsm::io {
namespace {

constexpr std::size_t kMostUnknownTypes = 50;
constexpr std::size_t kMostLasers = 64;  // More are a mistake.

std::string_view LastPartOf(std::string_view topic) { return topic.substr(topic.rfind('/') + 1); }

// A simulator knows where the robot is.
bool IsTruth(const BagTopic& topic) { return LastPartOf(topic.name) == "ground_truth"; }

/// Sorts the messages of a bag by what they are for.
class Surveyor {
 public:
  Surveyor(BagContents& contents, LogReport& report, BagFaults& faults)
      : contents_(contents), report_(report), faults_(faults) {}

  void Take(const BagTopic& topic, const BagMessage& message, std::uint32_t file) {
    ++report_.lines;
    if (topic.encoding == Encoding::kOther) return CountUnknown(topic.type + " (not CDR)");
    try {
      const std::string_view bytes = PlainMessage(message.bytes, buffer_);
      if (!TakeKnown(topic, message, bytes, file)) CountUnknown(topic.type);
    } catch (const MessageError& error) {
      faults_.OfMessage(topic.name, report_.lines, error.what());
    }
  }

 private:
  bool TakeKnown(const BagTopic& topic,
                 const BagMessage& message,
                 std::string_view bytes,
                 std::uint32_t file) {
    if (topic.type == kLaserScanMessage) {
      TakeScan(topic, message, bytes, file);
    } else if (topic.type == kOdometryMessage && IsTruth(topic)) {
      TakeTruth(topic, DecodeOdometry(bytes, topic.encoding));
    } else if (topic.type == kOdometryMessage) {
      TakeOdometry(topic, bytes);
    } else if (topic.type == kImuMessage) {
      TakeImu(topic, DecodeImu(bytes, topic.encoding));
    } else if (topic.type == kTransformsMessage || topic.type == kOldTransformsMessage) {
      TakeTransforms(topic, bytes);
    } else {
      return false;
    }
    return true;
  }

  void TakeScan(const BagTopic& topic,
                const BagMessage& message,
                std::string_view bytes,
                std::uint32_t file) {
    const RosHeader header = DecodeHeader(bytes, topic.encoding);
    ScanTopic& scans = LaserOn(topic.name, FrameName(header.frame));
    scans.places.push_back({.stamp = header.stamp,
                            .sequence = report_.lines,
                            .address = message.address,
                            .file = file,
                            .topic = static_cast<std::uint32_t>(message.topic)});
  }

  ScanTopic& LaserOn(const std::string& topic, const std::string& frame) {
    ScanTopic& first = contents_.scans[topic];
    if (first.places.empty()) first.frame = frame;
    if (first.frame == frame) return first;
    if (lasers_.size() >= kMostLasers && !lasers_.contains(topic + frame)) {
      throw MessageError("its frame is that of one laser too many");
    }
    lasers_.insert(topic + frame);
    ScanTopic& other = contents_.scans[topic + "[" + frame + "]"];
    other.frame = frame;
    return other;
  }

  void TakeOdometry(const BagTopic& topic, std::string_view bytes) {
    const OdometryMessage pose = DecodeOdometry(bytes, topic.encoding);
    OdometryTopic& odometry = contents_.odometry[topic.name];
    odometry.child_frame = FrameName(pose.child_frame);
    odometry.track.Add({.stamp = pose.header.stamp, .T_odom_robot = Planar(pose.T_frame_child)},
                       report_.lines);
  }

  void TakeImu(const BagTopic& topic, const ImuMessage& imu) {
    ImuTopic& known = contents_.imus[topic.name];
    known.frame = FrameName(imu.frame);
    known.readings.push_back(imu.reading);
  }

  void TakeTruth(const BagTopic& topic, const OdometryMessage& truth) {
    contents_.truth[topic.name].Add(
        {.stamp = truth.header.stamp, .T_odom_robot = Planar(truth.T_frame_child)}, report_.lines);
  }

  void TakeTransforms(const BagTopic& topic, std::string_view bytes) {
    TransformTree& tree = contents_.transforms[NamespaceOf(topic.name)];
    const bool is_static = LastPartOf(topic.name) == "tf_static";
    for (const TransformMessage& transform : DecodeTransforms(bytes, topic.encoding)) {
      if (tree.Take(transform, is_static, report_.lines)) continue;
      faults_.OfMessage(topic.name,
                        report_.lines,
                        "a transform is none, has no name, or has another parent than before");
    }
  }

  void CountUnknown(const std::string& type) {
    auto& unknown = report_.unknown_messages;
    const bool fits = unknown.contains(type) || unknown.size() < kMostUnknownTypes;
    ++unknown[fits ? type : "(others)"];
  }

  BagContents& contents_;
  LogReport& report_;
  BagFaults& faults_;
  std::string buffer_;
  std::set<std::string> lasers_;  // Topics and frames of those that share a topic with another.
};

}  // namespace

std::string NamespaceOf(std::string_view topic) {
  topic = topic.substr(0, topic.find('['));
  const std::size_t slash = topic.rfind('/');
  return std::string(slash == std::string_view::npos ? std::string_view() : topic.substr(0, slash));
}

std::string_view PlainMessage(std::string_view bytes, std::string& buffer) {
  if (!IsZstd(bytes)) return bytes;
  PlainChunk plain = Decompress("zstd", bytes);
  if (!plain.problem.empty()) throw MessageError(plain.problem);
  buffer = std::move(plain.bytes);
  return buffer;
}

void ForEachMessage(
    const std::filesystem::path& path,
    BagFaults& faults,
    std::vector<OpenBagFile>& files,
    const std::function<void(const BagTopic&, const BagMessage&, std::uint32_t)>& take) {
  const auto tell = [&faults](const std::string& what) { faults.Doubt(what); };
  for (const std::filesystem::path& file : FilesOfBag(path, tell)) {
    const auto number = static_cast<std::uint32_t>(files.size());
    files.emplace_back(file, [&faults, file](std::uint64_t where, const std::string& what) {
      faults.OfFile(file.string(), where, what);
    });
    MessageSource& messages = files.back().messages();
    while (const std::optional<BagMessage> message = messages.Next()) {
      take(messages.topics()[message->topic], *message, number);
    }
  }
}

BagContents Survey(std::span<const std::filesystem::path> paths,
                   LogReport& report,
                   BagFaults& faults) {
  BagContents contents;
  Surveyor surveyor(contents, report, faults);
  const auto take = [&](const BagTopic& topic, const BagMessage& message, std::uint32_t file) {
    surveyor.Take(topic, message, file);
  };
  for (const std::filesystem::path& path : paths) {
    try {
      ForEachMessage(path, faults, contents.files, take);
    } catch (const LogError&) {
      throw;
    } catch (const std::runtime_error& error) {
      const std::string what = error.what();
      throw LogError(what.starts_with(path.string()) ? what : path.string() + ": " + what);
    }
  }
  for (auto& [name, odometry] : contents.odometry) odometry.track.Sort();
  for (auto& [name, track] : contents.truth) track.Sort();
  return contents;
}

}  // namespace qwsm::io
