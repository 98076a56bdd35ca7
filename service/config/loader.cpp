// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/loader.hpp"

#include <algorithm>
#include <cerrno>
#include <deque>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "service/config/number_text.hpp"
#include "service/config/suggestion.hpp"
#include "service/config/value_reader.hpp"

namespace qwsm::config {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBaseKey = "base";
constexpr std::size_t kMaxFileBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxIncludes = 16;

struct FileText {
  std::string text;
  std::string error;  ///< Why there is no text.
};

FileText ReadWhole(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored))
    return {.text = {}, .error = "is a directory, not a YAML file"};
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    return {.text = {}, .error = "cannot be opened: " + std::generic_category().message(errno)};
  std::string text(kMaxFileBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) return {.text = {}, .error = "cannot be read"};
  if (text.size() > kMaxFileBytes)
    return {.text = {}, .error = "is larger than 1 MiB; is it a YAML file?"};
  return {.text = std::move(text), .error = {}};
}

/// One name of a dotted key: `laser`, or `robots[1]`.
struct Step {
  std::string name;
  std::optional<int> index{};
};

Step StepOf(const std::string& text) {
  const std::size_t bracket = text.find('[');
  if (bracket == std::string::npos || !text.ends_with(']')) return {.name = text};
  const std::string index = text.substr(bracket + 1, text.size() - bracket - 2);
  return {.name = text.substr(0, bracket), .index = ParseWholeNumber(index)};
}

/// The group that a field, or one item of it, is; nothing where it is none. Items are kept in
/// `items`.
OptionGroup* GroupIn(Field& field, const Step& step, std::deque<OptionGroup>& items) {
  if (!step.index) return std::get_if<OptionGroup>(&field.value);
  const auto* list = std::get_if<ListField>(&field.value);
  if (list == nullptr) return nullptr;
  std::vector<OptionGroup> all = list->items();
  if (*step.index < 0 || static_cast<std::size_t>(*step.index) >= all.size()) return nullptr;
  items.push_back(std::move(all[static_cast<std::size_t>(*step.index)]));
  return &items.back();
}

std::string ItemKey(const std::string& list, std::size_t index) {
  return list + "[" + std::to_string(index) + "]";
}

/// The full names of all options of this name, wherever they are.
void CollectNamesakes(const OptionGroup& group,
                      const std::string& prefix,
                      const std::string& name,
                      std::vector<std::string>& keys) {
  for (const Field& field : group.fields) {
    if (field.name == name) keys.push_back(prefix + field.name);
    if (const auto* nested = std::get_if<OptionGroup>(&field.value)) {
      CollectNamesakes(*nested, prefix + field.name + ".", name, keys);
    }
  }
}

std::string UnknownOption(const std::string& name,
                          const OptionGroup& group,
                          const OptionGroup& root) {
  const std::string suggestion = DidYouMean(name, group.Names());
  if (!suggestion.empty()) return "unknown option" + suggestion;
  std::vector<std::string> namesakes;
  CollectNamesakes(root, "", name, namesakes);
  if (namesakes.empty()) return "unknown option";
  return "unknown option here; did you mean '" + namesakes.front() + "'?";
}

std::string NewName(const std::string& key) { return "is now called '" + key + "'"; }

// What cannot be resolved is left as it is: reading it tells what is wrong with it.
fs::path Resolved(const fs::path& file) {
  std::error_code error;
  const fs::path resolved = fs::weakly_canonical(file, error);
  return error ? file : resolved;
}

}  // namespace

void Loader::ReadFile(const fs::path& file) { Include(file, {.source = file.string()}); }

void Loader::Include(const fs::path& file, const Location& from) {
  const bool is_included = !open_files_.empty();
  const std::string who = is_included ? "'" + file.string() + "' " : std::string();
  const fs::path resolved = Resolved(file);
  const bool is_open = std::ranges::any_of(
      open_files_, [&](const fs::path& open) { return Resolved(open) == resolved; });
  if (is_open) return Report(from, std::string(kBaseKey), who + "includes itself");
  if (open_files_.size() >= kMaxIncludes) {
    return Report(from, std::string(kBaseKey), "more than 16 files include each other");
  }
  const FileText content = ReadWhole(file);
  if (!content.error.empty()) {
    return Report(from, is_included ? std::string(kBaseKey) : std::string(), who + content.error);
  }
  ReadText(content.text, file);
}

void Loader::ReadText(const std::string& text, const fs::path& name) {
  open_files_.push_back(name);
  sources_.push_back(name.string());
  try {
    ReadRoot(ParseYaml(text));
  } catch (const YamlError& error) {
    Report({name.string(), error.line(), error.column()}, "", error.what());
  }
  open_files_.pop_back();
}

void Loader::Set(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  const std::string key = setting.substr(0, equals);
  const Location at{.source = "--set " + key};
  sources_.push_back(at.source);
  if (equals == std::string::npos) return Report(at, "", "expected key=value");

  OptionGroup* group = &root_;
  std::string new_key;            // With the names of this release.
  std::deque<OptionGroup> items;  // Of lists on the way down; they live until the value is set.
  std::size_t begin = 0;
  while (true) {
    const std::size_t dot = key.find('.', begin);
    const std::string text = key.substr(begin, dot == std::string::npos ? dot : dot - begin);
    const Step step = StepOf(text);
    Field* field = group->Find(step.name);
    if (field == nullptr) field = group->FindFormer(step.name);
    if (field == nullptr) return Report(at, "", UnknownOption(step.name, *group, root_));
    new_key += (begin == 0 ? "" : ".") + field->name + text.substr(step.name.size());
    if (dot == std::string::npos) {
      if (new_key != key) return Report(at, "", NewName(new_key));
      YamlNode value;
      value.text = setting.substr(equals + 1);
      const bool is_text = std::holds_alternative<std::string*>(field->value);
      if (is_text || !value.text.empty()) value.kind = YamlNode::Kind::kPlain;  // "" is a text.
      return Assign({*field, key}, value, at);
    }
    group = GroupIn(*field, step, items);
    if (group == nullptr)
      return Report(at, "", "'" + key.substr(0, dot) + "' is no group of options");
    begin = dot + 1;
  }
}

void Loader::Finish() {
  Check(root_, "");
  if (problems_.empty()) return;
  const auto rank = [this](const Problem& problem) {
    return std::ranges::find(sources_, problem.location.source) - sources_.begin();
  };
  std::ranges::stable_sort(problems_, {}, [&](const Problem& problem) {
    return std::tuple(rank(problem), problem.location.line, problem.location.column);
  });
  throw ConfigError(std::move(problems_));
}

void Loader::ReadRoot(const YamlNode& document) {
  for (const YamlEntry& entry : document.entries) {
    if (entry.key.text != kBaseKey) continue;
    if (entry.value.text.empty()) {
      Report(At(entry.value), std::string(kBaseKey), "expected the name of a file");
      continue;
    }
    Include(open_files_.back().parent_path() / entry.value.text, At(entry.value));
  }
  ReadMap(document, root_, "");
}

void Loader::ReadMap(const YamlNode& map, OptionGroup& group, const std::string& prefix) {
  if (map.kind == YamlNode::Kind::kNothing) return;
  const std::string key = prefix.substr(0, prefix.empty() ? 0 : prefix.size() - 1);
  if (map.kind != YamlNode::Kind::kMap) {
    return Report(At(map), key, "expected a group of options (key: value, indented below)");
  }
  std::map<std::string, int> line_of;
  for (const YamlEntry& entry : map.entries) {
    const auto [first, is_new] = line_of.emplace(entry.key.text, entry.key.line);
    if (is_new) {
      ReadEntry(entry, group, prefix);
    } else {
      Report(At(entry.key),
             prefix + entry.key.text,
             "given twice; first in line " + std::to_string(first->second));
    }
  }
}

void Loader::ReadEntry(const YamlEntry& entry, OptionGroup& group, const std::string& prefix) {
  const std::string& name = entry.key.text;
  if (prefix.empty() && name == kBaseKey) return;  // Read first, in ReadRoot().
  if (Field* field = group.Find(name)) return ReadValue(entry, *field, prefix + name);
  if (Field* field = group.FindFormer(name)) {
    Report(At(entry.key), prefix + name, NewName(prefix + field->name));
    // Read all the same, for what else is wrong with it.
    return ReadValue(entry, *field, prefix + field->name);
  }
  Report(At(entry.key), prefix + name, UnknownOption(name, group, root_));
}

void Loader::ReadValue(const YamlEntry& entry, Field& field, const std::string& key) {
  if (auto* nested = std::get_if<OptionGroup>(&field.value)) {
    return ReadMap(entry.value, *nested, key + ".");
  }
  if (const auto* list = std::get_if<ListField>(&field.value)) {
    return ReadList(entry.value, *list, key);
  }
  const bool has_value = entry.value.kind != YamlNode::Kind::kNothing;
  Assign({field, key}, entry.value, At(has_value ? entry.value : entry.key));
}

void Loader::ReadList(const YamlNode& list, const ListField& field, const std::string& key) {
  if (list.kind == YamlNode::Kind::kNothing) return;
  if (list.kind != YamlNode::Kind::kSequence) {
    return Report(At(list), key, "expected a list (one '- ' for each item, indented below)");
  }
  given_[key] = At(list);
  field.clear();  // A later list takes the place of an earlier one.
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const std::string item_key = ItemKey(key, i);
    given_[item_key] = At(list.items[i]);
    OptionGroup item = field.append();
    ReadMap(list.items[i], item, item_key + ".");
  }
}

void Loader::Assign(const Slot& slot, const YamlNode& value, const Location& at) {
  // --set names the key already.
  const std::string shown_key = at.line > 0 ? slot.key : std::string();
  if (std::holds_alternative<OptionGroup>(slot.field.value)) {
    return Report(at, shown_key, "is a group of options; set one of them");
  }
  if (std::holds_alternative<ListField>(slot.field.value)) {
    return Report(at, shown_key, "is a list; set an option of one of its items, such as [0]");
  }
  given_[slot.key] = at;
  if (const std::optional<std::string> wrong = AssignValue(slot.field, value)) {
    Report(at, shown_key, *wrong);
  }
}

void Loader::Check(const OptionGroup& group, const std::string& prefix) {
  for (const Field& field : group.fields) {
    if (const auto* nested = std::get_if<OptionGroup>(&field.value)) {
      Check(*nested, prefix + field.name + ".");
    } else if (const auto* list = std::get_if<ListField>(&field.value)) {
      const std::vector<OptionGroup> items = list->items();
      for (std::size_t i = 0; i < items.size(); ++i) {
        Check(items[i], ItemKey(prefix + field.name, i) + ".");
      }
    }
  }
  // Values already refused would only be refused a second time.
  if (!group.validate || HasProblemsIn(prefix)) return;
  group.validate([&](std::string_view field, const std::string& what) {
    const std::string key = prefix + YamlName(field);
    Report(WhereGiven(prefix, key), key, what);
  });
}

bool Loader::HasProblemsIn(const std::string& prefix) const {
  return std::ranges::any_of(problems_, [&](const Problem& problem) {
    return problem.key.starts_with(prefix) || problem.key + "." == prefix ||
           problem.location.line == 0;
  });
}

Location Loader::WhereGiven(const std::string& prefix, const std::string& key) const {
  if (const auto found = given_.find(key); found != given_.end()) return found->second;
  // The other side of the comparison was given then.
  const auto near = given_.lower_bound(prefix);
  const bool is_near = near != given_.end() && near->first.starts_with(prefix);
  if (is_near && !prefix.empty()) return near->second;
  // Or the list or the item of a list that it belongs to.
  for (std::size_t end = key.find_last_of(".["); end != std::string::npos && end > 0;
       end = key.find_last_of(".[", end - 1)) {
    const auto around = given_.find(key.substr(0, end));
    if (around != given_.end()) return around->second;
  }
  if (is_near) return near->second;
  return {.source = sources_.empty() ? "defaults" : sources_.back()};
}

Location Loader::At(const YamlNode& node) const {
  return {open_files_.back().string(), node.line, node.column};
}

void Loader::Report(const Location& at, const std::string& key, const std::string& what) {
  problems_.push_back({at, key, what});
}

}  // namespace qwsm::config
