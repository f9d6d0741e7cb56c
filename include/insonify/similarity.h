// similarity.h -- similarity measures between two sonar pictures, and the scores of control pictures without content.

#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "insonify/field.h"

namespace insonify {

/// A picture of grey levels, from 0 to 1 (full scale). In pings and polar pictures the rows are ranges.
struct GreyPicture {
  std::string name;            ///< For messages: "a.png", "a.h5 ping 3".
  int columns = 0;             ///< [pixels]
  int rows = 0;                ///< [pixels]
  std::vector<double> values;  ///< Row by row: columns x rows numbers from 0 to 1.
};

/// Similarity measures of two pictures. Those of several pairs can be averaged field by field.
struct Similarity {
  double mse = 0;
  double psnr_db = 0;  ///< [dB re full scale]; infinite for equal pictures.
  double ssim = 0;
  double ms_ssim = std::numeric_limits<double>::quiet_NaN();  ///< NaN if it was not computed.
  double correlation = 0;
  double ks_distance = 0;

  /// Calls visit(Field, number) on every measure, in order. `help` says it in a few words.
  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit);
};

// The measures. Each is symmetric in a and b, and throws Error for pictures of unequal shape. Pictures may be constant
// or exceed full scale here; compare_pictures() refuses those.

/// Mean of the squared differences of all pixels.
[[nodiscard]] double mean_squared_error(const GreyPicture& a, const GreyPicture& b);

/// Peak signal-to-noise ratio for pictures of full scale 1: -10 log10(mse) [dB], infinite for 0.
[[nodiscard]] double psnr_db(double mse);

/// Structural similarity, -1 to 1: the product of luminance, contrast and structure terms, averaged over all windows
/// that lie inside the picture. Gaussian windows of 11 x 11 pixels with standard deviation 1.5, K1 = 0.01, K2 = 0.03,
/// full scale 1, population moments. Z. Wang, A. C. Bovik, H. R. Sheikh and E. P. Simoncelli, "Image quality
/// assessment: from error visibility to structural similarity", IEEE Trans. Image Processing 13(4), 600 (2004), eqs.
/// (13) to (17).
/// @throws Error for pictures of fewer than kSsimSide pixels a side.
[[nodiscard]] double ssim(const GreyPicture& a, const GreyPicture& b);
inline constexpr int kSsimSide = 11;

/// Multi-scale structural similarity, 0 to 1: the product of contrast and structure terms at five scales and of the
/// luminance term at the coarsest, raised to the weights .0448 .2856 .3001 .2363 .1333. Each scale is the mean over 2 x
/// 2 pixels of the previous one; an odd last row or column is dropped. Negative terms count as 0. Z. Wang, E. P.
/// Simoncelli and A. C. Bovik, "Multi-scale structural similarity for image quality assessment", 37th Asilomar
/// Conference (2003), eq. (7).
///
/// Each scale must hold one window. Of a picture with a side below kMsSsimSide the ms_ssim_scales() finest are taken.
/// Their weights are divided by their sum, which must be 1 for values of different scales to be comparable (ibid.,
/// after eq. (7)); with a single scale it is SSIM.
/// @throws Error for pictures of fewer than kSsimSide pixels a side.
[[nodiscard]] double ms_ssim(const GreyPicture& a, const GreyPicture& b);
inline constexpr int kMsSsimScales = 5;
inline constexpr int kMsSsimSide = kSsimSide << (kMsSsimScales - 1);  ///< From here on there are all scales [pixels].

/// Scales of MS-SSIM that a picture has room for, 0 to kMsSsimScales.
[[nodiscard]] int ms_ssim_scales(int columns, int rows);

/// Pearson correlation of the pixels, -1 to 1; independent of gain and offset. 0 if a picture is constant.
[[nodiscard]] double correlation(const GreyPicture& a, const GreyPicture& b);

/// Kolmogorov-Smirnov distance of two samples, 0 to 1: the largest difference of their cumulative distributions. It
/// depends on which levels occur, not on where, and does not change under a monotonic mapping of the levels:
/// intensities, amplitudes and decibels give the same distance.
/// @throws Error for an empty sample or one with NaN.
[[nodiscard]] double ks_distance(std::span<const double> a, std::span<const double> b);

struct SimilarityOptions {
  bool ms_ssim = true;  ///< Whether to compute MS-SSIM, which takes longest.
};

/// Checks that a picture can be compared by all measures.
/// @throws Error with its name and numbers for one that is too small, constant, or not from 0 to 1.
void check_comparable(const GreyPicture& picture);

/// All measures of a picture b against a picture a.
/// @throws Error with names and numbers, also for two of unequal shape.
[[nodiscard]] Similarity compare_pictures(const GreyPicture& a, const GreyPicture& b,
                                          const SimilarityOptions& options = {});

/// Similarity measures scaled to 0 (none) .. 1 (equal), so that larger is better for each.
struct NormalisedSimilarity {
  double mse = 0;
  double psnr = 0;
  double ssim = 0;
  double ms_ssim = 0;  ///< NaN if it was not computed.

  /// As Similarity::visit_fields.
  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit);
};
[[nodiscard]] NormalisedSimilarity normalised(const Similarity& similarity);

// Control pictures: derived from a picture, they contain almost nothing of its scene. A simulated picture is evidence
// for a simulator only if it scores higher against a real one than the controls of the real one do.

/// Every pixel is the picture's mean: the constant picture with the least mean squared error.
[[nodiscard]] GreyPicture flat_grey(const GreyPicture& picture);

/// Every row is its own mean: keeps the level over range, not the distribution over the fan.
[[nodiscard]] GreyPicture mean_range_profile(const GreyPicture& picture);

/// The picture's pixels in random order, with a fixed seed: keeps the histogram only.
[[nodiscard]] GreyPicture pixel_shuffle(const GreyPicture& picture);

/// Similarity of each control to its picture.
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
  visit(Field{"ms_ssim", "", from_to(0, 1), "Structure at several scales."}, self.ms_ssim);
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
