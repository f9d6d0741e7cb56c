// compare.h -- insonify compare: similarity of two recordings or pictures.

#pragma once

#include "console/command.h"

namespace insonify {

/// Adds the command.
void add_compare(const Command& program);

}  // namespace insonify
