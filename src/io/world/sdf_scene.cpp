// sdf_scene.cpp -- reads a world, without its joints if need be, and makes a scene of it.

#include "io/world/sdf_scene.h"

#include <fmt/format.h>

#include <memory>
#include <mutex>
#include <sdf/Root.hh>
#include <string>
#include <utility>
#include <vector>

#include "base/log_line.h"
#include "insonify/error.h"
#include "io/file/missing_parts.h"
#include "io/world/sdf_root.h"
#include "io/world/sdf_scene_builder.h"
#include "io/world/sdf_source.h"

namespace insonify {
namespace {

// The files of a world, and what libsdformat makes of them.
struct Parsed {
  std::unique_ptr<SdfSource> source;
  sdf::Root root;
};

Parsed parse(const std::filesystem::path& path, bool joints, bool strict, MissingParts& missing, const Log& log) {
  Parsed parsed;
  parsed.source = std::make_unique<SdfSource>(path, joints, missing, log);
  if (strict) {
    missing.report(path.string(), strict, log);
  }
  try {
    parsed.root = read_sdf_root(*parsed.source, log);
  } catch (const Error& error) {
    throw missing.empty()
        ? error
        : Error(fmt::format("{}; what is missing may be the cause: {}", error.what(), missing.text()));
  }
  return parsed;
}

// Faults of joints, which have no shape, do no harm: where the file cannot be read it is tried again without them.
Parsed parse_with_or_without_joints(const std::filesystem::path& path, bool strict, MissingParts& missing,
                                    const Log& log) {
  std::vector<std::pair<Severity, std::string>> said;
  const Log keep = [&](Severity severity, const std::string& line) { said.emplace_back(severity, line); };
  const auto tell = [&] {
    for (const auto& [severity, line] : said) {
      log_line(log, severity, line);
    }
  };
  Parsed parsed;
  MissingParts found;
  try {
    parsed = parse(path, true, strict, found, keep);
  } catch (const Error& fault) {
    if (strict) {
      tell();
      throw;
    }
    said.clear();
    found = {};
    parsed = parse(path, false, strict, found, keep);
    found.add("the joints, which have no shapes,", fmt::format(" for a fault: {}", fault.what()));
  }
  tell();
  missing = found;
  return parsed;
}

}  // namespace

Scene load_sdf_scene(const std::filesystem::path& path, const WorldOptions& options, const Log& log) {
  static std::mutex one_at_a_time;  // libsdformat's settings and std::cerr are global.
  const std::lock_guard lock(one_at_a_time);
  MissingParts missing;
  const Parsed parsed = parse_with_or_without_joints(path, options.strict, missing, log);

  SdfSceneBuilder builder(*parsed.source, options, missing, log);
  for (std::uint64_t w = 0; w < parsed.root.WorldCount(); ++w) {
    builder.add_world(*parsed.root.WorldByIndex(w));
  }
  if (parsed.root.Model() != nullptr) {
    builder.add_model(*parsed.root.Model());
  }
  return builder.finish(path.string());
}

}  // namespace insonify
