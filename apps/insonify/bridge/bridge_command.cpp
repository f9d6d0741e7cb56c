// bridge_command.cpp -- insonify bridge: finds the program of a bridge and becomes it.

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "transport/bridge_options.h"

namespace insonify {
namespace {

std::filesystem::path folder_of_this_program() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
}

// Becomes the program insonify-bridge-NAME, that beside this one or else the first on PATH.
// @param words  Its arguments.
// @throws Error if it is not installed, or cannot be run.
[[noreturn]] void become_bridge(const BridgeKind& kind, std::vector<std::string> words) {
  const std::string name = fmt::format("insonify-bridge-{}", kind.name);
  const std::string beside = folder_of_this_program() / name;
  words.insert(words.begin(), name);
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  flush_output();
  execv(beside.c_str(), arguments.data());
  const std::string tried = errno == ENOENT ? name : beside;
  if (errno == ENOENT) {
    execvp(name.c_str(), arguments.data());
  }
  if (errno != ENOENT) {
    throw Error(fmt::format("{}: cannot run it: {}", tried, std::generic_category().message(errno)));
  }
  throw Error(
      fmt::format("bridge {0} is not installed. It is the Debian package insonify-{0} (./dev package); in the source, "
                  "`./dev bridges` installs what it needs and builds it: {1}",
                  kind.name, kind.packages));
}

}  // namespace

void add_bridge(const Command& program, const std::vector<std::string>& words) {
  const Command command = program.add("bridge", "Publish pings live to ROS 1, ROS 2 or Gazebo");
  command.footer("Help on one: insonify bridge ros1 --help");
  for (const BridgeKind& kind : bridge_kinds()) {
    const Command bridge = command.add(kind.name, kind.help);
    add_bridge_options(bridge, kind, bridge.keep<BridgeRequest>());
    bridge.act([bridge, &kind, &words]() -> int {
      check_other_words(bridge, kind);
      become_bridge(kind, {words.begin() + 2, words.end()});
    });
  }
}

}  // namespace insonify
