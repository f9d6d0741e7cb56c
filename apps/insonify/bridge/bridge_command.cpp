// bridge_command.cpp -- finds the program of a bridge and becomes it.

#include "bridge/bridge_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "console/console.h"
#include "console/outcome.h"

namespace insonify {
namespace {

std::filesystem::path folder_of_this_program() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
}

}  // namespace

void become_bridge(const BridgeKind& kind, std::vector<std::string> words) {
  const std::string name = fmt::format("insonify-bridge-{}", kind.name);
  const std::string beside = folder_of_this_program() / name;
  words.insert(words.begin(), name);
  std::vector<char*> arguments;
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
      fmt::format("bridge {} was not built. `./dev bridges` installs what it needs and builds it; its packages are {}",
                  kind.name, kind.packages));
}

}  // namespace insonify
