// export.h -- insonify export: writes recordings in the formats of other tools.

#pragma once

#include "console/command.h"

namespace insonify {

/// Adds the command.
void add_export(const Command& program);

}  // namespace insonify
