// views.h -- pictures of the scene in front of each sonar at its first ping.

#pragma once

#include <filesystem>
#include <vector>

#include "insonify/picture.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"
#include "pictures/output_folder.h"
#include "run/run.h"

namespace insonify {

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
