// listen_address.h -- the address that an emulated instrument listens on.

#pragma once

#include <boost/asio/ip/address.hpp>

#include "console/console.h"
#include "emulate/emulate.h"

namespace insonify {

/// Warns where others than this machine can reach it: instruments' protocols know no password.
/// @throws InputError for what is no address.
[[nodiscard]] boost::asio::ip::address address_of(const EmulateOptions& options);

}  // namespace insonify
