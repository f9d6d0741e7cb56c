// http_answers.h -- responses to plain HTTP requests.

#pragma once

#include <boost/beast/http.hpp>
#include <string>
#include <string_view>

#include "serve/net/net_server.h"

namespace insonify {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;
using HttpResponse = boost::beast::http::response<boost::beast::http::string_body>;

/// Path of a GET request whose response says whether a WebSocket would be accepted: browsers hide from pages why
/// opening one failed.
inline constexpr std::string_view kAccessPath = "/access";

[[nodiscard]] std::string_view view_of(boost::beast::string_view text);

/// The headers that decide whether a request may open a WebSocket. They refer to `request`.
[[nodiscard]] AccessRequest access_of(const HttpRequest& request);

/// A response with the common headers.
[[nodiscard]] HttpResponse response_to(const HttpRequest& request, boost::beast::http::status status, std::string body,
                                       std::string_view type = "text/plain; charset=utf-8");

/// A response to something that is not a request; the connection ends after it.
[[nodiscard]] HttpResponse response_to_none(boost::beast::http::status status, std::string body);

/// An error such as "401 the token is missing or wrong".
[[nodiscard]] HttpResponse refusal(const HttpRequest& request, const AccessRules& rules, const std::string& reason);

/// A file, or an error.
[[nodiscard]] HttpResponse answer(const HttpRequest& request, const NetServerOptions& options);

}  // namespace insonify
