// console.h -- writes to the standard streams and reports failures.

#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "insonify/printable.h"

namespace insonify {

/// Opens closed standard streams on /dev/null, so that no other file gets their descriptors and their output.
void open_standard_streams();

/// Writes to the standard output. finish_output() reports failures.
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

/// Flushes the standard output and reports a failed write. A closed pipe, as by `head`, is not reported.
/// @return  `status`, or kFailed if a write failed.
[[nodiscard]] int finish_output(int status);

}  // namespace insonify
