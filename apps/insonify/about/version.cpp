// version.cpp -- insonify version: prints the version.

#include "insonify/version.h"

#include <fmt/format.h>

#include "about/about.h"
#include "console/console.h"
#include "console/outcome.h"
#include "insonify/engine.h"

namespace insonify {

int version() {
  const auto engines = engine_names();
  say("insonify {}\nengines: {}\n", kVersion, fmt::format("{}", fmt::join(engines, ", ")));
  return kDone;
}

}  // namespace insonify
