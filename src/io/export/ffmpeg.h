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
  /// @param name   Of the video in messages; its ending says the format.
  /// @param place  Where the video is written; a file that is there already.
  /// @param rate   Pictures a second.
  /// @throws Error where ffmpeg is not installed.
  Ffmpeg(std::filesystem::path name, const std::filesystem::path& place, int width, int height, double rate);
  /// Ends it where finish() was not called.
  ~Ffmpeg();
  Ffmpeg(const Ffmpeg&) = delete;
  Ffmpeg& operator=(const Ffmpeg&) = delete;

  /// @throws Error with what ffmpeg says where it has failed; for a picture of another size.
  void add(const Picture& picture);

  /// Waits until the video is written.
  /// @throws Error where it has failed, or the file is no whole video.
  void finish();

 private:
  [[noreturn]] void fail();
  int wait();

  std::filesystem::path name_, place_;
  int width_, height_;
  int pictures_ = -1;  // Socket to its standard input.
  int words_ = -1;     // A file in memory: its standard error.
  pid_t child_ = -1;
};

}  // namespace insonify
