// sdf_source.h -- prepares an SDF file and its includes for libsdformat.

#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "insonify/error.h"
#include "insonify/log.h"
#include "io/file/missing_parts.h"
#include "io/file/xml_file.h"
#include "io/mesh/mesh_read_ahead.h"
#include "io/sdf/sdf_check.h"
#include "io/sdf/sdf_portions.h"
#include "io/sdf/sdf_twins.h"

namespace insonify {

/// How a file is prepared.
struct SdfReading {
  bool joints = true;   ///< Whether joints are kept. They have no shape and can be removed, except those that are the
                        ///< frame of something else.
  bool strict = false;  ///< Whether a pose with too few numbers is an error; else it is completed.
  bool whole = false;   ///< Whether the file is read as a whole: without twins() and in one portion.
};

/// Prepares an SDF file and the files that it includes for libsdformat.
///
/// libsdformat looks for included files in the current folder first and supports no paths relative to the including
/// file, so every <include> is resolved here (sdf_uri.h). Elements without a shape (looks, lights, sensors, physics)
/// are removed, so that their faults do not matter; so are includes of files with nothing but lights or actors. Several
/// models at the root, of which libsdformat reads only one, are put into a world. A file that was changed is read from
/// a copy in memory (/proc/self/fd/9), which is gone with this object. place() maps the lines of a copy to those of the
/// file.
/// Worlds of many models are read in portions.
class SdfSource {
 public:
  /// @param without  "path:line:column: " of elements that are left out for their faults.
  /// @param missing  Receives included models that are not found or cannot be read, which are removed.
  /// @param log      Receives warnings about versions other than 1.4 to 1.9, about actors, which are skipped, and about
  ///                 poses with too few numbers.
  /// The last three must outlive this object.
  /// @throws Error for a world that takes libsdformat more than Budget::kMemory allows, for a file that is missing, not
  /// XML or not SDF, for files that include themselves, and for faults
  /// that check_sdf_element() finds.
  SdfSource(const std::filesystem::path& file, const SdfReading& reading, const std::set<std::string>& without,
            MissingParts& missing, const Log& log);
  ~SdfSource();
  SdfSource(const SdfSource&) = delete;
  SdfSource& operator=(const SdfSource&) = delete;

  /// The files that libsdformat reads with an include, innermost first. Absolute paths, as those of portions().
  [[nodiscard]] const std::vector<std::string>& includes() const { return includes_; }

  /// The file itself, in portions: each a world with some of its models.
  [[nodiscard]] const std::vector<std::string>& portions() const { return portions_; }

  /// Models of the file itself that were taken out of its world.
  [[nodiscard]] const SdfTwins& twins() const { return twins_; }

  /// Asks for the meshes of all visuals.
  void want_meshes(MeshReadAhead& ahead) const;

  /// The user's file that one of these is a copy of, absolute; any other path unchanged.
  [[nodiscard]] std::string original(const std::string& path) const;

  /// The same as the user named it, for messages.
  [[nodiscard]] std::string shown(const std::string& path) const;

  /// A text of libsdformat's with the user's files and lines in place of those of copies.
  [[nodiscard]] std::string with_users_places(std::string text) const;

  /// An element in one of these files, if its line there, its kind and its name identify it; else its line only, or the
  /// file only for an element that is not in the user's.
  [[nodiscard]] Place place(const std::string& path, int line, const std::string& element,
                            const std::string& name = "") const;

  /// An element within such an element, for which libsdformat has no line: one that it does not know. By its kind, its
  /// name, and the text of its attribute `name`; where it is not found, the place of the outer one.
  [[nodiscard]] Place place_within(const std::string& path, int line, const std::string& element,
                                   const std::string& name, const std::string& inner,
                                   const std::string& inner_name) const;

  /// The fault of such an element, with its place before the message.
  [[nodiscard]] SdfFault fault(const std::string& message, const std::string& path, int line,
                               const std::string& element) const;

  /// The fault of the only element with an attribute of the first of these values that there is. Where several have it,
  /// the first gives the place, the file itself before its includes; where none has any, the file at `path` does.
  [[nodiscard]] SdfFault fault(const std::string& message, const std::string& path,
                               const std::vector<std::string>& names) const;

  /// Whether the visual at a place, "path:line:column: ", has a look (a script in its <material>) that is named water.
  [[nodiscard]] bool is_water(const std::string& place) const { return water_.contains(place); }

  /// Alpha of the look of the visual at such a place; 1 if it has none.
  [[nodiscard]] double opacity(const std::string& place) const {
    const auto found = opacities_.find(place);
    return found == opacities_.end() ? 1 : found->second;
  }

 private:
  // How far the preparation of a file is, and the file to read instead: none where it holds no models.
  struct Ready {
    enum State { kBegun, kDone } state = kBegun;
    std::optional<std::string> file = {};
    std::size_t weight = 0;  // See weight_of().
  };
  // The tree of a user's file without the removed elements.
  struct Source {
    Source(XmlFile file, bool was_converted) : xml(std::move(file)), converted(was_converted) {}
    XmlFile xml;
    bool converted;  // From another encoding than UTF-8.
  };
  using Lines = std::multimap<int, pugi::xml_node>;

  void check_weight(std::size_t weight, const std::string& name) const;
  [[nodiscard]] pugi::xml_node find(const std::string& path, int line, const std::string& element,
                                    const std::string& name) const;
  [[nodiscard]] pugi::xml_node any_at(const std::string& path, int line) const;
  [[nodiscard]] std::size_t weight_of(pugi::xml_node element) const;
  std::string make_readable(const SdfPortion& portion, const Source& source, const std::string& name, bool copied);
  void open(const std::string& name);
  std::optional<std::string> prepare(const std::string& name);
  void note_left_out(pugi::xml_node element, const XmlFile& xml);
  bool prepare_inside(pugi::xml_node parent, const XmlFile& xml, const std::filesystem::path& file);
  bool prepare_include(pugi::xml_node include, const XmlFile& xml, const std::filesystem::path& file);
  std::optional<std::string> resolve_include(const std::string& uri, const std::filesystem::path& file,
                                             const std::string& place);
  std::string write_copy(const std::string& text, const std::string& original);

  std::filesystem::path file_;
  std::vector<int> copies_;  // Open files.
  std::vector<std::string> includes_, portions_;
  std::map<std::string, std::string> originals_;            // copy -> original
  std::map<std::string, std::unique_ptr<Source>> sources_;  // by original
  std::map<std::string, Lines> lines_;                      // by file read: elements of the originals
  std::map<std::string, Ready> ready_;                      // by original
  std::set<std::string> water_;                             // Places of visuals.
  std::map<std::string, double> opacities_;                 // By place, of those that are not opaque.
  SdfTwins twins_;
  SdfReading reading_;
  const std::set<std::string>& without_;
  MissingParts& missing_;
  const Log& log_;
};

}  // namespace insonify
