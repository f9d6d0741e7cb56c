// pictures.h -- chooses the pings of a run to draw, and writes their pictures.

#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "insonify/picture.h"
#include "insonify/ping_sink.h"
#include "insonify/waterfall.h"
#include "pictures/output_folder.h"
#include "pictures/picture_options.h"

namespace insonify {

/// Which pings of a run are drawn.
struct PictureChoice {
  std::uint64_t most = 20;  ///< Most pings drawn, evenly spaced; the last ping is always among them.

  std::vector<std::uint64_t> only = {};  ///< If not empty, only these pings, by number.

  /// "all", "none", "last" or a number.  @throws InputError
  static PictureChoice parse(const std::string& text);

  /// @param total  Number of pings of the run.
  [[nodiscard]] bool takes(std::uint64_t ping, std::uint64_t total) const;
};

/// Draws one sonar's pings into a folder. For a fan: NAME_polar_0000.png and NAME_fan_0000.png. For a scanning sonar:
/// NAME_scan_0000.png, the scan up to a ping, and at the end NAME_scan.png and the waterfall NAME_polar.png. For a
/// side-scan sonar, and if the style asks for it for a single beam that does not turn: NAME_waterfall.png, all pings.
/// If the style asks for masks, NAME_instance_... and NAME_material_... beside each picture of a ping or scan.
class PingPictures final : public PingSink {
 public:
  /// In the calibrated model the display may apply gain by range, or be that of counts. Unless the style fixes full
  /// scale, it is fitted to the first ping of a fan, for all of its pictures, or to all pings so far of a scan.
  /// @param folder  Where pictures are written; must outlive this.
  PingPictures(PictureFolder& folder, const SonarConfig& sonar, const PictureStyle& style, PictureChoice choice,
               std::uint64_t total);

  void add(std::size_t sonar, const Ping& ping) override;

  /// Draws the pictures of the whole run, and that of the last ping added if a stopped run has left it out. The folder
  /// puts them in place.
  void close() override;
  [[nodiscard]] const std::filesystem::path& place() const override { return folder_->path(); }

  /// Files written so far, in order.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

  /// Says so where fixed levels leave every picture black, or counts are all the greatest; else "".
  [[nodiscard]] std::string darkness_text() const;

 private:
  [[nodiscard]] Ping shown(const Ping& ping) const;
  void note_brightest();
  void draw_fan_of_last();
  void draw_scan(const std::string& name, bool polar);
  void write(const std::string& name, const Picture& picture);
  void write_mask(const char* layer, const std::string& name, const NumberPicture& picture);

  PictureFolder* folder_;
  SonarConfig sonar_;
  EchoModel model_;
  int mask_bits_ = 0;                    // 0: no masks.
  bool fixed_ = false, scaled_ = false;  // Full scale is given; full scale of a fan is fitted.
  Display display_;
  PictureChoice choice_;
  std::uint64_t total_ = 0;
  std::unique_ptr<ScanView> scan_;                                 // Only for a scanning sonar.
  std::unique_ptr<Waterfall> waterfall_;                           // Only where the style asks for it.
  std::vector<std::vector<std::uint16_t>> instances_, materials_;  // Of a scan with masks, by ping.
  Ping last_;                                                      // As it is drawn.
  bool last_drawn_ = true;
  double brightest_ = 0;                                      // Largest intensity drawn.
  double darkest_ = std::numeric_limits<double>::infinity();  // The least.
  std::vector<std::filesystem::path> files_;
};

}  // namespace insonify
