// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "service/config/option_group.hpp"
#include "service/config/problem.hpp"
#include "service/config/yaml_document.hpp"

namespace qwsm::config {

/// Fills a group from files and settings, later ones over earlier ones, collecting everything that
/// is wrong. Nothing is thrown before Finish().
class Loader {
 public:
  /// Fills a group. @pre `root` outlives the loader.
  explicit Loader(OptionGroup& root) : root_(root) {}

  /// Reads a YAML file; one that begins with `base: other.yaml` is laid over that one, whose name
  /// is relative to the file that includes it.
  void ReadFile(const std::filesystem::path& file);

  /// Reads YAML from memory; `name` stands for the file in messages.
  void ReadText(const std::string& text, const std::filesystem::path& name);

  /// Takes a setting as given after --set, such as `mapper.noise.range_m=0.01`.
  void Set(const std::string& setting);

  /// Runs the cross-field checks. @throws ConfigError naming all problems met, if any.
  void Finish();

 private:
  struct Slot {
    Field& field;
    std::string key;
  };

  void Include(const std::filesystem::path& file, const Location& from);
  void ReadRoot(const YamlNode& document);
  void ReadMap(const YamlNode& map, OptionGroup& group, const std::string& prefix);
  void ReadEntry(const YamlEntry& entry, OptionGroup& group, const std::string& prefix);
  void ReadValue(const YamlEntry& entry, Field& field, const std::string& key);
  void ReadList(const YamlNode& list, const ListField& field, const std::string& key);
  void Assign(const Slot& slot, const YamlNode& value, const Location& at);
  void Check(const OptionGroup& group, const std::string& prefix);
  bool HasProblemsIn(const std::string& prefix) const;
  Location WhereGiven(const std::string& prefix, const std::string& key) const;
  Location At(const YamlNode& node) const;
  void Report(const Location& at, const std::string& key, const std::string& what);

  OptionGroup& root_;
  /// Files being read; the innermost is the last.
  std::vector<std::filesystem::path> open_files_;
  /// Names of the files, in the order in which they were opened.
  std::vector<std::string> sources_;
  std::vector<Problem> problems_;
  /// Where each key got its value last, and where each list and each of its items begins.
  std::map<std::string, Location> given_;
};

}  // namespace qwsm::config
