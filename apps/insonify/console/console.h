// console.h -- runs a program's main function, writes to the standard streams and reports failures.

#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "insonify/log.h"
#include "insonify/printable.h"

namespace insonify {

/// Runs a program; reports what it throws in one line, and a standard output that could not be written. Closed standard
/// streams are opened on /dev/null, so that no other file gets their descriptors and their output.
/// @return  The exit status of the process.
[[nodiscard]] int run_guarded(const std::function<int()>& program);

/// Writes to the standard output. run_guarded() reports failures.
void say_text(std::string_view text);

/// Converts an argument of say() for printing: strings, which may come from files, are made printable.
template <typename Arg>
[[nodiscard]] decltype(auto) shown(const Arg& arg) {
  if constexpr (std::is_convertible_v<const Arg&, std::string_view>) {
    return printable(arg, kLongestMessage);
  } else {
    return arg;
  }
}
template <typename Arg>
using Shown = decltype(shown(std::declval<const Arg&>()));

/// Formats and prints to the standard output. The format may hold line breaks, string arguments are made printable.
template <typename... Args>
void say(fmt::format_string<Shown<Args>...> format, const Args&... args) {
  say_text(fmt::format(format, shown(args)...));
}

/// Flushes the standard output.
void flush_output();

/// Writes "insonify: MESSAGE" in one line to the standard error stream. Failures to write are ignored.
void complain(std::string_view message);

/// Whether a line of the standard output can be overwritten: it is a terminal, and TERM is not "dumb".
[[nodiscard]] bool can_redraw();

/// Shows a status line, cut to the terminal's width, in place of the one before. The next output removes it. Does
/// nothing if lines cannot be overwritten.
void show_status(std::string_view line);

/// Columns of the terminal.
[[nodiscard]] std::size_t terminal_width();

/// Removes the status line. Async-signal-safe.
void clear_status();

/// Prints messages of the library to the standard output and warnings to the standard error stream.
/// @param quiet  Prints warnings only.
[[nodiscard]] Log log_to_user(bool quiet);

/// Prints rows with columns as wide as their widest cell; the last column is not padded.
using Row = std::vector<std::string>;
void print_table(const std::vector<Row>& rows);

/// "812 bytes", "2.6 MB", "34 GB", in powers of 1000.
[[nodiscard]] std::string bytes_text(std::uintmax_t bytes);

}  // namespace insonify
