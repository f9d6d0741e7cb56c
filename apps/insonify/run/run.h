// run.h -- insonify run: computes the pings of a scenario and writes recordings and pictures.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "insonify/recording_formats.h"
#include "pictures/picture_options.h"

namespace insonify {

/// Formats that a run records in, in the order of recording_formats().
using RecordKinds = std::vector<const RecordingFormat*>;

/// @param text  Names of formats with commas between: "h5,mcap".
[[nodiscard]] RecordKinds record_kinds(const std::string& text);

/// Endings of the files, with their dots.
[[nodiscard]] std::vector<std::string> endings_of(const RecordKinds& kinds);

struct RunOptions {
  std::filesystem::path scenario;
  std::filesystem::path folder;             ///< Empty: the scenario's name + "_pings".
  int threads = 0;                          ///< 0: one per processor.
  std::vector<std::string> settings;        ///< "key=value", in order.
  RecordKinds record = record_kinds("h5");  ///< Which recordings are made.
  MessageChoice messages = {};              ///< What the messages of MCAP recordings hold.
  bool compress = false;                    ///< Compress recordings, with HDF5's own filters.
  bool force = false;                       ///< Replace recordings and pictures of an earlier run.

  PictureOptions pictures;
  bool view = true;       ///< Draw a camera view of the scene.
  bool channels = false;  ///< Draw images of distance and intensity by direction.
  bool quiet = false;     ///< Print only warnings and errors.
};

/// @return  kDone. @throws InputError for wrong input, Error for a failure while running
int run(const RunOptions& options);

}  // namespace insonify
