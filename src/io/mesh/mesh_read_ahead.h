// mesh_read_ahead.h -- reads the meshes of a world on threads of its own, while the world is parsed.

#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "insonify/log.h"
#include "insonify/mesh.h"
#include "io/mesh/mesh_file.h"

namespace insonify {

/// While it lives, load_mesh_file() in its thread takes the files that it has been asked for from here. Results and
/// messages are those of reading each file where it is used.
class MeshReadAhead {
 public:
  MeshReadAhead();
  /// Waits for the file that each thread reads at the moment; those not begun are dropped.
  ~MeshReadAhead();
  MeshReadAhead(const MeshReadAhead&) = delete;
  MeshReadAhead& operator=(const MeshReadAhead&) = delete;

  /// That of this thread; null without one, and where files are read in this process.
  [[nodiscard]] static MeshReadAhead* current();

  /// Asks for a file, which need not exist. A second request for the same part of it does nothing.
  void want(const std::filesystem::path& path, const Submesh& submesh);

  /// Waits for a file, passes what was logged about it to `log`, and forgets it.
  /// @return  Nothing for one that was not asked for, or is taken already.
  /// @throws Error as load_mesh_file() does.
  [[nodiscard]] std::optional<Mesh> take(const std::filesystem::path& path, const Submesh& submesh, const Log& log);

 private:
  struct ReadFile {
    std::vector<std::pair<Severity, std::string>> messages = {};
    std::optional<Mesh> mesh = {};  // Absent after an error.
    std::exception_ptr error = {};
  };
  using Key = std::tuple<std::filesystem::path, std::string, bool>;

  void read_files(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any more_;
  std::deque<std::packaged_task<ReadFile()>> tasks_;
  std::map<Key, std::future<ReadFile>> files_;
  std::vector<std::jthread> threads_;
};

}  // namespace insonify
