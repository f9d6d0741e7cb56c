// access.cpp -- checks tokens, hosts and origins.

#include "serve/net/access.h"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace insonify {
namespace {

bool is_v4(std::string_view text) {
  in_addr address{};
  return inet_pton(AF_INET, std::string(text).c_str(), &address) == 1;
}

bool is_v6(std::string_view text) {
  in6_addr address{};
  return inet_pton(AF_INET6, std::string(text).c_str(), &address) == 1;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

// localhost for "localhost:8765", ::1 for "[::1]:8765".
std::string_view name_of(std::string_view host) {
  if (host.starts_with('[')) {
    const std::size_t end = host.find(']');
    return end == std::string_view::npos ? std::string_view() : host.substr(1, end - 1);
  }
  return host.substr(0, host.find(':'));
}

std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      result += text[i];
      continue;
    }
    unsigned value = 0;
    const char* digits = text.data() + i + 1;
    if (i + 2 >= text.size() || std::from_chars(digits, digits + 2, value, 16).ptr != digits + 2 || value == 0) {
      return "";
    }
    result += static_cast<char>(value);
    i += 2;
  }
  return result;
}

std::optional<std::string> token_of_query(std::string_view query) {
  while (!query.empty()) {
    const std::size_t end = std::min(query.find('&'), query.size());
    const std::string_view item = query.substr(0, end);
    if (item.starts_with("token=")) {
      return decoded(item.substr(6));
    }
    query.remove_prefix(std::min(end + 1, query.size()));
  }
  return {};
}

bool has_token(const std::string& token, const AccessRequest& request) {
  constexpr std::string_view kBearer = "bearer ", kProtocol = "token.";
  bool told = false;
  if (lower(request.authorization.substr(0, kBearer.size())) == kBearer) {
    told = same_secret(request.authorization.substr(kBearer.size()), token);
  }
  if (const std::optional<std::string> of_query = token_of_query(request.query)) {
    told = same_secret(*of_query, token) || told;
  }
  for (const std::string_view protocol : request.protocols) {
    if (protocol.starts_with(kProtocol)) {
      told = same_secret(protocol.substr(kProtocol.size()), token) || told;
    }
  }
  return told;
}

}  // namespace

bool same_secret(std::string_view a, std::string_view b) {
  volatile unsigned char difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char other = b.empty() ? '\0' : b[i % b.size()];
    difference = static_cast<unsigned char>(difference | static_cast<unsigned char>(a[i] ^ other));
  }
  return difference == 0;
}

bool is_loopback(std::string_view address) {
  return address == "localhost" || (is_v4(address) && address.starts_with("127.")) ||
         (is_v6(address) && lower(address) == "::1");
}

bool is_origin(std::string_view text) {
  const std::size_t colon = text.find("://");
  const std::string scheme = lower(text.substr(0, std::min(colon, text.size())));
  const auto is_of_scheme = [](unsigned char c) { return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.'; };
  if (colon == std::string_view::npos || colon == 0 || !std::ranges::all_of(scheme, is_of_scheme)) {
    return false;
  }
  const std::string_view host = text.substr(colon + 3);
  return !host.empty() && host.find_first_of("/?#@* ") == std::string_view::npos;
}

std::string encoded(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        byte < 128 && (std::isalnum(byte) != 0 || std::string_view("-._~").find(c) != std::string_view::npos);
    result += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return result;
}

std::string decoded_path(std::string_view target) {
  return decoded(target.substr(0, target.find('?')));
}

std::string_view query_of(std::string_view target) {
  const std::size_t mark = target.find('?');
  return mark == std::string_view::npos ? std::string_view() : target.substr(mark + 1);
}

std::vector<std::string_view> list_items(std::string_view text) {
  std::vector<std::string_view> items;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    std::string_view item = text.substr(0, end);
    while (!item.empty() && (item.front() == ' ' || item.front() == '\t')) {
      item.remove_prefix(1);
    }
    while (!item.empty() && (item.back() == ' ' || item.back() == '\t')) {
      item.remove_suffix(1);
    }
    if (!item.empty()) {
      items.push_back(item);
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return items;
}

std::string refused_host(const AccessRules& rules, std::string_view host) {
  if (host.empty()) {
    return "the request has no Host";
  }
  const std::string name = lower(name_of(host));
  const bool known = is_v4(name) || is_v6(name) || name == "localhost" || name.ends_with(".localhost");
  return known || !rules.token.empty() ? "" : "the Host must be an address or localhost, as there is no token";
}

std::string refused_connection(const AccessRules& rules, const AccessRequest& request) {
  if (std::string reason = refused_host(rules, request.host); !reason.empty()) {
    return reason;
  }
  if (!rules.token.empty()) {
    return has_token(rules.token, request) ? "" : "the token is missing or wrong";
  }
  const std::string origin = lower(request.origin), host = lower(request.host);
  const bool own = origin.empty() || origin == "http://" + host || origin == "https://" + host;
  const bool allowed = std::ranges::any_of(rules.origins, [&](const std::string& one) { return lower(one) == origin; });
  return own || allowed ? "" : "pages of another origin must be named by --allow-origin, or send a token";
}

}  // namespace insonify
