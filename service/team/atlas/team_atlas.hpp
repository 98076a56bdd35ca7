// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "qwsm/mapping/mapper_options.hpp"
#include "service/io/journal/journal_entry.hpp"
#include "service/team/atlas/rearranged_maps.hpp"
#include "service/team/atlas/rearrangement.hpp"
#include "service/team/map/team_corrector.hpp"
#include "service/team/map/team_maps.hpp"
#include "service/team/sinks/sink_list.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::team {

struct TeamAtlasOptions {
  MapSharing sharing = MapSharing::kTeam;
  MapperOptions mapper;
  bool corrects = true;  ///< Whether maps are corrected while robots drive.
};

/// What an atlas needs of the service that it belongs to.
struct AtlasSurroundings {
  std::function<std::string()> service;  ///< Tells the service's name in keys of scans.
  /// Keeps an entry in the journal, if there is one, and calls what is to be told once it is safe.
  std::function<void(io::JournalEntry, std::function<void()>)> keep;
  const SinkList<TeamSink>& sinks;
};

/// How the frame of one component lies in another one.
struct ComponentPlace {
  MapVersion from;  ///< As it was when this was found.
  std::string from_name;
  MapVersion into;
  std::string into_name;
  UncertainPose2 into_from;
};

/// All that a team knows of its surroundings: the map that its robots share, and the components of
/// those of which nobody knows where in it they are (an atlas, Elvira et al. 2019). Robots
/// and other services extend it; what is drawn wrong is put elsewhere, and components that are
/// found in one another become one. Each of these is an epoch, in the journal and for the other
/// services. All functions may be called from any thread.
class TeamAtlas {
 public:
  TeamAtlas(const TeamAtlasOptions& options, AtlasSurroundings surroundings);

  TeamMaps& maps() { return maps_; }
  const TeamMaps& maps() const { return maps_; }

  /// Takes back a scan of a journal. @param component it is in.
  void Restore(TeamScan scan, const std::string& component);
  /// Goes on from the last epoch of a journal, whose scans have been taken back.
  void GoOnFrom(const EpochRank& epoch) { epoch_ = epoch; }
  /// Tells the sinks the last epoch again, if there was one, with all scans where they are: others
  /// may have been away when it was found.
  void RepeatEpoch();

  /// Adds a relevant scan of a robot of this service.
  /// @param answered_in the map that its pose is in.
  /// @return false if that has been corrected, or become part of another one, since.
  bool Extend(const TeamScan& scan,
              std::span<const ScanPoint> points,
              const MapVersion& answered_in);

  /// Takes in a scan of another service. @return whether it is new here.
  /// @pre ObjectionTo(scan).empty()
  bool TakeIn(TeamScan scan);
  /// Takes in a correction by another service; see TeamService.
  void TakeIn(const TeamEpoch& epoch);
  /// What was taken in of others, for those that come later, if these are gone. Told once.
  std::vector<TeamScan> TakenIn();

  /// Makes two components one. @return false if one of them has been corrected since the place was
  /// found.
  bool Join(const ComponentPlace& place);
  /// Takes all scans of a robot out of a component, into one of their own.
  /// @return false if the component has been corrected since.
  bool Part(const std::string& robot, const MapVersion& from, const std::string& from_name);
  /// Corrects a component once more, in the end, for those who look at what is left; nobody is
  /// told.
  /// @return nothing where it is empty, or maps are not corrected, or where other services know it,
  /// too: they have agreed on it as it is. @pre it changes no more, and this is the first call for
  /// it.
  std::optional<Correction> Finish(const std::string& component);
  /// Ends looks at components that are none any more, and frees maps that others have replaced and
  /// nobody reads any more. Takes as long as these; to be called beside.
  void Tidy();

 private:
  struct JoinedTo {
    std::string component;
    Pose2 T_into_from;
  };
  // Where all scans belong from an epoch on.
  struct Plan {
    EpochRank rank;
    Rearrangement rearrangement;
  };
  using Planner = std::function<std::optional<Plan>()>;

  bool IsKnownToOthers(const TeamMap& map) const;
  bool IsTeams() const { return options_.sharing == MapSharing::kTeam; }
  bool IsStill(const std::string& component, const MapVersion& version);
  void Settle(TeamScan& scan) const;
  TeamCorrector& CorrectorOf(const std::string& component);
  void CatchUp(const MapComponent& component);
  void CorrectIfDue(const MapComponent& component);
  bool Rearrange(const Planner& plan);
  EpochRank Next(const EpochRank& last) const;
  void TakeEffect(const Rearrangement& rearrangement, const RearrangedMaps& made);
  void Leave(const std::string& component,
             const std::vector<Placement>& wanted,
             std::map<std::string, std::string>& home_of_robot);
  void NoteJoined(const std::string& component, const Placement& last);
  void Tell(TeamEpoch epoch);
  void TellNewPoints(const TeamScan& scan, const MapAddition& addition) const;
  void TellAsEvent(const TeamEpoch& epoch) const;

  const TeamAtlasOptions options_;
  const AtlasSurroundings surroundings_;
  TeamMaps maps_;
  std::mutex rearranging_;      // Only one at a time; locked before the other one.
  std::mutex extension_;        // Keeps the journal in the order of the maps; guards what follows.
  bool is_rearranged_ = false;  // Meanwhile correctors take in nothing.
  std::map<std::string, TeamCorrector> correctors_;  // By component.
  std::vector<decltype(correctors_)::node_type> retired_;
  std::vector<std::shared_ptr<TeamMap>> outdated_;  // Maps that others have replaced.
  EpochRank epoch_;
  Placements told_;                         // By the last epoch of another service.
  std::map<std::string, JoinedTo> joined_;  // Components without scans, to such as have some.
  std::vector<TeamScan> of_others_;         // Scans taken in from other services.
};

}  // namespace qwsm::team
