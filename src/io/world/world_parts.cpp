// world_parts.cpp -- makes instances from parts, and reports skipped ones.

#include "insonify/world_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/missing_parts.h"
#include "io/file/name_patterns.h"
#include "io/file/scene_folders.h"
#include "io/world/shape_maker.h"
#include "io/world/water_shapes.h"

namespace insonify {

struct WorldParts::State {
  State(std::filesystem::path the_base, WorldOptions the_options, Log the_log)
      : base(std::move(the_base)),
        options(std::move(the_options)),
        log(std::move(the_log)),
        ignored(options.ignore),
        maker(log) {}

  std::filesystem::path base;
  WorldOptions options;
  Log log;
  NamePatterns ignored;
  ShapeMaker maker;

  // Whether a part, or its model or link, is to be skipped: also "ship" of "ship::hull::plate".
  [[nodiscard]] bool is_ignored(const std::string& name) {
    for (std::size_t end = name.find("::"); end != std::string::npos; end = name.find("::", end + 2)) {
      if (ignored.match(name.substr(0, end))) {
        return true;
      }
    }
    return ignored.match(name);
  }
  void add(const WorldPart& part, MissingParts& missing, Scene& scene);
};

void WorldParts::State::add(const WorldPart& part, MissingParts& missing, Scene& scene) {
  const std::string what = fmt::format("visual '{}'", printable(part.name, kLongestName));
  try {
    const PlacedMesh made = maker.make(part.shape, base, what);
    Instance instance{.name = part.name,
                      .mesh = made.mesh,
                      .world_from_mesh = part.world_from_part * Pose{made.offset},
                      .user_material = part.material,
                      .moving = part.moving};
    check_reach(instance, what);
    scene.instances.push_back(std::move(instance));
  } catch (const UnreadablePart& unreadable) {
    missing.add(unreadable);
  } catch (const Error& error) {
    missing.add(error.what(), "");
  }
}

WorldParts::WorldParts(std::filesystem::path base, WorldOptions options, Log log)
    : state_(std::make_unique<State>(std::move(base), std::move(options), std::move(log))) {}
WorldParts::~WorldParts() = default;
WorldParts::WorldParts(WorldParts&&) noexcept = default;
WorldParts& WorldParts::operator=(WorldParts&&) noexcept = default;

Scene WorldParts::scene(std::span<const WorldPart> parts, const std::string& name) {
  State& state = *state_;
  const SceneFolders anywhere(std::vector<std::string>{"/"});  // The running world is the user's own.
  Scene scene;
  MissingParts missing;
  std::set<std::string> names;
  std::vector<std::string> water, for_eyes;
  for (const WorldPart& part : parts) {
    state.maker.expect(part.shape);
  }
  for (const WorldPart& part : parts) {
    if (state.is_ignored(part.name)) {
      continue;
    }
    if (!names.insert(part.name).second) {
      throw Error(fmt::format("visual '{}' has the name of another one", printable(part.name, kLongestName)));
    }
    const std::size_t before = scene.instances.size();
    state.add(part, missing, scene);
    if (scene.instances.size() == before || !part.material.empty() || state.options.keep_water) {
      continue;
    }
    if (is_water_name(part.name) || (part.for_eyes_only && is_level_sheet(scene.instances.back()))) {
      water.push_back(printable(part.name, kLongestName));
      scene.instances.pop_back();
    } else if (part.for_eyes_only) {
      for_eyes.push_back(printable(part.name, kLongestName));
    }
  }
  missing.report(name, state.options.strict, state.log);
  state.maker.report_coarse(name);
  if (state.options.parts &&
      std::ranges::any_of(parts, [](const WorldPart& part) { return part.shape.kind == ShapeKind::kMesh; })) {
    log_line(state.log, Severity::kWarning, fmt::format("{}: parts has no effect: a visual is one object", name));
  }
  const auto warn = [&](const char* text, const std::vector<std::string>& found) {
    if (!found.empty()) {
      log_line(state.log, Severity::kWarning, fmt::format("{}: {}: {}", name, text, fmt::join(found, ", ")));
    }
  };
  warn("left out as water (keep_water: true keeps it)", water);
  warn("what is invisible to cameras echoes as a solid surface (ignore removes it)", for_eyes);
  return scene;
}

void WorldParts::leave_out(const std::string& name) {
  (void)state_->is_ignored(name);
}

void WorldParts::report_unused_patterns(const std::string& name) const {
  state_->ignored.report_unused(name, state_->log);
}

}  // namespace insonify
