// field_test.cpp -- limits as text, names and units of fields, and messages of checks.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "insonify/geometry.h"
#include "insonify/settings_table.h"
#include "support/message_of.h"

namespace insonify::field_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Limits kOpen{.least = -2, .most = 3, .least_allowed = false, .most_allowed = false};
constexpr Limits kBelow{.most = 3, .most_allowed = false};

TEST(LimitsTest, TheEndsBelongToThemUnlessSaidOtherwise) {
  EXPECT_TRUE(from_to(-2, 3).allow(-2));
  EXPECT_TRUE(from_to(-2, 3).allow(3));
  EXPECT_FALSE(above_to(-2, 3).allow(-2));
  EXPECT_TRUE(above_to(-2, 3).allow(3));
  EXPECT_TRUE(at_least(1).allow(1));
  EXPECT_FALSE(greater_than(1).allow(1));
  EXPECT_FALSE(kOpen.allow(-2));
  EXPECT_FALSE(kOpen.allow(3));
  EXPECT_FALSE(kBelow.allow(3));
}

TEST(LimitsTest, NothingBeyondTheEndsIsAllowed) {
  EXPECT_FALSE(from_to(-2, 3).allow(std::nextafter(-2.0, -3.0)));
  EXPECT_FALSE(from_to(-2, 3).allow(std::nextafter(3.0, 4.0)));
  EXPECT_FALSE(at_least(1).allow(0.5));
}

TEST(LimitsTest, WhatIsNotFiniteIsNeverAllowed) {
  for (const Limits& limits : {any_number(), at_least(0), from_to(0, 1)}) {
    EXPECT_FALSE(limits.allow(NAN));
    EXPECT_FALSE(limits.allow(kInfinity));
    EXPECT_FALSE(limits.allow(-kInfinity));
  }
}

TEST(LimitsTest, AreWrittenInWords) {
  EXPECT_EQ(any_number().text(), "any finite number");
  EXPECT_EQ(at_least(1).text(), "at least 1");
  EXPECT_EQ(greater_than(0).text(), "greater than 0");
  EXPECT_EQ((Limits{.most = 5}).text(), "at most 5");
  EXPECT_EQ(kBelow.text(), "less than 3");
  EXPECT_EQ(from_to(7.7, 8.3).text(), "from 7.7 to 8.3");
  EXPECT_EQ(above_to(0, 360).text(), "greater than 0, at most 360");
  EXPECT_EQ(kOpen.text(), "greater than -2, less than 3");
  EXPECT_EQ((Limits{.least = -2, .most = 3, .most_allowed = false}).text(), "at least -2, less than 3");
}

TEST(LimitsTest, AreWrittenInTheUnitAskedFor) {
  EXPECT_EQ(from_to(-std::numbers::pi, std::numbers::pi).text(180 / std::numbers::pi), "from -180 to 180");
}

TEST(FieldTest, AnglesAreWrittenInDegrees) {
  const Field field{"step", "rad", {}, ""};
  EXPECT_EQ(file_name_of(field), "step_deg");
  EXPECT_EQ(file_unit_of(field), "deg");
  EXPECT_DOUBLE_EQ(file_scale_of(field) * std::numbers::pi, 180);
}

TEST(FieldTest, OtherUnitsAreWrittenAsTheyAre) {
  const Field field{"depth", "m", {}, ""};
  EXPECT_EQ(file_name_of(field), "depth");
  EXPECT_EQ(file_unit_of(field), "m");
  EXPECT_EQ(file_scale_of(field), 1);
}

struct Config {
  double length = 4;
  double turn = 0.1;
  int count = 3;
  bool flag = false;
  std::string word = "nan";
  std::optional<double> extra = {};
  std::vector<double> list{1, 2};
  Vec3 place = Vec3::Zero();

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"length", "m", greater_than(0), ""}, self.length);
    visit(Field{"turn", "rad", from_to(-1, 1), ""}, self.turn);
    visit(Field{"count", "", from_to(1, 9), ""}, self.count);
    visit(Field{"flag", "", from_to(5, 6), ""}, self.flag);
    visit(Field{"word", "", from_to(5, 6), ""}, self.word);
    visit(Field{"extra", "s", at_least(2), ""}, self.extra);
    visit(Field{"list", "", at_least(1), ""}, self.list);
    visit(Field{"place", "m", any_number(), ""}, self.place);
  }
};

std::string message(const Config& config) {
  return message_of([&] { check_fields("thing", config); });
}

TEST(CheckFieldsTest, PassesWhatIsInLimitsAndLeavesWordsAndFlagsAlone) {
  EXPECT_EQ(message({}), "no error");
  EXPECT_EQ(message({.extra = 2}), "no error");
}

TEST(CheckFieldsTest, NamesObjectFieldValueAndLimit) {
  EXPECT_EQ(message({.length = 0}), "thing.length = 0 m must be greater than 0 m");
  EXPECT_EQ(message({.count = 10}), "thing.count = 10 must be from 1 to 9");
  EXPECT_EQ(message({.extra = 1.5}), "thing.extra = 1.5 s must be at least 2 s");
  EXPECT_EQ(message({.extra = NAN}), "thing.extra = nan s must be at least 2 s");
  EXPECT_EQ(message({.list = {3, 0.5}}), "thing.list[1] = 0.5 must be at least 1");
  EXPECT_EQ(message({.place = {1, 2, kInfinity}}), "thing.place[2] = inf m must be a finite number");
}

// 1 rad = 57.29577951308232 deg.
TEST(CheckFieldsTest, GivesAnglesInDegrees) {
  EXPECT_EQ(message({.turn = -2}), "thing.turn_deg = -114.591559 deg must be from -57.29577951 to 57.29577951 deg");
}

TEST(CheckFieldsTest, LeavesOutAnObjectWithoutAName) {
  EXPECT_EQ(message_of([] { check_fields("", Config{.count = 0}); }), "count = 0 must be from 1 to 9");
}

TEST(CheckFieldsTest, StopsAtTheFirstFault) {
  EXPECT_EQ(message({.length = -1, .count = 10}), "thing.length = -1 m must be greater than 0 m");
}

}  // namespace
}  // namespace insonify::field_test
