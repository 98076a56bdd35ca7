// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "qwsm/correction/map_corrector.hpp"
#include "qwsm/mapping/scan_locator.hpp"

namespace qwsm {

/// Begins to do some work, perhaps on another thread, and gives what waits for its end.
using WorkBeside = std::function<std::function<void()>(std::function<void()> work)>;

/// Does the work at once.
std::function<void()> WorkAtOnce(std::function<void()> work);

/// Whose the chains of scans are that a map is made of.
enum class ChainsOf : std::uint8_t {
  kOneRobot,  ///< Of one that was lost and found: its scans come in one order, whatever threads do.
  kTeam,      ///< Of as many robots, which drive side by side.
};

/// A map whose scans were put where they belong.
struct CorrectedMap {
  std::vector<UncertainPose2> map_node;  ///< Poses of all nodes so far.
  ScanMap map;                           ///< Their scans, inserted there.
};

/// Looks for loops beside the robots' driving: every few relevant scans the last look is ended and
/// the next one begun. So a look has as much time as these scans take to come, and what it finds
/// takes effect at a scan that is fixed by the data, not by the time it took. Of several robots no
/// order of scans is fixed anyway: there nobody waits for a look that takes longer, nor for all
/// that came meanwhile to find its place in the corrected map.
class BackgroundCorrector {
 public:
  explicit BackgroundCorrector(const MapperOptions& options = {},
                               WorkBeside beside = WorkAtOnce,
                               ChainsOf chains_of = ChainsOf::kTeam);
  BackgroundCorrector(const BackgroundCorrector&) = delete;
  BackgroundCorrector& operator=(const BackgroundCorrector&) = delete;
  ~BackgroundCorrector();

  /// Takes the next relevant scan. Its pose is one in the map as it is.
  void Add(ScanNode node);
  /// Number of scans that were taken.
  std::size_t size() const { return map_node_.size() + news_.size(); }

  /// Whether so many scans are new that it is time to look again, or of a team the last look has
  /// found something.
  bool IsLookDue() const;
  /// Ends the last look and begins the next one.
  /// @return the map to go on in, if the last look found that it is drawn wrong.
  std::optional<CorrectedMap> LookAgain();

  /// Takes over the poses that somebody else found, without waiting: what a look under way finds is
  /// given up when it ends. @param map_node of all nodes so far.
  void Adopt(std::span<const UncertainPose2> map_node);

  /// Forgets the last scans, and what a look under way finds. @param first of them.
  void ForgetSince(std::size_t first);

  /// Corrects all that was added once more, in the end: loops are looked for from where others have
  /// moved the scans, too.
  Correction Correct();
  /// The scans that were added, at these poses in the order they came, when they are not needed
  /// here any more. @param map_node as Correct() gives them.
  std::vector<RelevantScan> ScansAt(std::span<const UncertainPose2> map_node) &&;

 private:
  // A pose in the map as it was, and as it is.
  struct MovedPose {
    UncertainPose2 before;
    UncertainPose2 after;
  };
  // What a look comes to.
  struct Proposal {
    std::vector<UncertainPose2> map_node;
    ScanMap map;
    std::vector<UncertainPose2> map_news;  // What came since, as far as it has found its place.
    std::map<std::size_t, MovedPose> last_of_robot;  // Of that, or of what was looked at.
  };

  void Finish();
  void Look();
  bool IsOneRobots() const { return chains_of_ == ChainsOf::kOneRobot || robots_.size() == 1; }
  std::vector<ScanNode> TakeNews();
  CorrectedMap TakeUp(Proposal proposal);
  void PlaceBeside();
  void NoteLastBefore(std::span<const ScanNode> news, Proposal& proposal) const;
  void Place(std::span<const ScanNode> news, Proposal& proposal) const;
  UncertainPose2 PlacedAnew(const ScanMap& map,
                            std::span<const ScanPoint> points,
                            const ScanNode& node,
                            const MovedPose& last) const;
  std::size_t LookedAtBeside(const ScanNode& node) const;

  WorkBeside beside_;
  ChainsOf chains_of_;
  ScanLocator locator_;
  MapCorrector corrector_;            // Belongs to the look while there is one.
  std::vector<ScanNode> under_look_;  // Likewise; or what is to find its place.
  std::optional<Proposal> proposal_;  // Likewise.
  std::atomic<bool> is_looking_ = false;
  std::function<void()> wait_;            // For the look, where there is one.
  bool is_overtaken_ = false;             // By poses that somebody else found.
  std::vector<ScanNode> news_;            // Nodes that no look has seen.
  std::vector<UncertainPose2> map_node_;  // In the map as it is, of those looked at.
  std::vector<std::size_t> robot_;        // Likewise: whose they are.
  std::set<std::size_t> robots_;
};

}  // namespace qwsm
