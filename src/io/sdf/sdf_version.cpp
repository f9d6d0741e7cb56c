// sdf_version.cpp -- reads the version of an SDF file.

#include "io/sdf/sdf_version.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

// Versions of SDF that libsdformat 12 supports.
constexpr std::pair kOldest{1, 4}, kNewest{1, 9};

}  // namespace

void check_sdf_version(const XmlFile& file, const Log& log) {
  const pugi::xml_node root = file.root();
  const std::string where = file.where(root);
  const std::string_view name = root.name();
  if (name != "sdf") {
    throw Error(fmt::format("{}the root element is <{}>, not <sdf>{}", where, printable(name),
                            name == "robot" ? "; 'gz sdf -p' or 'ign sdf -p' turns URDF into SDF" : ""));
  }
  if (!root.attribute("version")) {
    throw Error(where + "<sdf> has no version, 1.4 to 1.9 are read");
  }
  const std::string version = root.attribute("version").value();
  int major = 0, minor = 0, length = 0;
  if (std::sscanf(version.c_str(), "%d.%d%n", &major, &minor, &length) != 2 ||
      length != static_cast<int>(version.size())) {
    throw Error(fmt::format("{}SDF version '{}' is not two numbers, 1.4 to 1.9 are read", where, printable(version)));
  }
  const auto number = std::pair(major, minor);
  if (number < kOldest) {
    log_line(log, Severity::kWarning,
             fmt::format("{}SDF version {} is older than {}.{}, the oldest that is known to be read right", where,
                         printable(version), kOldest.first, kOldest.second));
  } else if (number > kNewest) {
    log_line(log, Severity::kWarning,
             fmt::format("{}SDF version {} is newer than {}.{} and read as that; new features are "
                         "ignored",
                         where, printable(version), kNewest.first, kNewest.second));
  }
}

}  // namespace insonify
