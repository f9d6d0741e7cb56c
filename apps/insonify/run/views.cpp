// views.cpp -- pictures of the scene in front of each sonar at its first ping.

#include "run/views.h"

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
