// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>
#include <utility>
#include <vector>

namespace qwsm::team {

/// Tells those who listen to a service, one after the other.
/// @tparam Sink TeamSink or CloudSink.
template <class Sink>
class SinkList {
 public:
  /// Makes the list. @param sinks outlive this.
  SinkList(std::vector<Sink*> sinks) : sinks_(std::move(sinks)) {}
  SinkList(Sink& sink) : sinks_{&sink} {}

  /// Tells every sink.
  /// @param take which of the sinks' functions takes it, such as &TeamSink::TakeAnswer.
  template <class Base, class Told>
  void Tell(void (Base::*take)(const Told&), const std::type_identity_t<Told>& told) const {
    for (Sink* sink : sinks_) (sink->*take)(told);
  }

 private:
  std::vector<Sink*> sinks_;
};

}  // namespace qwsm::team
