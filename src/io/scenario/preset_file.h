// preset_file.h -- checks the names of presets and modes without loading them.

#pragma once

#include <string>

namespace insonify {

/// @throws Error '"gemini" is not a preset; did you mean tritech-gemini-720i?'
void check_preset_name(const std::string& name);

/// @param name  Name of an existing preset.
/// @throws Error '"hgh" is not a mode of blueprint-oculus-m750d, which has low and high'
void check_preset_mode(const std::string& name, const std::string& mode);

}  // namespace insonify
