// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Our messages stand twice, as IDL for Cyclone DDS and as .msg for ROS 2. On the wire they are the
// same only if the fields are the same, in the same order.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "service/io/bags/writing/message_definitions.hpp"

namespace qwsm {
namespace {

namespace fs = std::filesystem;

const fs::path kIdl = fs::path(QWSM_SOURCE_DIR) / "idl";

std::string Read(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// What a .msg file calls a type of the IDL.
std::string ToRosType(const std::string& type) {
  static const std::map<std::string, std::string> kNumbers = {
      {"double", "float64"}, {"float", "float32"}, {"boolean", "bool"}};
  if (const auto number = kNumbers.find(type); number != kNumbers.end()) return number->second;
  std::smatch parts;
  if (std::regex_match(type, parts, std::regex(R"(sequence<(\w+)>)"))) {
    return ToRosType(parts[1]) + "[]";
  }
  if (std::regex_match(type, parts, std::regex(R"((\w+)::msg::dds_::(\w+)_)"))) {
    return parts[1].str() + "/" + parts[2].str();
  }
  return type.ends_with('_') ? type.substr(0, type.size() - 1) : type;  // Of the same package.
}

/// `type name` of each field of a struct.
std::vector<std::string> FieldsOfIdl(const std::string& idl, const std::string& message) {
  std::smatch body;
  if (!std::regex_search(idl, body, std::regex("struct " + message + R"(_ \{([^}]*)\})")))
    return {};
  const std::string text = body[1];
  const std::regex field(R"(([A-Za-z0-9_:<>]+) (\w+)(\[\d+\])?;)");
  std::vector<std::string> fields;
  for (std::sregex_iterator at(text.begin(), text.end(), field), end; at != end; ++at) {
    fields.push_back(ToRosType((*at)[1]) + (*at)[3].str() + " " + (*at)[2].str());
  }
  return fields;
}

/// The same of a .msg file; constants are not sent.
std::vector<std::string> FieldsOfMsg(const std::string& msg) {
  std::vector<std::string> fields;
  std::istringstream stream(msg);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string type;
    std::string name;
    if (words >> type >> name && name.find('=') == name.npos) fields.push_back(type + " " + name);
  }
  return fields;
}

TEST(IdlTwins, HaveTheSameFields) {
  const std::string idl = Read(kIdl / "qwsm_msgs.idl");
  const std::regex kOwnPackage("^qwsm_msgs/");
  std::set<std::string> messages;
  for (const auto& entry : fs::directory_iterator(kIdl / "qwsm_msgs" / "msg")) {
    const std::string message = entry.path().stem();
    SCOPED_TRACE(message);
    messages.insert(message);
    const std::vector<std::string> fields = FieldsOfMsg(Read(entry.path()));
    EXPECT_FALSE(fields.empty());
    EXPECT_EQ(FieldsOfIdl(idl, message), fields);
    // The definition that goes with recorded and shown messages, without those of the types in it.
    const std::string definition = io::MessageDefinition("qwsm_msgs/msg/" + message);
    std::vector<std::string> defined = FieldsOfMsg(definition.substr(0, definition.find("==")));
    for (std::string& field : defined) field = std::regex_replace(field, kOwnPackage, "");
    EXPECT_EQ(defined, fields);
    EXPECT_NE(Read(kIdl / "qwsm_msgs" / "CMakeLists.txt").find("msg/" + message + ".msg"),
              std::string::npos);
  }
  const std::regex any_struct(R"(struct (\w+)_ \{)");
  for (std::sregex_iterator at(idl.begin(), idl.end(), any_struct), end; at != end; ++at) {
    EXPECT_TRUE(messages.contains((*at)[1])) << (*at)[1];
  }
}

}  // namespace
}  // namespace qwsm
