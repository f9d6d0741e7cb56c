// console.h -- what is said on the standard streams, and whether it arrived.

#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "insonify/printable.h"

namespace insonify {

/// Opens what of the standard streams is closed, on nothing, so that no file of ours takes its number and its text.
void open_standard_streams();

/// Says something on the standard output. Whether it arrived is told by finish_output().
void say_text(std::string_view text);

/// An argument of say() as it is printed: strings, which may come from files, are made printable.
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

/// Sends what was said on its way.
void flush_output();

/// Says "insonify: MESSAGE" in one line on the standard error output. Where that is gone nobody can be told.
void complain(std::string_view message);

/// Whether a line of the standard output can be drawn anew: it is a terminal, and not a dumb one.
[[nodiscard]] bool can_redraw();

/// On such a terminal shows a line, cut to its width, in the place of the one shown before; what is said next takes it
/// away. Elsewhere does nothing.
void show_status(std::string_view line);

/// Columns of the terminal.
[[nodiscard]] std::size_t terminal_width();

/// Takes the status away. Async-signal-safe.
void clear_status();

/// Has everything that was said arrive. A reader that has gone, as `head` does, is no fault.
/// @return  `status`, or kFailed after a complaint where it could not arrive.
[[nodiscard]] int finish_output(int status);

}  // namespace insonify
