// access.h -- access control: tokens, and the Host and Origin of requests.

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

struct AccessRules {
  std::string token;                 ///< Required of every WebSocket; "": none.
  std::vector<std::string> origins;  ///< Origins of other pages allowed to connect without a token.
};

/// Headers of a request; "" if absent.
struct AccessRequest {
  std::string_view host, origin, authorization, query;
  std::vector<std::string_view> protocols;  ///< Subprotocols offered, "token.T" among them.
};

/// Whether a page or a file may be sent. Without a token the Host must be an address or localhost: a name could belong
/// to another site, whose page the browser would then treat as ours (DNS rebinding).
/// @return  "" or the reason for refusing.
[[nodiscard]] std::string refused_host(const AccessRules& rules, std::string_view host);

/// Whether a WebSocket may be opened: Host as above, the token if there is one, and without one the Origin of this
/// server or one of `origins`. Programs, unlike browsers, send no Origin.
[[nodiscard]] std::string refused_connection(const AccessRules& rules, const AccessRequest& request);

/// Compares in a time that depends only on the lengths.
[[nodiscard]] bool same_secret(std::string_view a, std::string_view b);

/// Whether an address is a loopback address: 127.0.0.0/8, ::1 or localhost.
[[nodiscard]] bool is_loopback(std::string_view address);

/// Whether a text is a valid Origin: scheme, host and an optional port (RFC 6454).
[[nodiscard]] bool is_origin(std::string_view text);

/// Percent-encodes a query value: all but letters, digits and -._~ (RFC 3986).
[[nodiscard]] std::string encoded(std::string_view text);

/// Decodes percent-encoded text.
/// @return  The text up to a '?', decoded; "" if it is malformed or holds a zero byte.
[[nodiscard]] std::string decoded_path(std::string_view target);

/// The query of a target, after its '?'; "" without one.
[[nodiscard]] std::string_view query_of(std::string_view target);

/// Items of a comma-separated list.
[[nodiscard]] std::vector<std::string_view> list_items(std::string_view text);

}  // namespace insonify
