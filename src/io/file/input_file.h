// input_file.h -- checks common to all readers of files.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace insonify {

/// The byte-order mark that some programs write before text in UTF-8. Readers skip it.
inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// Whether a path names something that can be read only once, such as a pipe or the standard input. Relative paths
/// cannot refer to its folder.
[[nodiscard]] bool is_stream(const std::filesystem::path& path);

/// @throws Error "PATH: no such file", "PATH: is a folder, not a file", "PATH: is a named pipe, not a file", "PATH:
///         cannot be opened: REASON" or "PATH: the file is empty".
void check_input_file(const std::filesystem::path& path);

/// The whole file. Checks it first.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

/// The same, also from a named pipe, for which it waits.
[[nodiscard]] std::string read_text_or_pipe(const std::filesystem::path& path);

/// The path's extension in lower case, with its dot.
[[nodiscard]] std::string ending_of(const std::filesystem::path& path);

/// The reason that a library gives for a failure, made fit for the end of a message: printable, at most 500 bytes,
/// without a full stop.
[[nodiscard]] std::string foreign_reason(std::string_view reason);

}  // namespace insonify
