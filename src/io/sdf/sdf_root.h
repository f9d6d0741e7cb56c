// sdf_root.h -- parses SDF by libsdformat; errors become one line, warnings go to the log.

#pragma once

#include <sdf/Root.hh>

#include "insonify/log.h"
#include "io/sdf/sdf_source.h"

namespace insonify {

/// Parses the files that `source` prepared. Nothing is printed.
/// @throws Error "path:line:column: ..." for the first fault; the message ends with the number of further ones.
[[nodiscard]] sdf::Root read_sdf_root(const SdfSource& source, const Log& log);

}  // namespace insonify
