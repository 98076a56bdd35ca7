// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A second vendor: a robot that speaks Fast DDS, as most ROS 2 robots do, with the service.
#include <fastrtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/fast_dds.hpp"
#include "tests/support/network.hpp"

// Fast DDS 2.9 deletes its readers by a class of another size than they were made by.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "new_delete_type_mismatch=0"; }

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;
using namespace eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

/// A participant of Fast DDS on loopback, which finds others there without multicast.
class FastParticipant {
 public:
  explicit FastParticipant(int domain) {
    DomainParticipantQos qos;
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    for (int participant = 0; participant < 8; ++participant) {
      rtps::Locator_t peer;
      rtps::IPLocator::setIPv4(peer, 127, 0, 0, 1);
      // Where the RTPS standard has participants of a domain listen for discovery.
      peer.port = static_cast<std::uint32_t>(7400 + 250 * domain + 10 + 2 * participant);
      qos.wire_protocol().builtin.initialPeersList.push_back(peer);
    }
    participant_ = Factory()->create_participant(static_cast<DomainId_t>(domain), qos);
    publisher_ = participant_->create_publisher(PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
  }
  FastParticipant(const FastParticipant&) = delete;
  FastParticipant& operator=(const FastParticipant&) = delete;
  ~FastParticipant() {
    participant_->delete_contained_entities();
    Factory()->delete_participant(participant_);
  }

  template <class Message>
  DataWriter* Write(const std::string& topic) {
    DataWriterQos qos;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return publisher_->create_datawriter(TopicOf<Message>(topic), qos);
  }
  template <class Message>
  DataReader* Read(const std::string& topic, bool is_latched = false) {
    DataReaderQos qos;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    if (is_latched) qos.durability().kind = TRANSIENT_LOCAL_DURABILITY_QOS;
    qos.history().depth = 100;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return subscriber_->create_datareader(TopicOf<Message>(topic), qos);
  }

 private:
  static DomainParticipantFactory* Factory() { return DomainParticipantFactory::get_instance(); }

  template <class Message>
  Topic* TopicOf(const std::string& topic) {
    TypeSupport type(new fast::Type<Message>());
    type.register_type(participant_);
    return participant_->create_topic(topic, type.get_type_name(), TOPIC_QOS_DEFAULT);
  }

  DomainParticipant* participant_ = nullptr;
  Publisher* publisher_ = nullptr;
  Subscriber* subscriber_ = nullptr;
};

/// A square room of 10 m around a robot that stands in it.
fast::LaserScan ScanOfRoom(int index) {
  fast::LaserScan scan;
  scan.header = {.sec = 1000 + index / 10,
                 .nanosec = static_cast<std::uint32_t>(index % 10) * 100'000'000U,
                 .frame_id = "fast/base_link"};
  scan.angle_min = -3.1F;
  scan.angle_increment = 6.2F / 360.0F;
  scan.angle_max = 3.1F;
  scan.range_min = 0.1F;
  scan.range_max = 30.0F;
  for (int beam = 0; beam < 361; ++beam) {
    const float bearing = scan.angle_min + static_cast<float>(beam) * scan.angle_increment;
    const float reach = std::max(std::abs(std::cos(bearing)), std::abs(std::sin(bearing)));
    scan.ranges.push_back(5.0F / reach);
  }
  return scan;
}

template <class Message>
std::optional<Message> Await(DataReader* reader, std::chrono::seconds timeout) {
  Message message;
  SampleInfo info;
  const auto until = std::chrono::steady_clock::now() + timeout;
  do {
    if (reader->take_next_sample(&message, &info) == ReturnCode_t::RETCODE_OK && info.valid_data) {
      return message;
    }
    std::this_thread::sleep_for(10ms);
  } while (std::chrono::steady_clock::now() < until);
  return std::nullopt;
}

/// The robot's odometry says that it stands two metres from where that began.
fast::Odometry OdometryOf(const fast::LaserScan& scan) {
  fast::Odometry odometry;
  odometry.header = scan.header;
  odometry.header.frame_id = "fast/odom";
  odometry.child_frame_id = "fast/base_link";
  odometry.position = {2.0, -1.0, 0.0};
  odometry.orientation = {0.0, 0.0, 0.0, 1.0};
  return odometry;
}

class DdsFastDds : public ::testing::Test {
 protected:
  // Cells so small that the map of a room has 4 MB.
  DdsFastDds()
      : service_({"serve",
                  "--verbose",
                  "--set",
                  "network.domain=" + std::to_string(domain_),
                  "--set",
                  "network.interface=lo",
                  "--set",
                  "rendering.cell_m=0.005",
                  "--set",
                  "team.map_period_s=1"}) {}

  int domain_ = 100 + static_cast<int>(getpid() % 100);
  Daemon service_;
};

TEST_F(DdsFastDds, RobotOfAnotherVendorIsAnsweredAndGetsTransformsAndTheMap) {
  ASSERT_TRUE(service_.WaitUntilItSays("serving as"));
  FastParticipant robot(domain_);
  DataReader* poses = robot.Read<fast::PoseWithCovarianceStamped>("rt/fast/pose");
  DataReader* transforms = robot.Read<fast::TFMessage>("rt/tf");
  DataWriter* odometry = robot.Write<fast::Odometry>("rt/fast/odom");
  DataWriter* scans = robot.Write<fast::LaserScan>("rt/fast/scan");

  std::optional<fast::PoseWithCovarianceStamped> pose;
  for (int i = 0; i < 100 && !pose; ++i) {
    fast::LaserScan scan = ScanOfRoom(i);
    fast::Odometry reading = OdometryOf(scan);
    ASSERT_TRUE(odometry->write(&reading));
    ASSERT_TRUE(scans->write(&scan));
    std::this_thread::sleep_for(100ms);
    pose = Await<fast::PoseWithCovarianceStamped>(poses, 0s);
  }
  ASSERT_TRUE(pose) << service_.ErrorsSoFar();
  EXPECT_EQ(pose->header.frame_id, "map");
  EXPECT_NEAR(pose->position[0], 2.0, 0.05);
  EXPECT_NEAR(pose->position[1], -1.0, 0.05);
  EXPECT_NEAR(std::abs(pose->orientation[3]), 1.0, 1e-3);
  EXPECT_GE(pose->covariance[0], 0.0);

  const auto transform = Await<fast::TFMessage>(transforms, 10s);
  ASSERT_TRUE(transform);
  ASSERT_EQ(transform->transforms.size(), 1U);
  EXPECT_EQ(transform->transforms.front().header.frame_id, "map");
  EXPECT_EQ(transform->transforms.front().child_frame_id, "fast/odom");
  EXPECT_NEAR(transform->transforms.front().translation[0], 0.0, 0.05);

  // Comes late, and still gets the last map. It is painted when nobody else needs the processor.
  FastParticipant operator_station(domain_);
  const auto map =
      Await<fast::OccupancyGrid>(operator_station.Read<fast::OccupancyGrid>("rt/map", true), 100s);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->data.size(), std::size_t{map->width} * map->height);
  EXPECT_GT(map->data.size(), 4'000'000U);
  EXPECT_GT(std::ranges::count(map->data, 100), 200);
  EXPECT_FLOAT_EQ(map->resolution, 0.005F);
}

}  // namespace
}  // namespace qwsm::test
