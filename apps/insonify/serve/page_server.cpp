// page_server.cpp -- checks access options, and shuts down in the right order.

#include "serve/page_server.h"

#include <fmt/format.h>

#include <chrono>

#include "console/console.h"
#include "console/outcome.h"
#include "insonify/printable.h"
#include "serve/foxglove_feed.h"
#include "serve/hub.h"
#include "serve/net/own_addresses.h"
#include "serve/page_files.h"
#include "serve/viewer_client.h"

namespace insonify {
namespace {

// The query that a browser needs.
std::string url_of(const PageServerOptions& options, const std::string& host, std::uint16_t port) {
  const bool bracket = host.find(':') != std::string::npos;
  return fmt::format("http://{}{}{}:{}/{}{}", bracket ? "[" : "", host, bracket ? "]" : "", port,
                     options.token.empty() ? "" : "?token=", encoded(options.token));
}

// The first line is the address; others may follow when listening on all interfaces.
void print_addresses(const PageServerOptions& options, std::uint16_t port) {
  const bool all = options.address == "0.0.0.0" || options.address == "::";
  std::vector<std::string> hosts = all ? own_addresses(options.address == "::") : std::vector{options.address};
  hosts.resize(options.quiet ? 1 : hosts.size());
  for (const std::string& host : hosts) {
    say("{}\n", url_of(options, host, port));
  }
  flush_output();
}

void check(const PageServerOptions& options) {
  for (const std::string& origin : options.origins) {
    if (!is_origin(origin)) {
      throw InputError(
          fmt::format("--allow-origin {} must be a scheme and a host, such as https://app.example or "
                      "http://localhost:8080, without a path",
                      printable(origin)));
    }
  }
  if (options.token.empty() && !is_loopback(options.address)) {
    throw InputError(fmt::format("--address {} can be reached by others: it needs a --token, which clients must send",
                                 printable(options.address)));
  }
}

// Ends a source before its listeners, also on an exception.
class SourceEnd {
 public:
  explicit SourceEnd(PingSource& source) : source_(source) {}
  ~SourceEnd() {
    try {
      source_.end();
    } catch (const Error& error) {
      complain(error.what());
    }
  }
  SourceEnd(const SourceEnd&) = delete;
  SourceEnd& operator=(const SourceEnd&) = delete;

 private:
  PingSource& source_;
};

}  // namespace

PageServer::PageServer(const PageServerOptions& options) : options_(options) {
  check(options);
  server_ = std::make_unique<NetServer>(NetServerOptions{
      .address = options.address,
      .port = static_cast<std::uint16_t>(options.port),
      .access = {.token = options.token, .origins = options.origins},
      .protocols = {std::string(kViewerProtocol), std::string(kFoxgloveSdkProtocol), std::string(kFoxgloveProtocol)},
      .file = [this](std::string_view path) { return page_file(path, options_.page); },
      .client =
          [this](Connection& connection, const std::string& protocol) {
            return protocol == kViewerProtocol ? make_viewer_client(connection, *hub_) : feed_->client(connection);
          }});
}

PageServer::~PageServer() = default;

void PageServer::show(PingSource& source, const std::filesystem::path& recording,
                      const std::function<void()>& started) {
  Hub hub(source, *server_, recording, options_.quiet);
  FoxgloveFeed feed(hub, options_.messages);
  hub_ = &hub;
  feed_ = &feed;
  const SourceEnd end(source);

  server_->watch_signals();
  source.start(hub);
  if (started) {
    started();
  }
  server_->every(std::chrono::seconds(1), [&hub] { hub.send_state(); });
  print_addresses(options_, server_->port());
  server_->run();
  source.end();
}

}  // namespace insonify
