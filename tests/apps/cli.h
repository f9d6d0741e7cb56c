// cli.h -- runs insonify as a user does: as a shell command, or as a process that receives signals.

#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <array>
#include <csignal>
#include <set>
#include <sstream>

#include "support/working_folder.h"

namespace insonify {

struct Outcome {
  int status = -1;
  std::string out, err;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// Runs a shell command in the current folder, with this build's `insonify` on the path.
inline Outcome shell(const std::string& line) {
  const std::string script = fmt::format("insonify() {{ '{}' \"$@\"; }}\n{}", INSONIFY_CLI, line);
  std::ofstream("script.sh") << script;
  FILE* pipe = popen("bash script.sh 2> script.err < /dev/null", "r");
  Outcome outcome;
  std::array<char, 4096> buffer;
  for (std::size_t count = 0; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    outcome.out.append(buffer.data(), count);
  }
  outcome.status = WEXITSTATUS(pclose(pipe));
  outcome.err = text_of("script.err");
  std::filesystem::remove("script.sh");
  std::filesystem::remove("script.err");
  return outcome;
}

// An insonify process with default signal handling, whatever the test was started with.
class Process {
 public:
  explicit Process(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), INSONIFY_CLI);
    std::vector<char*> words;
    for (std::string& argument : arguments) {
      words.push_back(argument.data());
    }
    words.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 1, "process.out", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_addopen(&files, 2, "process.err", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawnattr_t how;
    posix_spawnattr_init(&how);
    sigset_t usual;
    sigemptyset(&usual);
    sigaddset(&usual, SIGINT);
    sigaddset(&usual, SIGTERM);
    posix_spawnattr_setsigdefault(&how, &usual);
    posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGDEF);
    EXPECT_EQ(posix_spawn(&id_, INSONIFY_CLI, &files, &how, words.data(), environ), 0);
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
  }

  // Waits until a condition holds. The limit of two minutes only ends a test that fails: others may use the machine.
  template <typename Happened>
  static void wait_until(Happened&& happened) {
    for (int i = 0; i < 24'000 && !happened(); ++i) {
      usleep(5'000);
    }
    ASSERT_TRUE(happened());
  }

  void send(int signal) const { kill(id_, signal); }

  // Waits for the process to end; status is -1 if a signal ended it.
  [[nodiscard]] Outcome end() const {
    int status = 0;
    waitpid(id_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of("process.out"), text_of("process.err")};
  }

 private:
  pid_t id_ = 0;
};

class CliTest : public testing::Test {
 protected:
  CliTest() {
    // A floor of 40 x 40 m, 2 m below the sonar.
    folder.write("floor.obj", "v -20 -20 -2\nv 20 -20 -2\nv 20 20 -2\nv -20 20 -2\nf 1 2 3\nf 1 3 4\n");
    folder.write("fan.yaml",
                 "world: floor.obj\npings: 3\nsonars:\n  - name: ahead\n    beam_count: 16\n    bin_count: 40\n"
                 "    max_range: 12\n    orientation_deg: [0, 20, 0]\n    sampling: {columns_per_beam: 2, rows: 20}\n");
    folder.write(
        "scan.yaml",
        "world: floor.obj\npings: 20\nsonars:\n  - name: around\n    preset: tritech-micron-dst\n"
        "    bin_count: 40\n    max_range: 12\n    step_deg: 18\n    sampling: {columns_per_beam: 2, rows: 20}\n");
  }

  std::set<std::string> files(const std::filesystem::path& in) const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / in)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

  WorkingFolder folder;
};

}  // namespace insonify
