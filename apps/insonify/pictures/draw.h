// draw.h -- insonify draw: draws pictures of a recording's pings.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pictures/picture_options.h"

namespace insonify {

struct DrawOptions {
  std::filesystem::path recording;
  std::string sonar;                 ///< Sonar of a recording with several; "" for the only one.
  std::filesystem::path folder;      ///< Empty: the folder of the recording.
  std::vector<std::uint64_t> pings;  ///< Numbers from 0; empty: chosen by `pictures`.
  PictureOptions pictures;
  bool force = false;  ///< Replace existing pictures.
};

/// @return  kDone. @throws InputError for wrong input, Error for a failure while running
int draw(const DrawOptions& options);

/// What the help of both says of the choice between them.
inline constexpr std::string_view kDrawOrReplay =
    "insonify draw makes pictures; insonify replay --view plays the same recordings in a browser. Without --view,\n"
    "replay is draw.\n";

/// Adds the options that `insonify draw` and `insonify replay` have in common.
void add_draw_options(const Command& command, DrawOptions& options);

}  // namespace insonify
