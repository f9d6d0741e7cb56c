// serve.cpp -- insonify serve: starts the live loop and the server, and ends them in order.

#include "serve/serve.h"

#include <chrono>
#include <future>

#include "console/console.h"
#include "console/outcome.h"
#include "insonify/printable.h"
#include "serve/foxglove_feed.h"
#include "serve/hub.h"
#include "serve/own_addresses.h"
#include "serve/page_files.h"
#include "serve/recordings.h"
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
std::string url_of(const ServeOptions& options, const std::string& host, std::uint16_t port) {
  const bool bracket = host.find(':') != std::string::npos;
  return fmt::format("http://{}{}{}:{}/{}{}", bracket ? "[" : "", host, bracket ? "]" : "", port,
                     options.token.empty() ? "" : "?token=", encoded(options.token));
}

// The first line is the address; where all interfaces are listened on, others may follow.
void print_addresses(const ServeOptions& options, std::uint16_t port) {
  const bool all = options.address == "0.0.0.0" || options.address == "::";
  std::vector<std::string> hosts = all ? own_addresses(options.address == "::") : std::vector{options.address};
  hosts.resize(options.quiet ? 1 : hosts.size());
  for (const std::string& host : hosts) {
    say("{}\n", url_of(options, host, port));
  }
  flush_output();
}

void check(const ServeOptions& options) {
  for (const std::string& origin : options.origins) {
    if (!is_origin(origin)) {
      throw InputError(
          fmt::format("--allow-origin {} must be a scheme and a host, such as https://app.example or "
                      "http://localhost:8080, without a path",
                      printable(origin)));
    }
  }
  if (options.token.empty() && !is_loopback(options.address)) {
    throw InputError(fmt::format("--address {} can be reached by others: it needs a --token, which they must tell",
                                 printable(options.address)));
  }
}

std::unique_ptr<LiveLoop> loop_of(const ServeOptions& options) {
  try {
    return std::make_unique<LiveLoop>(
        options.scenario, options.settings,
        LiveOptions{.threads = options.threads,
                    .rate_limit = options.rate > 0 ? std::optional(options.rate) : std::nullopt,
                    .paused = options.paused},
        log_to_user(options.quiet));
  } catch (const Error& error) {
    throw InputError(error.what());
  }
}

// Waits for the loop to begin to record.
void record_from_start(const ServeOptions& options, LiveLoop& loop) {
  if (options.recording.empty()) {
    return;
  }
  refuse_recordings(options.recording, loop.world()->sonars, options.force, options.scenario);
  std::promise<std::string> begun;
  loop.record(
      options.recording, [&begun](const std::string& error) { begun.set_value(error); }, options.force);
  if (const std::string error = begun.get_future().get(); !error.empty()) {
    throw InputError(error);
  }
}

// Ends a loop before what listens to it, whatever happens.
class LoopEnd {
 public:
  explicit LoopEnd(LiveLoop& loop) : loop_(loop) {}
  ~LoopEnd() {
    try {
      loop_.end();
    } catch (const Error& error) {
      complain(error.what());
    }
  }
  LoopEnd(const LoopEnd&) = delete;
  LoopEnd& operator=(const LoopEnd&) = delete;

 private:
  LiveLoop& loop_;
};

}  // namespace

int serve(const ServeOptions& options) {
  check(options);
  Hub* hub_of_clients = nullptr;
  FoxgloveFeed* feed_of_clients = nullptr;
  NetServer server(
      {.address = options.address,
       .port = static_cast<std::uint16_t>(options.port),
       .access = {.token = options.token, .origins = options.origins},
       .protocols = {std::string(kViewerProtocol), std::string(kFoxgloveSdkProtocol), std::string(kFoxgloveProtocol)},
       .file = [&options](std::string_view path) { return page_file(path, options.page); },
       .client =
           [&](Connection& connection, const std::string& protocol) {
             return protocol == kViewerProtocol ? make_viewer_client(connection, *hub_of_clients)
                                                : feed_of_clients->client(connection);
           }});
  const std::unique_ptr<LiveLoop> loop = loop_of(options);
  Hub hub(*loop, server, options.recording.empty() ? options.scenario.filename() : options.recording, options.quiet);
  FoxgloveFeed feed(hub);
  hub_of_clients = &hub;
  feed_of_clients = &feed;
  const LoopEnd end(*loop);

  const Clock::time_point start = Clock::now();
  server.watch_signals();
  loop->start(hub);
  record_from_start(options, *loop);
  server.every(std::chrono::seconds(1), [&hub] { hub.tell_state(); });
  print_addresses(options, server.port());
  server.run();
  loop->end();
  if (!options.quiet) {
    say("{} in {:.1f} s\n", counted(loop->state().pings_made, "ping"),
        std::chrono::duration<double>(Clock::now() - start).count());
  }
  return kDone;
}

}  // namespace insonify
