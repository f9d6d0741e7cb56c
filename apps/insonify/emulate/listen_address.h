// listen_address.h -- the address that an emulated instrument listens on.

#pragma once

#include <boost/asio/ip/address.hpp>

#include "console/console.h"
#include "emulate/emulate.h"

namespace insonify {

/// Warns if other machines can reach it: instruments' protocols have no password.
/// @throws InputError for an invalid address.
[[nodiscard]] boost::asio::ip::address address_of(const EmulateOptions& options);

}  // namespace insonify
