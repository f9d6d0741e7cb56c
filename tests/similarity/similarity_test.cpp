// similarity_test.cpp -- similarity measures against other programs, values computed by hand and laws; refusals.

#include "insonify/similarity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "similarity/reference_pictures.h"
#include "support/message_of.h"

namespace insonify::similarity_test {
namespace {

// The same formula in double precision, summed in another order.
constexpr double kSame = 1e-9;

// ---------------------------------------------------------------- Against the values of others

struct Reference {
  const char* name;
  GreyPicture (*change)(const GreyPicture& a);
  double mse, psnr_db, ssim, ms_ssim, small_ssim;  ///< 256 x 256; `small_ssim` of 64 x 64.
};

GreyPicture with_common_noise(const GreyPicture& a) {
  return with_noise(a);
}

constexpr Reference kReferences[] = {
    {"Gain", with_gain, .0008, 30.969100130080562, .9765226303563733, .9796666903418572, .976558867940707},
    {"Offset", with_offset, .0025, 26.02059991327962, .9948923589208523, .9993957560922623, .9949209089155998},
    {"Shift", shifted, .005384294391935389, 22.688712026292226, .7351652391833409, .9329198005252373,
     .7266229986354659},
    {"Noise", with_common_noise, .003330930618285591, 24.774344133639204, .818061406487109, .9773020626391735,
     .8183549780771034},
    {"Speckle", with_speckle, .07340407296065347, 11.342798417833633, .22859973392577693, .7459342114239371,
     .22242750495222044},
};

class ReferenceTest : public testing::TestWithParam<Reference> {};

TEST_P(ReferenceTest, EveryMeasureAgrees) {
  const GreyPicture a = waves_and_squares(256);
  const GreyPicture b = GetParam().change(a);
  EXPECT_NEAR(mean_squared_error(a, b), GetParam().mse, kSame);
  EXPECT_NEAR(psnr_db(mean_squared_error(a, b)), GetParam().psnr_db, kSame);
  EXPECT_NEAR(ssim(a, b), GetParam().ssim, kSame);
  EXPECT_NEAR(ms_ssim(a, b), GetParam().ms_ssim, kSame);
  const GreyPicture small = waves_and_squares(64);
  EXPECT_NEAR(ssim(small, GetParam().change(small)), GetParam().small_ssim, kSame);
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceTest, testing::ValuesIn(kReferences),
                         [](const auto& reference) { return std::string(reference.param.name); });

// Windows without any contrast leave brightness alone: (2 x .5 x .6 + .0001) / (.25 + .36 + .0001).
TEST(SimilarityTest, OnlyBrightnessCountsForConstantPictures) {
  const GreyPicture half{"half", 20, 11, std::vector<double>(220, 0.5)};
  const GreyPicture more{"more", 20, 11, std::vector<double>(220, 0.6)};
  EXPECT_NEAR(ssim(half, more), .9836092443861661, kSame);
  EXPECT_NEAR(ssim(half, more), 0.6001 / 0.6101, kSame);
  EXPECT_EQ(correlation(half, more), 0);
  EXPECT_EQ(ks_distance(half.values, more.values), 1);
}

// ---------------------------------------------------------------- By law

TEST(SimilarityTest, APictureIsIdenticalToItself) {
  const GreyPicture a = waves_and_squares(176);
  const Similarity self = compare_pictures(a, a);
  EXPECT_EQ(self.mse, 0);
  EXPECT_EQ(self.psnr_db, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(self.ssim, 1, kSame);
  EXPECT_NEAR(self.ms_ssim, 1, kSame);
  EXPECT_NEAR(self.correlation, 1, kSame);
  EXPECT_EQ(self.ks_distance, 0);
}

TEST(SimilarityTest, TheOrderOfThePicturesDoesNotMatter) {
  const GreyPicture a = waves_and_squares(176), b = with_noise(shifted(a));
  const Similarity there = compare_pictures(a, b), back = compare_pictures(b, a);
  Similarity::visit_fields(there, [&](const Field& field, double value) {
    Similarity::visit_fields(back, [&](const Field& other, double returned) {
      if (field.name == other.name) {
        EXPECT_NEAR(value, returned, kSame) << field.name;
      }
    });
  });
}

TEST(SimilarityTest, MoreNoiseIsLessAlike) {
  const GreyPicture a = waves_and_squares(176);
  Similarity last = compare_pictures(a, a);
  for (const double strength : {0.02, 0.05, 0.1, 0.2, 0.3}) {
    const Similarity now = compare_pictures(a, with_noise(a, strength));
    EXPECT_GT(now.mse, last.mse) << strength;
    EXPECT_LT(now.psnr_db, last.psnr_db) << strength;
    EXPECT_LT(now.ssim, last.ssim) << strength;
    EXPECT_LT(now.ms_ssim, last.ms_ssim) << strength;
    EXPECT_LT(now.correlation, last.correlation) << strength;
    last = now;
  }
}

TEST(SimilarityTest, CorrelationIgnoresGainAndOffsetButNotTheSign) {
  const GreyPicture a = waves_and_squares(32);
  EXPECT_NEAR(correlation(a, with_gain(a)), 1, kSame);
  EXPECT_NEAR(correlation(a, with_offset(a)), 1, kSame);
  EXPECT_NEAR(correlation(a, changed(a, [](double value, double) { return 1 - value; })), -1, kSame);
}

// The negative of a picture is anti-alike: a power of that would not be a number.
TEST(SimilarityTest, NegativeScalesCountAsZero) {
  const GreyPicture a = waves_and_squares(176);
  const GreyPicture negative = changed(a, [](double value, double) { return 1 - value; });
  EXPECT_LT(ssim(a, negative), 0);
  EXPECT_EQ(ms_ssim(a, negative), 0);
}

// 191, 95, 47, 23, 11. The number is of the same definition in NumPy.
TEST(SimilarityTest, OddSidesLoseTheirLastPixelOnTheWayToCoarserScales) {
  const GreyPicture odd = waves_and_squares(191);
  EXPECT_NEAR(ms_ssim(odd, shifted(odd)), .9327143777509248, kSame);
}

// The values are those of the same definition in NumPy and SciPy, with the finest scales' weights divided by their sum.
TEST(SimilarityTest, SmallPicturesHaveFewerScales) {
  struct Fewer {
    int side, scales;
    double gain, shift, noise, speckle;
  };
  constexpr Fewer kFewer[] = {{175, 4, .9765596034606783, .9240412522308783, .9767078804899092, .7506234011502204},
                              {64, 3, .9766420338652685, .9051201859746714, .9684610880914596, .6805309256081367},
                              {43, 2, .9763118597026081, .8893450367652472, .9547024751231653, .5831758465921143},
                              {11, 1, .9801970885826176, .7437853796269643, .6329424760439633, .04716824312739665}};
  for (const Fewer& one : kFewer) {
    const GreyPicture a = waves_and_squares(one.side);
    EXPECT_EQ(ms_ssim_scales(one.side, one.side), one.scales);
    EXPECT_EQ(ms_ssim_scales(1000, one.side), one.scales);
    EXPECT_NEAR(ms_ssim(a, with_gain(a)), one.gain, kSame) << one.side;
    EXPECT_NEAR(ms_ssim(a, shifted(a)), one.shift, kSame) << one.side;
    EXPECT_NEAR(ms_ssim(a, with_noise(a)), one.noise, kSame) << one.side;
    EXPECT_NEAR(ms_ssim(a, with_speckle(a)), one.speckle, kSame) << one.side;
    EXPECT_NEAR(ms_ssim(a, a), 1, kSame) << one.side;
  }
  const GreyPicture least = waves_and_squares(11);
  EXPECT_NEAR(ms_ssim(least, shifted(least)), ssim(least, shifted(least)), kSame);
  EXPECT_EQ(ms_ssim_scales(176, 176), 5);
  EXPECT_EQ(ms_ssim_scales(10, 500), 0);
}

TEST(SimilarityTest, MsSsimCanBeLeftOut) {
  const GreyPicture a = waves_and_squares(11);
  const Similarity found = compare_pictures(a, with_gain(a), {.ms_ssim = false});
  EXPECT_TRUE(std::isnan(found.ms_ssim));
  EXPECT_TRUE(std::isnan(normalised(found).ms_ssim));
  EXPECT_NEAR(found.ssim, ssim(a, with_gain(a)), kSame);
}

// 48.1308 dB is the PSNR of an error of one step of 8 bits; half of it is sqrt(1 / 255) of full scale.
TEST(SimilarityTest, NormalisedMeasuresGoFromZeroToOne) {
  const NormalisedSimilarity some = normalised({.mse = 1.0 / 255, .psnr_db = psnr_db(1.0 / 255), .ssim = -0.1});
  EXPECT_NEAR(some.mse, 254.0 / 255, kSame);
  EXPECT_NEAR(some.psnr, 0.5, kSame);
  EXPECT_EQ(some.ssim, 0);
  const NormalisedSimilarity equal = normalised({.mse = 0, .psnr_db = psnr_db(0), .ssim = 1, .ms_ssim = 1});
  EXPECT_EQ(equal.mse, 1);
  EXPECT_EQ(equal.psnr, 1);
  EXPECT_EQ(normalised({.mse = 1, .psnr_db = psnr_db(1)}).psnr, 0);
}

// ---------------------------------------------------------------- Kolmogorov and Smirnov

TEST(KsDistanceTest, IsTheLargestGapOfTheDistributions) {
  // At 2 all four of the first lie behind, and one of four of the second.
  EXPECT_DOUBLE_EQ(ks_distance(std::vector{0.0, 1.0, 1.0, 2.0}, std::vector{2.0, 3.0, 4.0, 5.0}), 0.75);
  // Samples of unequal size: at 1, 2/2 and 1/4.
  EXPECT_DOUBLE_EQ(ks_distance(std::vector{0.5, 1.0}, std::vector{1.0, 2.0, 3.0, 4.0}), 0.75);
  EXPECT_EQ(ks_distance(std::vector{1.0, 2.0}, std::vector{3.0}), 1);
  EXPECT_EQ(ks_distance(std::vector{1.0, 2.0, 2.0, 1.0}, std::vector{2.0, 1.0}), 0);
}

// Uniform over 0..1 against 0..2: F differs most at 1, by 1 - 1/2. Uniform against its square: x against sqrt(x), most
// at x = 1/4, by 1/4.
TEST(KsDistanceTest, AgreesWithKnownDistributions) {
  constexpr int kCount = 10000;
  std::vector<double> uniform, wide, squared;
  for (int i = 0; i < kCount; ++i) {
    uniform.push_back((i + 0.5) / kCount);
    wide.push_back(2 * uniform.back());
    squared.push_back(uniform.back() * uniform.back());
  }
  constexpr double kStep = 1.0 / kCount;
  EXPECT_NEAR(ks_distance(uniform, wide), 0.5, kStep);
  EXPECT_NEAR(ks_distance(uniform, squared), 0.25, kStep);
}

TEST(KsDistanceTest, IsTheSameOnEveryScale) {
  const GreyPicture a = waves_and_squares(64), b = with_noise(a);
  const auto decibels = [](double value, double) { return std::log10(value); };
  EXPECT_DOUBLE_EQ(ks_distance(a.values, b.values),
                   ks_distance(changed(a, decibels).values, changed(b, decibels).values));
}

// 8 bits read from a picture are double precision; from a recording, single.
TEST(KsDistanceTest, LevelsStoredInOtherPrecisionAreTheSame) {
  GreyPicture a{"a", 255, 255, {}};
  for (int i = 0; i < 255 * 255; ++i) {
    a.values.push_back(i % 253 / 255.0);
  }
  const GreyPicture b = changed(a, [](double value, double) { return static_cast<float>(value); });
  EXPECT_EQ(compare_pictures(a, b).ks_distance, 0);
}

TEST(KsDistanceTest, RefusesEmptySamplesAndNaN) {
  EXPECT_EQ(message_of([] { (void)ks_distance({}, std::vector{1.0}); }),
            "a sample of 0 values must have at least one and no NaN");
  EXPECT_EQ(message_of([] {
              (void)ks_distance(std::vector{1.0}, std::vector{0.0, std::nan("")});
            }),
            "a sample of 2 values must have at least one and no NaN");
}

// ---------------------------------------------------------------- What is refused

std::string refusal(const GreyPicture& a, const GreyPicture& b) {
  return message_of([&] { (void)compare_pictures(a, b); });
}

TEST(RefusalTest, NamesThePictureTheNumbersAndTheReason) {
  const GreyPicture a = waves_and_squares(176);
  GreyPicture wide{"wide.png", 352, 88, a.values};
  wide.values.resize(352 * 88);
  EXPECT_EQ(refusal(a, wide), "wide.png: 352 columns x 88 rows, but a has 176 columns x 176 rows");

  const GreyPicture flat{"flat.png", 176, 176, std::vector<double>(176 * 176, 0.25)};
  EXPECT_EQ(refusal(a, flat), "flat.png: every value is 0.25; there is nothing to compare in a constant picture");
  EXPECT_EQ(refusal(flat, a), "flat.png: every value is 0.25; there is nothing to compare in a constant picture");

  const GreyPicture tiny = waves_and_squares(10);
  EXPECT_EQ(refusal(tiny, tiny), "a: 10 columns x 10 rows; SSIM needs at least 11 x 11");
  GreyPicture loud = a;
  loud.values[176 * 3 + 5] = 1.5;
  EXPECT_EQ(refusal(a, loud), "a: the value in column 5, row 3 is 1.5; it must be from 0 to full scale, 1");
  loud.values[176 * 3 + 5] = std::nan("");
  EXPECT_EQ(refusal(loud, a), "a: the value in column 5, row 3 is nan; it must be from 0 to full scale, 1");

  const GreyPicture torn{"torn", 176, 176, {0.5, 0.6}};
  EXPECT_EQ(refusal(a, torn),
            "torn: 176 columns x 176 rows must hold at least one pixel and a value for each, not 2 values");
  EXPECT_EQ(refusal({"none", 0, 0, {}}, a),
            "none: 0 columns x 0 rows must hold at least one pixel and a value for each, not 0 values");
}

}  // namespace
}  // namespace insonify::similarity_test
