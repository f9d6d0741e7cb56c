// serve.h -- insonify serve: makes pings while browsers and other programs watch.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace insonify {

struct ServeOptions {
  std::filesystem::path scenario;
  int port = 8765;  ///< 0: any that is free.
  std::string address = "127.0.0.1";
  std::string token;                  ///< "" for none: loopback only.
  std::vector<std::string> origins;   ///< Other pages that may connect without a token.
  std::filesystem::path recording;    ///< Recorded from the start; empty: not.
  bool force = false;                 ///< Whether its files may replace others.
  double rate = 0;                    ///< Most pings a second of each sonar; 0: no limit.
  int threads = 0;                    ///< 0: one per processor.
  std::vector<std::string> settings;  ///< "key=value", in order.
  bool paused = false;
  bool quiet = false;          ///< Print only the address, warnings and errors.
  std::filesystem::path page;  ///< Folder to serve the page from; empty: that in the program.
};

/// @return  kDone. @throws InputError for wrong input, Error for a failure while running
int serve(const ServeOptions& options);

}  // namespace insonify
