// run.h -- insonify run: computes the pings of a scenario and writes recordings and pictures.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pictures/message_choice.h"
#include "run/recordings.h"

namespace insonify {

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
