// sdf_source.h -- an SDF file with everything that it includes found beforehand.

#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "insonify/log.h"
#include "io/file/xml_file.h"

namespace insonify {

/// Makes an SDF file and the files it includes ready for libsdformat.
///
/// libsdformat looks for included files in the current folder first and knows no path relative to the including file.
/// So every <include> is resolved here (sdf_uri.h). What has no shape (looks, lights, sensors, physics) is taken out,
/// so that its faults do not matter. Several models at the root, of which libsdformat keeps one, are put into a world.
/// A file in which something changed is read from a copy in a scratch folder that lives as long as this object; its
/// lines are not those of the file, place() finds those again.
class SdfSource {
 public:
  /// @param log  Told of versions newer than 1.9 and of actors, which are left out.
  /// @throws Error for files that are missing, not XML, not SDF or include themselves, and for what check_sdf_element()
  /// finds.
  SdfSource(const std::filesystem::path& file, const Log& log);
  ~SdfSource();
  SdfSource(const SdfSource&) = delete;
  SdfSource& operator=(const SdfSource&) = delete;

  /// What libsdformat is to read, innermost includes first, the file itself last. Absolute.
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

  /// The file that stands behind one of files(), absolute; any other path as it is.
  [[nodiscard]] std::string original(const std::string& path) const;

  /// The same as the user knows it, for messages.
  [[nodiscard]] std::string shown(const std::string& path) const;

  /// "path:line:column: " of an element in one of files(), as far as its line there, its kind and its name tell it from
  /// others; else "path:line: ", or "path: " for one that is not in the user's file.
  [[nodiscard]] std::string place(const std::string& path, int line, const std::string& element,
                                  const std::string& name = "") const;

  /// "path:line:column: " of the first element of which an attribute says `name`, the file itself before its includes;
  /// "" when there is none.
  [[nodiscard]] std::string place_of_name(const std::string& name) const;

 private:
  // A file as the user wrote it, less what was left out, and its elements by the line at which libsdformat reads them.
  struct Source {
    explicit Source(XmlFile file) : xml(std::move(file)) {}
    XmlFile xml;
    std::multimap<int, pugi::xml_node> lines;
  };

  std::string prepare(const std::filesystem::path& file, const Log& log);
  bool prepare_inside(pugi::xml_node parent, const XmlFile& xml, const std::filesystem::path& file, const Log& log);
  std::string resolve_include(const std::string& uri, const std::filesystem::path& file, const std::string& place,
                              const Log& log);
  std::string write_copy(const std::string& text, const std::string& original);

  std::filesystem::path file_;
  std::filesystem::path scratch_;
  std::vector<std::string> files_;
  std::map<std::string, std::string> originals_;             // copy -> original
  std::map<std::string, std::unique_ptr<Source>> sources_;   // by original
  std::map<std::string, std::optional<std::string>> ready_;  // original -> what to read; nothing while it is prepared
};

}  // namespace insonify
