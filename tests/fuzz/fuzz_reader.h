// fuzz_reader.h -- what the three fuzzers share: bytes become a file, and a reader must take it or throw an Error.

#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "insonify/error.h"

namespace insonify::fuzz {

/// A file that is written anew for each input, in a folder of the process's own.
class InputFile {
 public:
  InputFile() : folder_(std::filesystem::temp_directory_path() / ("insonify_fuzz_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~InputFile() { std::filesystem::remove_all(folder_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::filesystem::path write(const char* name, std::string_view bytes) const {
    const std::filesystem::path path = folder_ / name;
    std::FILE* file = std::fopen(path.c_str(), "wb");
    std::fwrite(bytes.data(), 1, bytes.size(), file);
    std::fclose(file);
    return path;
  }

 private:
  std::filesystem::path folder_;
};

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Reads; what is wrong must come as an Error, anything else ends the fuzzer.
template <typename Read>
void expect_error_or_nothing(const Read& read) {
  try {
    read();
  } catch (const Error&) {
  }
}

}  // namespace insonify::fuzz
