#include "run/tracks.h"

#include <algorithm>

#include "console/console.h"

namespace insonify {

PictureStyle track_style(const PictureOptions& options, const Scenario& scenario, const SonarConfig& sonar) {
  const auto counts = [&](const SonarConfig& each) {
    return scenario.model == EchoModel::kCalibrated && scenario.receiver_of(each).counts;
  };
  PictureOptions own = options;
  own.counts = options.counts && (counts(sonar) || std::ranges::none_of(scenario.sonars, counts));
  return picture_style(own, scenario.model, scenario.receiver_of(sonar), sonar);
}

std::vector<Track> start_tracks(const Simulator& simulator, const ScenarioRequests& requests,
                                const std::filesystem::path& folder, const PictureOptions& options,
                                const PictureChoice& choice, PictureFolder& pictures, const RecordKinds& kinds,
                                const RecordOptions& recording) {
  const Scenario& scenario = simulator.scenario();
  std::vector<Track> tracks;
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    const SonarConfig& sonar = simulator.sonar(static_cast<int>(i));
    const std::uint64_t pings = requests.ping_count(static_cast<int>(i));
    const PictureStyle style = track_style(options, scenario, sonar);
    tracks.push_back({SonarRecordings(folder, simulator, static_cast<int>(i), kinds, recording),
                      PingPictures(pictures, sonar, style, choice, pings)});
  }
  return tracks;
}

bool discard_without_pings(std::vector<Track>& tracks, PictureFolder& pictures) {
  if (std::ranges::any_of(tracks, [](const Track& track) { return track.made > 0; })) {
    return false;
  }
  std::vector<std::filesystem::path> files;
  files.reserve(tracks.size());
  for (const Track& track : tracks) {
    const std::vector<std::filesystem::path> places = track.recordings.places();
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

std::string kept_beside(const std::vector<Track>& tracks) {
  std::string text;
  for (const Track& track : tracks) {
    const std::vector<std::filesystem::path> places = track.recordings.places();
    for (std::size_t i = 0; i < places.size() && track.made > 0; ++i) {
      const std::filesystem::path& file = track.recordings.files()[i];
      if (places[i] != file) {
        text += fmt::format("; {} is still that of the earlier run, {} of this one {} in {}", file.string(),
                            counted(track.made, "ping"), track.made == 1 ? "is" : "are", places[i].string());
      }
    }
  }
  return text;
}

bool finish_tracks(std::vector<Track>& tracks, PictureFolder& pictures, bool quiet) {
  if (discard_without_pings(tracks, pictures)) {
    throw Error("interrupted before the first ping");
  }
  bool replaced = false;
  for (Track& track : tracks) {
    replaced = replaced || track.recordings.places() != track.recordings.files();
    track.recordings.close();
    if (track.made > 0) {
      track.pictures.finish(track.ping);
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

void print_track(const Track& track, const SonarConfig& sonar) {
  say("{}: {} of {} x {} to {:.4g} m{}{}\n", sonar.name, counted(track.made, "ping"),
      counted(static_cast<std::uint64_t>(sonar.beam_count), "beam"),
      counted(static_cast<std::uint64_t>(sonar.bin_count), "bin"), sonar.max_range,
      track.first_ping.empty() ? "" : "; ", track.first_ping);
  for (const std::filesystem::path& file : track.recordings.files()) {
    say("  {}\n", file.string());
  }
  if (!track.pictures.files().empty()) {
    say("  {}\n", listed(track.pictures.files()));
  }
}

}  // namespace insonify
