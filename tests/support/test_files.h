// test_files.h -- temporary files of a test, and the paths of real data where they are available.

#pragma once

#include <stdlib.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace insonify {

/// A folder of the test's own, gone afterwards.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "insonify_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Writes a file, making the folders it lies in.
  std::filesystem::path write(const std::filesystem::path& name, std::string_view content) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// A folder of this process, gone when it ends: other tests that run at the same time have their own.
inline const std::filesystem::path& process_folder() {
  static const ScratchFolder folder;
  return folder.path();
}

/// The bytes of a value as files hold them on a little-endian machine.
template <typename Value>
std::string bytes_of(const Value& value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

/// A real data file, in the folder that the environment's INSONIFY_TEST_DATA names; empty where it is absent.
inline std::filesystem::path real_data(const std::filesystem::path& name) {
  const char* folder = std::getenv("INSONIFY_TEST_DATA");
  const std::filesystem::path path = std::filesystem::path(folder != nullptr ? folder : "") / name;
  return folder != nullptr && std::filesystem::exists(path) ? path : std::filesystem::path();
}

}  // namespace insonify

/// Defines `variable` as the place of a real data file, or skips the test, saying why.
#define INSONIFY_REAL_DATA(variable, name)                                                \
  const std::filesystem::path variable = ::insonify::real_data(name);                     \
  if ((variable).empty()) {                                                               \
    GTEST_SKIP() << "no " << (name) << " below INSONIFY_TEST_DATA, the real data folder"; \
  }
