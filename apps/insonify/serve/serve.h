// serve.h -- insonify serve: makes pings while browsers and other programs watch.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "serve/page_server.h"

namespace insonify {

struct ServeOptions {
  std::filesystem::path scenario;
  PageServerOptions server;
  std::filesystem::path recording;    ///< Recorded from the start; empty: not.
  bool force = false;                 ///< Whether its files may replace others.
  std::string levels;                 ///< MessageOptions::low_db and high_db, "-90:-40"; "" for none.
  double rate = 0;                    ///< Most pings a second of each sonar; 0: no limit.
  int threads = 0;                    ///< 0: one per processor.
  std::vector<std::string> settings;  ///< "key=value", in order.
  bool paused = false;
};

/// @return  kDone. @throws InputError for wrong input, Error for a failure while running
int serve(const ServeOptions& options);

}  // namespace insonify
