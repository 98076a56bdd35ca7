// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What clients say, and who of them is let in.
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "service/view/http/access.hpp"
#include "service/view/http/web_error.hpp"
#include "service/view/protocol/client_message.hpp"
#include "service/view/protocol/server_message.hpp"

namespace qwsm::view {
namespace {

std::string Complaint(const std::string& text) {
  try {
    static_cast<void>(ParseClientText(text));
    return {};
  } catch (const ProtocolError& error) {
    return error.what();
  }
}

TEST(ViewProtocol, SubscriptionsAreRead) {
  const ClientMessage message = ParseClientText(
      R"({"op":"subscribe","subscriptions":[{"id":3,"channelId":4},{"id":5,"channelId":6,"newsOnly":true}]})");
  const auto& subscriptions = std::get<Subscribe>(message).subscriptions;
  ASSERT_EQ(subscriptions.size(), 2U);
  EXPECT_EQ(subscriptions[1].id, 5U);
  EXPECT_EQ(subscriptions[1].channel, 6U);
  EXPECT_FALSE(subscriptions[0].wants_news_only);
  EXPECT_TRUE(subscriptions[1].wants_news_only);
}

TEST(ViewProtocol, WhatIsWrongIsTold) {
  EXPECT_EQ(Complaint("{"), "this is no JSON");
  EXPECT_EQ(Complaint("[1]"), "'op' is missing");
  EXPECT_EQ(Complaint(R"({"op":"subscribe"})"), "'subscriptions' is missing");
  EXPECT_EQ(Complaint(R"({"op":"unsubscribe","subscriptionIds":[-1]})"),
            "an id must be a whole number of 32 bits");
  EXPECT_EQ(
      Complaint(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":2,"newsOnly":3}]})"),
      "'newsOnly' must be true or false");
  EXPECT_EQ(Complaint(R"({"op":"unadvertise","channelIds":7})"), "'channelIds' must be a list");
  EXPECT_EQ(Complaint(std::string(60'000, '[')), "this is no JSON");
  const ClientMessage other = ParseClientText(R"({"op":"getParameters"})");
  EXPECT_EQ(std::get<NotOffered>(other).operation, "getParameters");
}

TEST(ViewProtocol, BytesAreLittleEndian) {
  const ClientData data = ParseClientData(std::string_view("\1\2\1\0\0payload", 12));
  EXPECT_EQ(data.channel, 258U);
  EXPECT_EQ(data.cdr, "payload");
  EXPECT_THROW(static_cast<void>(ParseClientData("\1\2")), ProtocolError);
  EXPECT_EQ(MessageHead(258, 1), std::string("\1\2\1\0\0\1\0\0\0\0\0\0\0", 13));
}

TEST(ViewProtocol, NamesThatAreNoUtf8AreTold) {
  EXPECT_NE(StatusText(StatusLevel::kInfo, "\xff").find("\xef\xbf\xbd"), std::string::npos);
}

int StatusOf(const ViewOptions& options, const WebRequest& request) {
  const auto objection = Access(options).Objection(request);
  return objection ? objection->status : 101;
}

TEST(ViewAccess, OwnPagesAreLetIn) {
  const ViewOptions options;
  EXPECT_EQ(StatusOf(options, {.host = "localhost:8765", .origin = "http://localhost:8765"}), 101);
  EXPECT_EQ(StatusOf(options, {.host = "[::1]:8765", .origin = "http://[::1]:8765"}), 101);
  EXPECT_EQ(StatusOf(options, {.host = "127.0.0.1", .origin = ""}), 101);
  EXPECT_EQ(StatusOf(options, {.host = "localhost:8765", .origin = "http://localhost:80"}), 403);
  EXPECT_EQ(StatusOf(options, {.host = "localhost:8765", .origin = "null"}), 403);
  EXPECT_EQ(StatusOf(options, {.host = "localhost.evil.example", .origin = ""}), 403);
  EXPECT_EQ(StatusOf(options, {.host = "", .origin = ""}), 403);
}

TEST(ViewAccess, NamedPagesAreLetIn) {
  const ViewOptions options{.origins = "https://a.example, https://b.example"};
  EXPECT_EQ(StatusOf(options, {.host = "localhost", .origin = "https://b.example"}), 101);
  EXPECT_EQ(StatusOf(options, {.host = "localhost", .origin = "https://b.example.org"}), 403);
}

TEST(ViewAccess, PagesAreNamedAsTheirAddressesAre) {
  const ViewOptions options{.origins = "https://a.example/ ,https://b.example/"};
  EXPECT_EQ(StatusOf(options, {.host = "localhost", .origin = "https://a.example"}), 101);
  EXPECT_EQ(StatusOf(options, {.host = "localhost", .origin = "https://b.example"}), 101);
}

TEST(ViewAccess, ATokenMustBeWholeAndRight) {
  const ViewOptions options{.address = "0.0.0.0", .token = "secret"};
  const auto with = [&](const char* target) {
    return StatusOf(options, {.target = target, .host = "robot.lan:8765"});
  };
  EXPECT_EQ(with("/ws?token=secret"), 101);
  EXPECT_EQ(with("/ws?a=b&token=secret&c"), 101);
  EXPECT_EQ(with("/ws?token=secre"), 401);
  EXPECT_EQ(with("/ws?token=secret2"), 401);
  EXPECT_EQ(with("/ws?token="), 401);
  EXPECT_EQ(with("/ws?nottoken=secret"), 401);
  EXPECT_EQ(with("/ws"), 401);
  EXPECT_THROW(Access({.address = "0.0.0.0"}), WebError);
  EXPECT_THROW(Access({.token = "two words"}), WebError);
}

}  // namespace
}  // namespace qwsm::view
