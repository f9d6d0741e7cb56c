// real_pings_test.cpp -- similarity of successive real pings, and of real pings and control pictures.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iterator>

#include "insonify/similarity.h"
#include "support/test_files.h"

namespace insonify::real_pings_test {
namespace {

// Three pings of a Blueprint Oculus, one after the other: 256 beams x 703 bins of 8 bits, each message 182016 bytes of
// which the first 2048 are its header.
GreyPicture oculus_ping(const std::filesystem::path& path, int number) {
  constexpr int kMessage = 182016, kHeader = 2048, kBeams = 256, kBins = 703;
  std::ifstream file(path, std::ios::binary);
  const std::string raw{std::istreambuf_iterator<char>(file), {}};
  GreyPicture ping{fmt::format("oculus ping {}", number), kBeams, kBins, {}};
  for (int i = 0; i < kBeams * kBins; ++i) {
    ping.values.push_back(static_cast<unsigned char>(raw.at(number * kMessage + kHeader + i)) / 255.0);
  }
  return ping;
}

// The expected numbers are of the same definitions in NumPy, printed with so many digits.
constexpr double kPrinted = 1e-6;

void expect_similarity(const Similarity& found, const Similarity& expected) {
  EXPECT_NEAR(found.psnr_db, expected.psnr_db, kPrinted);
  EXPECT_NEAR(found.ssim, expected.ssim, kPrinted);
  EXPECT_NEAR(found.ms_ssim, expected.ms_ssim, kPrinted);
  EXPECT_NEAR(found.correlation, expected.correlation, kPrinted);
  EXPECT_NEAR(found.ks_distance, expected.ks_distance, kPrinted);
}

// Successive pings of one scene are an upper bound for the similarity that a simulation of a ping can reach; the
// controls are a lower bound for one of any use.
TEST(RealPingsTest, PingsInARowAreFarMoreAlikeThanControls) {
  INSONIFY_REAL_DATA(file, "liboculus_oculus_raw/three_pings_8bit.raw");
  const GreyPicture first = oculus_ping(file, 0);
  const Similarity next = compare_pictures(first, oculus_ping(file, 1));
  const ControlSimilarities controls = compare_controls(first);
  expect_similarity(next, {.psnr_db = 27.110570,
                           .ssim = .710022295,
                           .ms_ssim = .892430843,
                           .correlation = .976711593,
                           .ks_distance = .005028672});
  expect_similarity(
      controls.flat_grey,
      {.psnr_db = 13.798836, .ssim = .222898236, .ms_ssim = .464381692, .correlation = 0, .ks_distance = .632695813});
  expect_similarity(controls.range_profile, {.psnr_db = 19.143417,
                                             .ssim = .396419010,
                                             .ms_ssim = .606820941,
                                             .correlation = .841363819,
                                             .ks_distance = .126639180});
  EXPECT_NEAR(controls.pixel_shuffle.mse, 2 * controls.flat_grey.mse, 0.01 * controls.flat_grey.mse);
  EXPECT_EQ(controls.pixel_shuffle.ks_distance, 0);
}

}  // namespace
}  // namespace insonify::real_pings_test
