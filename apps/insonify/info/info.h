// info.h -- insonify info: describes recordings.

#pragma once

#include <filesystem>
#include <vector>

namespace insonify {

struct InfoOptions {
  std::vector<std::filesystem::path> recordings;
  bool json = false;
};

/// Describes every recording, also after one that cannot be read.
/// @return  kDone, or kWrongInput after a message for each file that is not a recording.
int info(const InfoOptions& options);

}  // namespace insonify
