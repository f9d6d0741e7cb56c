// output_folder.cpp -- checks that the folder is writable, and recognises the files of a run by their names.

#include "pictures/output_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "console/outcome.h"
#include "insonify/files.h"

namespace insonify {
namespace {

constexpr std::string_view kUnfinished = ".new";

[[noreturn]] void refuse_folder(const std::filesystem::path& folder, std::error_code reason) {
  throw Error(fmt::format("{}: cannot make this folder: {}", folder.string(), reason.message()));
}

// Whether a file name is that of a run's picture, or of one left unfinished when a run was killed: "sonar_view.png",
// "sonar_fan_0003.png" with at least four digits, its mask "sonar_instance_fan_0003.png",
// "sonar_view.png.1f2e3d4c.new".
bool is_picture_of(const std::string& name, std::string_view file) {
  constexpr std::string_view kEnding = ".1f2e3d4c.new";
  if (file.ends_with(kUnfinished)) {
    file.remove_suffix(std::min(kEnding.size(), file.size()));
  }
  if (!file.starts_with(name + "_") || !file.ends_with(".png")) {
    return false;
  }
  std::string_view kind = file.substr(name.size() + 1, file.size() - name.size() - 5);
  for (const std::string_view mask : {"instance_", "material_"}) {
    kind.remove_prefix(kind.starts_with(mask) ? mask.size() : 0);
  }
  if (kind == "view" || kind == "channels" || kind == "scan" || kind == "polar") {
    return true;
  }
  const std::size_t digits = kind.size() - std::min(kind.find_last_not_of("0123456789") + 1, kind.size());
  kind.remove_suffix(digits);
  return digits >= 4 && (kind == "fan_" || kind == "scan_" || kind == "polar_");
}

// In alphabetical order.
std::vector<std::filesystem::path> pictures_in(const std::filesystem::path& folder,
                                               const std::vector<std::string>& sonars) {
  std::vector<std::filesystem::path> pictures;
  if (!std::filesystem::is_directory(folder)) {
    return pictures;
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (entry.is_regular_file() &&
        std::ranges::any_of(sonars, [&](const std::string& sonar) { return is_picture_of(sonar, file); })) {
      pictures.push_back(entry.path());
    }
  }
  std::ranges::sort(pictures);
  return pictures;
}

std::vector<std::filesystem::path> finished_pictures_in(const std::filesystem::path& folder,
                                                        const std::vector<std::string>& sonars) {
  std::vector<std::filesystem::path> pictures = pictures_in(folder, sonars);
  std::erase_if(pictures, [](const auto& picture) { return picture.string().ends_with(kUnfinished); });
  return pictures;
}

void refuse(const std::vector<std::filesystem::path>& files) {
  if (files.size() == 1) {
    throw InputError(
        fmt::format("{} exists already: --force replaces it, -o DIR writes to another folder", files.front().string()));
  }
  if (!files.empty()) {
    throw InputError(
        fmt::format("{} exists already, with {} more of an earlier run: --force replaces them, -o DIR writes to "
                    "another folder",
                    files.front().string(), files.size() - 1));
  }
}

void remove_picture(const std::filesystem::path& picture) {
  std::error_code error;
  std::filesystem::remove(picture, error);
  if (error) {
    throw Error(fmt::format("{}: cannot remove this picture of an earlier run: {}", picture.string(), error.message()));
  }
}

// Writes a file, or the names in a folder, to disk. Some file systems keep names in another way.
void sync(const std::filesystem::path& path) {
  const int opened = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) {
    return;
  }
  const bool failed = fsync(opened) != 0 && errno == EIO;
  close(opened);
  if (failed) {
    throw Error(fmt::format("{}: cannot write: {}", path.string(), std::generic_category().message(EIO)));
  }
}

}  // namespace

std::filesystem::path output_folder(const std::filesystem::path& chosen, const std::filesystem::path& scenario) {
  std::filesystem::path folder = chosen.empty() ? std::filesystem::path(scenario.stem().string() + "_pings") : chosen;
  std::filesystem::path there = std::filesystem::absolute(folder);
  std::error_code error;
  while (std::filesystem::status(there, error).type() == std::filesystem::file_type::not_found) {
    there = there.parent_path();
  }
  if (!std::filesystem::is_directory(there, error)) {
    refuse_folder(folder, error ? error : std::make_error_code(std::errc::not_a_directory));
  }
  if (access(there.c_str(), W_OK | X_OK) != 0) {
    const std::error_code reason(errno, std::generic_category());
    if (std::filesystem::exists(folder, error)) {
      throw Error(fmt::format("{}: cannot write into this folder: {}", folder.string(), reason.message()));
    }
    refuse_folder(folder, reason);
  }
  return folder;
}

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    refuse_folder(folder, error);
  }
  sync(std::filesystem::absolute(folder / "..").lexically_normal());
}

std::vector<std::filesystem::path> unfinished_recordings(const std::filesystem::path& folder, const Scenario& scenario,
                                                         const std::vector<std::string>& endings) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string file = entry->path().filename().string();
    const bool is_of_sonar = std::ranges::any_of(scenario.sonars, [&](const SonarConfig& sonar) {
      return std::ranges::any_of(
          endings, [&](const std::string& ending) { return file.starts_with(sonar.name + ending + "."); });
    });
    if (is_of_sonar && file.ends_with(kUnfinished)) {
      files.push_back(entry->path());
    }
  }
  std::ranges::sort(files);
  return files;
}

void refuse_earlier_pictures(const std::filesystem::path& folder, const std::string& sonar) {
  refuse(finished_pictures_in(folder, {sonar}));
}

void refuse_earlier_run(const std::filesystem::path& folder, const Scenario& scenario,
                        const std::vector<std::string>& endings) {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> sonars;
  for (const SonarConfig& sonar : scenario.sonars) {
    sonars.push_back(sonar.name);
    for (const std::string& ending : endings) {
      const std::filesystem::path recording = folder / (sonar.name + ending);
      std::error_code ignored;
      if (std::filesystem::is_regular_file(recording, ignored) || std::filesystem::is_symlink(recording, ignored)) {
        files.push_back(recording);
      }
    }
  }
  const std::vector<std::filesystem::path> pictures = finished_pictures_in(folder, sonars);
  files.insert(files.end(), pictures.begin(), pictures.end());
  refuse(files);
}

PictureFolder::PictureFolder(std::filesystem::path folder, std::vector<std::string> sonars)
    : folder_(std::move(folder)), sonars_(std::move(sonars)) {
  if (finished_pictures_in(folder_, sonars_).empty()) {
    return;
  }
  std::string name = (folder_ / "pictures.new.XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw Error(
        fmt::format("{}: cannot make a folder in it: {}", folder_.string(), std::generic_category().message(errno)));
  }
  collected_ = name;
}

PictureFolder::~PictureFolder() {
  if (!collected_.empty()) {
    std::error_code ignored;
    std::filesystem::remove_all(collected_, ignored);
  }
}

std::filesystem::path PictureFolder::write(const std::string& file, const Picture& picture) {
  write_png(place() / file, picture);
  return wrote(file);
}

std::filesystem::path PictureFolder::write(const std::string& file, const NumberPicture& picture, int bits) {
  write_png(place() / file, picture, bits);
  return wrote(file);
}

std::filesystem::path PictureFolder::wrote(const std::string& file) {
  written_.push_back(file);
  return folder_ / file;
}

void PictureFolder::discard() {
  for (const std::string& file : written_) {
    std::error_code ignored;
    std::filesystem::remove(place() / file, ignored);
  }
  written_.clear();
}

std::size_t PictureFolder::put_in_place() {
  for (const std::string& file : written_) {
    sync(place() / file);
  }
  std::size_t removed = 0;
  for (const std::filesystem::path& picture : pictures_in(folder_, sonars_)) {
    const bool is_new = std::ranges::find(written_, picture.filename().string()) != written_.end();
    if (!collected_.empty() || !is_new) {
      remove_picture(picture);
      ++removed;
    }
  }
  for (const std::string& file : collected_.empty() ? std::vector<std::string>() : written_) {
    std::error_code error;
    std::filesystem::rename(collected_ / file, folder_ / file, error);
    if (error) {
      throw Error(fmt::format("{}: cannot put this picture in place: {}", (folder_ / file).string(), error.message()));
    }
  }
  sync(folder_);
  return removed;
}

}  // namespace insonify
