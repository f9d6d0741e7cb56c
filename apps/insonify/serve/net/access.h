// access.h -- who may connect: tokens, the Host and Origin of requests.

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

struct AccessRules {
  std::string token;                 ///< That every WebSocket must tell; "" for none.
  std::vector<std::string> origins;  ///< Origins of other pages that may connect without a token.
};

/// What a request tells of itself; "" where it does not.
struct AccessRequest {
  std::string_view host, origin, authorization, query;
  std::vector<std::string_view> protocols;  ///< Subprotocols offered, "token.T" among them.
};

/// Whether a page or a file may be sent. Without a token the Host must be an address or localhost: a name could be
/// another site's, whose page the browser would take for ours (DNS rebinding).
/// @return  "" or the reason why not.
[[nodiscard]] std::string refused_host(const AccessRules& rules, std::string_view host);

/// Whether a WebSocket may be opened: Host as above, the token if there is one, and without one the Origin of this
/// server or one of `origins`. Programs, unlike browsers, send no Origin.
[[nodiscard]] std::string refused_connection(const AccessRules& rules, const AccessRequest& request);

/// Compares in a time that depends on the lengths alone.
[[nodiscard]] bool same_secret(std::string_view a, std::string_view b);

/// Whether an address is this machine's own: 127.0.0.0/8, ::1 or localhost.
[[nodiscard]] bool is_loopback(std::string_view address);

/// Whether a text can be an Origin: a scheme and a host, perhaps with a port, and nothing after them (RFC 6454).
[[nodiscard]] bool is_origin(std::string_view text);

/// A text as the value of a query: all but letters, digits and -._~ become "%41" and the like (RFC 3986).
[[nodiscard]] std::string encoded(std::string_view text);

/// Decodes "%41" and the like.
/// @return  The text up to a '?', decoded; "" where it is not well formed or holds a zero byte.
[[nodiscard]] std::string decoded_path(std::string_view target);

/// What follows the '?' of a target; "" without one.
[[nodiscard]] std::string_view query_of(std::string_view target);

/// Words of a comma-separated list.
[[nodiscard]] std::vector<std::string_view> list_items(std::string_view text);

}  // namespace insonify
