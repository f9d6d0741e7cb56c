// commands.h -- the commands of the program; main.cpp puts them on its command line.

#pragma once

#include <string>
#include <vector>

#include "console/command.h"

namespace insonify {

/// Each adds its command, and those below it, to the command line.
void add_run(const Command& program);
void add_serve(const Command& program);
void add_emulate(const Command& program);
/// @param words  The command line, without the program. Must outlive the command line.
void add_bridge(const Command& program, const std::vector<std::string>& words);
void add_draw(const Command& program);
void add_replay(const Command& program);
void add_info(const Command& program);
void add_export(const Command& program);
void add_mosaic(const Command& program);
void add_grid(const Command& program);
void add_scenes(const Command& program);
void add_sonars(const Command& program);
void add_describe(const Command& program);
void add_compare(const Command& program);
void add_survey(const Command& program);
void add_bench(const Command& program);
void add_completion(const Command& program);
void add_manual(const Command& program);

}  // namespace insonify
