// console.cpp -- writes to the standard streams and keeps the first error.

#include "console/console.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "console/outcome.h"

namespace insonify {
namespace {

int output_error = 0;  // errno of the first write that failed.
volatile std::sig_atomic_t status_shown = 0;

void check_output(bool good) {
  if (!good && output_error == 0) {
    output_error = errno;
  }
}

}  // namespace

void open_standard_streams() {
  // open() takes the lowest free descriptor, so those of closed standard streams come first.
  int stream = 0;
  do {
    stream = open("/dev/null", O_RDWR);
  } while (stream >= 0 && stream <= STDERR_FILENO);
  if (stream >= 0) {
    close(stream);
  }
}

void say_text(std::string_view text) {
  clear_status();
  check_output(std::fwrite(text.data(), 1, text.size(), stdout) == text.size());
}

void flush_output() {
  check_output(std::fflush(stdout) == 0);
}

void complain(std::string_view message) {
  clear_status();
  std::fflush(stdout);
  const std::string line = fmt::format("insonify: {}\n", printable(message, kLongestMessage));
  std::fwrite(line.data(), 1, line.size(), stderr);
}

bool can_redraw() {
  static const bool kCan = [] {
    const char* kind = std::getenv("TERM");
    return isatty(STDOUT_FILENO) != 0 && kind != nullptr && std::string_view(kind) != "dumb";
  }();
  return kCan;
}

std::size_t terminal_width() {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUsual;
}

void show_status(std::string_view line) {
  if (!can_redraw()) {
    return;
  }
  // After a character in the last column some terminals start a new line.
  const std::string text = fmt::format("\r{}\x1b[K", printable(line, kLongestMessage).substr(0, terminal_width() - 1));
  std::fwrite(text.data(), 1, text.size(), stdout);
  flush_output();
  status_shown = 1;
}

void clear_status() {
  constexpr std::string_view kClear = "\r\x1b[K";
  if (status_shown != 0) {
    status_shown = 0;
    // write(), not fwrite(), to be async-signal-safe. The buffer is empty while a status is shown.
    check_output(write(STDOUT_FILENO, kClear.data(), kClear.size()) >= 0);
  }
}

int finish_output(int status) {
  clear_status();
  flush_output();
  if (output_error == 0) {
    return status;
  }
  if (output_error != EPIPE) {
    complain("standard output: cannot write: " + std::generic_category().message(output_error));
  }
  return status == kDone ? kFailed : status;
}

}  // namespace insonify
