// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/streams/news.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "qwsm/geometry/angle.hpp"
#include "service/io/bags/messages/message_reader.hpp"
#include "service/io/bags/messages/ros_messages.hpp"

namespace qwsm::view {
namespace {

using namespace std::chrono_literals;

// A robot that goes on reporting must not look silent (kSilent_s of the page).
constexpr Clock::duration kReportSilence = 1500ms;
constexpr Clock::duration kHealthSilence = 5s;

// Less than a pixel of a map on which a room fills the screen.
constexpr double kSeenMove_m = 0.01;
constexpr double kSeenTurn_rad = 0.005;
// Of the ellipse that is drawn.
constexpr double kSeenSpread = 0.2;
constexpr double kSeenSpread_m = 0.005;

// Of a beam, well beyond the noise of lasers; and of so many beams that they are no flicker.
constexpr float kSeenRange_m = 0.1F;
constexpr float kSeenRangeShare = 0.03F;
constexpr std::size_t kSeenBeams = 3;
constexpr std::size_t kBeamsPerSeen = 50;  // Of as many beams, one must differ.
constexpr float kNoEcho_m = 1e6F;

/// What a match report shows of a robot.
struct ShownRobot {
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;
  double spread_m = 0.0;  ///< Root of the trace of the position's covariance.
  int status = 0;
  std::string reason;
};

/// Compares match reports: where the robot is, how sure that is, and whether it was matched.
class ReportNews final : public NewsFilter {
 protected:
  bool Differs(const Sample& sample) override {
    now_ = Read(sample);
    return std::hypot(now_.x_m - last_.x_m, now_.y_m - last_.y_m) > kSeenMove_m ||
           std::abs(NormalizeAngle(now_.theta_rad - last_.theta_rad)) > kSeenTurn_rad ||
           std::abs(now_.spread_m - last_.spread_m) >
               kSeenSpread_m + kSeenSpread * last_.spread_m ||
           now_.status != last_.status || now_.reason != last_.reason;
  }
  void Remember() override { last_ = now_; }
  Clock::duration longest_silence() const override { return kReportSilence; }

 private:
  static ShownRobot Read(const Sample& sample) {
    io::MessageReader reader(sample.bytes, io::Encoding::kCdr);
    static_cast<void>(reader.Unsigned32());  // The stamp.
    static_cast<void>(reader.Unsigned32());
    static_cast<void>(reader.String());  // Frame and robot.
    static_cast<void>(reader.String());
    ShownRobot robot;
    robot.x_m = reader.Double();
    robot.y_m = reader.Double();
    robot.theta_rad = reader.Double();
    double trace_m2 = 0.0;
    for (int i = 0; i < 9; ++i) {
      const double covariance = reader.Double();
      if (i == 0 || i == 4) trace_m2 += covariance;
    }
    robot.spread_m = std::sqrt(std::max(trace_m2, 0.0));
    robot.status = reader.Byte();
    robot.reason = reader.String();
    return robot;
  }

  ShownRobot now_;
  ShownRobot last_;
};

/// Compares scans beam by beam. At the edges of things beams flicker between near and far, so that
/// a beam is compared with its neighbours of the last scan, too.
class ScanNews final : public NewsFilter {
 protected:
  bool Differs(const Sample& sample) override {
    now_ = io::DecodeLaserScan(sample.bytes, io::Encoding::kCdr).ranges_m;
    for (float& range_m : now_) {
      if (!std::isfinite(range_m)) range_m = kNoEcho_m;
    }
    if (now_.size() != last_.size()) return true;
    std::size_t changed = 0;
    for (std::size_t i = 0; i < now_.size(); ++i) changed += HasChanged(i) ? 1 : 0;
    return changed > std::max(kSeenBeams, now_.size() / kBeamsPerSeen);
  }
  void Remember() override { std::swap(last_, now_); }
  Clock::duration longest_silence() const override { return Clock::duration::max(); }

 private:
  bool HasChanged(std::size_t beam) const {
    const auto begin = last_.begin() + static_cast<std::ptrdiff_t>(beam - (beam > 0 ? 1 : 0));
    const auto end = last_.begin() + static_cast<std::ptrdiff_t>(std::min(beam + 2, last_.size()));
    const auto [nearest, farthest] = std::minmax_element(begin, end);
    const float slack_m = kSeenRange_m + kSeenRangeShare * std::min(now_[beam], *farthest);
    return now_[beam] < *nearest - slack_m || now_[beam] > *farthest + slack_m;
  }

  std::vector<float> now_;
  std::vector<float> last_;
};

/// Compares the words of diagnostics: who is how, and what is counted, but not the counts.
class HealthNews final : public NewsFilter {
 protected:
  bool Differs(const Sample& sample) override {
    now_.clear();
    io::MessageReader reader(sample.bytes, io::Encoding::kCdr);
    static_cast<void>(reader.Unsigned32());  // Stamp and frame.
    static_cast<void>(reader.Unsigned32());
    static_cast<void>(reader.String());
    constexpr std::size_t kLeastBytesOfStatus = 17;
    for (std::size_t left = reader.Count(kLeastBytesOfStatus); left > 0; --left) AddStatus(reader);
    return now_ != last_;
  }
  void Remember() override { std::swap(last_, now_); }
  Clock::duration longest_silence() const override { return kHealthSilence; }

 private:
  void AddStatus(io::MessageReader& reader) {
    now_ += static_cast<char>(reader.Byte());
    AddText(reader.String());  // Name.
    AddText(reader.String());  // Message.
    static_cast<void>(reader.String());
    constexpr std::size_t kLeastBytesOfValue = 8;
    for (std::size_t left = reader.Count(kLeastBytesOfValue); left > 0; --left) {
      AddText(reader.String());
      static_cast<void>(reader.String());
    }
  }
  void AddText(const std::string& text) {
    now_ += text;
    now_ += '\0';
  }

  std::string now_;
  std::string last_;
};

}  // namespace

bool NewsFilter::IsNews(const Sample& sample) {
  try {
    const bool differs = Differs(sample);
    const bool is_due = sample.arrived - picked_ >= longest_silence();
    if (!differs && !is_due) return false;
    Remember();
  } catch (const io::MessageError&) {
    return true;
  }
  picked_ = sample.arrived;
  return true;
}

std::unique_ptr<NewsFilter> NewsFilterOf(std::string_view type) {
  if (type == "qwsm_msgs/msg/MatchReport") return std::make_unique<ReportNews>();
  if (type == "sensor_msgs/msg/LaserScan") return std::make_unique<ScanNews>();
  if (type == "diagnostic_msgs/msg/DiagnosticArray") return std::make_unique<HealthNews>();
  return nullptr;
}

}  // namespace qwsm::view
