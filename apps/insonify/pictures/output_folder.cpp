// output_folder.cpp -- checks that the nearest existing parent of the output folder is writable.

#include "pictures/output_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "insonify/error.h"

namespace insonify {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& folder, std::error_code reason) {
  throw Error(fmt::format("{}: cannot make this folder: {}", folder.string(), reason.message()));
}

}  // namespace

std::filesystem::path output_folder(const std::filesystem::path& chosen, const std::filesystem::path& scenario) {
  std::filesystem::path folder = chosen.empty() ? std::filesystem::path(scenario.stem().string() + "_pings") : chosen;
  std::filesystem::path there = std::filesystem::absolute(folder);
  std::error_code error;
  while (std::filesystem::status(there, error).type() == std::filesystem::file_type::not_found) {
    there = there.parent_path();
  }
  if (!std::filesystem::is_directory(there, error)) {
    refuse(folder, error ? error : std::make_error_code(std::errc::not_a_directory));
  }
  if (access(there.c_str(), W_OK | X_OK) != 0) {
    const std::error_code reason(errno, std::generic_category());
    if (std::filesystem::exists(folder, error)) {
      throw Error(fmt::format("{}: cannot write into this folder: {}", folder.string(), reason.message()));
    }
    refuse(folder, reason);
  }
  return folder;
}

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    refuse(folder, error);
  }
}

}  // namespace insonify
