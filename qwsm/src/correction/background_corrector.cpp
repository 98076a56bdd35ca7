// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/background_corrector.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "qwsm/geometry/frame_covariance.hpp"

namespace qwsm {
namespace {

// Loops are looked for once so many relevant scans of a robot are new.
constexpr std::size_t kNodesOfALook = 8;

}  // namespace

std::function<void()> WorkAtOnce(std::function<void()> work) {
  work();
  return [] {};
}

BackgroundCorrector::BackgroundCorrector(const MapperOptions& options,
                                         WorkBeside beside,
                                         ChainsOf chains_of)
    : beside_(std::move(beside)),
      chains_of_(chains_of),
      locator_(options.locator),
      corrector_(options) {}

BackgroundCorrector::~BackgroundCorrector() { Finish(); }

void BackgroundCorrector::Add(ScanNode node) {
  robots_.insert(node.robot);
  news_.push_back(std::move(node));
}

bool BackgroundCorrector::IsLookDue() const {
  if (IsOneRobots()) return news_.size() >= kNodesOfALook;
  if (is_looking_) return false;
  return proposal_ || news_.size() >= kNodesOfALook * robots_.size();
}

std::optional<CorrectedMap> BackgroundCorrector::LookAgain() {
  Finish();
  // A robot that has recognised a place since is no longer beside the scans that were looked at:
  // the next look knows more.
  const bool is_outdated =
      std::ranges::any_of(news_, [](const ScanNode& node) { return !node.T_last_node; });
  if (is_outdated) proposal_.reset();
  const bool is_much_left =
      proposal_ && proposal_->map_news.empty() && news_.size() > kNodesOfALook;
  if (is_much_left && !IsOneRobots()) {
    PlaceBeside();
    return std::nullopt;
  }
  std::optional<CorrectedMap> corrected;
  if (proposal_) corrected = TakeUp(*std::exchange(proposal_, std::nullopt));
  Look();
  return corrected;
}

void BackgroundCorrector::Finish() {
  if (wait_) std::exchange(wait_, nullptr)();
  if (!std::exchange(is_overtaken_, false)) return;
  proposal_.reset();
  corrector_.Adopt(map_node_);
}

std::vector<ScanNode> BackgroundCorrector::TakeNews() {
  for (const ScanNode& node : news_) {
    map_node_.push_back(node.map_robot);
    robot_.push_back(node.robot);
  }
  return std::exchange(news_, {});
}

void BackgroundCorrector::Look() {
  under_look_ = TakeNews();
  is_looking_ = true;
  wait_ = beside_([this] {
    for (ScanNode& node : under_look_) corrector_.Add(std::move(node));
    if (auto map_node = corrector_.Propose()) {
      ScanMap map = corrector_.MapAt(*map_node);
      proposal_ = {.map_node = std::move(*map_node),
                   .map = std::move(map),
                   .map_news = {},
                   .last_of_robot = {}};
    }
    is_looking_ = false;
  });
}

// Of many robots so much comes during a look that who adds the next scan is not to wait for it,
// only for what comes while this is placed.
void BackgroundCorrector::PlaceBeside() {
  under_look_ = news_;
  NoteLastBefore(under_look_, *proposal_);
  is_looking_ = true;
  wait_ = beside_([this] {
    Place(under_look_, *proposal_);
    is_looking_ = false;
  });
}

CorrectedMap BackgroundCorrector::TakeUp(Proposal proposal) {
  corrector_.Adopt(proposal.map_node);
  const auto left = std::span(news_).subspan(proposal.map_news.size());
  NoteLastBefore(left, proposal);
  Place(left, proposal);
  map_node_ = proposal.map_node;
  for (std::size_t i = 0; i < news_.size(); ++i) news_[i].map_robot = proposal.map_news[i];
  CorrectedMap corrected{.map_node = std::move(proposal.map_node), .map = std::move(proposal.map)};
  std::ranges::copy(proposal.map_news, std::back_inserter(corrected.map_node));
  return corrected;
}

// What scans that came since the look are placed beside, of robots of which none has been yet.
void BackgroundCorrector::NoteLastBefore(std::span<const ScanNode> news, Proposal& proposal) const {
  for (const ScanNode& node : news) {
    const auto [last, is_first] = proposal.last_of_robot.try_emplace(node.robot);
    if (!is_first) continue;
    const std::size_t beside = LookedAtBeside(node);
    last->second = {.before = map_node_[beside], .after = proposal.map_node[beside]};
  }
}

// What came since the look is placed anew beside what was looked at: while a loop is open, answers
// slide from one of its ends to the other.
void BackgroundCorrector::Place(std::span<const ScanNode> news, Proposal& proposal) const {
  for (const ScanNode& node : news) {
    MovedPose& last = proposal.last_of_robot.at(node.robot);
    const std::vector<ScanPoint> points = ToPoints(node.scan);
    const UncertainPose2 placed = PlacedAnew(proposal.map, points, node, last);
    proposal.map.Insert(node.scan, points, placed);
    proposal.map_news.push_back(placed);
    last = {.before = node.map_robot, .after = placed};
  }
}

// Where the scan is found near the robot's last node; if nowhere, it keeps its place beside that.
UncertainPose2 BackgroundCorrector::PlacedAnew(const ScanMap& map,
                                               std::span<const ScanPoint> points,
                                               const ScanNode& node,
                                               const MovedPose& last) const {
  UncertainPose2 placed = last.after * Since(last.before, node.map_robot);
  const UncertainPose2 by_odometry = UncertainPose2{.T_a_b = last.after.T_a_b} * node.odometry;
  const MatchResult match = locator_.Locate(map, points, About(placed.T_a_b, by_odometry));
  if (HasMatched(match)) placed.T_a_b = match.T_ref_cur;
  return placed;
}

void BackgroundCorrector::Adopt(std::span<const UncertainPose2> map_node) {
  is_overtaken_ = true;
  const auto news = map_node.subspan(map_node_.size());
  map_node_.assign(map_node.begin(), map_node.end() - static_cast<std::ptrdiff_t>(news.size()));
  for (std::size_t i = 0; i < news.size(); ++i) news_[i].map_robot = news[i];
}

void BackgroundCorrector::ForgetSince(std::size_t first) {
  Finish();
  proposal_.reset();
  if (first < map_node_.size()) {
    map_node_.erase(map_node_.begin() + static_cast<std::ptrdiff_t>(first), map_node_.end());
    robot_.resize(first);
    corrector_.ForgetSince(static_cast<NodeId>(first));
  }
  news_.erase(news_.begin() + static_cast<std::ptrdiff_t>(first - map_node_.size()), news_.end());
}

// The last scan of the same robot that was looked at; of a robot that is new, the nearest one.
std::size_t BackgroundCorrector::LookedAtBeside(const ScanNode& node) const {
  const auto last = std::ranges::find(robot_.rbegin(), robot_.rend(), node.robot);
  if (last != robot_.rend()) return static_cast<std::size_t>(robot_.rend() - last) - 1;
  const auto distance_m = [&](const UncertainPose2& other) {
    return (other.T_a_b.translation_m() - node.map_robot.T_a_b.translation_m()).norm();
  };
  return static_cast<std::size_t>(std::ranges::min_element(map_node_, {}, distance_m) -
                                  map_node_.begin());
}

Correction BackgroundCorrector::Correct() {
  Finish();
  proposal_.reset();
  for (ScanNode& node : TakeNews()) corrector_.Add(std::move(node));
  return corrector_.Correct();
}

std::vector<RelevantScan> BackgroundCorrector::ScansAt(
    std::span<const UncertainPose2> map_node) && {
  Finish();
  return std::move(corrector_).ScansAt(map_node);
}

}  // namespace qwsm
