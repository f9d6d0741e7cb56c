// run.cpp -- insonify run: pings of a scenario into recordings and pictures.

#include <chrono>

#include "commands.h"
#include "console.h"
#include "hints.h"
#include "insonify/files.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"
#include "output_folder.h"
#include "pictures.h"
#include "progress.h"
#include "stop.h"
#include "views.h"
#include "world_report.h"

namespace insonify {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Log log_to_user(bool quiet) {
  return [quiet](Severity severity, const std::string& message) {
    if (severity == Severity::kWarning) {
      complain("warning: " + message);
    } else if (!quiet) {
      say("{}\n", message);
    }
  };
}

Display display_of(const RunOptions& options) {
  Display display;
  display.colour_map = colour_map_from_name(options.colour_map);
  display.scale = options.scale == "db" ? Scale::kDecibel : Scale::kLinear;
  display.floor_db = options.floor_db;
  display.height = options.height;
  display.validate();
  return display;
}

std::string counted(std::uint64_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void print_world(const Scene& scene, double seconds) {
  std::size_t triangles = 0;
  for (const Instance& instance : scene.instances) {
    triangles += instance.mesh->triangles.size();
  }
  say("world: {} of {}, {}, ready in {:.2f} s\n", counted(scene.instances.size(), "object"),
      counted(triangles, "triangle"), size_text(scene), seconds);
  flush_output();  // The first ping can take long.
}

// Reading can take long: a world is large, or nobody writes into a pipe.
void tell_of_reading(const RunOptions& options) {
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

// All that can only be wrong because the input is.
Simulator prepare(const RunOptions& options, Display& display) {
  try {
    const Clock::time_point start = Clock::now();
    display = display_of(options);
    tell_of_reading(options);
    Scenario scenario = load_scenario(options.scenario, options.settings, log_to_user(options.quiet));
    Scene scene = load_scene(scenario, log_to_user(options.quiet));
    Simulator simulator(std::move(scenario), std::move(scene), options.threads);
    if (options.scale.empty() && simulator.scenario().model == EchoModel::kCalibrated) {
      display.scale = Scale::kDecibel;
    }
    if (!options.quiet) {
      print_world(simulator.scene(), seconds_since(start));
    }
    return simulator;
  } catch (const Error& error) {
    throw InputError(error.what());
  }
}

// One sonar's part of a run.
struct Track {
  std::filesystem::path file;
  Recording recording;
  PingPictures pictures;
  Ping ping = {};
  std::uint64_t made = 0;
  Loudness loudness = {};
  std::string heard = {};  // Of the first ping: see heard_text().
};

// Levels are raised by range unless the receiver has done that.
Display display_of(const Scenario& scenario, Display display) {
  const bool raised = scenario.receiver.time_varied_gain || !scenario.receiver.gain_ranges.empty();
  display.of_source = scenario.model == EchoModel::kCalibrated;
  display.raised_per_decade = display.of_source && !raised ? kShownGainPerDecade : 0;
  return display;
}

std::vector<Track> start_tracks(const Simulator& simulator, const ScenarioRequests& requests,
                                const std::filesystem::path& folder, const Display& display,
                                const PictureChoice& choice) {
  const Scenario& scenario = simulator.scenario();
  std::vector<Track> tracks;
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    const SonarConfig& sonar = simulator.sonar(static_cast<int>(i));
    const std::uint64_t pings = requests.ping_count(static_cast<int>(i));
    const std::filesystem::path file = folder / (sonar.name + ".h5");
    tracks.push_back({file, Recording(file, scenario, simulator.scene(), sonar, pings),
                      PingPictures(folder, sonar, scenario.model, display_of(scenario, display), choice, pings)});
  }
  return tracks;
}

// What a look at the world and the trajectories tells before the first ping.
void print_oddities(const Simulator& simulator, const ScenarioRequests& requests, bool quiet) {
  for (const std::string& text : oddities_of(simulator, requests)) {
    complain("warning: " + text);
  }
  for (const std::string& text : quiet ? std::vector<std::string>() : lengths_of(simulator, requests)) {
    say("note: {}\n", text);
  }
}

// Done once the new recordings are there.
void clear_old_pictures(const std::filesystem::path& folder, const std::vector<Track>& tracks, bool quiet) {
  std::size_t count = 0;
  for (const Track& track : tracks) {
    count += remove_old_pictures(folder, track.file.stem().string());
  }
  if (count > 0 && !quiet) {
    say("removed {} of an earlier run from {}\n", counted(count, "picture"), folder.string());
  }
}

// Makes the pings, in turn for each sonar, until all are there or a stop is asked for.
// @return  Seconds that computing them took, without recording and drawing.
double make_pings(Simulator& simulator, const ScenarioRequests& requests, std::vector<Track>& tracks, bool quiet) {
  Progress progress(requests.total_pings(), quiet);
  PingRequest request;
  double computing = 0;
  for (std::uint64_t number = 0; number < requests.most_pings() && !stop_asked(); ++number) {
    for (std::size_t i = 0; i < tracks.size() && !stop_asked(); ++i) {
      if (number >= requests.ping_count(static_cast<int>(i))) {
        continue;
      }
      Track& track = tracks[i];
      const Clock::time_point start = Clock::now();
      requests.fill(static_cast<int>(i), number, request);
      simulator.ping(static_cast<int>(i), request, track.ping);
      computing += seconds_since(start);
      track.recording.add(track.ping);
      track.pictures.add(track.ping);
      track.loudness.add(track.ping);
      if (number == 0) {
        track.heard = heard_text(simulator.scene(), simulator.sonar(static_cast<int>(i)), track.ping);
      }
      ++track.made;
      progress.advance();
    }
  }
  return computing;
}

std::string listed(const std::vector<std::filesystem::path>& files) {
  if (files.size() <= 2) {
    return files.empty() ? "" : files.front().string() + (files.size() == 2 ? ", " + files.back().string() : "");
  }
  return fmt::format("{} ... {} ({} pictures)", files.front().string(), files.back().string(), files.size());
}

void print_track(const Track& track, const SonarConfig& sonar) {
  say("{}: {} of {} x {} to {:.4g} m{}{}\n  {}\n", sonar.name, counted(track.made, "ping"),
      counted(static_cast<std::uint64_t>(sonar.beam_count), "beam"),
      counted(static_cast<std::uint64_t>(sonar.bin_count), "bin"), sonar.max_range, track.heard.empty() ? "" : "; ",
      track.heard, track.file.string());
  if (!track.pictures.files().empty()) {
    say("  {}\n", listed(track.pictures.files()));
  }
}

// What the user can do about a sonar that heard little.
void print_hints(const Simulator& simulator, const std::vector<Track>& tracks, const Display& display, bool quiet) {
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const Loudness& loudness = tracks[i].loudness;
    const int sonar = static_cast<int>(i);
    if (tracks[i].made > 0 && !loudness.heard() && !hears_more_than_surfaces(simulator.scenario())) {
      complain("warning: " + silence_text(simulator, sonar));
    } else if (simulator.scenario().model == EchoModel::kPaper && loudness.dim() && display.scale == Scale::kLinear &&
               !tracks[i].pictures.files().empty() && !quiet) {
      say("hint: {}\n", dimness_text(loudness, simulator.sonar(sonar)));
    }
  }
}

}  // namespace

int run(const RunOptions& options) {
  end_when_asked();
  const PictureChoice choice = PictureChoice::parse(options.pictures);
  Display display;
  const std::filesystem::path folder = output_folder(options.folder, options.scenario);
  Simulator simulator = prepare(options, display);
  make_output_folder(folder);

  const Clock::time_point start = Clock::now();
  const ScenarioRequests requests(simulator.scenario());
  print_oddities(simulator, requests, options.quiet);
  const std::vector<View> views = draw_views(simulator, requests, options, display, folder);
  note_when_asked();
  std::vector<Track> tracks = start_tracks(simulator, requests, folder, display, choice);
  clear_old_pictures(folder, tracks, options.quiet);
  const std::vector<std::filesystem::path> view_files = write_views(views);

  const double computing = make_pings(simulator, requests, tracks, options.quiet);
  std::uint64_t made = 0;
  for (Track& track : tracks) {
    track.recording.close();
    if (track.made > 0) {
      track.pictures.finish(track.ping);
    }
    made += track.made;
  }
  if (made == 0) {
    throw Error("interrupted before the first ping");
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
  print_hints(simulator, tracks, display, options.quiet);
  const std::uint64_t asked_for = requests.total_pings();
  if (made < asked_for) {
    throw Error(fmt::format("stopped after {} of {}; they are kept", made, counted(asked_for, "ping")));
  }
  return kDone;
}

}  // namespace insonify
