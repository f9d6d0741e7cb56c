// output_folder.h -- the folder that a run writes to, and files that an earlier run has left there.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "insonify/picture.h"
#include "insonify/scenario.h"

namespace insonify {

/// The requested folder, or the scenario's name + "_pings"; it need not exist yet.
/// @throws Error if it cannot be made or written to. Checked before the world is loaded, which can take long.
[[nodiscard]] std::filesystem::path output_folder(const std::filesystem::path& chosen,
                                                  const std::filesystem::path& scenario);

/// @throws Error
void make_output_folder(const std::filesystem::path& folder);

/// Refuses to replace recordings and pictures that an earlier run has made for the scenario's sonars.
/// @param endings  Of the recordings that are to be made, with their dots.
/// @throws InputError with the first such file and the options that apply.
void refuse_earlier_run(const std::filesystem::path& folder, const Scenario& scenario,
                        const std::vector<std::string>& endings);

/// Recordings of the scenario's sonars, in alphabetical order, that a run in this folder has not finished: it was
/// killed, or is still running.
[[nodiscard]] std::vector<std::filesystem::path> unfinished_recordings(const std::filesystem::path& folder,
                                                                       const Scenario& scenario,
                                                                       const std::vector<std::string>& endings);

/// Refuses to replace pictures of one sonar.
/// @throws InputError as above.
void refuse_earlier_pictures(const std::filesystem::path& folder, const std::string& sonar);

/// Receives the pictures of a run. If the folder has pictures of an earlier run of the same sonars, new ones go to a
/// subfolder, pictures.new.XXXXXX, until put_in_place(), so that a failing run leaves the earlier pictures as they are.
class PictureFolder {
 public:
  /// @param sonars  Names; a sonar's pictures begin with its name.
  PictureFolder(std::filesystem::path folder, std::vector<std::string> sonars);
  /// Removes new pictures that have not been put in place.
  ~PictureFolder();
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

  /// Writes a picture.
  /// @return  Its path once it is in place.
  std::filesystem::path write(const std::string& file, const Picture& picture);
  std::filesystem::path write(const std::string& file, const NumberPicture& picture, int bits);

  /// Removes the new pictures.
  void discard();

  /// Removes the pictures of the earlier run and puts the new ones in their place.
  /// @return  Number of pictures removed.
  std::size_t put_in_place();

 private:
  std::filesystem::path wrote(const std::string& file);
  [[nodiscard]] const std::filesystem::path& place() const { return collected_.empty() ? folder_ : collected_; }

  std::filesystem::path folder_;
  std::vector<std::string> sonars_;
  std::filesystem::path collected_;  // Empty if pictures are written directly into the folder.
  std::vector<std::string> written_;
};

}  // namespace insonify
