// sdf_root.h -- libsdformat's view of a file, with its errors as one line and its warnings in the log.

#pragma once

#include <sdf/Root.hh>

#include "insonify/log.h"
#include "io/world/sdf_source.h"

namespace insonify {

/// Lets libsdformat read what `source` prepared. Nothing is printed.
/// @throws Error "path:line:column: ..." of the first fault; the message ends with how many more there are.
[[nodiscard]] sdf::Root read_sdf_root(const SdfSource& source, const Log& log);

}  // namespace insonify
