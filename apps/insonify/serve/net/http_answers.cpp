// http_answers.cpp -- responds with files of the page, or with errors.

#include "serve/net/http_answers.h"

namespace insonify {

namespace beast = boost::beast;
namespace http = beast::http;

std::string_view view_of(beast::string_view text) {
  return {text.data(), text.size()};
}

AccessRequest access_of(const HttpRequest& request) {
  return {.host = view_of(request[http::field::host]),
          .origin = view_of(request[http::field::origin]),
          .authorization = view_of(request[http::field::authorization]),
          .query = query_of(view_of(request.target())),
          .protocols = list_items(view_of(request[http::field::sec_websocket_protocol]))};
}

HttpResponse response_to(const HttpRequest& request, http::status status, std::string body, std::string_view type) {
  HttpResponse response(status, request.version());
  response.set(http::field::server, "insonify");
  response.set(http::field::content_type, beast::string_view(type.data(), type.size()));
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("X-Frame-Options", "DENY");
  response.set("Content-Security-Policy",
               "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
               "font-src 'self'; connect-src 'self' ws: wss:; base-uri 'none'; form-action 'none'; frame-ancestors "
               "'none'");
  response.keep_alive(request.keep_alive());
  response.body() = std::move(body);
  const std::size_t size = response.body().size();
  if (request.method() == http::verb::head) {
    response.body().clear();
  }
  response.content_length(size);
  return response;
}

HttpResponse response_to_none(http::status status, std::string body) {
  HttpRequest none;
  none.version(11);
  none.keep_alive(false);
  return response_to(none, status, std::move(body));
}

HttpResponse refusal(const HttpRequest& request, const AccessRules& rules, const std::string& reason) {
  return response_to(request, rules.token.empty() ? http::status::forbidden : http::status::unauthorized,
                     reason + "\n");
}

HttpResponse answer(const HttpRequest& request, const NetServerOptions& options) {
  if (const std::string reason = refused_host(options.access, view_of(request[http::field::host])); !reason.empty()) {
    return response_to(request, http::status::forbidden, reason + "\n");
  }
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    HttpResponse response = response_to(request, http::status::method_not_allowed, "only GET and HEAD are served\n");
    response.set(http::field::allow, "GET, HEAD");
    return response;
  }
  const std::string path = decoded_path(view_of(request.target()));
  if (path == kAccessPath) {
    const std::string reason = refused_connection(options.access, access_of(request));
    return reason.empty() ? response_to(request, http::status::ok, "a WebSocket may be opened\n")
                          : refusal(request, options.access, reason);
  }
  if (std::optional<ServedFile> file = options.file(path)) {
    return response_to(request, http::status::ok, std::move(file->bytes), file->type);
  }
  return response_to(request, http::status::not_found, "there is no such file\n");
}

}  // namespace insonify
