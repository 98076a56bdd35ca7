// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/background_corrector.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
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
  const std::size_t robots = chains_of_ == ChainsOf::kTeam ? robots_.size() : 1;
  if (news_.size() < kNodesOfALook * robots) return false;
  return robots == 1 || !is_looking_;
}

std::optional<CorrectedMap> BackgroundCorrector::LookAgain() {
  Finish();
  auto proposal = std::exchange(proposal_, std::nullopt);
  // A robot that has recognised a place since is no longer beside the scans that were looked at:
  // the next look knows more.
  const bool is_outdated =
      std::ranges::any_of(news_, [](const ScanNode& node) { return !node.T_last_node; });
  std::optional<CorrectedMap> corrected;
  if (proposal && !is_outdated) corrected = TakeUp(std::move(*proposal));
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
      proposal_ = {.map_node = std::move(*map_node), .map = std::move(map)};
    }
    is_looking_ = false;
  });
}

// What came since the look is placed anew beside what was looked at: while a loop is open, answers
// slide from one of its ends to the other.
std::optional<CorrectedMap> BackgroundCorrector::TakeUp(Proposal proposal) {
  corrector_.Adopt(proposal.map_node);
  CorrectedMap corrected{.map_node = std::move(proposal.map_node), .map = std::move(proposal.map)};
  std::map<std::size_t, MovedPose> last_of_robot;
  for (ScanNode& node : news_) {
    const auto [known, is_first] = last_of_robot.try_emplace(node.robot);
    MovedPose& last = known->second;
    if (is_first) {
      const std::size_t beside = LookedAtBeside(node);
      last = {.before = map_node_[beside], .after = corrected.map_node[beside]};
    }
    const std::vector<ScanPoint> points = ToPoints(node.scan);
    const UncertainPose2 placed = PlacedAnew(corrected.map, points, node, last);
    corrected.map.Insert(node.scan, points, placed);
    last = {.before = std::exchange(node.map_robot, placed), .after = placed};
  }
  map_node_ = corrected.map_node;
  for (const ScanNode& node : news_) corrected.map_node.push_back(node.map_robot);
  return corrected;
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

ScanMap BackgroundCorrector::MapAt(std::span<const UncertainPose2> map_node) && {
  Finish();
  return std::move(corrector_).MapAt(map_node);
}

}  // namespace qwsm
