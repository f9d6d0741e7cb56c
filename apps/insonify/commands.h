// commands.h -- options of each command, and the functions that run them. request_*.cpp fill in the options.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "insonify/error.h"
#include "picture_options.h"

namespace insonify {

// Exit statuses.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;      ///< A failure while running, or the run was stopped.
inline constexpr int kWrongInput = 2;  ///< The input is wrong.

/// Wrong input, as opposed to a failure while running.
class InputError : public Error {
 public:
  using Error::Error;
};

struct RunOptions {
  std::filesystem::path scenario;
  std::filesystem::path folder;       ///< Empty: the scenario's name + "_pings".
  int threads = 0;                    ///< 0: one per processor.
  std::vector<std::string> settings;  ///< "key=value", in order.
  bool compress = false;              ///< Compress recordings, with HDF5's own filters.
  bool force = false;                 ///< Replace recordings and pictures of an earlier run.

  PictureOptions pictures;
  bool view = true;       ///< Draw a camera view of the scene.
  bool channels = false;  ///< Draw images of distance and intensity by direction.
  bool quiet = false;     ///< Print only warnings and errors.
};

/// insonify run: computes the pings of a scenario and writes recordings and pictures.
int run(const RunOptions& options);

struct DrawOptions {
  std::filesystem::path recording;
  std::filesystem::path folder;      ///< Empty: the folder of the recording.
  std::vector<std::uint64_t> pings;  ///< Numbers from 0; empty: chosen by `pictures`.
  PictureOptions pictures;
  bool force = false;  ///< Replace existing pictures.
};

/// insonify draw: draws pictures of a recording's pings.
int draw(const DrawOptions& options);

struct CompareOptions {
  std::filesystem::path a, b;        ///< Recordings, folders of them, or pictures.
  std::string sonar;                 ///< Sonar whose recording is used in a folder; "" if the folder has only one.
  std::vector<std::uint64_t> pings;  ///< Numbers from 0; empty: all that both recordings have.
  std::string scale;                 ///< linear or db; "" for db with recordings of the calibrated model, else linear.
  double floor_db = -50;             ///< [dB]
  std::optional<double>
      full_scale;       ///< When absent: the largest intensity of both recordings in the calibrated model, else 1.
  bool ms_ssim = true;  ///< Compute MS-SSIM where pictures are large enough.
  bool json = false;
};

/// insonify compare: similarity of two recordings or pictures.
int compare(const CompareOptions& options);

/// insonify sonars: lists all presets, or shows one in full.
int sonars(const std::string& name, const std::string& mode);

/// insonify describe: documents every key of a scenario, or of one of its sections.
int describe(const std::string& section, bool markdown);

/// insonify version.
int version();

}  // namespace insonify
