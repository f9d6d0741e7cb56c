// serve.cpp -- insonify serve: serves a live loop.

#include "serve/serve.h"

#include <chrono>
#include <future>

#include "console/console.h"
#include "console/log_to_user.h"
#include "console/outcome.h"
#include "insonify/recording_formats.h"
#include "insonify/words.h"
#include "serve/recordings.h"

namespace insonify {
namespace {

using Clock = std::chrono::steady_clock;

std::unique_ptr<LiveLoop> loop_of(const ServeOptions& options) {
  if (is_recording(options.scenario)) {
    throw InputError(fmt::format("{0}: is a recording, not a scenario; insonify replay {0} --view shows it",
                                 options.scenario.string()));
  }
  return checked_input([&] {
    return std::make_unique<LiveLoop>(
        options.scenario, options.settings,
        LiveOptions{.threads = options.threads,
                    .rate_limit = options.rate > 0 ? std::optional(options.rate) : std::nullopt,
                    .paused = options.paused,
                    .messages = options.server.messages},
        log_to_user(options.server.quiet));
  });
}

// Waits until the loop records.
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

// A live loop as the source of a server.
class Simulation : public PingSource {
 public:
  explicit Simulation(LiveLoop& loop) : loop_(loop) {}
  void start(LiveListener& listener) override { loop_.start(listener); }
  void end() override { loop_.end(); }
  [[nodiscard]] LiveState state() const override { return loop_.state(); }
  void pause(bool on) override { loop_.pause(on); }
  void step(int /*sonar*/) override { loop_.step(); }
  void set_speed(double factor) override { loop_.set_speed(factor); }
  [[nodiscard]] LiveLoop* simulation() override { return &loop_; }

 private:
  LiveLoop& loop_;
};

}  // namespace

int serve(const ServeOptions& options) {
  PageServer server(options.server);
  const std::unique_ptr<LiveLoop> loop = loop_of(options);
  Simulation simulation(*loop);
  const Clock::time_point start = Clock::now();
  server.show(simulation, options.recording.empty() ? options.scenario.filename() : options.recording,
              [&] { record_from_start(options, *loop); });
  if (!options.server.quiet) {
    say("{} in {:.1f} s\n", counted(loop->state().pings_made, "ping"),
        std::chrono::duration<double>(Clock::now() - start).count());
  }
  return kDone;
}

}  // namespace insonify
