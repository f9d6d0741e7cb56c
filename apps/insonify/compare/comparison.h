// comparison.h -- result of a comparison of two files, and its output.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "insonify/picture.h"
#include "insonify/similarity.h"

namespace insonify {

/// Two files compared picture by picture, each number a mean over the pictures.
struct Comparison {
  std::string a, b;                  ///< Names of the files.
  std::string sonar;                 ///< "" where the files do not contain it.
  int columns = 0, rows = 0;         ///< Size of each picture [pixels].
  std::vector<std::uint64_t> pings;  ///< Pings compared; empty for two pictures.
  std::string unmatched;             ///< "a.h5 has 12" where the files have different numbers of pings; else "".
  std::vector<std::string> notes;    ///< What was chosen of the files, or left out.
  std::string hint;                  ///< Why levels of the two may not be comparable; else "".
  int ms_ssim_scales = 0;            ///< 0: MS-SSIM was skipped.
  std::string differing;             ///< How the sonars of two recordings differ in range and aperture; else "".
  Display levels;                    ///< Maps intensities of recordings to levels from 0 to 1.
  bool is_scan = false;              ///< Pings of one or two beams are compared side by side as one picture.
  std::vector<Similarity> each;      ///< One per picture.
  Similarity similarity;
  NormalisedSimilarity normalised;
  ControlSimilarities controls;
};

void print_comparison(const Comparison& comparison);
void print_comparison_json(const Comparison& comparison);

}  // namespace insonify
