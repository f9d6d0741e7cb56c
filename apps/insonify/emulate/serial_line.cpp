// serial_line.cpp -- opens a pseudo terminal in raw mode.

#include "emulate/serial_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <boost/asio/write.hpp>
#include <cerrno>
#include <cstring>

#include "insonify/error.h"

namespace insonify {

namespace net = boost::asio;
using boost::system::error_code;

namespace {

constexpr std::size_t kMostWaitingBytes = std::size_t{16} * 1024;  // [bytes]; a message has up to 1.2 KiB.
constexpr std::size_t kMostAtOnce = 512;                           // Bytes received in one piece.

[[noreturn]] void fail() {
  throw Error(fmt::format("cannot open a pseudo terminal: {}", std::strerror(errno)));
}

}  // namespace

SerialLine::SerialLine(net::io_context& context) : master_(context), in_(kMostAtOnce) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (master < 0) {
    fail();
  }
  master_.assign(master);
  char path[128];
  if (grantpt(master) != 0 || unlockpt(master) != 0 || ptsname_r(master, path, sizeof path) != 0) {
    fail();
  }
  path_ = path;
  slave_ = open(path, O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios settings;
  if (slave_ < 0 || tcgetattr(slave_, &settings) != 0) {
    fail();
  }
  cfmakeraw(&settings);  // No echo, no line editing, eight-bit data.
  if (tcsetattr(slave_, TCSANOW, &settings) != 0) {
    fail();
  }
}

SerialLine::~SerialLine() {
  if (slave_ >= 0) {
    close(slave_);
  }
}

void SerialLine::receive(std::function<void(std::span<const std::uint8_t>)> function) {
  master_.async_read_some(net::buffer(in_),
                          [this, function = std::move(function)](error_code failure, std::size_t size) {
                            if (!failure) {
                              function(std::span(in_).first(size));
                            }
                          });
}

bool SerialLine::send(Bytes bytes) {
  if (writing_.size() + out_.size() + bytes.size() > kMostWaitingBytes) {
    return false;
  }
  out_.insert(out_.end(), bytes.begin(), bytes.end());
  if (writing_.empty()) {
    write();
  }
  return true;
}

void SerialLine::write() {
  std::swap(writing_, out_);
  net::async_write(master_, net::buffer(writing_), [this](error_code failure, std::size_t) {
    writing_.clear();
    if (!failure && !out_.empty()) {
      write();
    }
  });
}

}  // namespace insonify
