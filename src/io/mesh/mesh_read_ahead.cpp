// mesh_read_ahead.cpp -- a queue of mesh files and the threads that read them, each with a reader process.

#include "io/mesh/mesh_read_ahead.h"

#include "io/file/reader_process.h"
#include "io/file/scene_folders.h"

namespace insonify {
namespace {

constexpr std::size_t kThreads = 2;  // Each reader process may take half of the machine's memory.

thread_local MeshReadAhead* current_read_ahead = nullptr;

}  // namespace

MeshReadAhead::MeshReadAhead() {
  if (!reads_here()) {
    current_read_ahead = this;
  }
}

MeshReadAhead::~MeshReadAhead() {
  current_read_ahead = nullptr;
  for (std::jthread& thread : threads_) {
    thread.request_stop();
  }
}

MeshReadAhead* MeshReadAhead::current() {
  return current_read_ahead;
}

void MeshReadAhead::want(const std::filesystem::path& path, const Submesh& submesh) {
  const std::lock_guard lock(mutex_);
  std::future<ReadFile>& file = files_[{path, submesh.name, submesh.center}];
  if (file.valid()) {
    return;
  }
  std::packaged_task<ReadFile()> task([path, submesh, folders = SceneFolders::current()] {
    const SceneFolders scene(folders);
    ReadFile read;
    const Log keep = [&](Severity severity, const std::string& line) { read.messages.emplace_back(severity, line); };
    try {
      read.mesh = load_mesh_file(path, submesh, keep);
    } catch (...) {
      read.error = std::current_exception();
    }
    return read;
  });
  file = task.get_future();
  tasks_.push_back(std::move(task));
  if (threads_.size() < kThreads) {
    threads_.emplace_back([this](const std::stop_token& stop) { read_files(stop); });
  }
  more_.notify_one();
}

std::optional<Mesh> MeshReadAhead::take(const std::filesystem::path& path, const Submesh& submesh, const Log& log) {
  std::future<ReadFile> file;
  {
    const std::lock_guard lock(mutex_);
    auto entry = files_.extract({path, submesh.name, submesh.center});
    if (entry.empty()) {
      return std::nullopt;
    }
    file = std::move(entry.mapped());
  }
  ReadFile read = file.get();
  for (const auto& [severity, line] : read.messages) {
    if (log) {
      log(severity, line);
    }
  }
  if (read.error != nullptr) {
    std::rethrow_exception(read.error);
  }
  return std::move(read.mesh);
}

void MeshReadAhead::read_files(const std::stop_token& stop) {
  const SharedReader reader;
  for (std::unique_lock lock(mutex_);
       more_.wait(lock, stop, [this] { return !tasks_.empty(); }) && !stop.stop_requested(); lock.lock()) {
    std::packaged_task<ReadFile()> task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task();
  }
}

}  // namespace insonify
