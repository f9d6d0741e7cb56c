// serve.h -- insonify serve: makes pings live for browsers and other programs.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "serve/page_server.h"

namespace insonify {

struct ServeOptions {
  std::filesystem::path scenario;
  PageServerOptions server;
  std::filesystem::path recording;    ///< Recorded from the start; empty: none.
  bool force = false;                 ///< Whether its files may replace existing ones.
  std::string levels;                 ///< MessageOptions::low_db and high_db, "-90:-40"; "": default.
  double rate = 0;                    ///< Limit of pings per second of each sonar; 0: no limit.
  int threads = 0;                    ///< 0: one per processor.
  std::vector<std::string> settings;  ///< "key=value", in order.
  bool paused = false;
};

/// @return  kDone. @throws InputError for wrong input, Error for a failure while running
int serve(const ServeOptions& options);

}  // namespace insonify
