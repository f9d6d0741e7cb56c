// info.h -- insonify info: tells what recordings hold.

#pragma once

#include <filesystem>
#include <vector>

namespace insonify {

struct InfoOptions {
  std::vector<std::filesystem::path> recordings;
  bool json = false;
};

/// Tells of every recording, also after one that cannot be read.
/// @return  kDone, or kWrongInput after a message for each file that is no recording.
int info(const InfoOptions& options);

}  // namespace insonify
