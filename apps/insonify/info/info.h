// info.h -- insonify info: tells what recordings hold.

#pragma once

#include <filesystem>
#include <vector>

namespace insonify {

struct InfoOptions {
  std::vector<std::filesystem::path> recordings;
  bool json = false;
};

/// @return  kDone. @throws InputError for a file that is no recording.
int info(const InfoOptions& options);

}  // namespace insonify
