// sdf_scene.cpp -- reads a world and makes a scene of it; what the library finds in libinsonify_sdf.

#include "io/sdf/sdf_file.h"
#include "io/sdf/sdf_scene_builder.h"
#include "io/sdf/sdf_sonars.h"

namespace insonify {
namespace {

Scene load_sdf_scene(const std::filesystem::path& path, const WorldOptions& options, const Log& log) {
  const auto lock = lock_sdf();
  std::optional<MeshReadAhead> ahead;
  if (!options.collisions && options.ignore.empty()) {  // Else it would read files that are not used.
    ahead.emplace();
  }
  MissingParts missing;
  SdfFile parsed = read_sdf_file(path, {.strict = options.strict, .twins = true}, missing, log);
  const SdfTwins& twins = parsed.source->twins();
  if (!twins.twins.empty() && parsed.root.WorldByIndex(0)->ModelCount() != twins.left) {
    missing = {};
    parsed = read_sdf_file(path, {.strict = options.strict}, missing, log);
  }

  SdfSceneBuilder builder(*parsed.source, options, missing, log);
  for (std::uint64_t w = 0; w < parsed.root.WorldCount(); ++w) {
    builder.add_world(*parsed.root.WorldByIndex(w));
  }
  if (parsed.root.Model() != nullptr) {
    builder.add_model(*parsed.root.Model());
  }
  return builder.finish(path.string());
}

}  // namespace

extern "C" const SdfReader insonify_sdf_reader{&load_sdf_scene, &load_sdf_sonars};

}  // namespace insonify
