// http_answers.h -- what plain HTTP requests are answered with.

#pragma once

#include <boost/beast/http.hpp>
#include <string>
#include <string_view>

#include "serve/net/net_server.h"

namespace insonify {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;
using HttpResponse = boost::beast::http::response<boost::beast::http::string_body>;

/// Path of a GET request that is answered as a WebSocket's opening would be: a browser does not tell a page why it
/// failed.
inline constexpr std::string_view kAccessPath = "/access";

[[nodiscard]] std::string_view view_of(boost::beast::string_view text);

/// The members of a request that decide whether it may open a WebSocket. They are parts of `request`.
[[nodiscard]] AccessRequest access_of(const HttpRequest& request);

/// An answer with the headers that all have.
[[nodiscard]] HttpResponse response_to(const HttpRequest& request, boost::beast::http::status status, std::string body,
                                       std::string_view type = "text/plain; charset=utf-8");

/// An answer to what is no request; the connection ends after it.
[[nodiscard]] HttpResponse response_to_none(boost::beast::http::status status, std::string body);

/// "401 the token is missing or wrong" or the like.
[[nodiscard]] HttpResponse refusal(const HttpRequest& request, const AccessRules& rules, const std::string& reason);

/// A file, or why there is none.
[[nodiscard]] HttpResponse answer(const HttpRequest& request, const NetServerOptions& options);

}  // namespace insonify
