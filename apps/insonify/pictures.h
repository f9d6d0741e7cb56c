// pictures.h -- which pictures a run draws of its pings, and the files they go to.

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "insonify/engine.h"
#include "insonify/picture.h"

namespace insonify {

/// How many pings of a run are drawn.
struct PictureChoice {
  std::uint64_t most = 20;  ///< Evenly spread; the last ping is always among them.

  /// "all", "none", "last" or a number.  @throws InputError
  static PictureChoice parse(const std::string& text);

  /// @param total  Pings of the run.
  [[nodiscard]] bool takes(std::uint64_t ping, std::uint64_t total) const;
};

/// Removes NAME_fan_0000.png and the like of an earlier run, so that they are not taken for this one's.
/// @return  How many.
std::size_t remove_old_pictures(const std::filesystem::path& folder, const std::string& name);

/// Draws one sonar's pings into a folder: of a fan NAME_polar_0000.png and NAME_fan_0000.png; of a scanning sonar
/// NAME_scan_0000.png, what it has seen up to a ping, and at the end NAME_scan.png and the waterfall NAME_polar.png.
class PingPictures {
 public:
  /// Levels of the calibrated model are raised by range as the display says. Full scale is that of a fan's first ping,
  /// for all; of a scan, what fits the pings so far.
  PingPictures(std::filesystem::path folder, const SonarConfig& sonar, EchoModel model, Display display,
               PictureChoice choice, std::uint64_t total);

  void add(const Ping& ping);

  /// Draws what only the whole run shows, and the last ping that was added if a stopped run has left it out.
  void finish(const Ping& last);

  /// Files written so far, in order.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  void add_shown(const Ping& ping);
  void fit_scan();
  void draw_fan_of(const Ping& ping);
  void write(const std::string& name, const Picture& picture);

  std::filesystem::path folder_;
  SonarConfig sonar_;
  EchoModel model_;
  bool scaled_ = false;  // The full scale of a fan is chosen.
  Display display_;
  PictureChoice choice_;
  std::uint64_t total_ = 0;
  std::unique_ptr<ScanView> scan_;  // Of a scanning sonar.
  bool last_drawn_ = true;
  std::vector<std::filesystem::path> files_;
};

}  // namespace insonify
