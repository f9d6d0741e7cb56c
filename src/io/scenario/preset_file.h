// preset_file.h -- preset files by name, and checks of the names of presets and modes without loading them.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace insonify {

/// Folders of presets, in the order in which a name is looked up: those that INSONIFY_PRESETS lists (separated by
/// colons, as in PATH), then the shipped one, which is the one installed with this library wherever the installation
/// has been moved to, else that of the source tree it was built from. A preset of an earlier folder replaces one of the
/// same name in a later one.
/// @throws Error if an entry of INSONIFY_PRESETS is not a folder.
[[nodiscard]] std::vector<std::filesystem::path> preset_folders();

/// The file NAME.yaml of the first folder that has it; empty if none has.
[[nodiscard]] std::filesystem::path find_preset_file(const std::string& name);

/// @throws Error '"gemini" is not a preset; did you mean tritech-gemini-720i?'
void check_preset_name(const std::string& name);

/// @param name  Name of an existing preset.
/// @throws Error '"hgh" is not a mode of blueprint-oculus-m750d, which has low and high'
void check_preset_mode(const std::string& name, const std::string& mode);

}  // namespace insonify
