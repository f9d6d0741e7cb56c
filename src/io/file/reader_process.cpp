// reader_process.cpp -- starts insonify-read, passes requests by a socket, and says how the process has ended.

#include "io/file/reader_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/version.h"
#include "io/file/budgets.h"

namespace insonify {
namespace {

// The only place that names this setting in the environment: "in-process" or the program's path.
constexpr const char* kSetting = "INSONIFY_READER";
constexpr std::string_view kInProcess = "in-process";

constexpr double kSecondsAGigabyte = 100;  // More processor time for each gigabyte of the file [s].
constexpr double kPatience = 10;           // How many times as long may pass: disks are slow.

std::atomic<bool>& reads_here_flag() {
  static std::atomic<bool> flag = [] {
    const char* setting = std::getenv(kSetting);
    return setting != nullptr && setting == kInProcess;
  }();
  return flag;
}

std::uint32_t seconds_for(const StrangersFile& file) {
  std::error_code ignored;
  const std::uintmax_t bytes = std::filesystem::file_size(file.path, ignored);
  return static_cast<std::uint32_t>(
      std::ceil(budget(Budget::kSeconds) + (ignored ? 0 : static_cast<double>(bytes) / 1e9 * kSecondsAGigabyte)));
}

// The folder of this library or, where it is a part of a program, of that. Never by a relative path, at which a
// stranger's program may lie.
std::filesystem::path own_folder() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&own_folder), &library) != 0 && library.dli_fname != nullptr &&
      library.dli_fname[0] == '/') {
    return std::filesystem::path(library.dli_fname).parent_path();
  }
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
}

std::filesystem::path reader_program(const StrangersFile& file) {
  if (const char* setting = std::getenv(kSetting); setting != nullptr && *setting != '\0') {
    return setting;
  }
  const std::array<std::filesystem::path, 3> places = {(own_folder() / INSONIFY_READER_FROM_LIBRARY).lexically_normal(),
                                                       own_folder() / "insonify-read", INSONIFY_INSTALLED_READER};
  for (const std::filesystem::path& place : places) {
    if (place.is_absolute() && access(place.c_str(), X_OK) == 0) {
      return place;
    }
  }
  throw Error(fmt::format("{}: there is no program {} to read it safely; {}={} reads {} files without it",
                          file.path.string(), places[0].string(), kSetting, kInProcess, file.format));
}

// At 10 or above: the places that files take in the child are below.
int moved_up(int file) {
  const int moved = fcntl(file, F_DUPFD_CLOEXEC, 10);
  close(file);
  return moved;
}

// Starts the program with these two files and no others, and with no signal blocked or ignored.
int spawn_reader(const std::string& program, int socket, int memory, pid_t& child) {
  std::string name = "insonify-read", version = kVersion, bytes = fmt::format("{:.0f}", budget(Budget::kMemory));
  char* arguments[] = {name.data(), version.data(), bytes.data(), nullptr};
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&files, file, "/dev/null", O_RDWR, 0);
  }
  posix_spawn_file_actions_adddup2(&files, socket, kReaderSocket);
  posix_spawn_file_actions_adddup2(&files, memory, kReaderMemory);
  posix_spawn_file_actions_addclosefrom_np(&files, std::max(kReaderSocket, kReaderMemory) + 1);
  posix_spawnattr_t how;
  posix_spawnattr_init(&how);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&how, &none);
  posix_spawnattr_setsigdefault(&how, &all);
  posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  const int failure = posix_spawn(&child, program.c_str(), &files, &how, arguments, environ);
  posix_spawnattr_destroy(&how);
  posix_spawn_file_actions_destroy(&files);
  return failure;
}

thread_local ReaderProcess* shared_reader = nullptr;

}  // namespace

bool reads_here() {
  return reads_here_flag();
}

void read_files_in_process() {
  reads_here_flag() = true;
}

ReaderProcess::~ReaderProcess() {
  stop();
}

void ReaderProcess::start(const StrangersFile& file) {
  if (child_ > 0 && owner_ == getpid()) {
    return;
  }
  stop();
  const std::string program = reader_program(file).string();
  std::array<int, 2> ends = {-1, -1};
  int failure = socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) == 0 ? 0 : errno;
  const int theirs = moved_up(ends[1]);
  socket_ = ends[0];
  memory_ = moved_up(memfd_create("insonify-read", MFD_CLOEXEC));
  failure = failure == 0 && (theirs < 0 || memory_ < 0) ? errno : failure;
  pid_t child = -1;
  failure = failure == 0 ? spawn_reader(program, theirs, memory_, child) : failure;
  close(theirs);
  if (failure != 0) {
    stop();
    throw Error(fmt::format("{}: the reader of {} files, {}, cannot be started: {}", file.path.string(), file.format,
                            program, std::strerror(failure)));
  }
  child_ = child;
  owner_ = getpid();
}

// It has nothing to tidy up, and would not see the end of a socket that a fork of this process has too. Such a fork
// only closes its copies of the files.
void ReaderProcess::stop() {
  for (int* file : {&socket_, &memory_}) {
    if (*file >= 0) {
      close(std::exchange(*file, -1));
    }
  }
  const pid_t child = std::exchange(child_, -1);
  if (child > 0 && owner_ == getpid()) {
    kill(child, SIGKILL);
    while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
}

// False if the process has ended, or is late.
bool ReaderProcess::pass(const ReaderRequest& request, ReaderAnswer& answer, bool& late) const {
  if (send(socket_, &request, sizeof request, MSG_NOSIGNAL) != sizeof request) {
    return false;
  }
  const auto patience = static_cast<int>(std::min(kPatience * 1000 * request.seconds, 2e9));
  pollfd wait = {socket_, POLLIN, 0};
  int ready = 0;
  do {
    ready = poll(&wait, 1, patience);
  } while (ready < 0 && errno == EINTR);
  late = ready == 0;
  return ready > 0 && recv(socket_, &answer, sizeof answer, 0) == sizeof answer;
}

// Only after the process has closed its socket, or is late.
void ReaderProcess::fail(const StrangersFile& file, std::uint32_t seconds, bool late) {
  if (late) {
    kill(child_, SIGKILL);
  }
  int status = 0;
  rusage usage{};
  pid_t ended = -1;
  while ((ended = wait4(child_, &status, 0, &usage)) < 0 && errno == EINTR) {
  }
  child_ = -1;
  stop();
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const double used = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec);
  std::string what;
  if (late) {
    what = fmt::format("took longer than {:.0f} s", kPatience * seconds);
  } else if (ended < 0) {
    what = "ended";  // Somebody else in this process has waited for it.
  } else if (signal == SIGXCPU || (signal == SIGKILL && used + 1 >= seconds)) {
    what = fmt::format("took longer than {} s of processor time", seconds);
  } else if (signal == SIGKILL) {
    what = "was killed (SIGKILL)";
  } else if (signal != 0) {
    const char* name = sigabbrev_np(signal);
    what = fmt::format("crashed (SIG{})", name != nullptr ? name : std::to_string(signal));
  } else if (WEXITSTATUS(status) == kReaderNoMemory) {
    what = fmt::format("needed more than {:.3g} GB", budget(Budget::kMemory) / 1e9);
  } else {
    what = fmt::format("did not work: insonify-read ended with status {}", WEXITSTATUS(status));
  }
  throw Error(fmt::format("{}: the reader of {} files {}", file.path.string(), file.format, what));
}

void ReaderProcess::ask(const StrangersFile& file, ReaderTask task,
                        const std::function<void(SharedBytes&)>& put_arguments,
                        const std::function<void(SharedBytes&)>& get_result) {
  const std::lock_guard lock(mutex_);
  start(file);
  SharedBytes arguments(memory_);
  put_arguments(arguments);
  const ReaderRequest request{task, seconds_for(file), arguments.place()};
  ReaderAnswer answer;
  if (bool late = false; !pass(request, answer, late)) {
    fail(file, request.seconds, late);
  }
  SharedBytes result(memory_, answer.bytes);
  std::string error;
  try {
    if (answer.kind == ReaderAnswer::kResult) {
      get_result(result);
    } else {
      get(result, error);
    }
  } catch (const BrokenAnswer&) {
    stop();
    throw Error(fmt::format("{}: the reader of {} files gave a broken answer", file.path.string(), file.format));
  }
  if (answer.kind != ReaderAnswer::kResult) {
    throw Error(error);
  }
}

SharedReader::SharedReader() {
  if (shared_reader == nullptr && !reads_here()) {
    shared_reader = &own_.emplace();
  }
}

SharedReader::~SharedReader() {
  if (own_) {
    shared_reader = nullptr;
  }
}

ReaderProcess* SharedReader::current() {
  return shared_reader;
}

}  // namespace insonify
