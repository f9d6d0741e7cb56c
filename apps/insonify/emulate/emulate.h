// emulate.h -- insonify emulate: a simulated sonar that speaks the protocol of an instrument.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace insonify {

struct EmulateOptions {
  std::filesystem::path scenario;
  std::string sonar;  ///< Name; "": the first of the right type.
  std::string high;   ///< Name of another for the high frequency mode; "": that of the preset (oculus).
  std::string address = "127.0.0.1";
  int port = 0;                            ///< 0: any free port.
  std::string destination = "224.0.0.96";  ///< Address to send to (sonar3d15).
  double silence = 30;                     ///< Longest time for which a client may send nothing [s] (oculus).
  bool serial = false;                     ///< Whether to serve a pseudo terminal too (ping360).
  bool fast = false;                       ///< Whether the head turns and samples are read out in no time (ping360).
  int threads = 0;                         ///< 0: one per processor.
  std::vector<std::string> settings;       ///< "key=value", in order.
  bool quiet = false;                      ///< Print only addresses, warnings and errors.
};

}  // namespace insonify
