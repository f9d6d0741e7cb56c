// about.h -- commands that describe insonify: presets, keys, version.

#pragma once

#include <string>

namespace insonify {

/// insonify sonars: lists all presets, or shows one in full.
int sonars(const std::string& name, const std::string& mode);

/// insonify describe: documents every key of a scenario, or of one of its sections.
int describe(const std::string& section, bool markdown);

/// insonify version.
int version();

}  // namespace insonify
