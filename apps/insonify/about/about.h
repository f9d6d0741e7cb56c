// about.h -- commands that describe what insonify knows: presets and keys.

#pragma once

#include "console/command.h"

namespace insonify {

/// insonify sonars: lists all presets, or shows one in full.
void add_sonars(const Command& program);

/// insonify describe: documents every key of a scenario, or of one of its sections.
void add_describe(const Command& program);

}  // namespace insonify
