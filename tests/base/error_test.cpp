// error_test.cpp -- errors tell what is wrong, where it stands, and say so in one line.

#include "insonify/error.h"

#include <gtest/gtest.h>

namespace insonify::error_test {
namespace {

const Error kRange("sonars[0]", "max_range", " = 2 m must be greater than min_range = 5 m", {"sonars[0].min_range"});

TEST(ErrorTest, SaysTheSettingAndWhatIsWrongWithIt) {
  EXPECT_STREQ(kRange.what(), "sonars[0].max_range = 2 m must be greater than min_range = 5 m");
  EXPECT_EQ(kRange.object(), "sonars[0]");
  EXPECT_EQ(kRange.field(), "max_range");
  EXPECT_EQ(kRange.place(), Place());
  EXPECT_STREQ(Error("", "pings", " = 0 must be at least 1").what(), "pings = 0 must be at least 1");
  EXPECT_STREQ(Error("view", "", " is empty").what(), "view is empty");
}

TEST(ErrorTest, BeginsWithItsPlace) {
  const Error error = kRange.at({"a.yaml", 3, 5});
  EXPECT_STREQ(error.what(), "a.yaml:3:5: sonars[0].max_range = 2 m must be greater than min_range = 5 m");
  EXPECT_EQ(error.place().line, 3);
  EXPECT_EQ(error.field(), "max_range");
  EXPECT_STREQ(Error("gone").at({"ship.sdf", 12}).what(), "ship.sdf:12: gone");
  EXPECT_STREQ(Error("gone").at({"--set pings=3"}).what(), "--set pings=3: gone");
  EXPECT_STREQ(Error("gone").at({}).what(), "gone");
}

TEST(ErrorTest, KeepsTheFirstPlaceItIsGiven) {
  EXPECT_STREQ(Error("gone").at({"a", 1}).at({"b", 2}).what(), "a:1: gone");
}

TEST(ErrorTest, TakesThePlaceOfItsSettingElseOfARelatedOneElseOfWhatHoldsIt) {
  Places places{{"", {"whole"}}};
  EXPECT_EQ(kRange.located(places).place().file, "whole");
  places["sonars"] = {"list"};
  EXPECT_EQ(kRange.located(places).place().file, "list");
  places["sonars[0]"] = {"entry"};
  EXPECT_EQ(kRange.located(places).place().file, "entry");
  places["sonars[0].min_range"] = {"related"};
  EXPECT_EQ(kRange.located(places).place().file, "related");
  places["sonars[0].max_range"] = {"own"};
  EXPECT_EQ(kRange.located(places).place().file, "own");
  EXPECT_EQ(Error("sonars[0]", "position[2]", "").located({{"sonars[0].position", {"list"}}}).place().file, "list");
  // The list that holds the value tells more than what the value is compared with.
  EXPECT_EQ(Error("sonars[0]", "missing_beams[1]", "", {"sonars[0].beam_count"})
                .located({{"sonars[0].missing_beams", {"list"}}, {"sonars[0].beam_count", {"related"}}})
                .place()
                .file,
            "list");
}

TEST(ErrorTest, HasNoPlaceWhereItBelongsToNoSetting) {
  EXPECT_STREQ(Error("mesh.obj:3: bad").located({{"", {"scenario.yaml", 1, 1}}}).what(), "mesh.obj:3: bad");
}

}  // namespace
}  // namespace insonify::error_test
