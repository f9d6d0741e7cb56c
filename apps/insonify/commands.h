// commands.h -- what each command is told, and where it is done. request_*.cpp fill these in from its words.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "insonify/error.h"
#include "picture_options.h"

namespace insonify {

// What the program ends with.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;      ///< Something went wrong while running, or the run was stopped.
inline constexpr int kWrongInput = 2;  ///< What was asked for makes no sense.

/// Wrong input, as against a failure while running.
class InputError : public Error {
 public:
  using Error::Error;
};

struct RunOptions {
  std::filesystem::path scenario;
  std::filesystem::path folder;       ///< Empty: the scenario's name with "_pings" after it.
  int threads = 0;                    ///< 0: as many as there are processors.
  std::vector<std::string> settings;  ///< "key=value", in order.
  bool compress = false;              ///< Recordings, by HDF5's own filters.
  bool force = false;                 ///< Replace what an earlier run has left.

  PictureOptions pictures;
  bool view = true;       ///< Draw the scene itself.
  bool channels = false;  ///< Draw distance and intensity by direction.
  bool quiet = false;     ///< Print only warnings and errors.
};

/// insonify run: pings of a scenario into recordings and pictures.
int run(const RunOptions& options);

struct DrawOptions {
  std::filesystem::path recording;
  std::filesystem::path folder;      ///< Empty: the recording's own.
  std::vector<std::uint64_t> pings;  ///< Numbers from 0; none for those that `pictures` chooses.
  PictureOptions pictures;
  bool force = false;  ///< Replace pictures that are there.
};

/// insonify draw: pictures of a recording's pings.
int draw(const DrawOptions& options);

struct CompareOptions {
  std::filesystem::path a, b;        ///< Recordings, folders of them, or pictures.
  std::string sonar;                 ///< Which recording of a folder; "" where there is one.
  std::vector<std::uint64_t> pings;  ///< Numbers from 0; none for all that both have.
  std::string scale;                 ///< linear or db; "" for db in recordings of the calibrated model, else linear.
  double floor_db = -50;             ///< [dB]
  std::optional<double> full_scale;  ///< Loudest of both in recordings of the calibrated model when absent, else 1.
  bool ms_ssim = true;               ///< Where pictures are large enough.
  bool json = false;
};

/// insonify compare: how alike two recordings or pictures are.
int compare(const CompareOptions& options);

/// insonify sonars: a table of all presets, or all that is known of one.
int sonars(const std::string& name, const std::string& mode);

/// insonify describe: every key of a scenario, of one section or all.
int describe(const std::string& section, bool markdown);

/// insonify version.
int version();

}  // namespace insonify
