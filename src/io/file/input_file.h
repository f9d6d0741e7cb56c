// input_file.h -- what all readers ask of a path before they open it.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace insonify {

/// Whether a path leads to what can be read once only, such as a pipe or the standard input: it has no folder of its
/// own.
[[nodiscard]] bool is_stream(const std::filesystem::path& path);

/// @throws Error "PATH: no such file", "PATH: is a folder, not a file", "PATH: cannot be opened: REASON" or
///         "PATH: the file is empty".
void check_input_file(const std::filesystem::path& path);

/// The whole file. Checks it first.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

/// The path's ending in lower case, with its dot.
[[nodiscard]] std::string ending_of(const std::filesystem::path& path);

/// What a library gives as the reason, as the end of a message of ours: printable, not too long, without a full stop.
[[nodiscard]] std::string foreign_reason(std::string_view reason);

}  // namespace insonify
