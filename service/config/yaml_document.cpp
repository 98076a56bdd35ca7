// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/yaml_document.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <sstream>
#include <utility>

namespace qwsm::config {
namespace {

constexpr std::size_t kMaxDepth = 32;

YamlError ErrorAt(const YAML::Mark& mark, const std::string& what) {
  return {what, mark.line + 1, mark.column + 1};
}

/// Builds the tree from the events of yaml-cpp, which knows marks, duplicates and quotes where its
/// own nodes forget them.
class TreeBuilder : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    RefuseAnchor(mark, anchor);
    Add(NodeAt(mark, YamlNode::Kind::kNothing));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    RefuseAnchor(mark, anchor);
  }

  void OnScalar(const YAML::Mark& mark,
                const std::string& tag,
                YAML::anchor_t anchor,
                const std::string& value) override {
    Refuse(mark, tag, anchor);
    YamlNode node = NodeAt(mark, tag == "!" ? YamlNode::Kind::kQuoted : YamlNode::Kind::kPlain);
    node.text = value;
    Add(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark,
                       const std::string& tag,
                       YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Open(mark, tag, anchor, YamlNode::Kind::kSequence);
  }
  void OnSequenceEnd() override { Close(); }

  void OnMapStart(const YAML::Mark& mark,
                  const std::string& tag,
                  YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    Open(mark, tag, anchor, YamlNode::Kind::kMap);
  }
  void OnMapEnd() override { Close(); }

  YamlNode Take() { return std::move(root_); }

 private:
  struct OpenNode {
    YamlNode node;
    YamlNode key;
    bool has_key = false;
  };

  static YamlNode NodeAt(const YAML::Mark& mark, YamlNode::Kind kind) {
    YamlNode node;
    node.kind = kind;
    node.line = mark.line + 1;
    node.column = mark.column + 1;
    return node;
  }

  static void RefuseAnchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) throw ErrorAt(mark, "anchors and aliases are not supported");
  }

  static void Refuse(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    RefuseAnchor(mark, anchor);
    const bool is_explicit = !tag.empty() && tag != "?" && tag != "!";
    if (is_explicit) throw ErrorAt(mark, "tags are not supported");
  }

  void Open(const YAML::Mark& mark,
            const std::string& tag,
            YAML::anchor_t anchor,
            YamlNode::Kind kind) {
    Refuse(mark, tag, anchor);
    if (open_.size() >= kMaxDepth) throw ErrorAt(mark, "nested too deeply");
    open_.push_back({.node = NodeAt(mark, kind), .key = {}});
  }

  void Close() {
    YamlNode node = std::move(open_.back().node);
    open_.pop_back();
    Add(std::move(node));
  }

  void Add(YamlNode node) {
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    OpenNode& parent = open_.back();
    if (parent.node.kind == YamlNode::Kind::kSequence) {
      parent.node.items.push_back(std::move(node));
      return;
    }
    if (parent.has_key) {
      parent.node.entries.push_back({std::move(parent.key), std::move(node)});
    } else {
      parent.key = std::move(node);
    }
    parent.has_key = !parent.has_key;
  }

  std::vector<OpenNode> open_;
  YamlNode root_;
};

}  // namespace

YamlNode ParseYaml(const std::string& text) {
  std::istringstream stream(text);
  try {
    YAML::Parser parser(stream);
    TreeBuilder first;
    if (!parser.HandleNextDocument(first)) return {};
    TreeBuilder second;
    if (parser.HandleNextDocument(second)) {
      const YamlNode extra = second.Take();
      throw YamlError("a second document begins; only one is read", extra.line, extra.column);
    }
    return first.Take();
  } catch (const YAML::Exception& error) {
    throw ErrorAt(error.mark, error.msg);
  }
}

}  // namespace qwsm::config
