// run.cpp -- insonify run: computes the pings of a scenario and writes recordings and pictures.

#include "run/run.h"

#include <algorithm>
#include <chrono>

#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "insonify/files.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"
#include "pictures/output_folder.h"
#include "pictures/pictures.h"
#include "run/hints.h"
#include "run/ping_schedule.h"
#include "run/progress.h"
#include "run/tracks.h"
#include "run/world_report.h"

namespace insonify {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void print_world(const Simulator& simulator, double seconds) {
  const Scene& scene = simulator.scene();
  if (!simulator.engine_choice().empty()) {
    say("{}\n", simulator.engine_choice());
  }
  say("world: {} of {}, {}, ready in {:.2f} s\n", counted(scene.instances.size(), "object"),
      counted(scene.triangle_count(), "triangle"), size_text(scene), seconds);
  flush_output();  // The first ping can take long.
}

// Reading can take long: the world may be large, or the file a pipe without a writer.
void announce_reading(const RunOptions& options) {
  std::error_code ignored;
  if (options.quiet) {
    return;
  }
  if (std::filesystem::is_fifo(options.scenario, ignored)) {
    say("reading the scenario from {}, a pipe\n", options.scenario.string());
    flush_output();
  }
  show_status(fmt::format("Loading {} ...", options.scenario.string()));
}

// Loads and checks all input; every failure here is an input error.
Simulator prepare(const RunOptions& options, const std::filesystem::path& folder, PictureStyle& style) {
  return checked_input([&] {
    const Clock::time_point start = Clock::now();
    announce_reading(options);
    Scenario scenario = load_scenario(options.scenario, options.settings, log_to_user(options.quiet));
    style = picture_style(options.pictures, scenario.model, scenario.receiver);
    for (const SonarConfig& sonar : scenario.sonars) {
      if (!track_style(options.pictures, scenario, sonar).display.of_counts && options.pictures.counts) {
        complain(fmt::format("warning: --counts: {} has none (receiver.counts); its pictures show levels", sonar.name));
      }
    }
    if (!options.force) {
      refuse_earlier_run(folder, scenario, endings_of(options.record));
    }
    Scene scene = load_scene(scenario, log_to_user(options.quiet));
    scenario = flown(std::move(scenario), scene);
    const std::uint64_t pings = ScenarioRequests(scenario).total_pings() / scenario.sonars.size();
    Simulator simulator(std::move(scenario), std::move(scene), options.threads, {}, log_to_user(options.quiet), pings);
    if (!options.quiet) {
      print_world(simulator, seconds_since(start));
    }
    return simulator;
  });
}

std::vector<std::string> names_of(const std::vector<SonarConfig>& sonars) {
  std::vector<std::string> names;
  names.reserve(sonars.size());
  for (const SonarConfig& sonar : sonars) {
    names.push_back(sonar.name);
  }
  return names;
}

RecordOptions record_options(const RunOptions& options, const PictureStyle& style) {
  RecordOptions record{
      .h5 = {.compress = options.compress, .threads = options.threads, .replace = options.force},
      .mcap = {.messages = message_options(style, options.messages),
               .log = [](Severity,
                         const std::string& message) { complain("warning: " + message + "; --levels changes that"); },
               .replace = options.force}};
  return record;
}

// Refuses options that do nothing for the recordings that were asked for.
void check_effects(const RunOptions& options) {
  const auto check = [&](const std::string& option, bool RecordingFormat::*takes) {
    std::vector<std::string_view> names;
    for (const RecordingFormat* format : options.record) {
      if (format->*takes) {
        return;
      }
      names.push_back(format->name);
    }
    throw InputError(fmt::format("{} has no effect on --record {}, only on {}", option, fmt::join(names, ","),
                                 recording_names("", ", ", takes)));
  };
  if (options.compress) {
    check("--compress", &RecordingFormat::can_compress);
  }
  if (const std::vector<std::string> given = options.messages.given(); !given.empty()) {
    check(given.front(), &RecordingFormat::has_messages);
  }
}

// Prints what is unusual about the world and the trajectories, before the first ping.
void print_oddities(Simulator& simulator, const ScenarioRequests& requests, bool quiet) {
  for (const std::string& text : oddities_of(simulator, requests)) {
    complain("warning: " + text);
  }
  for (const std::string& text : quiet ? std::vector<std::string>() : lengths_of(simulator, requests)) {
    say("note: {}\n", text);
  }
}

// Computes a batch. False if a ping of several cannot be made: which one, each of them made alone will show.
bool make_batch(Simulator& simulator, std::span<const PingOrder> orders) {
  try {
    simulator.ping(orders);
    return true;
  } catch (const Error&) {
    if (orders.size() == 1) {
      throw;
    }
    return false;
  }
}

// Computes the pings of all sonars in order of time, until all are done or a stop is requested.
// @return  Computing time without recording and drawing [s].
double make_pings(Simulator& simulator, const ScenarioRequests& requests, std::vector<SonarOutput>& tracks,
                  bool quiet) {
  Progress progress(requests.total_pings(), quiet);
  PingSchedule schedule(requests);
  double computing = 0;
  try {
    for (std::span<PingOrder> orders = schedule.next(); !orders.empty() && !stop_asked(); orders = schedule.next()) {
      const Clock::time_point start = Clock::now();
      const bool made = make_batch(simulator, orders);
      const double seconds = seconds_since(start);
      schedule.took(seconds);
      computing += seconds;
      for (const PingOrder& order : orders) {
        if (!made) {
          simulator.ping({&order, 1});
        }
        SonarOutput& track = tracks[static_cast<std::size_t>(order.sonar)];
        if (track.made == 0) {
          track.first_ping = first_ping_text(simulator.scene(), simulator.sonar(order.sonar), *order.ping);
        }
        track.add(*order.ping);
        progress.advance();
      }
    }
  } catch (const Interrupted&) {
  }
  return computing;
}

// make_pings() whose errors say where the pings made so far are.
double make_pings_or_explain(Simulator& simulator, const ScenarioRequests& requests, std::vector<SonarOutput>& tracks,
                             PictureFolder& pictures, bool quiet) {
  try {
    return make_pings(simulator, requests, tracks, quiet);
  } catch (const Error& error) {
    const std::string kept = kept_beside(tracks);
    discard_without_pings(tracks, pictures);
    throw Error(error.what() + kept);
  }
}

// Prints hints for sonars with no or only weak echoes.
void print_hints(const Simulator& simulator, const std::vector<SonarOutput>& tracks, const Display& display,
                 bool quiet) {
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const Loudness& loudness = tracks[i].loudness;
    const int sonar = static_cast<int>(i);
    if (tracks[i].made > 0 && !loudness.has_echo() && !receives_more_than_surfaces(simulator.scenario())) {
      complain("warning: " + silence_text(simulator, sonar));
    } else if (simulator.scenario().model == EchoModel::kPaper && loudness.dim() && display.scale == Scale::kLinear &&
               !tracks[i].pictures->files().empty() && !quiet) {
      say("hint: {}\n", dimness_text(loudness, simulator.sonar(sonar)));
    }
    if (const std::string text = tracks[i].pictures->darkness_text(); !text.empty()) {
      complain("warning: " + text);
    }
  }
}

}  // namespace

int run(const RunOptions& options) {
  end_when_asked();
  check_effects(options);
  const PictureChoice choice = PictureChoice::parse(options.pictures.pictures);
  PictureStyle style;
  const std::filesystem::path folder = output_folder(options.folder, options.scenario);
  Simulator simulator = prepare(options, folder, style);
  make_output_folder(folder);

  const Clock::time_point start = Clock::now();
  const ScenarioRequests requests(simulator.scenario());
  print_oddities(simulator, requests, options.quiet);
  if (const auto unfinished = unfinished_recordings(folder, simulator.scenario(), endings_of(options.record));
      !unfinished.empty()) {
    complain(fmt::format("warning: {}{} is an unfinished recording, of a run that was killed or is still running",
                         unfinished.front().string(),
                         unfinished.size() == 1 ? "" : fmt::format(" (and {} more)", unfinished.size() - 1)));
  }
  report_disk_space(simulator.scenario(), requests, folder, options, message_options(style, options.messages));
  const std::vector<View> views = draw_views(simulator, requests, options, style.display);
  note_when_asked();
  simulator.stop_when(&stop_asked());
  PictureFolder pictures(folder, names_of(simulator.scenario().sonars));
  std::vector<SonarOutput> tracks =
      start_tracks(simulator, requests, options, choice, pictures, record_options(options, style));
  const std::vector<std::filesystem::path> view_files = write_views(views, pictures);

  const double computing = make_pings_or_explain(simulator, requests, tracks, pictures, options.quiet);
  const bool replaced = finish_tracks(tracks, pictures, options.quiet);
  std::uint64_t made = 0;
  for (const SonarOutput& track : tracks) {
    made += track.made;
  }

  if (!options.quiet) {
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      print_track(tracks[i], simulator.sonar(static_cast<int>(i)));
    }
    if (!view_files.empty()) {
      say("scene: {}\n", listed(view_files));
    }
    const double all = seconds_since(start);
    say("{} in {:.2f} s: {:.1f} pings/s to compute, {:.1f} pings/s with files and pictures\n", counted(made, "ping"),
        all, static_cast<double>(made) / computing, static_cast<double>(made) / all);
  }
  print_hints(simulator, tracks, style.display, options.quiet);
  const std::uint64_t asked_for = requests.total_pings();
  if (made < asked_for) {
    throw Error(fmt::format("stopped after {} of {}; {} kept{}", made, counted(asked_for, "ping"),
                            made == 1 ? "it is" : "they are", replaced ? ", instead of the earlier run's" : ""));
  }
  return kDone;
}

}  // namespace insonify
