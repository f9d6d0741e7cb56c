// philox_test.cpp -- Philox against the published known answers.

#include "base/philox.h"

#include <gtest/gtest.h>

namespace insonify::philox_test {
namespace {

// Known answers published with the authors' Random123 library, kat_vectors, philox4x32 with 10 rounds.
TEST(PhiloxTest, GivesThePublishedAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (PhiloxCounter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({~0U, ~0U, ~0U, ~0U}, {~0U, ~0U}), (PhiloxCounter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (PhiloxCounter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

// The same, philox2x32 with 10 rounds.
TEST(PhiloxTest, PairsGiveThePublishedAnswers) {
  EXPECT_EQ(philox({0, 0}, 0), (PhiloxPair{0xff1dae59, 0x6cd10df2}));
  EXPECT_EQ(philox({~0U, ~0U}, ~0U), (PhiloxPair{0x2c3f628b, 0xab4fd7ad}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3}, 0x13198a2e), (PhiloxPair{0xdd7ce038, 0xf62a4c12}));
}

TEST(PhiloxTest, UniformNeverReachesItsEnds) {
  EXPECT_GT(uniform_open(0), 0.0F);
  EXPECT_LT(uniform_open(~0U), 1.0F);
}

}  // namespace
}  // namespace insonify::philox_test
