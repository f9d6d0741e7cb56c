// stonefish_source.h -- a Stonefish scenario with the files that it includes.

#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "io/file/missing_parts.h"
#include "io/stonefish/stonefish_element.h"

namespace insonify {

/// Largest number of included files; one included twice counts twice.
inline constexpr int kMostStonefishIncludes = 1000;
/// Largest length of an attribute after replacing arguments [bytes].
inline constexpr std::size_t kLongestStonefishAttribute = 4096;

/// Reads a scenario, replaces each <include> by its file's contents, $(arg ...) by the include's arguments or the
/// user's, $(param ...) by the user's and $(find ...) by the package's folder.
class StonefishSource {
 public:
  /// @param arguments  The user's: "px=8". The name of a parameter may be the last part of its path.
  /// @param missing    Receives included files that are missing or unreadable, which are skipped.
  /// @throws Error for a file that is missing, not XML or not a scenario, for one that includes itself, and for more
  /// than the limits above or Budget allows.
  StonefishSource(const std::filesystem::path& file, std::span<const std::string> arguments, MissingParts& missing);

  /// The elements inside <scenario>, those of included files after those of the file itself.
  [[nodiscard]] const std::vector<StonefishElement>& elements() const { return elements_; }

 private:
  using Arguments = std::map<std::string, std::string>;
  void read(const std::shared_ptr<const XmlFile>& file, const std::filesystem::path& path, const Arguments& arguments);
  void include(const StonefishElement& element);
  [[nodiscard]] Arguments arguments_of(const StonefishElement& include) const;

  Arguments given_;
  MissingParts& missing_;
  std::vector<StonefishElement> elements_;
  std::set<std::filesystem::path> open_;
  int included_ = 0;
  double nodes_ = 0;  // Elements of all files so far: the budget's nodes, see XmlFile.
};

}  // namespace insonify
