// ffmpeg.cpp -- starts the program without a shell and sends it pictures through a socket, since writes to a closed
// socket, unlike a pipe, need not raise SIGPIPE.

#include "io/export/ffmpeg.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "insonify/error.h"
#include "io/file/input_file.h"

namespace insonify {
namespace {

// H.264 in a form that every player supports, which needs even sizes; GIF with the best 256 colours of each picture.
std::vector<std::string> coding(bool gif) {
  if (gif) {
    return {"-vf", "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=none", "-f", "gif"};
  }
  return {"-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2",
          "-c:v",      "libx264",
          "-crf",      "18",
          "-pix_fmt",  "yuv420p",
          "-movflags", "+faststart",
          "-f",        "mp4"};
}

// Whether the boxes of an MP4 file (ISO 14496-12, 4.2) fill it to its end with the index among them, or a GIF has its
// trailer.
bool is_whole_video(const std::filesystem::path& path, bool gif) {
  std::ifstream file(path, std::ios::binary);
  const std::uint64_t end = std::filesystem::file_size(path);
  if (gif) {
    constexpr char kTrailer = 0x3B;
    return file.seekg(-1, std::ios::end) && file.get() == kTrailer;
  }
  bool has_index = false;
  std::uint64_t place = 0;
  while (place < end) {
    std::array<unsigned char, 16> head{};
    file.seekg(static_cast<std::streamoff>(place));
    file.read(reinterpret_cast<char*>(head.data()),
              static_cast<std::streamsize>(std::min<std::uint64_t>(16, end - place)));
    const auto number = [&head](int first, int count) {
      std::uint64_t value = 0;
      for (int i = first; i < first + count; ++i) {
        value = value << 8 | head[static_cast<std::size_t>(i)];
      }
      return value;
    };
    constexpr std::uint64_t kLongSize = 1, kHead = 8;
    const std::uint64_t size = number(0, 4) == kLongSize ? number(8, 8) : number(0, 4);
    if (!file || size < kHead || size > end - place) {
      return false;
    }
    has_index = has_index || std::string_view(reinterpret_cast<const char*>(head.data()) + 4, 4) == "moov";
    place += size;
  }
  return has_index;
}

}  // namespace

Ffmpeg::Ffmpeg(std::filesystem::path name, const std::filesystem::path& place, int width, int height, double rate)
    : name_(std::move(name)), place_(place), width_(width), height_(height) {
  std::vector<std::string> words = {"ffmpeg",   "-hide_banner",
                                    "-nostats", "-loglevel",
                                    "error",    "-y",
                                    "-f",       "rawvideo",
                                    "-pix_fmt", "rgb24",
                                    "-s",       fmt::format("{}x{}", width, height),
                                    "-r",       fmt::format("{:.6g}", rate),
                                    "-i",       "pipe:0"};
  for (std::string& word : coding(ending_of(name_) == ".gif")) {
    words.push_back(std::move(word));
  }
  words.push_back("file:" + std::filesystem::absolute(place).string());  // Cannot be read as an option or an address.
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);

  std::array<int, 2> ends{};
  words_ = memfd_create("ffmpeg", MFD_CLOEXEC);
  if (words_ < 0 || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw Error(fmt::format("{}: cannot start ffmpeg: {}", name_.string(), std::generic_category().message(errno)));
  }
  pictures_ = ends[0];
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, words_, STDERR_FILENO);
  const int error = posix_spawnp(&child_, "ffmpeg", &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  close(ends[1]);
  if (error != 0) {
    child_ = -1;
    close(pictures_);
    close(words_);
    throw Error(error == ENOENT ? fmt::format("{}: the program ffmpeg makes videos, and it is not installed (Debian, "
                                              "Ubuntu: apt-get install ffmpeg)",
                                              name_.string())
                                : fmt::format("{}: cannot start ffmpeg: {}", name_.string(),
                                              std::generic_category().message(error)));
  }
}

Ffmpeg::~Ffmpeg() {
  if (child_ > 0) {
    kill(child_, SIGKILL);
    wait();
  }
  close(pictures_);
  close(words_);
}

int Ffmpeg::wait() {
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  return status;
}

namespace {

// The reason why a file does not grow, if the program's output has it.
std::optional<std::string> full_disk_in(std::string_view text) {
  for (const int error : {ENOSPC, EDQUOT, EFBIG}) {
    const std::string reason = std::generic_category().message(error);
    if (text.find(reason) != std::string_view::npos) {
      return reason;
    }
  }
  return {};
}

}  // namespace

// The end of its output, which usually names the reason.
void Ffmpeg::fail() {
  std::array<char, 4096> buffer{};
  const off_t size = lseek(words_, 0, SEEK_END);
  const auto from = std::max<off_t>(0, size - static_cast<off_t>(buffer.size()));
  const ssize_t count = pread(words_, buffer.data(), buffer.size(), from);
  std::string_view text(buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(0, count)));
  if (const std::optional<std::string> reason = full_disk_in(text)) {
    throw Error(fmt::format("{}: cannot write: {}", name_.string(), *reason));
  }
  while (text.ends_with('\n')) {
    text.remove_suffix(1);
  }
  text.remove_prefix(text.rfind('\n') + 1);
  throw Error(fmt::format("{}: ffmpeg has failed: {}", name_.string(),
                          text.empty() ? "it says nothing" : foreign_reason(text)));
}

void Ffmpeg::add(const Picture& picture) {
  if (picture.width != width_ || picture.height != height_) {
    throw Error(fmt::format("{}: a picture has {} x {} pixels, those before it {} x {}", name_.string(), picture.width,
                            picture.height, width_, height_));
  }
  std::span<const std::uint8_t> rest = picture.rgb;
  while (!rest.empty()) {
    const ssize_t sent = send(pictures_, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno != EINTR) {
      wait();
      fail();
    }
    rest = rest.subspan(static_cast<std::size_t>(std::max<ssize_t>(0, sent)));
  }
}

void Ffmpeg::finish() {
  shutdown(pictures_, SHUT_WR);
  const int status = wait();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    fail();
  }
  // With a full disk, ffmpeg may report success for part of a video.
  if (!is_whole_video(place_, ending_of(name_) == ".gif")) {
    throw Error(fmt::format("{}: cannot write: ffmpeg has left half a video; the disk may be full", name_.string()));
  }
}

}  // namespace insonify
