// fuzz_reader.h -- shared by the fuzzers: writes the bytes to a file, which a reader must read or refuse with an Error.

#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "insonify/error.h"
#include "io/file/reader_process.h"

namespace insonify::fuzz {

/// A file that is rewritten for each input, in a folder of this process.
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
  SharedReader reader_;  // To start a process for each input would take most of the time.
};

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Calls a reader. Any exception other than an Error ends the fuzzer.
template <typename Read>
void expect_error_or_nothing(const Read& read) {
  try {
    read();
  } catch (const Error&) {
  }
}

}  // namespace insonify::fuzz
