// console.cpp -- writes to the standard streams, keeps the first error and reports it at the end.

#include "console/console.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
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

int status_of(const std::function<int()>& program) {
  try {
    return program();
  } catch (const InputError& error) {
    complain(error.what());
    return kWrongInput;
  } catch (const std::bad_alloc&) {
    complain("out of memory");
  } catch (const std::exception& error) {
    complain(error.what());
  }
  return kFailed;
}

// Flushes the standard output and reports a failed write. A closed pipe, as by `head`, is not reported.
// @return  `status`, or kFailed if a write failed.
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

// For exceptions in threads of libraries, such as oneTBB where the system starts no more of them. Several threads may
// end so at once.
[[noreturn]] void end_with_reason() {
  static std::atomic_flag begun;
  while (begun.test_and_set()) {
    pause();
  }
  try {
    if (std::current_exception() != nullptr) {
      throw;
    }
    complain("ended by a fault of its own");
  } catch (const std::exception& error) {
    complain(fmt::format("ended by a thread: {}; fewer threads take less memory", error.what()));
  } catch (...) {
    complain("ended by a fault of its own");
  }
  _exit(kFailed);
}

}  // namespace

int run_guarded(const std::function<int()>& program) {
  open_standard_streams();
  std::set_terminate(end_with_reason);
  std::signal(SIGXFSZ, SIG_IGN);  // Exceeding a file size limit becomes an ordinary write error.
  return finish_output(status_of(program));
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

Log log_to_user(bool quiet) {
  return [quiet](Severity severity, const std::string& message) {
    if (severity == Severity::kWarning) {
      complain("warning: " + message);
    } else if (!quiet) {
      say("{}\n", message);
    }
  };
}

void print_table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t column = 0; column + 1 < row.size(); ++column) {
      widths[column] = std::max(widths[column], row[column].size());
    }
  }
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column) {
      line += fmt::format("{:<{}}  ", row[column], widths[column]);
    }
    say("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  }
}

std::string bytes_text(std::uintmax_t bytes) {
  constexpr std::array<const char*, 6> kUnits = {"bytes", "kB", "MB", "GB", "TB", "PB"};
  auto size = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; size >= 999.5 && unit + 1 < kUnits.size(); ++unit) {
    size /= 1000;
  }
  return size < 10 && unit > 0 ? fmt::format("{:.1f} {}", size, kUnits[unit])
                               : fmt::format("{:.0f} {}", size, kUnits[unit]);
}

}  // namespace insonify
