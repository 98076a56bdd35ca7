// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/network.hpp"
#include "tests/support/web_client.hpp"

namespace qwsm::test {

/// A service, or another program, with a page.
class ViewedService {
 public:
  explicit ViewedService(const PrivateNetwork& network, std::vector<std::string> more = {})
      : ViewedService(network.JoinService(With(std::move(more)))) {}
  /// @param arguments of a program that tells its messages.
  explicit ViewedService(std::vector<std::string> arguments) : service_(std::move(arguments)) {
    constexpr std::string_view kBefore = "look at ";
    if (!service_.WaitUntilItSays(std::string(kBefore) + "http")) {
      throw std::runtime_error(service_.ErrorsSoFar());
    }
    const std::string said = service_.ErrorsSoFar();
    const std::size_t begin = said.find(kBefore) + kBefore.size();
    address_ = said.substr(begin, said.find('\n', begin) - begin);
    port_ = std::stoi(address_.substr(address_.rfind(':') + 1));
  }

  int port() const { return port_; }
  /// What it says where the page is.
  const std::string& address() const { return address_; }
  Daemon& daemon() { return service_; }

 private:
  static std::vector<std::string> With(std::vector<std::string> more) {
    more.insert(more.begin(), {"serve", "--verbose", "--view", "--set", "view.port=0"});
    return more;
  }

  Daemon service_;
  std::string address_;
  int port_ = 0;
};

/// One who looks on: it knows which channels there are.
class Onlooker {
 public:
  explicit Onlooker(int port, int receive_buffer_bytes = 0)
      : Onlooker(WebClient(port, receive_buffer_bytes)) {}
  explicit Onlooker(WebClient client, const std::string& target = "/ws")
      : client_(std::move(client)) {
    const std::string answer = client_.Upgrade(target);
    if (answer.find(" 101 ") == std::string::npos) throw std::runtime_error(answer);
  }

  WebClient& client() { return client_; }

  /// Waits until a topic is offered and subscribes to it. @returns whether it was in time.
  bool Subscribe(const std::string& topic, int subscription) {
    for (int i = 0; i < 1000 && !ids_.contains(topic); ++i) {
      const auto frame = client_.Receive();
      if (!frame) return false;
      Note(frame->payload);
    }
    return client_.SendFrame(WebClient::kText,
                             R"({"op":"subscribe","subscriptions":[{"id":)" +
                                 std::to_string(subscription) + R"(,"channelId":)" + ids_[topic] +
                                 "}]}");
  }
  /// The next sample of a subscription: what is behind its head of 13 bytes.
  std::optional<std::string> Sample(int subscription) {
    while (const auto frame = client_.Receive()) {
      Note(frame->payload);
      const bool is_sample = frame->opcode == WebClient::kBinary && frame->payload[0] == 1;
      if (is_sample && frame->payload[1] == subscription) return frame->payload.substr(13);
    }
    return std::nullopt;
  }

 private:
  /// Of each channel of an advertisement, keys come in the order of the alphabet.
  void Note(const std::string& text) {
    if (text.find(R"("op":"advertise")") == std::string::npos) return;
    for (std::size_t at = 0; (at = text.find(R"("id":)", at)) != std::string::npos; ++at) {
      const std::string id = text.substr(at + 5, text.find(',', at) - at - 5);
      const std::size_t topic = text.find(R"("topic":")", at) + 9;
      ids_[text.substr(topic, text.find('"', topic) - topic)] = id;
    }
  }

  WebClient client_;
  std::map<std::string, std::string> ids_;
};

}  // namespace qwsm::test
