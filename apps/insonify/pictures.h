// pictures.h -- which pictures a run draws of its pings, and the files they go to.

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "earlier_run.h"
#include "insonify/picture.h"
#include "picture_options.h"

namespace insonify {

/// How many pings of a run are drawn.
struct PictureChoice {
  std::uint64_t most = 20;  ///< Evenly spread; the last ping is always among them.

  std::vector<std::uint64_t> only = {};  ///< Where not empty, just these pings, by number.

  /// "all", "none", "last" or a number.  @throws InputError
  static PictureChoice parse(const std::string& text);

  /// @param total  Pings of the run.
  [[nodiscard]] bool takes(std::uint64_t ping, std::uint64_t total) const;
};

/// Draws one sonar's pings into a folder: of a fan NAME_polar_0000.png and NAME_fan_0000.png; of a scanning sonar
/// NAME_scan_0000.png, what it has seen up to a ping, and at the end NAME_scan.png and the waterfall NAME_polar.png.
class PingPictures {
 public:
  /// In the calibrated model levels are raised by range as the display says, and full scale is what fits a fan's first
  /// ping, for all of them, or the pings so far of a scan, unless the style fixes it.
  /// @param folder  Where pictures are written; must outlive this.
  PingPictures(PictureFolder& folder, const SonarConfig& sonar, const PictureStyle& style, PictureChoice choice,
               std::uint64_t total);

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

  PictureFolder* folder_;
  SonarConfig sonar_;
  EchoModel model_;
  bool fixed_ = false, scaled_ = false;  // The full scale is given; that of a fan is chosen.
  Display display_;
  PictureChoice choice_;
  std::uint64_t total_ = 0;
  std::unique_ptr<ScanView> scan_;  // Of a scanning sonar.
  bool last_drawn_ = true;
  std::vector<std::filesystem::path> files_;
};

}  // namespace insonify
