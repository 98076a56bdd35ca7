// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/live_view.hpp"

#include <fmt/format.h>

#include <chrono>
#include <set>
#include <utility>

#include "service/dds/gateway/topic_gateway.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/view/http/access.hpp"
#include "service/view/http/page_files.hpp"
#include "service/view/http/web_server.hpp"
#include "service/view/live/board.hpp"

namespace qwsm::view {
namespace {

std::string_view TypeOfFile(std::string_view path) {
  if (path.ends_with(".html")) return "text/html; charset=utf-8";
  if (path.ends_with(".css")) return "text/css; charset=utf-8";
  if (path.ends_with(".js")) return "text/javascript; charset=utf-8";
  return "image/svg+xml";
}

std::optional<TlsIdentity> IdentityOf(const ViewOptions& options) {
  const auto files = EncryptionOf(options);
  return files ? std::make_optional<TlsIdentity>(*files) : std::nullopt;
}

/// By which name a browser on this computer reaches an address.
std::string HostOf(const std::string& address) {
  for (const std::string_view all_or_local : {"0.0.0.0", "::", "127.0.0.1", "localhost"}) {
    if (address == all_or_local) return "localhost";
  }
  return address.find(':') == std::string::npos ? address : fmt::format("[{}]", address);
}

/// Changes with each start: clients begin anew then.
std::string NewSession() {
  return std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
}

}  // namespace

class LiveView::Parts final : public WebHandler {
 public:
  Parts(const dds::Participant& participant,
        const dds::RosGraph& graph,
        const ViewOptions& options,
        const Service& service)
      : access_(options),
        identity_(IdentityOf(options)),
        host_(HostOf(options.address)),
        marks_(service.marks),
        greeting_(ServerInfoText(service.name, NewSession())),
        board_(service.warn),
        server_({.address = options.address,
                 .port = options.port,
                 .max_sockets = static_cast<std::size_t>(options.max_clients),
                 .identity = identity_},
                *this),
        gateway_(participant,
                 graph,
                 {.take_topics = [this](auto topics) { TakeTopics(std::move(topics)); },
                  .take_samples = [this](auto samples) { TakeSamples(std::move(samples)); },
                  .warn = service.warn}) {
    if (identity_ && !identity_->warning().empty()) service.warn(identity_->warning());
    server_.Start();
  }
  ~Parts() override { server_.Stop(); }

  WebAnswer Answer(const WebRequest& request) override {
    constexpr std::string_view kPlain = "text/plain";
    if (!request.is_get) return {.status = 405, .type = kPlain, .body = "only GET and HEAD\n"};
    std::string_view path = request.target.substr(0, request.target.find('?'));
    if (path == "/") path = "/index.html";
    for (const PageFile& file : PageFiles()) {
      if (file.path == path) return {.type = TypeOfFile(path), .body = file.content};
    }
    return {.status = 404, .type = kPlain, .body = "there is no such page\n"};
  }
  std::optional<WebAnswer> Objection(const WebRequest& request) override {
    return access_.Objection(request);
  }
  std::unique_ptr<Client> Open() override {
    return std::make_unique<Client>(board_, uplink_, greeting_);
  }

  std::string url() const {
    if (!identity_) return fmt::format("http://{}:{}/", host_, server_.port());
    const bool is_local_name = identity_->host() == "localhost";
    return fmt::format("https://{}:{}/", is_local_name ? host_ : identity_->host(), server_.port());
  }

 private:
  void TakeTopics(std::vector<dds::PublishedTopic> topics) {
    server_.Post([this, topics = std::move(topics)] {
      board_.TakeTopics(topics);
      for (const dds::PublishedTopic& topic : topics) {
        if (Board::IsKeptUnasked(topic.type)) Want(topic.name);
      }
    });
  }
  void TakeSamples(std::vector<dds::TopicSamples> samples) {
    server_.Post([this, samples = std::move(samples)] {
      const auto now = Clock::now();
      for (const dds::TopicSamples& topic : samples) board_.TakeSamples(topic, now);
    });
  }
  void Want(const std::string& topic) {
    if (wanted_.insert(topic).second) gateway_.Want(topic);
  }

  void TellMark(const team::Mark& mark) {
    try {
      marks_.Tell(mark);
    } catch (const dds::MarkError& error) {
      throw ProtocolError(error.what());
    }
  }

  Access access_;
  std::optional<TlsIdentity> identity_;
  std::string host_;
  dds::MarkExchange& marks_;
  std::string greeting_;
  // What follows, but for server and gateway, is used by the server's thread.
  Board board_;
  std::set<std::string> wanted_;
  Uplink uplink_{.want = [this](const std::string& topic) { Want(topic); },
                 .prepare_pose = [this](const std::string& topic) { gateway_.PreparePose(topic); },
                 .tell_pose = [this](const std::string& topic,
                                     const dds::ToldPose& pose) { gateway_.TellPose(topic, pose); },
                 .tell_mark = [this](const team::Mark& mark) { TellMark(mark); }};
  WebServer server_;
  dds::TopicGateway gateway_;  // Gone when the server has stopped, before the server is gone.
};

LiveView::LiveView(const dds::Participant& participant,
                   const dds::RosGraph& graph,
                   const ViewOptions& options,
                   Service service)
    : parts_(std::make_unique<Parts>(participant, graph, options, std::move(service))) {}

LiveView::~LiveView() = default;

std::string LiveView::url() const { return parts_->url(); }

}  // namespace qwsm::view
