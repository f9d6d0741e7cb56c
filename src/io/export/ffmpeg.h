// ffmpeg.h -- the program ffmpeg as a child that makes a video of raw pictures.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "insonify/picture.h"

namespace insonify {

class Ffmpeg {
 public:
  /// Starts it.
  /// @param name   Name of the video in messages; its extension is the format.
  /// @param place  Output file, which must exist.
  /// @param rate   Frames per second.
  /// @throws Error if ffmpeg is not installed.
  Ffmpeg(std::filesystem::path name, const std::filesystem::path& place, int width, int height, double rate);
  /// Ends it if finish() was not called.
  ~Ffmpeg();
  Ffmpeg(const Ffmpeg&) = delete;
  Ffmpeg& operator=(const Ffmpeg&) = delete;

  /// @throws Error with ffmpeg's output if it has failed; for a picture of another size.
  void add(const Picture& picture);

  /// Waits until the video is written.
  /// @throws Error if it has failed, or if the video is incomplete.
  void finish();

 private:
  [[noreturn]] void fail();
  int wait();

  std::filesystem::path name_, place_;
  int width_, height_;
  int pictures_ = -1;  // Socket to its standard input.
  int words_ = -1;     // Its standard error, a file in memory.
  pid_t child_ = -1;
};

}  // namespace insonify
