// listen_address.cpp -- reads --address.

#include "emulate/listen_address.h"

#include "console/outcome.h"

namespace insonify {

boost::asio::ip::address address_of(const EmulateOptions& options) {
  boost::system::error_code failure;
  const auto address =
      boost::asio::ip::make_address(options.address == "localhost" ? "127.0.0.1" : options.address, failure);
  if (failure) {
    throw InputError(fmt::format("--address {} must be an IP address, such as 127.0.0.1 or ::1, or localhost",
                                 printable(options.address)));
  }
  if (!address.is_loopback()) {
    complain(fmt::format("warning: whoever reaches {} can command this sonar: its protocol knows no password",
                         printable(options.address)));
  }
  return address;
}

}  // namespace insonify
