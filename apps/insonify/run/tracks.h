// tracks.h -- state of each sonar in a run: its recordings and pictures, views of the scene, and final messages.

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "insonify/picture.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"
#include "pictures/output_folder.h"
#include "pictures/pictures.h"
#include "run/hints.h"
#include "run/run.h"

namespace insonify {

/// One sonar in a run, and everything that is written of it.
struct SonarOutput {
  /// What takes the pings: a recording in each format that was asked for, DIR/NAME.h5, DIR/NAME.mcap, then pictures.
  std::vector<std::unique_ptr<PingSink>> sinks = {};
  std::vector<std::filesystem::path> files = {};  ///< Names that the recordings have in the end.
  PingPictures* pictures = nullptr;               ///< The last sink.
  std::uint64_t made = 0;                         ///< Pings so far.
  Loudness loudness = {};
  std::string first_ping = {};  ///< Text about the first ping: see first_ping_text().

  void add(const Ping& ping);

  /// Names that the recordings have now.
  [[nodiscard]] std::vector<std::filesystem::path> places() const;
};

/// Style of one sonar's pictures. With options.counts, a sonar that has no counts beside others that have some shows
/// its levels.
/// @throws InputError for contradictory options, and for counts where no sonar has any.
[[nodiscard]] PictureStyle track_style(const PictureOptions& options, const Scenario& scenario,
                                       const SonarConfig& sonar);

/// Starts the recordings and the pictures of each sonar.
[[nodiscard]] std::vector<SonarOutput> start_tracks(const Simulator& simulator, const ScenarioRequests& requests,
                                                    const RunOptions& options, const PictureChoice& choice,
                                                    PictureFolder& pictures, const RecordOptions& recording);

/// Removes recordings and pictures of this run if it made no ping: they would only block the next run.
/// @return  Whether it made no ping.
bool discard_without_pings(std::vector<SonarOutput>& tracks, PictureFolder& pictures);

/// Lists recordings that have not replaced those of an earlier run, with their paths; "" if there are none.
[[nodiscard]] std::string kept_beside(const std::vector<SonarOutput>& tracks);

/// Replaces recordings and pictures of an earlier run by the new ones.
/// @return  Whether there was an earlier recording.
bool finish_tracks(std::vector<SonarOutput>& tracks, PictureFolder& pictures, bool quiet);

void print_track(const SonarOutput& track, const SonarConfig& sonar);

/// Paths of pictures in one line: all of two, the first and the last of more.
[[nodiscard]] std::string listed(const std::vector<std::filesystem::path>& files);

struct View {
  std::string file;
  Picture picture;
};

/// Draws the requested pictures of each sonar NAME: the camera view, NAME_view.png, and NAME_channels.png. Writes
/// nothing yet.
[[nodiscard]] std::vector<View> draw_views(Simulator& simulator, const ScenarioRequests& requests,
                                           const RunOptions& options, const Display& display);

/// @return  The files, in order.
std::vector<std::filesystem::path> write_views(const std::vector<View>& views, PictureFolder& folder);

}  // namespace insonify
