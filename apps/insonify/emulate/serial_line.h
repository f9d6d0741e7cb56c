// serial_line.h -- a pseudo terminal that other programs open as a serial port.

#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace insonify {

class SerialLine {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// @throws Error if the system has no pseudo terminal.
  explicit SerialLine(boost::asio::io_context& context);
  ~SerialLine();
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }  ///< "/dev/pts/4"

  /// Calls the function once, when bytes have arrived.
  void receive(std::function<void(std::span<const std::uint8_t>)> function);

  /// Sends bytes without blocking.
  /// @return  False if the queue is full because nobody reads.
  bool send(Bytes bytes);

 private:
  void write();

  boost::asio::posix::stream_descriptor master_;
  int slave_ = -1;  // Kept open, so that the line survives a program that closes it.
  std::string path_;
  Bytes in_, out_, writing_;
};

}  // namespace insonify
