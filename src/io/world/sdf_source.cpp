// sdf_source.cpp -- resolves includes and writes copies in which they are absolute.

#include "io/world/sdf_source.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sdf/parser.hh>
#include <set>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/file/xml_scan.h"
#include "io/world/sdf_check.h"
#include "io/world/sdf_console.h"
#include "io/world/sdf_uri.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

// What libsdformat 12 is made for.
constexpr std::pair kOldest{1, 5}, kNewest{1, 9};

// A stretch of text and what to put in its place.
struct Edit {
  std::size_t begin, end;
  std::string text;
};

std::string apply_edits(const std::string& text, const std::vector<Edit>& edits) {
  std::string result;
  std::size_t at = 0;
  for (const Edit& edit : edits) {
    const std::string old = text.substr(edit.begin, edit.end - edit.begin);
    result += text.substr(at, edit.begin - at) + edit.text;
    result.append(static_cast<std::size_t>(std::count(old.begin(), old.end(), '\n')), '\n');  // keeps lines in place
    at = edit.end;
  }
  return result + text.substr(at);
}

void check_root(const XmlTag& root, const std::string& shown, const Log& log) {
  const std::string where = root.where(shown);
  if (root.name != "sdf") {
    throw Error(fmt::format("{}the root element is <{}>, not <sdf>{}", where, printable(root.name),
                            root.name == "robot" ? "; 'gz sdf -p' or 'ign sdf -p' turns URDF into SDF" : ""));
  }
  if (!root.attributes.contains("version")) {
    throw Error(where + "<sdf> has no version, 1.5 to 1.9 are read");
  }
  const std::string version = root.attribute("version");
  int major = 0, minor = 0, length = 0;
  if (std::sscanf(version.c_str(), "%d.%d%n", &major, &minor, &length) != 2 ||
      length != static_cast<int>(version.size())) {
    throw Error(fmt::format("{}SDF version '{}' is not two numbers, 1.5 to 1.9 are read", where, printable(version)));
  }
  const auto number = std::pair(major, minor);
  if (number < kOldest) {
    log_line(log, Severity::kWarning,
             fmt::format("{}SDF version {} is older than {}.{}, the oldest that is known to be read right", where,
                         printable(version), kOldest.first, kOldest.second));
  } else if (number > kNewest) {
    log_line(log, Severity::kWarning,
             fmt::format("{}SDF version {} is newer than {}.{} and read as that; what is new in it is "
                         "left out",
                         where, printable(version), kNewest.first, kNewest.second));
  }
}

// What a model.config lists for the newest version that is known; nothing where it makes no sense.
fs::path listed_file(const fs::path& folder) {
  const SdfConsole quiet;
  try {
    return sdf::getModelFilePath(folder.string());
  } catch (const std::exception&) {  // of a version that is no number
    return {};
  }
}

// The file that an include names: a model's folder stands for the file that its model.config lists, or its model.sdf.
std::optional<fs::path> file_of_model(const fs::path& found) {
  if (!fs::is_directory(found)) {
    return found;
  }
  const bool is_listed = fs::exists(found / "model.config") || fs::exists(found / "manifest.xml");
  const fs::path file = is_listed ? listed_file(found) : found / "model.sdf";
  return fs::is_regular_file(file) ? std::optional(file.lexically_normal()) : std::nullopt;
}

// Whether an element says nothing about shapes and places.
bool is_beside_the_point(const XmlTag& tag, const XmlTag& parent) {
  static const std::set<std::pair<std::string, std::string>> kLeftOut = {
      {"visual", "material"}, {"collision", "surface"}, {"link", "inertial"},
      {"link", "sensor"},     {"link", "light"},        {"link", "particle_emitter"},
      {"joint", "sensor"},    {"world", "light"},       {"world", "physics"},
      {"world", "gui"},       {"world", "scene"},       {"world", "actor"},
      {"state", "light"},     {"state", "insertions"},  {"state", "deletions"},
      {"sdf", "light"},       {"sdf", "actor"}};
  return kLeftOut.contains({parent.name, tag.name});
}

// The <uri> of an <include> in a place where includes may be.
bool is_include_uri(const std::vector<XmlTag>& tags, const XmlTag& tag) {
  static const std::set<std::string> kParents = {"sdf", "world", "model"};
  if (tag.name != "uri" || tags[tag.parent].name != "include") {
    return false;
  }
  const int place = tags[tag.parent].parent;
  return place >= 0 && kParents.contains(tags[place].name);
}

// libsdformat keeps one model of a file's root; a world keeps all.
std::vector<Edit> world_around_models(const std::vector<XmlTag>& tags) {
  int models = 0, worlds = 0;
  for (const XmlTag& tag : tags) {
    models += tag.parent == 0 && (tag.name == "model" || tag.name == "include") ? 1 : 0;
    worlds += tag.parent == 0 && tag.name == "world" ? 1 : 0;
  }
  if (models < 2 || worlds > 0) {
    return {};
  }
  const XmlTag& root = tags[0];
  return {{root.content_begin, root.content_begin, "<world name='world_of_models'>"},
          {root.content_end, root.content_end, "</world>"}};
}

}  // namespace

SdfSource::SdfSource(const fs::path& file, const Log& log) : file_(file) {
  prepare(fs::absolute(file).lexically_normal(), log);
}

SdfSource::~SdfSource() {
  if (!scratch_.empty()) {
    std::error_code ignored;
    fs::remove_all(scratch_, ignored);
  }
}

std::string SdfSource::original(const std::string& path) const {
  const auto entry = originals_.find(path);
  return entry == originals_.end() ? path : entry->second;
}

std::string SdfSource::shown(const std::string& path) const {
  const std::string whole = original(path);
  return whole == fs::absolute(file_).lexically_normal() ? file_.string() : whole;
}

std::string SdfSource::place(const std::string& path, int line, const std::string& element,
                             const std::string& name) const {
  const auto file = tags_.find(original(path));
  const XmlTag* found = nullptr;
  int candidates = 0;
  if (file != tags_.end()) {
    for (const XmlTag& tag : file->second) {
      if (tag.line == line && tag.name == element) {
        const bool is_better = found == nullptr || (found->attribute("name") != name && tag.attribute("name") == name);
        found = is_better ? &tag : found;
        ++candidates;
      }
    }
  }
  const bool is_certain = candidates == 1 || (found != nullptr && found->attribute("name") == name);
  return is_certain ? found->where(shown(path)) : fmt::format("{}:{}: ", shown(path), line);
}

std::string SdfSource::place_of_name(const std::string& name) const {
  for (auto file = files_.rbegin(); file != files_.rend(); ++file) {
    for (const XmlTag& tag : tags_.at(original(*file))) {
      if (std::ranges::any_of(tag.attributes, [&](const auto& attribute) { return attribute.second == name; })) {
        return tag.where(shown(*file));
      }
    }
  }
  return "";
}

std::string SdfSource::write_copy(const std::string& text, const std::string& original) {
  if (scratch_.empty()) {
    std::error_code failure;
    const fs::path folder = fs::temp_directory_path(failure);
    std::string name = folder / "insonify-sdf-XXXXXX";
    if (failure || mkdtemp(name.data()) == nullptr) {
      throw Error(fmt::format("{}: cannot be read: TMPDIR, or /tmp, is no folder to put a copy in", shown(original)));
    }
    scratch_ = name;
  }
  std::string copy = scratch_ / fmt::format("{}.sdf", originals_.size());
  std::ofstream stream(copy, std::ios::binary);
  stream << text;
  if (!stream.flush()) {
    throw Error(fmt::format("{}: the copy of an SDF file cannot be written", copy));
  }
  originals_[copy] = original;
  return copy;
}

// Gives the path that is to stand in an <include>.
std::string SdfSource::resolve_include(const std::string& uri, const fs::path& file, const XmlTag& tag,
                                       const Log& log) {
  const std::string where = fmt::format("{}include '{}'", tag.where(shown(file.string())), printable(uri));
  const std::optional<fs::path> found = find_sdf_uri(uri, file);
  if (!found) {
    throw Error(where + " " + sdf_uri_not_found(uri));
  }
  const std::optional<fs::path> model = file_of_model(*found);
  if (!model) {
    throw Error(
        fmt::format("{}: {} holds no model.sdf, nor a model.config that names a file in it", where, found->string()));
  }
  const auto known = ready_.find(model->string());
  if (known == ready_.end()) {
    return prepare(*model, log);
  }
  if (!known->second) {
    throw Error(where + " includes itself");
  }
  return *known->second;
}

// Gives the path that libsdformat is to read in the file's place.
std::string SdfSource::prepare(const fs::path& file, const Log& log) {
  const std::string name = file.string();
  const std::string text = read_text(shown(name));
  const std::vector<XmlTag>& tags = tags_[name] = scan_xml(text, shown(name));
  check_root(tags[0], shown(name), log);
  ready_[name] = std::nullopt;

  std::vector<Edit> edits = world_around_models(tags);
  std::size_t left_out_to = 0;
  for (std::size_t i = 1; i < tags.size(); ++i) {
    const XmlTag& tag = tags[i];
    if (tag.begin < left_out_to) {
      continue;
    }
    check_sdf_tag(tags, i, text, shown(name));
    if (is_beside_the_point(tag, tags[tag.parent])) {
      left_out_to = tag.end;
      edits.push_back({tag.begin, tag.end, ""});
      if (tag.name == "actor") {
        log_line(log, Severity::kWarning, tag.where(shown(name)) + "an actor is left out");
      }
    } else if (is_include_uri(tags, tag)) {
      const std::string uri = content_of(tag, text);
      const std::string path = resolve_include(uri, file, tag, log);
      if (path != uri) {
        edits.push_back({tag.content_begin, tag.content_end, xml_encode(path)});
      }
    }
  }

  std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
  std::string to_read = edits.empty() ? name : write_copy(apply_edits(text, edits), name);
  ready_[name] = to_read;
  files_.push_back(to_read);
  return to_read;
}

}  // namespace insonify
