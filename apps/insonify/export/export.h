// export.h -- insonify export: writes recordings in the formats of other tools.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pictures/message_choice.h"

namespace insonify {

struct ExportCommand {
  std::vector<std::filesystem::path> recordings;
  std::string sonar;  ///< Sonar of recordings with several; "" for all.
  std::filesystem::path file;
  bool force = false;               ///< Replace a file that is there.
  int bits = 16;                    ///< Bits of a value of sonar images in .mcap, 8 or 16.
  MessageChoice messages;           ///< What the messages of .mcap and .bag hold.
  bool store = false;               ///< Leave .npz uncompressed.
  std::optional<double> rate = {};  ///< Pictures a second of a video.
  PictureOptions pictures;          ///< Colours and levels.
  std::vector<std::string> given;   ///< Names of the options that act on some formats only and were given.
};

/// @return  kDone. @throws InputError for wrong input, Error for a failure while running
int export_command(const ExportCommand& options);

}  // namespace insonify
