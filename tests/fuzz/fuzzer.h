// fuzzer.h -- shared by the fuzzers: their list, and files of the bytes that a reader must read or refuse with an
// Error.

#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/error.h"
#include "io/file/reader_process.h"

namespace insonify::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Something that takes any bytes, by the name of its folder in tests/fuzz/seeds.
struct Fuzzer {
  std::string name;
  void (*take)(Bytes);
};

/// Those of this program: one with libFuzzer, all in fuzz_tests.
inline std::vector<Fuzzer>& fuzzers() {
  static std::vector<Fuzzer> list;
  return list;
}

/// A variable of this type at the end of a file adds a fuzzer to the list.
struct Listed {
  Listed(const char* name, void (*take)(Bytes)) { fuzzers().push_back({name, take}); }
};

/// A folder of this process, in which files are rewritten for each input.
class InputFile {
 public:
  InputFile() {
    std::error_code ignored;
    const std::filesystem::path memory = "/dev/shm";  // Much faster than a disk.
    const bool has_memory = std::filesystem::is_directory(memory, ignored);
    std::string pattern =
        ((has_memory ? memory : std::filesystem::temp_directory_path()) / "insonify_fuzz_XXXXXX").string();
    folder_ = mkdtemp(pattern.data()) != nullptr ? pattern : "";
  }
  ~InputFile() { std::filesystem::remove_all(folder_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

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

inline std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline void expect(bool holds) {
  if (!holds) {
    std::abort();
  }
}

/// Calls a reader, which may refuse its input by an Error of one line that begins with `start`, the file's name.
/// Anything else ends the fuzzer.
template <typename Read>
void expect_error_or_nothing(const Read& read, const std::string& start = "") {
  try {
    read();
  } catch (const Error& error) {
    const std::string_view message = error.what();
    expect(message.starts_with(start) && message.find('\n') == std::string_view::npos);
  }
}

/// `whole` with other words at some of `places`: for each three bytes of `changes`, the first two choose a place, the
/// third the word that stands there instead, of 1 to 8 bytes: all ones, the greatest, zero, or small.
inline std::string with_words(std::string whole, std::span<const std::size_t> places, Bytes changes) {
  for (std::size_t i = 0; i + 3 <= changes.size() && !places.empty(); i += 3) {
    const std::size_t at = places[(changes[i] + 256U * changes[i + 1]) % places.size()];
    const unsigned how = changes[i + 2];
    std::string word(std::size_t{1} << (how & 3U), '\0');
    switch (how >> 2U & 3U) {
      case 0:
        word.assign(word.size(), '\xff');
        break;
      case 1:
        word.assign(word.size(), '\xff').back() = '\x7f';
        break;
      case 2:
        break;
      default:
        word[0] = static_cast<char>(how >> 4U);
    }
    word.resize(std::min(word.size(), whole.size() - at));
    whole.replace(at, word.size(), word);
  }
  return whole;
}

}  // namespace insonify::fuzz
