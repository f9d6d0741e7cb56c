// sdf_scene.cpp -- reads a world and makes a scene of it; what the library finds in libinsonify_sdf.

#include <algorithm>

#include "io/sdf/sdf_file.h"
#include "io/sdf/sdf_scene_builder.h"
#include "io/sdf/sdf_sonars.h"

namespace insonify {
namespace {

Scene load_sdf_scene(const std::filesystem::path& path, const WorldOptions& options, const Log& log) {
  const auto lock = lock_sdf();
  std::optional<MeshReadAhead> ahead;
  // Else it would read files that are not used, or whole ones in place of their parts.
  if (!options.collisions && options.ignore.empty() && !options.parts) {
    ahead.emplace();
  }
  MissingParts missing;
  const SdfModels read = read_sdf_models(path, {.strict = options.strict}, missing, log);
  SdfSceneBuilder builder(options, missing, log);
  for (const SdfWorld& world : read.worlds) {
    std::ranges::for_each(world.models, [&](const SdfModel& model) { builder.expect_shapes(model); });
  }
  if (read.model) {
    builder.expect_shapes(*read.model);
  }
  for (const SdfWorld& world : read.worlds) {
    builder.add_world(world);
  }
  if (read.model) {
    builder.add_model(*read.model);
  }
  return builder.finish(path.string());
}

}  // namespace

extern "C" const SdfReader insonify_sdf_reader{&load_sdf_scene, &load_sdf_sonars};

}  // namespace insonify
