// sdf_sonars.cpp -- looks for sonars in models and links.

#include "io/sdf/sdf_sonars.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "insonify/printable.h"
#include "io/file/scene_folders.h"
#include "io/sdf/sdf_file.h"

namespace insonify {
namespace {

// "x y z roll pitch yaw", metres and radians.
Pose pose_in(const std::string& text, const std::string& where) {
  std::istringstream words(text);
  words.imbue(std::locale::classic());
  double values[6] = {};
  for (double& value : values) {
    if (!(words >> value)) {
      throw Error(fmt::format("{}: <pose> = '{}' must be 6 numbers", where, printable(text)));
    }
  }
  return {Vec3(values[0], values[1], values[2]), orientation_from_rpy(values[3], values[4], values[5])};
}

// Reads the sonars of one file.
class Reader {
 public:
  void read(const SdfModel& model, const std::string& scope, const Pose& world_from_model);
  [[nodiscard]] std::vector<SdfSonar> take() { return std::move(sonars_); }

 private:
  void add(const SdfSonarElement& element, const std::string& carrier, const Pose& world_from_carrier);

  std::vector<SdfSonar> sonars_;
};

void Reader::add(const SdfSonarElement& element, const std::string& carrier, const Pose& world_from_carrier) {
  SdfSonar sonar{.name = element.name,
                 .carrier = carrier,
                 .world_from_carrier = world_from_carrier,
                 .carrier_from_sonar = {},
                 .settings = {},
                 .place = element.place};
  const std::string where = fmt::format("{}sonar '{}'", sonar.place.text(), printable(sonar.name));
  for (const auto& [key, text] : element.children) {
    if (key == "pose") {
      sonar.carrier_from_sonar = pose_in(text, where);
    } else if (key == "position" || key == "orientation_deg" || key == "name") {
      throw Error(fmt::format("{}: <{}> is written as {}", where, key, key == "name" ? "an attribute" : "<pose>"));
    } else if (key != "link") {
      sonar.settings.emplace_back(key, text);
    }
  }
  sonars_.push_back(std::move(sonar));
}

// An undefined pose is an error only when the scene is read, or if it has a sonar.
Pose resolved(const SdfElement& element, const std::string& what) {
  if (!element.pose_fault.empty()) {
    throw Error(what + element.pose_fault);
  }
  return element.pose;
}

void Reader::read(const SdfModel& model, const std::string& scope, const Pose& world_from_model) {
  const std::string name = scope + model.name;
  std::map<std::string, Pose> links;
  for (const SdfLink& link : model.links) {
    const Pose world_from_link =
        world_from_model * resolved(link, fmt::format("link '{}'", printable(name + "::" + link.name, kLongestName)));
    links[link.name] = world_from_link;
    for (const SdfSonarElement& sonar : link.sonars) {
      add(sonar, name + "::" + link.name, world_from_link);
    }
  }
  for (const SdfSonarElement& sonar : model.sonars) {
    const auto named = std::ranges::find(sonar.children, "link", &std::pair<std::string, std::string>::first);
    const std::string link = named == sonar.children.end() ? "" : named->second;
    const auto found = links.find(link);
    if (!link.empty() && found == links.end()) {
      throw Error(fmt::format("{}sonar '{}': <link> = '{}' is not a link of the model {}", sonar.place.text(),
                              printable(sonar.name), printable(link), printable(name, kLongestName)));
    }
    add(sonar, link.empty() ? name : name + "::" + link, link.empty() ? world_from_model : found->second);
  }
  for (const SdfModel& inner : model.models) {
    read(inner, name + "::",
         world_from_model * resolved(inner, fmt::format("model '{}'", printable(name + "::" + inner.name))));
  }
}

}  // namespace

std::vector<SdfSonar> load_sdf_sonars(const std::filesystem::path& path, const Log& log) {
  const SceneFolders folders(path);
  const auto lock = lock_sdf();
  MissingParts missing;  // Reported when the scene is read.
  const SdfModels models = read_sdf_models(path, {}, missing, log);
  Reader reader;
  const auto read = [&](const SdfModel& model, const std::map<std::string, Pose>& saved) {
    const auto found = saved.find(model.name);
    reader.read(
        model, "",
        found == saved.end() ? resolved(model, fmt::format("model '{}'", printable(model.name))) : found->second);
  };
  for (const SdfWorld& world : models.worlds) {
    for (const SdfModel& model : world.models) {
      read(model, world.saved_poses);
    }
  }
  if (models.model) {
    read(*models.model, {});
  }
  return reader.take();
}

}  // namespace insonify
