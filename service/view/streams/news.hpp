// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string_view>

#include "service/view/streams/sample.hpp"

namespace qwsm::view {

/// Picks the samples of a topic that tell something new to somebody who looks at a screen: of
/// robots that stand and go on scanning next to nothing is left, of those that drive nearly
/// everything.
///
/// Each sample is compared with the last one that was picked, so that slow changes add up.
class NewsFilter {
 public:
  NewsFilter() = default;
  NewsFilter(const NewsFilter&) = delete;
  NewsFilter& operator=(const NewsFilter&) = delete;
  virtual ~NewsFilter() = default;

  /// Whether the sample is picked. A sample that cannot be read is: its reader shall say so.
  bool IsNews(const Sample& sample);

 protected:
  /// Whether it differs visibly from the last one that was remembered. @throws io::MessageError.
  virtual bool Differs(const Sample& sample) = 0;
  /// Compares with the sample last given to Differs() from now on.
  virtual void Remember() = 0;
  /// What says nothing new is picked all the same once the last one is that old.
  virtual Clock::duration longest_silence() const = 0;

 private:
  Clock::time_point picked_{};
};

/// The filter for a type of ROS, such as `qwsm_msgs/msg/MatchReport`; null where each sample of it
/// is news.
std::unique_ptr<NewsFilter> NewsFilterOf(std::string_view type);

}  // namespace qwsm::view
