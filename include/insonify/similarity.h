// similarity.h -- how alike two sonar pictures are, and what a worthless picture would score.

#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "insonify/field.h"

namespace insonify {

/// A table of grey levels, 0 (silent) to 1 (full scale). Rows are ranges where one is a ping or a polar picture.
struct GreyPicture {
  std::string name;            ///< For messages: "a.png", "a.h5 ping 3".
  int columns = 0;             ///< [pixels]
  int rows = 0;                ///< [pixels]
  std::vector<double> values;  ///< Row by row: columns x rows numbers from 0 to 1.
};

/// What two pictures have in common. Numbers of pairs can be averaged field by field.
struct Similarity {
  double mse = 0;
  double psnr_db = 0;  ///< [dB re full scale]; infinite for equal pictures.
  double ssim = 0;
  double ms_ssim = std::numeric_limits<double>::quiet_NaN();  ///< NaN where it was left out.
  double correlation = 0;
  double ks_distance = 0;

  /// Calls visit(Field, number) on every measure, in order. `help` says it in a few words.
  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit);
};

// The measures. Each gives the same for (b, a), and throws Error for pictures of unequal shape. They may be constant
// and go beyond full scale, which `compare_pictures` refuses.

/// Mean of the squared differences of all pixels.
[[nodiscard]] double mean_squared_error(const GreyPicture& a, const GreyPicture& b);

/// Peak signal-to-noise ratio of that error for pictures of full scale 1: -10 log10(mse) [dB], infinite for 0.
[[nodiscard]] double psnr_db(double mse);

/// Structural similarity, -1 to 1: the mean over all whole windows of how alike their brightness, contrast and pattern
/// are. Gaussian windows of 11 x 11 pixels and deviation 1.5, K1 = 0.01, K2 = 0.03, full scale 1, moments of the
/// population. Z. Wang, A. C. Bovik, H. R. Sheikh and E. P. Simoncelli, "Image quality assessment: from error
/// visibility to structural similarity", IEEE Trans. Image Processing 13(4), 600 (2004), eqs. (13) to (17).
/// @throws Error for pictures of fewer than kSsimSide pixels a side.
[[nodiscard]] double ssim(const GreyPicture& a, const GreyPicture& b);
inline constexpr int kSsimSide = 11;

/// Multi-scale structural similarity, 0 to 1: contrast and pattern at five scales, each half as fine as the last (means
/// of 2 x 2 pixels, an odd last row or column left out), brightness at the coarsest, multiplied with the weights
/// .0448 .2856 .3001 .2363 .1333. A scale that is anti-alike counts as 0. Z. Wang, E. P. Simoncelli and A. C. Bovik,
/// "Multi-scale structural similarity for image quality assessment", 37th Asilomar Conference (2003), eq. (7).
/// @throws Error for pictures of fewer than kMsSsimSide pixels a side: the coarsest scale must hold one window.
[[nodiscard]] double ms_ssim(const GreyPicture& a, const GreyPicture& b);
inline constexpr int kMsSsimSide = kSsimSide << 4;

/// Pearson's correlation of the pixels, -1 to 1. It does not see a common gain or offset. 0 where a picture is
/// constant.
[[nodiscard]] double correlation(const GreyPicture& a, const GreyPicture& b);

/// Kolmogorov and Smirnov's distance of two samples, 0 to 1: the largest difference of their cumulative distributions.
/// It looks at what levels there are and not at where they are, and is the same on any scale that keeps their order:
/// intensities, amplitudes and decibels give one number.
/// @throws Error for an empty sample or one with NaN.
[[nodiscard]] double ks_distance(std::span<const double> a, std::span<const double> b);

struct SimilarityOptions {
  bool ms_ssim = true;  ///< False for pictures that are too small for it.
};

/// Whether a picture can be compared by all measures.
/// @throws Error with its name and numbers for one that is too small, constant, or not from 0 to 1.
void check_comparable(const GreyPicture& picture, const SimilarityOptions& options = {});

/// All measures of a picture b against a picture a.
/// @throws Error with names and numbers, also for two of unequal shape.
[[nodiscard]] Similarity compare_pictures(const GreyPicture& a, const GreyPicture& b,
                                          const SimilarityOptions& options = {});

/// A similarity told from 0 (none) to 1 (equal), so that larger is better for each.
struct NormalisedSimilarity {
  double mse = 0;
  double psnr = 0;
  double ssim = 0;
  double ms_ssim = 0;  ///< NaN where it was left out.

  /// As Similarity::visit_fields.
  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit);
};
[[nodiscard]] NormalisedSimilarity normalised(const Similarity& similarity);

// Controls: pictures that know nothing of the scene but what little their name says. A simulation that does not score
// better than they do against the same picture has shown nothing.

/// One grey, the picture's mean: of all constant pictures the one with the least error.
[[nodiscard]] GreyPicture flat_grey(const GreyPicture& picture);

/// Each row its own mean: how loud each range is, and nothing of where in the fan.
[[nodiscard]] GreyPicture mean_range_profile(const GreyPicture& picture);

/// The picture's own pixels in random order, the same one every time: its histogram, and nothing else.
[[nodiscard]] GreyPicture pixel_shuffle(const GreyPicture& picture);

/// What each of them scores against a picture.
struct ControlSimilarities {
  Similarity flat_grey, range_profile, pixel_shuffle;
};
[[nodiscard]] ControlSimilarities compare_controls(const GreyPicture& picture, const SimilarityOptions& options = {});

// ---------------------------------------------------------------------------------------------------------------------

template <typename Self, typename Visit>
void Similarity::visit_fields(Self& self, Visit&& visit) {
  visit(Field{"mse", "", from_to(0, 1), "Mean squared difference."}, self.mse);
  visit(Field{"psnr_db", "dB", at_least(0), "The same in decibels."}, self.psnr_db);
  visit(Field{"ssim", "", from_to(-1, 1), "Local structure."}, self.ssim);
  visit(Field{"ms_ssim", "", from_to(0, 1), "Structure at five scales."}, self.ms_ssim);
  visit(Field{"correlation", "", from_to(-1, 1), "Rise and fall together."}, self.correlation);
  visit(Field{"ks_distance", "", from_to(0, 1), "Difference of histograms."}, self.ks_distance);
}

template <typename Self, typename Visit>
void NormalisedSimilarity::visit_fields(Self& self, Visit&& visit) {
  visit(Field{"mse", "", from_to(0, 1), "1 - mse."}, self.mse);
  visit(Field{"psnr", "", from_to(0, 1), "PSNR over that of one step of 8 bits, 48.13 dB, at most 1."}, self.psnr);
  visit(Field{"ssim", "", from_to(0, 1), "SSIM, at least 0."}, self.ssim);
  visit(Field{"ms_ssim", "", from_to(0, 1), "MS-SSIM."}, self.ms_ssim);
}

}  // namespace insonify
