// sdf_source.cpp -- resolves includes and writes copies of SDF files with absolute paths.

#include "io/world/sdf_source.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sdf/parser.hh>
#include <set>
#include <sstream>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/world/sdf_check.h"
#include "io/world/sdf_console.h"
#include "io/world/sdf_fuel.h"
#include "io/world/sdf_uri.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

// Versions of SDF that libsdformat 12 supports.
constexpr std::pair kOldest{1, 4}, kNewest{1, 9};

void check_root(const XmlFile& file, const Log& log) {
  const pugi::xml_node root = file.root();
  const std::string where = file.where(root);
  const std::string_view name = root.name();
  if (name != "sdf") {
    throw Error(fmt::format("{}the root element is <{}>, not <sdf>{}", where, printable(name),
                            name == "robot" ? "; 'gz sdf -p' or 'ign sdf -p' turns URDF into SDF" : ""));
  }
  if (!root.attribute("version")) {
    throw Error(where + "<sdf> has no version, 1.4 to 1.9 are read");
  }
  const std::string version = root.attribute("version").value();
  int major = 0, minor = 0, length = 0;
  if (std::sscanf(version.c_str(), "%d.%d%n", &major, &minor, &length) != 2 ||
      length != static_cast<int>(version.size())) {
    throw Error(fmt::format("{}SDF version '{}' is not two numbers, 1.4 to 1.9 are read", where, printable(version)));
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

// The file that a model.config lists for the newest known version; an empty path if it is malformed.
fs::path listed_file(const fs::path& folder) {
  const SdfConsole quiet;
  try {
    return sdf::getModelFilePath(folder.string());
  } catch (const std::exception&) {  // Thrown for a version that is not a number.
    return {};
  }
}

// The SDF file for a path that an include names. For a model's folder this is the file listed in its model.config, or
// its model.sdf.
std::optional<fs::path> file_of_model(const fs::path& found) {
  if (!fs::is_directory(found)) {
    return found;
  }
  const bool is_listed = fs::exists(found / "model.config") || fs::exists(found / "manifest.xml");
  const fs::path file = is_listed ? listed_file(found) : found / "model.sdf";
  return fs::is_regular_file(file) ? std::optional(file.lexically_normal()) : std::nullopt;
}

// Whether an element has no influence on shapes and places.
bool is_irrelevant(pugi::xml_node element) {
  static const std::set<std::pair<std::string, std::string>> kLeftOut = {
      {"visual", "material"}, {"collision", "surface"}, {"link", "inertial"},
      {"link", "sensor"},     {"link", "light"},        {"link", "particle_emitter"},
      {"joint", "sensor"},    {"world", "light"},       {"world", "physics"},
      {"world", "gui"},       {"world", "scene"},       {"world", "actor"},
      {"state", "light"},     {"state", "insertions"},  {"state", "deletions"},
      {"sdf", "light"},       {"sdf", "actor"}};
  return kLeftOut.contains({element.parent().name(), element.name()});
}

// Whether an element is an <include> where one may be.
bool is_include(pugi::xml_node element) {
  static const std::set<std::string_view> kParents = {"sdf", "world", "model"};
  return element.name() == std::string_view("include") && kParents.contains(element.parent().name());
}

// Whether a file holds lights or actors, and nothing else.
bool holds_only_lights(pugi::xml_node root) {
  const auto elements = root.children();
  const auto is_one = [](pugi::xml_node node) {
    return node.type() != pugi::node_element || node.name() == std::string_view("light") ||
           node.name() == std::string_view("actor");
  };
  return (root.child("light") || root.child("actor")) && std::all_of(elements.begin(), elements.end(), is_one);
}

// Whether a pose, a frame or a placement may stand relative to something of this name, scoped or not.
bool is_frame_of_another(pugi::xml_node root, std::string_view name) {
  const auto names_it = [&](std::string_view text) {
    const std::size_t colons = text.rfind("::");
    return (colons == std::string_view::npos ? text : text.substr(colons + 2)) == name;
  };
  const pugi::xml_node found = root.find_node([&](pugi::xml_node node) {
    for (const char* attribute : {"relative_to", "attached_to", "placement_frame", "frame"}) {
      if (names_it(node.attribute(attribute).value())) {
        return true;
      }
    }
    return node.name() == std::string_view("placement_frame") && names_it(xml_text(node));
  });
  return found;
}

// Whether an element is a visual's look whose name says that it is water, as "UUVSimulator/StaticWater".
bool paints_water(pugi::xml_node element) {
  std::string name = xml_text(element.child("script").child("name"));
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  return element.name() == std::string_view("material") && element.parent().name() == std::string_view("visual") &&
         name.find("water") != std::string::npos;
}

// libsdformat refuses a model without a link that is not static; one whose included models are missing has none.
void keep_empty_model_readable(pugi::xml_node parent) {
  if (parent.name() == std::string_view("model") && !parent.child("link") && !parent.child("model") &&
      !parent.child("include")) {
    parent.remove_child("static");
    parent.append_child("static").text() = "true";
  }
}

// Puts several models at the root into a world, because libsdformat reads only one model at the root. Returns whether
// it did.
bool put_world_around_models(pugi::xml_node root) {
  const auto count = [&](const char* name) {
    const auto children = root.children(name);
    return std::distance(children.begin(), children.end());
  };
  if (count("model") + count("include") < 2 || count("world") > 0) {
    return false;
  }
  pugi::xml_node world = root.append_child("world");
  world.append_attribute("name") = "world_of_models";
  while (root.first_child() != world) {
    world.append_move(root.first_child());
  }
  return true;
}

// All elements in document order.
std::vector<pugi::xml_node> elements_of(const XmlFile& file) {
  std::vector<pugi::xml_node> elements{file.root()};
  file.root().find_node([&](pugi::xml_node node) {
    if (node.type() == pugi::node_element) {
      elements.push_back(node);
    }
    return false;
  });
  return elements;
}

std::string text_of(const XmlFile& file) {
  std::ostringstream text;
  file.root().print(text, " ", pugi::format_default, pugi::encoding_utf8);
  return text.str();
}

}  // namespace

SdfSource::SdfSource(const fs::path& file, bool joints, SdfMissing& missing, const Log& log)
    : file_(file), joints_(joints), missing_(missing), log_(log) {
  const std::string whole = fs::absolute(file).lexically_normal().string();
  open(whole);
  prepare(whole);
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

Place SdfSource::place(const std::string& path, int line, const std::string& element, const std::string& name) const {
  const auto file = sources_.find(original(path));
  if (file == sources_.end()) {
    return {shown(path)};
  }
  const Source& source = *file->second;
  pugi::xml_node found;
  int candidates = 0;
  const auto has_name = [&](pugi::xml_node node) { return node.attribute("name").value() == name; };
  for (auto [at, end] = source.lines.equal_range(line); at != end; ++at) {
    if (at->second.name() == element) {
      found = !found || (!has_name(found) && has_name(at->second)) ? at->second : found;
      ++candidates;
    }
  }
  const bool is_certain = candidates == 1 || (found && has_name(found));
  if (is_certain) {
    return source.xml.place(found);
  }
  const auto any = source.lines.find(line);
  return any == source.lines.end() ? Place{shown(path)} : Place{shown(path), source.xml.line_of(any->second)};
}

std::string SdfSource::place_of_name(const std::string& name) const {
  for (auto file = files_.rbegin(); file != files_.rend(); ++file) {
    const XmlFile& xml = sources_.at(original(*file))->xml;
    for (const pugi::xml_node element : elements_of(xml)) {
      if (element.find_attribute([&](pugi::xml_attribute attribute) { return attribute.value() == name; })) {
        return xml.where(element);
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

// Returns the absolute path that replaces the URI of an <include>; nothing for one to leave out.
std::optional<std::string> SdfSource::resolve_include(const std::string& uri, const fs::path& file,
                                                      const std::string& place) {
  const std::string where =
      fmt::format("{}include '{}'", place, printable(uri, is_fuel_uri(uri) ? kLongestName : kLongestQuote));
  const std::optional<fs::path> found =
      find_sdf_uri(uri, file, [](const fs::path& path) { return file_of_model(path).has_value(); });
  if (!found) {
    if (is_fuel_uri(uri)) {
      missing_.add_fuel(where, " " + sdf_uri_not_found(uri), fuel_model_uri(uri));
    } else {
      missing_.add(where, " " + sdf_uri_not_found(uri));
    }
    return std::nullopt;
  }
  const std::optional<fs::path> model = file_of_model(*found);
  if (!model) {
    missing_.add(where,
                 fmt::format(": {} holds no model.sdf, nor a model.config that names a file in it", found->string()));
    return std::nullopt;
  }
  const std::string name = model->string();
  if (!ready_.contains(name)) {
    try {
      open(name);
    } catch (const Error& error) {
      missing_.add(where, fmt::format(": {}", error.what()));
      return std::nullopt;
    }
    return prepare(name);
  }
  if (ready_.at(name).state == Ready::kBegun) {
    throw Error(where + " includes itself");
  }
  return ready_.at(name).file;
}

// Resolves the URI of an <include>, or removes the whole element. Returns whether it changed the tree.
bool SdfSource::prepare_include(pugi::xml_node include, const XmlFile& xml, const fs::path& file) {
  pugi::xml_node element = include.child("uri");
  if (!element) {
    return false;  // libsdformat says so.
  }
  const std::string uri = xml_text(element);
  const std::optional<std::string> path = resolve_include(uri, file, xml.where(element));
  if (!path) {
    pugi::xml_node parent = include.parent();
    parent.remove_child(include);
    keep_empty_model_readable(parent);
    return true;
  }
  if (*path == uri) {
    return false;
  }
  element.remove_children();
  element.text() = path->c_str();
  return true;
}

// Checks the elements inside `parent`, removes irrelevant ones and resolves includes. Returns whether it changed the
// tree.
bool SdfSource::prepare_inside(pugi::xml_node parent, const XmlFile& xml, const fs::path& file) {
  bool changed = false;
  for (pugi::xml_node child = parent.first_child(), next; child; child = next) {
    next = child.next_sibling();
    if (child.type() != pugi::node_element) {
      continue;
    }
    if (!joints_ && child.name() == std::string_view("joint") &&
        !is_frame_of_another(xml.root(), child.attribute("name").value())) {
      parent.remove_child(child);
      changed = true;
      continue;
    }
    check_sdf_element(xml, child);
    if (is_irrelevant(child)) {
      if (child.name() == std::string_view("actor")) {
        log_line(log_, Severity::kWarning, xml.where(child) + "an actor is left out");
      }
      if (paints_water(child)) {
        water_.insert(xml.where(parent));
      }
      parent.remove_child(child);
      changed = true;
      continue;
    }
    changed = prepare_inside(child, xml, file) || changed;
    if (is_include(child)) {
      changed = prepare_include(child, xml, file) || changed;
    }
  }
  return changed;
}

void SdfSource::open(const std::string& name) {
  auto source = std::make_unique<Source>(XmlFile(read_text(shown(name)), shown(name)));
  check_root(source->xml, log_);
  sources_[name] = std::move(source);
}

// Returns the path that libsdformat reads instead of a file that open() has read; nothing for an included file that
// holds no models.
std::optional<std::string> SdfSource::prepare(const std::string& name) {
  Source& source = *sources_.at(name);
  const bool is_included = !ready_.empty();
  const bool is_empty = is_included && holds_only_lights(source.xml.root());
  ready_[name] = {Ready::kBegun, std::nullopt};

  const bool changed_inside = prepare_inside(source.xml.root(), source.xml, name);
  if (is_empty) {
    ready_[name] = {Ready::kDone, std::nullopt};
    return std::nullopt;
  }
  const bool changed = put_world_around_models(source.xml.root()) || changed_inside;
  const std::string copy = changed ? text_of(source.xml) : "";
  const std::string to_read = changed ? write_copy(copy, name) : name;

  // libsdformat reports lines of the file that it reads. Those of a copy are found by parsing the copy.
  const std::vector<pugi::xml_node> elements = elements_of(source.xml);
  if (changed) {
    const XmlFile copied(copy, to_read);
    const std::vector<pugi::xml_node> copies = elements_of(copied);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      source.lines.emplace(copied.line_of(copies[i]), elements[i]);
    }
  } else {
    for (const pugi::xml_node element : elements) {
      source.lines.emplace(source.xml.line_of(element), element);
    }
  }
  ready_[name] = {Ready::kDone, to_read};
  files_.push_back(to_read);
  return to_read;
}

}  // namespace insonify
