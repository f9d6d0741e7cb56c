// started_bridge.h -- the program insonify-bridge-dds, on this machine alone, with dive.yaml of the current folder.

#pragma once

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace insonify {

/// Limits only end a test that fails: on a busy machine all that is waited for can take seconds.
inline constexpr double kPrompt = 20;  // For the end of a bridge [s].

/// What it prints goes to the file "said" of the current folder.
class StartedBridge {
 public:
  StartedBridge(int domain, const std::vector<std::string>& options) {
    std::vector<std::string> words{INSONIFY_BRIDGE_DDS,    "dive.yaml", "-q", "--local",  "--domain",
                                   std::to_string(domain), "--bits",    "16", "--at-once"};
    words.insert(words.end(), options.begin(), options.end());
    std::vector<char*> arguments;
    for (std::string& word : words) {
      arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      std::signal(SIGINT, SIG_DFL);  // Ignored where a shell has started the test in the background.
      const int said = open("said", O_WRONLY | O_CREAT | O_TRUNC, 0666);
      dup2(said, STDOUT_FILENO);
      dup2(said, STDERR_FILENO);
      execv(arguments[0], arguments.data());
      _exit(127);
    }
  }
  StartedBridge(const StartedBridge&) = delete;
  StartedBridge& operator=(const StartedBridge&) = delete;
  ~StartedBridge() { (void)end(); }

  void send(int signal) const { kill(process_, signal); }

  /// Asks it to end. @return  Its wait status; the time it took is in `seconds`.
  int end(double* seconds = nullptr) {
    if (process_ <= 0) {
      return -1;
    }
    const auto begin = std::chrono::steady_clock::now();
    send(SIGINT);
    int status = 0;
    waitpid(std::exchange(process_, -1), &status, 0);
    if (seconds != nullptr) {
      *seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    return status;
  }

  [[nodiscard]] static std::string said() {
    std::ostringstream text;
    text << std::ifstream("said").rdbuf();
    return text.str();
  }

  /// Waits until it has said something.
  [[nodiscard]] static bool wait_for(const std::string& text) {
    for (int i = 0; i < 600; ++i) {
      if (said().find(text) != std::string::npos) {
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
  }

 private:
  pid_t process_ = -1;
};

}  // namespace insonify
