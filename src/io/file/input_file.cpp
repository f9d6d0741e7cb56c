// input_file.cpp -- plain reasons for files that cannot be read.

#include "io/file/input_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "base/names.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/budgets.h"

namespace insonify {
namespace {

[[noreturn]] void throw_unreadable(const std::filesystem::path& path, int reason) {
  throw Error(path.string() + ": cannot be read: " + std::generic_category().message(reason));
}

constexpr std::size_t kLongestStream = std::size_t{1} << 28;  // [bytes]

// Whether a path is one of the process's own open files, as of a shell's <(command).
bool is_open_already(const std::string& name) {
  return name == "/dev/stdin" || name.starts_with("/dev/fd/") || name.starts_with("/proc/");
}

std::string read_all(const std::filesystem::path& path) {
  // In one pass: a pipe cannot be rewound.
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text;
  if (std::error_code ignored; !is_stream(path)) {
    const std::uintmax_t bytes = std::filesystem::file_size(path, ignored);
    check_budget(Budget::kBytes, ignored ? 0 : static_cast<double>(bytes), path.string());
    text.reserve(ignored ? 0 : bytes);
  }
  std::array<char, 65536> part;
  while (file.read(part.data(), part.size()) || file.gcount() > 0) {
    text.append(part.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > kLongestStream && is_stream(path)) {
      throw Error(path.string() + ": is not a regular file and does not end");
    }
  }
  if (!file.eof()) {
    throw_unreadable(path, errno != 0 ? errno : EIO);
  }
  if (text.empty()) {
    throw Error(path.string() + ": the file is empty");
  }
  return text;
}

}  // namespace

bool is_stream(const std::filesystem::path& path) {
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  const bool is_special = std::filesystem::exists(status) && !std::filesystem::is_directory(status) &&
                          !std::filesystem::is_regular_file(status);
  return is_special || is_open_already(path.string());
}

void check_input_file(const std::filesystem::path& path) {
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw Error(path.string() + ": no such file");
  }
  if (failure) {
    throw_unreadable(path, failure.value());
  }
  if (std::filesystem::is_directory(status)) {
    throw Error(path.string() + ": is a folder, not a file");
  }
  if (std::filesystem::is_fifo(status) && !is_open_already(path.string())) {
    throw Error(path.string() + ": is a named pipe, not a file");  // It may never have a writer.
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw_unreadable(path, errno);
  }
  if (file.peek() == std::ifstream::traits_type::eof()) {
    throw Error(path.string() + ": the file is empty");
  }
}

std::string read_text(const std::filesystem::path& path) {
  if (!is_open_already(path.string())) {
    check_input_file(path);
  }
  return read_all(path);
}

std::string read_text_or_pipe(const std::filesystem::path& path) {
  if (!is_stream(path)) {
    check_input_file(path);
  }
  return read_all(path);
}

std::string ending_of(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

std::string foreign_reason(std::string_view reason) {
  constexpr std::size_t kLongest = 500;
  std::string text(reason.substr(0, reason.find_last_not_of(" .\r\n\t") + 1));
  std::ranges::replace(text, '\n', ' ');
  return printable(text, kLongest);
}

}  // namespace insonify
