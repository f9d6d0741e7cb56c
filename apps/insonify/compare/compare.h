// compare.h -- insonify compare: similarity of two recordings or pictures.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace insonify {

struct CompareOptions {
  std::filesystem::path a, b;        ///< Recordings, folders of them, or pictures.
  std::string sonar;                 ///< Sonar whose recording is used in a folder; "" if the folder has only one.
  std::vector<std::uint64_t> pings;  ///< Numbers from 0; empty: all that both recordings have.
  std::string scale;                 ///< linear or db; "" for db with recordings of the calibrated model, else linear.
  double floor_db = -50;             ///< [dB]
  std::optional<double>
      full_scale;       ///< When absent: the largest intensity of both recordings in the calibrated model, else 1.
  bool counts = false;  ///< Compare the counts of recordings, linear from 0 to the greatest.
  bool ms_ssim = true;  ///< Compute MS-SSIM where pictures are large enough.
  bool json = false;
};

/// @return  kDone. @throws InputError for wrong input, Error for a failure while running
int compare(const CompareOptions& options);

}  // namespace insonify
