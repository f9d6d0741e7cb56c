// serve.cpp -- insonify serve: starts the live loop and the server, and ends them in order.

#include "serve/serve.h"

#include <chrono>
#include <future>

#include "console/console.h"
#include "console/outcome.h"
#include "insonify/printable.h"
#include "serve/foxglove_feed.h"
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
                     options.token.empty() ? "" : "?token=", encoded(options.token));
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
  std::promise<std::string> begun;
  loop.record(options.recording, [&begun](const std::string& error) { begun.set_value(error); });
  if (const std::string error = begun.get_future().get(); !error.empty()) {
    throw InputError(error);
  }
}

void print_end(const LiveState& state, const std::string& recording, double seconds) {
  say("{} in {:.1f} s\n", counted(state.pings_made, "ping"), seconds);
  if (!recording.empty()) {
    say("recording: {} ({})\n", recording, counted(state.recorded_pings, "ping"));
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
  Hub hub(*loop, server, options.recording.empty() ? options.scenario.filename() : options.recording);
  FoxgloveFeed feed(hub);
  hub_of_clients = &hub;
  feed_of_clients = &feed;
  const LoopEnd end(*loop);

  const Clock::time_point start = Clock::now();
  server.watch_signals();
  loop->start(hub);
  record_from_start(options, *loop);
  server.every(std::chrono::seconds(1), [&hub] { hub.tell_state(); });
  say("{}\n", url_of(options, server.port()));
  flush_output();
  server.run();
  const std::string recording = loop->state().recording;
  loop->end();
  if (!options.quiet) {
    print_end(loop->state(), recording, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return kDone;
}

}  // namespace insonify
