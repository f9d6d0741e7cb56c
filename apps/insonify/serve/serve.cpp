// serve.cpp -- insonify serve: starts the live loop and the server, and ends them in order.

#include "serve/serve.h"

#include <chrono>

#include "console/console.h"
#include "console/outcome.h"
#include "serve/hub.h"
#include "serve/page_files.h"
#include "serve/viewer_client.h"

namespace insonify {
namespace {

using Clock = std::chrono::steady_clock;

Log log_to_user(bool quiet) {
  return [quiet](Severity severity, const std::string& message) {
    if (severity == Severity::kWarning) {
      complain("warning: " + message);
    } else if (!quiet) {
      say("{}\n", message);
    }
  };
}

// What a browser must be told.
std::string url_of(const ServeOptions& options, std::uint16_t port) {
  const bool any = options.address == "0.0.0.0" || options.address == "::";
  const std::string host = any ? "localhost" : options.address;
  const bool bracket = host.find(':') != std::string::npos;
  return fmt::format("http://{}{}{}:{}/{}{}", bracket ? "[" : "", host, bracket ? "]" : "", port,
                     options.token.empty() ? "" : "?token=", options.token);
}

void check(const ServeOptions& options) {
  if (options.token.empty() && !is_loopback(options.address)) {
    throw InputError(fmt::format("--address {} can be reached by others: it needs a --token, which they must tell",
                                 printable(options.address)));
  }
}

}  // namespace

int serve(const ServeOptions& options) {
  check(options);
  NetServer* server_pointer = nullptr;
  std::unique_ptr<LiveLoop> loop;
  try {
    loop = std::make_unique<LiveLoop>(
        options.scenario, options.settings,
        LiveOptions{.threads = options.threads,
                    .rate_limit = options.rate > 0 ? std::optional(options.rate) : std::nullopt,
                    .paused = options.paused},
        log_to_user(options.quiet));
  } catch (const Error& error) {
    throw InputError(error.what());
  }
  const std::filesystem::path base = options.recording.empty() ? options.scenario.filename() : options.recording;
  Hub hub(*loop, server_pointer, base);
  NetServer server(
      {.address = options.address,
       .port = static_cast<std::uint16_t>(options.port),
       .access = {.token = options.token, .origins = options.origins},
       .protocols = {std::string(kViewerProtocol)},
       .file = [&options](std::string_view path) { return page_file(path, options.page); },
       .client = [&hub](Connection& connection, const std::string&) { return make_viewer_client(connection, hub); }});
  server_pointer = &server;
  server.every(std::chrono::seconds(1), [&hub] { hub.tell_state(); });
  const Clock::time_point start = Clock::now();
  loop->start(hub);
  say("{}\n", url_of(options, server.port()));
  flush_output();
  server.run();
  loop->end();
  if (!options.quiet) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    say("{} pings in {:.1f} s\n", loop->state().pings_made, seconds);
  }
  return kDone;
}

}  // namespace insonify
