// processes.h -- the processes of these tests: the bridge, and one that plays Gazebo.

#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace insonify {

/// Limits only end a test that fails: on a busy machine all that is waited for can take seconds.
inline constexpr double kPatience = 60;  // For what must happen [s].
inline constexpr double kPrompt = 20;    // For the end of a bridge [s].

/// A process with files for its streams; ended with this object.
class Program {
 public:
  /// @param said  What it writes to both of its outputs goes to this file; "" for nowhere.
  Program(std::vector<std::string> words, const std::string& said, int input = -1, int output = -1) {
    process_ = fork();
    if (process_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      std::signal(SIGINT, SIG_DFL);  // Ignored where a shell has started the test in the background.
      const int file = said.empty() ? -1 : ::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      for (const auto& [from, to] : {std::pair(file, 1), {file, 2}, {input, 0}, {output, 1}}) {
        if (from >= 0) {
          dup2(from, to);
        }
      }
      std::vector<char*> arguments;
      for (std::string& word : words) {
        arguments.push_back(word.data());
      }
      arguments.push_back(nullptr);
      execv(arguments[0], arguments.data());
      _exit(127);
    }
  }
  ~Program() { (void)end(SIGINT); }
  Program(Program&& other) noexcept : process_(std::exchange(other.process_, -1)) {}
  Program& operator=(Program&&) = delete;

  void signal(int number) const { kill(process_, number); }

  /// @param seconds  Receives the time that it took to end.
  /// @return  Its wait status.
  int end(int number, double* seconds = nullptr) {
    if (process_ <= 0) {
      return -1;
    }
    const auto begin = std::chrono::steady_clock::now();
    kill(process_, number);
    int status = 0;
    waitpid(std::exchange(process_, -1), &status, 0);
    if (seconds != nullptr) {
      *seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    return status;
  }

 private:
  pid_t process_;
};

/// The process gazebo_player, in the role of Gazebo.
class Player {
 public:
  Player(const std::string& world, const std::string& generation) {
    int to[2], from[2];
    if (pipe2(to, O_CLOEXEC) != 0 || pipe2(from, O_CLOEXEC) != 0) {
      throw std::runtime_error("no pipe");
    }
    program_ =
        std::make_unique<Program>(std::vector<std::string>{GAZEBO_PLAYER, world, generation}, "", to[0], from[1]);
    ::close(to[0]);
    ::close(from[1]);
    in_ = fdopen(to[1], "w");
    out_ = fdopen(from[0], "r");
  }
  ~Player() { die(); }
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  void send(const std::string& line) { EXPECT_EQ(ask(line), "ok") << line; }
  std::string ask(const std::string& line) {
    std::fprintf(in_, "%s\n", line.c_str());
    std::fflush(in_);
    char answer[100] = {};
    if (std::fgets(answer, sizeof answer, out_) == nullptr) {
      return "gone";
    }
    const std::string text = answer;
    return text.substr(0, text.find('\n'));
  }
  /// As by a crash.
  void die() {
    if (program_) {
      program_->end(SIGKILL);
      program_.reset();
      std::fclose(in_);
      std::fclose(out_);
    }
  }

 private:
  std::unique_ptr<Program> program_;
  std::FILE* in_ = nullptr;
  std::FILE* out_ = nullptr;
};

inline std::string contents(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Waits until a file holds a text.
inline bool says(const std::string& file, const std::string& text, double seconds = kPatience) {
  for (int attempt = 0; attempt < seconds * 20; ++attempt) {
    if (contents(file).find(text) != std::string::npos) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

}  // namespace insonify
