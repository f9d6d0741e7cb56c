// reader_process.h -- a process of its own that reads strangers' files, so that what crashes in it ends only that.

#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "io/file/shared_bytes.h"

namespace insonify {

// The threat: assimp, HDF5 and libpng crash, hang and swell on files that are damaged or made to do so. Design and
// costs: docs/design/reader.md.

/// What the program insonify-read can be asked (src/io/reader/main.cpp).
enum class ReaderTask : std::uint32_t { kMesh, kPicture, kGrey, kBag, kTiff, kRecording, kSettings, kRow, kBlock };

/// A file of a stranger, for messages.
struct StrangersFile {
  std::filesystem::path path;
  std::string format;  ///< As "DAE" in "the reader of DAE files crashed (SIGSEGV)".
};

/// What passes between the two processes by their socket; arguments and results are in shared memory.
struct ReaderRequest {
  ReaderTask task = ReaderTask::kMesh;
  std::uint32_t seconds = 0;
  std::uint64_t bytes = 0;
};
struct ReaderAnswer {
  enum Kind : std::uint64_t { kResult, kError };
  Kind kind = kResult;
  std::uint64_t bytes = 0;
};
inline constexpr int kReaderSocket = 3, kReaderMemory = 4;  ///< File descriptors in the reader process.
inline constexpr int kReaderNoMemory = 4;                   ///< Exit status of one that has reached its limit.

/// Whether this process reads strangers' files itself: the reader process, and any that has called
/// read_files_in_process() or has INSONIFY_READER=in-process in its environment.
[[nodiscard]] bool reads_here();

/// A reader process, bounded by Budget::kMemory and kSeconds; ten times as long may pass. It begins at the first
/// request, and again after it has ended at another; in a process forked from this one too. Calls from several threads
/// take turns.
class ReaderProcess {
 public:
  ReaderProcess() = default;
  ~ReaderProcess();
  ReaderProcess(const ReaderProcess&) = delete;
  ReaderProcess& operator=(const ReaderProcess&) = delete;

  /// Has a task done.
  /// @param put_arguments  Writes them.
  /// @param get_result     Reads it, and throws BrokenAnswer for one that cannot be.
  /// @throws Error with what the reader has thrown, or "PATH: the reader of DAE files ...": how the process has ended.
  void ask(const StrangersFile& file, ReaderTask task, const std::function<void(SharedBytes&)>& put_arguments,
           const std::function<void(SharedBytes&)>& get_result);

  /// The same for a result that get() knows, which must be as fits(result) says, where there is such a function: the
  /// reader may have been taken over by its file.
  template <typename Result, typename... Arguments>
  [[nodiscard]] Result ask(const StrangersFile& file, ReaderTask task, const Arguments&... arguments) {
    Result result;
    ask(
        file, task, [&](SharedBytes& to) { (put(to, arguments), ...); },
        [&](SharedBytes& from) {
          get(from, result);
          if constexpr (requires { fits(result); }) {
            require_whole(fits(result));
          }
        });
    return result;
  }

 private:
  void start(const StrangersFile& file);
  void stop();
  [[nodiscard]] bool pass(const ReaderRequest& request, ReaderAnswer& answer, bool& late) const;
  [[noreturn]] void fail(const StrangersFile& file, std::uint32_t seconds, bool late);

  std::mutex mutex_;
  pid_t owner_ = -1, child_ = -1;
  int socket_ = -1, memory_ = -1;
};

/// While it lives, read_apart() in this thread uses one process for all files.
class SharedReader {
 public:
  SharedReader();
  ~SharedReader();
  SharedReader(const SharedReader&) = delete;
  SharedReader& operator=(const SharedReader&) = delete;

  /// That of this thread; null without one.
  [[nodiscard]] static ReaderProcess* current();

 private:
  std::optional<ReaderProcess> own_;
};

/// Has a file read by a reader process: by the thread's shared one, or by one that ends with this call.
template <typename Result, typename... Arguments>
[[nodiscard]] Result read_apart(const StrangersFile& file, ReaderTask task, const Arguments&... arguments) {
  if (ReaderProcess* const shared = SharedReader::current()) {
    return shared->ask<Result>(file, task, arguments...);
  }
  ReaderProcess alone;
  return alone.ask<Result>(file, task, arguments...);
}

}  // namespace insonify
