// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lists of options and texts, in files and in settings.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "service/config/options_io.hpp"

namespace qwsm::config {
namespace {

struct WheelOptions {
  double radius_m = 0.1;
  std::string maker = "nobody";
};

template <class Visitor>
void Describe(Visitor& visit, WheelOptions& o) {
  visit("radius_m", o.radius_m, {.help = "of the wheel", .min = 0.01, .max = 1});
  visit("maker", o.maker, {.help = "who made it"});
}

struct AxleOptions {
  std::vector<WheelOptions> wheels{};
  double load_rad = 0.0;
};

template <class Visitor>
void Describe(Visitor& visit, AxleOptions& o) {
  visit("wheels", o.wheels, {.help = "on both ends"});
  visit("load_rad", o.load_rad, {.help = "an angle"});
}

template <class Report>
void Validate(const AxleOptions& o, Report& report) {
  if (o.wheels.size() != 2) report("wheels", "an axle has two");
}

struct CartOptions {
  std::vector<AxleOptions> axles{};
};

template <class Visitor>
void Describe(Visitor& visit, CartOptions& o) {
  visit("axles", o.axles, {.help = "front to rear"});
}

template <class Report>
void Validate(const CartOptions& o, Report& report) {
  for (std::size_t i = 0; i < o.axles.size(); ++i) {
    if (o.axles[i].load_rad > 1.0)
      report("axles[" + std::to_string(i) + "].load_rad", "overloaded");
  }
}

CartOptions LoadCart(const std::string& text, const std::vector<std::string>& settings = {}) {
  CartOptions options;
  OptionGroup group = GroupOf(options);
  Loader loader(group);
  loader.ReadText(text, "cart.yaml");
  for (const std::string& setting : settings) loader.Set(setting);
  loader.Finish();
  return options;
}

std::string ComplaintOfCart(const std::string& text, const std::vector<std::string>& settings = {}) {
  try {
    LoadCart(text, settings);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

constexpr const char* kCart =
    "axles:\n"
    "  - wheels:\n"
    "      - {radius_m: 0.2, maker: Otto's}\n"
    "      - maker: 'A: B'\n"
    "    load_deg: 10\n"
    "  - wheels: [{}, {radius_m: 0.3}]\n";

TEST(ConfigList, ReadsListsWithinLists) {
  const CartOptions cart = LoadCart(kCart);
  ASSERT_EQ(cart.axles.size(), 2U);
  ASSERT_EQ(cart.axles[0].wheels.size(), 2U);
  EXPECT_EQ(cart.axles[0].wheels[0].radius_m, 0.2);
  EXPECT_EQ(cart.axles[0].wheels[0].maker, "Otto's");
  EXPECT_EQ(cart.axles[0].wheels[1].maker, "A: B");
  EXPECT_EQ(cart.axles[0].wheels[1].radius_m, 0.1) << "not given, so the default";
  EXPECT_EQ(cart.axles[1].wheels[1].radius_m, 0.3);
}

TEST(ConfigList, ReadsBackWhatItDumps) {
  const CartOptions cart = LoadCart(kCart);
  const std::string yaml = DumpOptions(cart);
  EXPECT_EQ(DumpOptions(LoadCart(yaml)), yaml);
  EXPECT_EQ(LoadCart(yaml).axles[0].wheels[0].maker, "Otto's");
  EXPECT_EQ(DumpOptions(CartOptions{}), "# front to rear\naxles: []\n");
}

TEST(ConfigList, SettingsReachItems) {
  EXPECT_EQ(LoadCart(kCart, {"axles[1].wheels[0].radius_m=0.5"}).axles[1].wheels[0].radius_m, 0.5);
  EXPECT_EQ(ComplaintOfCart(kCart, {"axles[2].load_deg=1"}),
            "--set axles[2].load_deg: 'axles[2]' is no group of options");
  EXPECT_EQ(ComplaintOfCart(kCart, {"axles=1"}),
            "--set axles: is a list; set an option of one of its items, such as [0]");
}

TEST(ConfigList, SaysWhereAnItemIsWrong) {
  EXPECT_EQ(ComplaintOfCart("axles:\n"
                      "  - wheels: [{radius_m: 9}, {makr: me}]\n"
                      "  - 3\n"),
            "cart.yaml:2:25: axles[0].wheels[0].radius_m: must be between 0.01 and 1, got 9\n"
            "cart.yaml:2:30: axles[0].wheels[1].makr: unknown option; did you mean 'maker'?\n"
            "cart.yaml:3:5: axles[1]: expected a group of options (key: value, indented below)");
  EXPECT_EQ(ComplaintOfCart("axles: 3\n"),
            "cart.yaml:1:8: axles: expected a list (one '- ' for each item, indented below)");
}

TEST(ConfigList, ChecksItemsAndTheWhole) {
  EXPECT_EQ(ComplaintOfCart("axles:\n  - wheels: [{}]\n"),
            "cart.yaml:2:13: axles[0].wheels: an axle has two");
  EXPECT_EQ(ComplaintOfCart("axles:\n  - {wheels: [{}, {}], load_deg: 90}\n"),
            "cart.yaml:2:34: axles[0].load_deg: overloaded");
}

TEST(ConfigList, IsDescribedByAnExample) {
  const std::string table = DescribeOptions<CartOptions>();
  EXPECT_NE(table.find("axles[].wheels[].radius_m"), std::string::npos);
  EXPECT_NE(table.find("'nobody'"), std::string::npos);
}

}  // namespace
}  // namespace qwsm::config
