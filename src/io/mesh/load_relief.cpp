// load_relief.cpp -- reads the pictures of normals, heights and reflectivity that a scenario names.

#include <fmt/format.h>

#include "insonify/error.h"
#include "io/file/input_file.h"
#include "io/mesh/relief_file.h"
#include "io/picture/picture_tile.h"

namespace insonify {

std::shared_ptr<const Relief> load_relief(const ReliefConfig& config, const std::filesystem::path& folder) {
  if (config.empty()) {
    return nullptr;
  }
  Relief relief;
  if (config.has_shape()) {
    relief = make_relief(config);
  } else {
    relief.by_position = config.tile_size > 0;
    relief.tile_size = relief.by_position ? config.tile_size : 1;
  }
  if (!config.normal_map.empty()) {
    relief.slopes = read_normals(PngReader(folder / config.normal_map));
    for (Eigen::Vector2f& slope : relief.slopes.texels) {
      slope *= static_cast<float>(config.normal_strength);
    }
  } else if (!config.height_map.empty()) {
    relief.slopes = read_heights(PngReader(folder / config.height_map), config.height);
    relief.rise_per_tile = true;
  }
  if (!config.reflectivity_map.empty()) {
    relief.reflectivity = read_levels(PngReader(folder / config.reflectivity_map), "a reflectivity map needs");
  }
  return std::make_shared<const Relief>(std::move(relief));
}

}  // namespace insonify
