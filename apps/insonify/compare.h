// compare.h -- what a comparison of two files found, and how it is told.

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
  std::string sonar;                 ///< "" where the files do not tell.
  int columns = 0, rows = 0;         ///< Of each picture.
  std::vector<std::uint64_t> pings;  ///< That were compared; none for two pictures.
  std::string unmatched;             ///< "a.h5 has 12" where the files have unequal numbers of pings; else "".
  Display levels;                    ///< How intensities of recordings became levels from 0 to 1.
  bool is_scan = false;              ///< The pings of one beam side by side are one picture.
  std::vector<Similarity> each;      ///< One for each picture.
  Similarity similarity;
  NormalisedSimilarity normalised;
  ControlSimilarities controls;
};

void print_comparison(const Comparison& comparison);
void print_comparison_json(const Comparison& comparison);

}  // namespace insonify
