// sdf_file.cpp -- reads a file by libsdformat, without its joints if need be.

#include "io/sdf/sdf_file.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "base/log_line.h"
#include "insonify/error.h"
#include "io/sdf/sdf_root.h"

namespace insonify {
namespace {

SdfFile parse(const std::filesystem::path& path, bool joints, bool strict, MissingParts& missing, const Log& log) {
  SdfFile parsed;
  parsed.source = std::make_unique<SdfSource>(path, joints, missing, log);
  if (strict) {
    missing.report(path.string(), strict, log);
  }
  try {
    parsed.root = read_sdf_root(*parsed.source, log);
  } catch (const Error& error) {
    throw missing.empty() ? error
                          : Error(fmt::format("{}; missing parts may be the cause: {}", error.what(), missing.text()));
  }
  return parsed;
}

}  // namespace

std::unique_lock<std::mutex> lock_sdf() {
  static std::mutex one_at_a_time;
  return std::unique_lock(one_at_a_time);
}

// Faults of joints, which have no shape, are tolerated: if the file cannot be read, it is read again without joints.
SdfFile read_sdf_file(const std::filesystem::path& path, bool strict, MissingParts& missing, const Log& log) {
  std::vector<std::pair<Severity, std::string>> said;
  const Log keep = [&](Severity severity, const std::string& line) { said.emplace_back(severity, line); };
  const auto flush_warnings = [&] {
    for (const auto& [severity, line] : said) {
      log_line(log, severity, line);
    }
  };
  SdfFile parsed;
  MissingParts found;
  try {
    parsed = parse(path, true, strict, found, keep);
  } catch (const Error& fault) {
    if (strict) {
      flush_warnings();
      throw;
    }
    said.clear();
    found = {};
    parsed = parse(path, false, strict, found, keep);
    found.add("the joints, which have no shapes,", fmt::format(" for a fault: {}", fault.what()));
  }
  flush_warnings();
  missing = found;
  return parsed;
}

}  // namespace insonify
