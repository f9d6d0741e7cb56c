// uri.h -- decodes URIs.

#pragma once

#include <string>
#include <string_view>

namespace insonify {

/// Replaces percent-encoded bytes: "my%20box.bin" gives "my box.bin". A percent sign without two hexadecimal digits
/// stays.
[[nodiscard]] std::string percent_decoded(std::string_view text);

}  // namespace insonify
