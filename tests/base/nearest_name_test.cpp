// nearest_name_test.cpp -- suggestions for mistyped names.

#include <gtest/gtest.h>

#include <vector>

#include "base/names.h"

namespace insonify::nearest_name_test {
namespace {

const std::vector<std::string> kKeys = {"max_range", "min_range", "beam_count", "bin_count", "step_deg"};

TEST(NearestNameTest, UndoesEachKindOfSlip) {
  EXPECT_EQ(nearest_name("max_rnge", kKeys), "max_range");      // A letter is missing.
  EXPECT_EQ(nearest_name("beam_couunt", kKeys), "beam_count");  // A letter is inserted.
  EXPECT_EQ(nearest_name("bun_count", kKeys), "bin_count");     // A letter is replaced.
  EXPECT_EQ(nearest_name("setp_deg", kKeys), "step_deg");       // Two letters are swapped.
}

TEST(NearestNameTest, IgnoresCase) {
  EXPECT_EQ(nearest_name("STEP_DEG", kKeys), "step_deg");
}

// "mxn_range" is one replacement from "min_range" and two from "max_range".
TEST(NearestNameTest, TakesTheFewestSlips) {
  EXPECT_EQ(nearest_name("mxn_range", kKeys), "min_range");
}

// One swap leads to "step_deg"; "set_dog" takes a letter left out and one replaced.
TEST(NearestNameTest, ASwapOfNeighboursIsOneSlip) {
  EXPECT_EQ(nearest_name("setp_deg", std::vector<std::string>{"set_dog", "step_deg"}), "step_deg");
}

TEST(NearestNameTest, TakesTheFirstOfEquals) {
  EXPECT_EQ(nearest_name("mxx_range", std::vector<std::string>{"min_range", "mid_range"}), "min_range");
}

// Two slips at most, or a third of the letters, and less than half of them; "step_dge_rd" of 11 letters may have 3.
TEST(NearestNameTest, SuggestsNothingWhereNothingIsNear) {
  EXPECT_EQ(nearest_name("noise", kKeys), "");
  EXPECT_EQ(nearest_name("rows", kKeys), "");
  EXPECT_EQ(nearest_name("maxrang", kKeys), "max_range");
  EXPECT_EQ(nearest_name("step_dge_rd", kKeys), "");
  EXPECT_EQ(nearest_name("step_dge_r", kKeys), "step_deg");
  EXPECT_EQ(nearest_name("ab", std::vector<std::string>{"xy"}), "");
  EXPECT_EQ(nearest_name("gold", std::vector<std::string>{"wood"}), "");
  EXPECT_EQ(nearest_name("", kKeys), "");
}

TEST(NearestNameTest, MakesTheEndOfAMessage) {
  EXPECT_EQ(suggestion("max_rnage", kKeys), "; did you mean max_range?");
  EXPECT_EQ(suggestion("colour", kKeys), "");
}

TEST(NearestNameTest, SuggestsNothingWithoutCandidates) {
  EXPECT_EQ(nearest_name("step", {}), "");
}

}  // namespace
}  // namespace insonify::nearest_name_test
