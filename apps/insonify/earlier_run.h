// earlier_run.h -- what an earlier run has left in the folder that a run writes to.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "insonify/picture.h"
#include "insonify/scenario.h"

namespace insonify {

/// Refuses to replace recordings and pictures of an earlier run of a scenario's sonars.
/// @throws InputError that names the first such file and the options that help.
void refuse_earlier_run(const std::filesystem::path& folder, const Scenario& scenario);

/// Refuses to replace pictures of one sonar.
/// @throws InputError as above.
void refuse_earlier_pictures(const std::filesystem::path& folder, const std::string& sonar);

/// Takes the pictures that a run draws of its sonars. Where the folder holds pictures of an earlier run of these
/// sonars, the new ones are collected in a folder of their own inside it, pictures.new.XXXXXX, until put_in_place(): a
/// run that fails leaves the earlier pictures alone.
class PictureFolder {
 public:
  /// @param sonars  Names; a sonar's pictures begin with its name.
  PictureFolder(std::filesystem::path folder, std::vector<std::string> sonars);
  /// Removes what was collected and not put in place.
  ~PictureFolder();
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

  /// Writes a picture.
  /// @return  Its path once it is in place.
  std::filesystem::path write(const std::string& file, const Picture& picture);

  /// Removes the new pictures.
  void discard();

  /// Removes the pictures of the earlier run and puts the new ones in their place.
  /// @return  How many were removed.
  std::size_t put_in_place();

 private:
  std::filesystem::path folder_;
  std::vector<std::string> sonars_;
  std::filesystem::path collected_;  // Empty where pictures are written into the folder itself.
  std::vector<std::string> written_;
};

}  // namespace insonify
