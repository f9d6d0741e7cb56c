// main.cpp -- insonify-read: reads strangers' files for the process that has started it, and for that alone.

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <new>

#include "insonify/files.h"
#include "insonify/version.h"
#include "io/file/hdf5.h"
#include "io/file/reader_process.h"
#include "io/file/scene_folders.h"
#include "io/foreign/foreign_formats.h"
#include "io/grid/height_grid_file.h"
#include "io/mesh/flatten_scene.h"
#include "io/picture/grey_picture.h"
#include "io/picture/png_reader.h"
#include "io/recording/hdf5_tables.h"

namespace insonify {
namespace {

// ---------------------------------------------------------------- What it cannot do

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // A sanitizer takes memory and opens files of its own.
#else
constexpr bool kSanitized = false;
#endif

void limit(decltype(RLIMIT_AS) resource, rlim_t most) {
  rlimit now{};
  getrlimit(resource, &now);
  now.rlim_cur = std::min(most, now.rlim_max);
  setrlimit(resource, &now);
}

// Where the kernel has Landlock: no file is changed, no program started; from version 4 on no TCP connection made, from
// version 6 on no signal sent to another process.
void change_nothing() {
  struct {
    std::uint64_t files, network, scopes;  // As landlock_ruleset_attr of new kernels.
  } refused{(LANDLOCK_ACCESS_FS_MAKE_SYM << 1U) - 1, 3, 3};
  refused.files &= ~std::uint64_t{LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR};
  const long version = syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  const std::size_t size = sizeof(std::uint64_t) * (version >= 6 ? 3 : version >= 4 ? 2 : 1);
  const auto rules = static_cast<int>(syscall(SYS_landlock_create_ruleset, &refused, size, 0));
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  syscall(SYS_landlock_restrict_self, rules, 0);
  close(rules);
}

// A signal of the socket ends a process whose parent was killed, which would otherwise go on to the end of its file.
void end_with_parent() {
  struct sigaction action {};
  action.sa_handler = [](int) {
    char byte = 0;
    if (recv(kReaderSocket, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0) {
      _exit(0);
    }
  };
  action.sa_flags = SA_RESTART;
  sigaction(SIGIO, &action, nullptr);
  fcntl(kReaderSocket, F_SETOWN, getpid());
  fcntl(kReaderSocket, F_SETFL, O_ASYNC);
}

void confine(std::uint64_t memory_bytes) {
  constexpr rlim_t kFiles = 64;
  std::set_new_handler([] { _exit(kReaderNoMemory); });
  std::signal(SIGINT, SIG_IGN);  // Ctrl-C is for the parent.
  limit(RLIMIT_AS, kSanitized ? RLIM_INFINITY : memory_bytes);
  limit(RLIMIT_FSIZE, memory_bytes);  // That which it hands back, too.
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_NOFILE, kFiles);
  end_with_parent();
  change_nothing();
  H5Lunregister(H5L_TYPE_EXTERNAL);  // Links to other files lead nowhere.
}

// It ends by SIGXCPU once it has used so much more processor time [s].
void allow_seconds(std::uint32_t seconds) {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  limit(RLIMIT_CPU, static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1) + seconds);
}

// ---------------------------------------------------------------- What it does

using OpenRecording = std::unique_ptr<RecordedTables>;

// Opened at the first task about it, after which no other file is: not what HDF5 calls external.
RecordedTables& opened(OpenRecording& recording, const std::string& path, const std::string& sonar) {
  if (recording == nullptr) {
    const ForeignFormat* const format = foreign_format(path);
    recording = format != nullptr ? OpenRecording(format->open(path, sonar)) : std::make_unique<Hdf5Tables>(path);
    limit(RLIMIT_NOFILE, kSanitized ? RLIM_INFINITY : 0);
  }
  return *recording;
}

// Bytes that are no UTF-8 become U+FFFD.
std::string text_of(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

template <typename Value>
Value next(SharedBytes& arguments) {
  Value value{};
  get(arguments, value);
  return value;
}

// Reads the arguments of a task, and writes its result in their place.
void answer(ReaderTask task, const std::string& path, OpenRecording& recording, SharedBytes& arguments,
            SharedBytes& result) {
  switch (task) {
    case ReaderTask::kMesh: {
      const auto submesh = next<std::string>(arguments);
      const SceneFolders scene(next<std::vector<std::string>>(arguments));
      return put(result, read_mesh(path, submesh));
    }
    case ReaderTask::kPicture:
      return put(result, decode_png(path, next<std::string>(arguments)));
    case ReaderTask::kGrey:
      return put(result, decode_grey(path, next<std::string>(arguments)));
    case ReaderTask::kBag:
      return put(result, read_bag(path));
    case ReaderTask::kTiff:
      return put(result, read_tiff(path));
    case ReaderTask::kRecording:
      return put(result, text_of(opened(recording, path, next<std::string>(arguments)).summary()));
    case ReaderTask::kSettings:
      return put(result, text_of(opened(recording, path, next<std::string>(arguments)).settings()));
    case ReaderTask::kRow: {
      opened(recording, path, next<std::string>(arguments));
      const RecordedTable& table = recording->table(next<std::string>(arguments));
      return put(result, recording->row(table, next<std::uint64_t>(arguments)));
    }
    case ReaderTask::kBlock: {
      opened(recording, path, next<std::string>(arguments));
      const RecordedTable& table = recording->table(next<std::string>(arguments));
      const auto type = next<NumberType>(arguments);
      const auto slices = next<std::vector<TableSlice>>(arguments);
      std::vector<std::byte> bytes(next<std::uint64_t>(arguments));
      recording->read(table, type, slices, bytes);
      return put(result, bytes);
    }
  }
}

ReaderAnswer answer(const ReaderRequest& request, OpenRecording& recording) {
  SharedBytes arguments(kReaderMemory, request.bytes);
  const auto path = next<std::string>(arguments);
  try {
    SharedBytes result(kReaderMemory);
    answer(request.task, path, recording, arguments, result);
    return {ReaderAnswer::kResult, result.place()};
  } catch (const std::exception& error) {
    const bool has_path = dynamic_cast<const Error*>(&error) != nullptr;
    SharedBytes text(kReaderMemory);
    put(text, (has_path ? "" : path + ": ") + error.what());
    return {ReaderAnswer::kError, text.place()};
  }
}

}  // namespace
}  // namespace insonify

// Started by ReaderProcess alone: insonify-read VERSION BYTES.
int main(int count, char** words) {
  using namespace insonify;
  if (count != 3 || words[1] != std::string_view(kVersion)) {
    return 3;
  }
  read_files_in_process();
  confine(std::strtoull(words[2], nullptr, 10));
  OpenRecording recording;
  for (ReaderRequest request; recv(kReaderSocket, &request, sizeof request, 0) == sizeof request;) {
    allow_seconds(request.seconds);
    const ReaderAnswer done = answer(request, recording);
    send(kReaderSocket, &done, sizeof done, MSG_NOSIGNAL);
  }
  _exit(0);  // Nothing to tidy up.
}
