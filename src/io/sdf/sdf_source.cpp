// sdf_source.cpp -- resolves includes and writes copies of SDF files with absolute paths.

#include "io/sdf/sdf_source.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <memory>
#include <span>
#include <sstream>
#include <system_error>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/budgets.h"
#include "io/file/input_file.h"
#include "io/file/unfinished_file.h"
#include "io/sdf/sdf_check.h"
#include "io/sdf/sdf_elements.h"
#include "io/sdf/sdf_file.h"
#include "io/world/sdf_fuel.h"
#include "io/world/sdf_uri.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

std::string text_of(const XmlFile& file) {
  std::ostringstream text;
  file.root().print(text, " ", pugi::format_default, pugi::encoding_utf8);
  return text.str();
}

}  // namespace

SdfSource::SdfSource(const fs::path& file, const SdfReading& reading, const std::set<std::string>& without,
                     MissingParts& missing, const Log& log)
    : file_(file), reading_(reading), without_(without), missing_(missing), log_(log) {
  const std::string whole = fs::absolute(file).lexically_normal().string();
  open(whole);
  prepare(whole);
}

SdfSource::~SdfSource() {
  for (const int file : copies_) {
    close(file);
  }
}

void SdfSource::want_meshes(MeshReadAhead& ahead) const {
  const auto is_file = [](const fs::path& path) { return !fs::is_directory(path); };
  for (const auto& [name, source] : sources_) {
    for (const pugi::xpath_node& found : source->xml.root().select_nodes("//visual/geometry/mesh")) {
      const pugi::xml_node mesh = found.node(), submesh = mesh.child("submesh");
      const std::optional<fs::path> path = find_sdf_uri(xml_text(mesh.child("uri")), name, is_file);
      if (path && is_mesh_file(*path) && is_file(*path)) {
        ahead.want(*path, {xml_text(submesh.child("name")), submesh.child("center").text().as_bool()});
      }
    }
  }
}

// A file in memory: nothing is left of it, however the process ends.
std::string SdfSource::write_copy(const std::string& text, const std::string& original) {
  int file = memfd_create("insonify-sdf", MFD_CLOEXEC);
  if (file < 0 && errno == EMFILE) {  // A world may include more files than a shell allows at first.
    rlimit limit{};
    getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
    file = memfd_create("insonify-sdf", MFD_CLOEXEC);
  }
  if (file >= 0) {
    copies_.push_back(file);
  }
  if (file < 0 || !write_at(file, 0, std::as_bytes(std::span(text)))) {
    throw Error(
        fmt::format("{}: cannot be copied in memory: {}", shown(original), std::generic_category().message(errno)));
  }
  std::string copy = fmt::format("/proc/self/fd/{}", file);
  originals_[copy] = original;
  return copy;
}

// Returns the absolute path that replaces the URI of an <include>; nothing for one to skip.
std::optional<std::string> SdfSource::resolve_include(const std::string& uri, const fs::path& file,
                                                      const std::string& place) {
  const std::string where =
      fmt::format("{}include '{}'", place, printable(uri, is_fuel_uri(uri) ? kLongestName : kLongestQuote));
  const std::optional<fs::path> found =
      find_sdf_uri(uri, file, [](const fs::path& path) { return sdf_file_of_model(path).has_value(); });
  if (!found) {
    missing_.add(
        UnreadablePart(where, " " + sdf_uri_not_found(uri, file), is_fuel_uri(uri) ? fuel_model_uri(uri) : ""));
    return std::nullopt;
  }
  const std::optional<fs::path> model = sdf_file_of_model(*found);
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
    keep_empty_sdf_model_readable(parent);
    return true;
  }
  if (*path == uri) {
    return false;
  }
  element.remove_children();
  element.text() = path->c_str();
  return true;
}

// Reports what is missed in a scene, and keeps what it says about others.
void SdfSource::note_left_out(pugi::xml_node element, const XmlFile& xml) {
  if (element.name() == std::string_view("actor")) {
    log_line(log_, Severity::kWarning, xml.where(element) + "an actor is skipped");
  }
  if (paints_sdf_water(element)) {
    water_.insert(xml.where(element.parent()));
  }
  if (const double opacity = sdf_opacity(element); opacity < 1) {
    opacities_[xml.where(element.parent())] = opacity;
  }
  const pugi::xml_node surface = element.child("surface_model");
  const std::string name = xml_text(surface);
  if (element.name() == std::string_view("spherical_coordinates") && surface && name != "EARTH_WGS84") {
    log_line(
        log_, Severity::kWarning,
        fmt::format("{}<surface_model> = '{}' is not read: places are in metres", xml.where(surface), printable(name)));
  }
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
    const bool is_idle_joint = !reading_.joints && child.name() == std::string_view("joint") &&
                               !is_sdf_frame_of_another(xml.root(), child.attribute("name").value());
    if (is_idle_joint || is_irrelevant_sdf(child) || without_.contains(xml.where(child))) {
      note_left_out(child, xml);
      parent.remove_child(child);
      keep_empty_sdf_model_readable(parent);
      changed = true;
      continue;
    }
    warn_of_sdf_turn(xml, child, log_);
    changed = (!reading_.strict && complete_sdf_pose(xml, child, log_)) || changed;
    check_sdf_element(xml, child);
    changed = prepare_inside(child, xml, file) || changed;
    if (is_sdf_include(child)) {
      changed = prepare_include(child, xml, file) || changed;
    }
  }
  return changed;
}

void SdfSource::open(const std::string& name) {
  const std::string text = read_text(shown(name)), valid = xml_in_utf8(text);
  auto source = std::make_unique<Source>(XmlFile(valid, shown(name)), valid != text);
  check_sdf_version(source->xml, log_);
  sources_[name] = std::move(source);
}

// Number of elements in it, and in files that it includes, that libsdformat takes much memory for.
std::size_t SdfSource::weight_of(pugi::xml_node element) const {
  static const std::set<std::string_view> kHeavy = {"model", "link", "visual", "collision"};
  if (is_sdf_include(element)) {
    const auto included = ready_.find(original(xml_text(element.child("uri"))));
    return included == ready_.end() ? 1 : included->second.weight;
  }
  std::size_t sum = kHeavy.contains(element.name()) ? 1 : 0;
  for (const pugi::xml_node child : element.children()) {
    sum += weight_of(child);
  }
  return sum;
}

// libsdformat parses an included file each time that it is: 22 models that include each the next one twice, in 10 kB,
// would be 4 million.
// @param weight  Of what it reads at once.
void SdfSource::check_weight(std::size_t weight, const std::string& name) const {
  constexpr double kEach = 1e6, kShare = 3, kLeast = 2e9;  // [bytes]; of all memory; that every machine has [bytes].
  const double bytes = kEach * static_cast<double>(weight), most = std::max(budget(Budget::kMemory) / kShare, kLeast);
  if (bytes > most) {
    throw Error(
        fmt::format("{}: its models would take libsdformat some {:.3g} GB, more than {:.3g}; for a file that you "
                    "trust: INSONIFY_LIMITS=memory={:.0f}",
                    shown(name), bytes / 1e9, most / 1e9, bytes * kShare));
  }
}

// Returns the path where libsdformat reads a portion. It reports lines there; those of a copy are found by parsing it.
std::string SdfSource::make_readable(const SdfPortion& portion, const Source& source, const std::string& name,
                                     bool copied) {
  if (!copied) {
    for (const pugi::xml_node element : portion.elements) {
      lines_[name].emplace(source.xml.line_of(element), element);
    }
    return name;
  }
  const std::string text = portion.text.empty() ? text_of(source.xml) : portion.text;
  const std::string copy = write_copy(text, name);
  const XmlFile parsed(text, copy);
  const std::vector<pugi::xml_node> copies = whole_sdf(parsed.root()).elements;
  Lines& lines = lines_[copy];
  for (std::size_t i = 0; i < copies.size(); ++i) {
    lines.emplace(parsed.line_of(copies[i]), portion.elements[i]);
  }
  return copy;
}

// Makes what libsdformat reads instead of a file that open() has read. Returns the path of an included file; nothing
// for one that holds no models.
std::optional<std::string> SdfSource::prepare(const std::string& name) {
  Source& source = *sources_.at(name);
  const pugi::xml_node root = source.xml.root();
  const bool is_included = !ready_.empty();
  const bool is_empty = is_included && holds_only_sdf_lights(root);
  ready_[name] = {Ready::kBegun, std::nullopt};

  bool changed = prepare_inside(root, source.xml, name) || source.converted;
  if (is_empty) {
    ready_[name] = {Ready::kDone, std::nullopt};
    return std::nullopt;
  }
  changed = put_world_around_sdf_models(root) || changed;
  if (is_included) {
    const std::string file = make_readable(whole_sdf(root), source, name, changed);
    ready_[name] = {Ready::kDone, file, weight_of(root)};
    check_weight(ready_[name].weight, name);
    includes_.push_back(file);
    return file;
  }
  if (!reading_.whole) {
    twins_ = take_out_sdf_twins(root);
  }
  const auto weight = [this](pugi::xml_node model) { return weight_of(model); };
  const std::vector<SdfPortion> portions = reading_.whole ? std::vector{whole_sdf(root)} : sdf_portions(root, weight);
  changed = changed || !twins_.twins.empty() || portions.size() > 1;
  check_weight(portions.size() > 1 ? 0 : weight_of(root), name);
  for (const SdfPortion& portion : portions) {
    portions_.push_back(make_readable(portion, source, name, changed));
  }
  ready_[name].state = Ready::kDone;
  return std::nullopt;
}

}  // namespace insonify
