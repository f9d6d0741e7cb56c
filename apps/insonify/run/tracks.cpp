// tracks.cpp -- passes each ping to all that is written of its sonar, and puts that in place at the end; draws the
// scene.

#include "run/tracks.h"

#include <algorithm>

#include "console/console.h"
#include "insonify/scene_view.h"

namespace insonify {
namespace {

Picture scene_around(Simulator& simulator, const SonarConfig& sonar, const Pose& world_from_sonar) {
  Engine& engine = simulator.engine();
  const std::optional<ViewConfig>& given = simulator.scenario().view;
  const ViewConfig view = given.has_value() ? *given : fitting_view(engine, simulator.scene(), sonar, world_from_sonar);
  ViewOptions options;
  for (const PointTarget& point : simulator.scenario().points) {
    options.marks.push_back(point.position);
  }
  return draw_scene(engine, simulator.scene(), view, sonar, world_from_sonar, options);
}

}  // namespace

PictureStyle track_style(const PictureOptions& options, const Scenario& scenario, const SonarConfig& sonar) {
  const auto counts = [&](const SonarConfig& each) {
    return scenario.model == EchoModel::kCalibrated && scenario.receiver_of(each).counts;
  };
  PictureOptions own = options;
  own.counts = options.counts && (counts(sonar) || std::ranges::none_of(scenario.sonars, counts));
  return picture_style(own, scenario.model, scenario.receiver_of(sonar), sonar);
}

void SonarOutput::add(const Ping& ping) {
  for (const auto& sink : sinks) {
    sink->add(0, ping);
  }
  loudness.add(ping);
  ++made;
}

std::vector<std::filesystem::path> SonarOutput::places() const {
  std::vector<std::filesystem::path> places;
  for (std::size_t i = 0; i < files.size(); ++i) {
    places.push_back(sinks[i]->place());
  }
  return places;
}

std::vector<SonarOutput> start_tracks(const Simulator& simulator, const ScenarioRequests& requests,
                                      const RunOptions& options, const PictureChoice& choice, PictureFolder& pictures,
                                      const RecordOptions& recording) {
  const Scenario& scenario = simulator.scenario();
  std::vector<SonarOutput> tracks(scenario.sonars.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const int index = static_cast<int>(i);
    const SonarConfig& sonar = simulator.sonar(index);
    SonarOutput& track = tracks[i];
    for (const RecordingFormat* format : options.record) {
      track.files.push_back(pictures.path() / (sonar.name + format->ending()));
      track.sinks.push_back(format->open(track.files.back(), {scenario, simulator.scene(), {&sonar, 1}}, recording));
    }
    auto drawn = std::make_unique<PingPictures>(pictures, sonar, track_style(options.pictures, scenario, sonar), choice,
                                                requests.ping_count(index));
    track.pictures = drawn.get();
    track.sinks.push_back(std::move(drawn));
  }
  return tracks;
}

bool discard_without_pings(std::vector<SonarOutput>& tracks, PictureFolder& pictures) {
  if (std::ranges::any_of(tracks, [](const SonarOutput& track) { return track.made > 0; })) {
    return false;
  }
  std::vector<std::filesystem::path> files;
  for (const SonarOutput& track : tracks) {
    const std::vector<std::filesystem::path> places = track.places();
    files.insert(files.end(), places.begin(), places.end());
  }
  tracks.clear();
  for (const std::filesystem::path& file : files) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  }
  pictures.discard();
  return true;
}

std::string kept_beside(const std::vector<SonarOutput>& tracks) {
  std::string text;
  for (const SonarOutput& track : tracks) {
    const std::vector<std::filesystem::path> places = track.places();
    for (std::size_t i = 0; i < places.size() && track.made > 0; ++i) {
      if (places[i] != track.files[i]) {
        text += fmt::format("; {} is still that of the earlier run, {} of this one {} in {}", track.files[i].string(),
                            counted(track.made, "ping"), track.made == 1 ? "is" : "are", places[i].string());
      }
    }
  }
  return text;
}

bool finish_tracks(std::vector<SonarOutput>& tracks, PictureFolder& pictures, bool quiet) {
  if (discard_without_pings(tracks, pictures)) {
    throw Error("interrupted before the first ping");
  }
  bool replaced = false;
  for (SonarOutput& track : tracks) {
    replaced = replaced || track.places() != track.files;
    for (const auto& sink : track.sinks) {
      sink->close();
    }
  }
  if (const std::size_t removed = pictures.put_in_place(); removed > 0 && !quiet) {
    say("removed {} of an earlier run from {}\n", counted(removed, "picture"), pictures.path().string());
  }
  return replaced;
}

std::string listed(const std::vector<std::filesystem::path>& files) {
  if (files.size() <= 2) {
    return files.empty() ? "" : files.front().string() + (files.size() == 2 ? ", " + files.back().string() : "");
  }
  return fmt::format("{} ... {} ({})", files.front().string(), files.back().string(), counted(files.size(), "picture"));
}

void print_track(const SonarOutput& track, const SonarConfig& sonar) {
  say("{}: {} of {} x {} to {:.4g} m{}{}\n", sonar.name, counted(track.made, "ping"),
      counted(static_cast<std::uint64_t>(sonar.beam_count), "beam"),
      counted(static_cast<std::uint64_t>(sonar.bin_count), "bin"), sonar.max_range,
      track.first_ping.empty() ? "" : "; ", track.first_ping);
  for (const std::filesystem::path& file : track.files) {
    say("  {}\n", file.string());
  }
  if (!track.pictures->files().empty()) {
    say("  {}\n", listed(track.pictures->files()));
  }
}

std::vector<View> draw_views(Simulator& simulator, const ScenarioRequests& requests, const RunOptions& options,
                             const Display& display) {
  std::vector<View> views;
  if (!options.quiet && (options.view || options.channels)) {
    show_status("Drawing the scene ...");
  }
  for (int i = 0; i < static_cast<int>(simulator.scenario().sonars.size()); ++i) {
    const SonarConfig& sonar = simulator.sonar(i);
    const PingRequest request = requests.at(i, 0);
    simulator.place(i, request);
    const Pose world_from_sonar = simulator.world_from_housing(i, request);
    if (options.view) {
      views.push_back({sonar.name + "_view.png", scene_around(simulator, sonar, world_from_sonar)});
    }
    if (options.channels) {
      const Channels channels =
          look_along_fan(simulator.engine(), sonar, simulator.scenario().water_at(sonar), world_from_sonar);
      views.push_back({sonar.name + "_channels.png", draw_channels(channels, sonar, display)});
    }
  }
  return views;
}

std::vector<std::filesystem::path> write_views(const std::vector<View>& views, PictureFolder& folder) {
  std::vector<std::filesystem::path> files;
  files.reserve(views.size());
  for (const View& view : views) {
    files.push_back(folder.write(view.file, view.picture));
  }
  return files;
}

}  // namespace insonify
