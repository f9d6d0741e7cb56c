// serve.cpp -- insonify serve: serves a live loop.

#include <chrono>
#include <future>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "insonify/recording_formats.h"
#include "insonify/words.h"
#include "serve/page_server.h"

namespace insonify {
namespace {

struct ServeOptions {
  std::filesystem::path scenario;
  PageServerOptions server;
  std::filesystem::path recording;    // Recorded from the start; empty: none.
  bool force = false;                 // Whether its files may replace existing ones.
  std::string levels;                 // MessageOptions::low_db and high_db, "-90:-40"; "": default.
  double rate = 0;                    // Limit of pings per second of each sonar; 0: no limit.
  int threads = 0;                    // 0: one per processor.
  std::vector<std::string> settings;  // "key=value", in order.
  bool strict = false;                // End if a part of the world is missing.
  bool paused = false;
};

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

// Refuses a recording whose files exist already, unless they may be replaced, and one whose scenario would replace the
// served scenario. Names the first such file and a remedy.
void refuse_recordings(const std::filesystem::path& recording, std::span<const SonarConfig> sonars, bool replace,
                       const std::filesystem::path& served) {
  const std::vector<std::filesystem::path> files = live_recording_files(recording, sonars);
  for (const std::filesystem::path& file : files) {
    if (!std::filesystem::exists(file)) {
      continue;
    }
    std::error_code error;
    if (std::filesystem::equivalent(file, served, error)) {
      throw InputError(fmt::format(
          "--record {}: the scenario that repeats the recording would replace {}, which is served; give another name",
          recording.string(), file.string()));
    }
    if (!replace) {
      const bool scenario = file == files.back();
      throw InputError(fmt::format("--record {}: {} exists already{}; --force replaces it, or give another name",
                                   recording.string(), file.string(),
                                   scenario ? ", where the scenario that repeats the recording is to be written" : ""));
    }
  }
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

}  // namespace

void add_serve(const Command& program) {
  const Command command = program.add("serve", "Make pings while you watch and steer in a browser");
  auto& options = command.keep<ServeOptions>();
  command.argument("SCENARIO", &options.scenario, "Scenario file (YAML, or Stonefish's .scn)");
  add_server_options(command, options.server);
  command.option("--record", "FILE", &options.recording,
                 fmt::format("Record from the start into this file ({})", recording_names(".", ", ")));
  command.option("--levels", "LOW:HIGH", &options.levels,
                 "Levels of the darkest and the brightest value in .mcap and for Foxglove, such as -90:-40 [dB]",
                 levels());
  command.flag("-f,--force", &options.force, "Replace earlier recordings of the same names");
  command.option("--rate", "N", &options.rate, "Limit of pings per second of each sonar; time slows down accordingly",
                 number_within(above_to(0, 1e6)));
  command.option("--threads", "N", &options.threads, "Worker threads; 0: one per processor [0]", whole_number(0, 1024));
  command.option("--set", "KEY=VALUE", &options.settings,
                 "Change a key of the scenario, such as max_range=20; may be repeated");
  command.flag("--strict", &options.strict, "End with an error if a part of the world is missing");
  command.flag("--paused", &options.paused, "Start paused");
  command.footer(
      "Prints the address of a page that shows the sonar's picture and steers the vehicle. Foxglove connects to the\n"
      "same port. Ctrl-C ends it.\n\n"
      "Examples:\n"
      "  insonify serve scenes/ferry_calibrated.yaml\n"
      "  insonify serve scenes/tank.yaml --port 9000 --rate 10 --record tank.h5\n"
      "  insonify serve scenes/tank.yaml --address 0.0.0.0");
  command.act([&options] {
    if (options.strict) {
      options.settings.emplace_back("--strict=true");
    }
    if (const auto levels = parsed_levels(options.levels)) {
      options.server.messages.low_db = levels->first;
      options.server.messages.high_db = levels->second;
    }
    return serve(options);
  });
}

}  // namespace insonify
