// sdf_sonars.cpp -- looks for sonars in models and links.

#include "io/sdf/sdf_sonars.h"

#include <fmt/format.h>

#include <functional>
#include <map>
#include <sdf/Element.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/World.hh>
#include <sstream>

#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/sdf/sdf_file.h"
#include "io/sdf/sdf_material.h"
#include "io/sdf/sdf_poses.h"

namespace insonify {
namespace {

std::string name_of(const sdf::ElementPtr& element) {
  return element->HasAttribute("name") ? element->GetAttribute("name")->GetAsString() : "";
}

// The elements of sonars directly in a link or model.
std::vector<sdf::ElementPtr> sonars_in(const sdf::ElementPtr& carrier) {
  std::vector<sdf::ElementPtr> sonars;
  for (const auto& [element, name] : insonify_elements(carrier)) {
    if (name == "sonar") {
      sonars.push_back(element);
    }
  }
  return sonars;
}

// "x y z roll pitch yaw", metres and radians.
Pose pose_in(const sdf::ElementPtr& element, const std::string& where) {
  std::istringstream words(sdf_text(element));
  words.imbue(std::locale::classic());
  double values[6] = {};
  for (double& value : values) {
    if (!(words >> value)) {
      throw Error(fmt::format("{}: <pose> = '{}' must be 6 numbers", where, printable(sdf_text(element))));
    }
  }
  return {Vec3(values[0], values[1], values[2]), orientation_from_rpy(values[3], values[4], values[5])};
}

// Reads the sonars of one file.
class Reader {
 public:
  explicit Reader(const SdfSource& source) : source_(source) {}

  void read(const sdf::Model& model, const std::string& scope, const Pose& world_from_model);
  [[nodiscard]] std::vector<SdfSonar> take() { return std::move(sonars_); }

 private:
  [[nodiscard]] Place place(const sdf::ElementPtr& sonar, const sdf::ElementPtr& holder) const;
  void add(const sdf::ElementPtr& element, const sdf::ElementPtr& holder, const std::string& carrier,
           const Pose& world_from_carrier);

  const SdfSource& source_;
  std::vector<SdfSonar> sonars_;
};

// @param holder  The link or model that holds it.
Place Reader::place(const sdf::ElementPtr& sonar, const sdf::ElementPtr& holder) const {
  return holder->LineNumber() ? source_.place_within(holder->FilePath(), *holder->LineNumber(), holder->GetName(),
                                                     name_of(holder), sonar->GetName(), name_of(sonar))
                              : Place{source_.shown(holder->FilePath())};
}

void Reader::add(const sdf::ElementPtr& element, const sdf::ElementPtr& holder, const std::string& carrier,
                 const Pose& world_from_carrier) {
  SdfSonar sonar{.name = name_of(element),
                 .carrier = carrier,
                 .world_from_carrier = world_from_carrier,
                 .carrier_from_sonar = {},
                 .settings = {},
                 .place = place(element, holder)};
  const std::string where = fmt::format("{}sonar '{}'", sonar.place.text(), printable(sonar.name));
  for (sdf::ElementPtr child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    const std::string key = without_sdf_prefix(child->GetName());
    if (key == "pose") {
      sonar.carrier_from_sonar = pose_in(child, where);
    } else if (key == "position" || key == "orientation_deg" || key == "name") {
      throw Error(fmt::format("{}: <{}> is written as {}", where, key, key == "name" ? "an attribute" : "<pose>"));
    } else if (key != "link") {
      sonar.settings.emplace_back(key, sdf_text(child));
    }
  }
  sonars_.push_back(std::move(sonar));
}

// An undefined pose is an error only when the scene is read, or if it has a sonar.
template <typename Part>
Pose resolved(const Part& part, const std::string& what) {
  sdf_math::Pose3d pose;
  const sdf::Errors errors = part.SemanticPose().Resolve(pose);
  if (!errors.empty()) {
    throw Error(fmt::format("{}: its pose cannot be worked out: {}", what, foreign_reason(errors.front().Message())));
  }
  return pose_of(pose);
}

void Reader::read(const sdf::Model& model, const std::string& scope, const Pose& world_from_model) {
  const std::string name = scope + model.Name();
  std::map<std::string, Pose> links;
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link& link = *model.LinkByIndex(i);
    const std::string what = fmt::format("link '{}'", printable(name + "::" + link.Name(), kLongestName));
    const Pose world_from_link = world_from_model * resolved(link, what);
    links[link.Name()] = world_from_link;
    for (const sdf::ElementPtr& sonar : sonars_in(link.Element())) {
      add(sonar, link.Element(), name + "::" + link.Name(), world_from_link);
    }
  }
  for (const sdf::ElementPtr& sonar : sonars_in(model.Element())) {
    const std::string link = sonar->HasElement("link") ? sdf_text(sonar->GetElement("link")) : "";
    const auto found = links.find(link);
    if (!link.empty() && found == links.end()) {
      throw Error(fmt::format("{}sonar '{}': <link> = '{}' is not a link of the model {}",
                              place(sonar, model.Element()).text(), printable(name_of(sonar)), printable(link),
                              printable(name, kLongestName)));
    }
    add(sonar, model.Element(), link.empty() ? name : name + "::" + link,
        link.empty() ? world_from_model : found->second);
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    const sdf::Model& inner = *model.ModelByIndex(i);
    read(inner, name + "::",
         world_from_model * resolved(inner, fmt::format("model '{}'", printable(name + "::" + inner.Name()))));
  }
}

}  // namespace

std::vector<SdfSonar> load_sdf_sonars(const std::filesystem::path& path, const Log& log) {
  const auto lock = lock_sdf();
  MissingParts missing;  // Reported when the scene is read.
  const SdfFile parsed = read_sdf_file(path, {}, missing, log);
  Reader reader(*parsed.source);
  const auto read = [&](const sdf::Model& model, const std::map<std::string, Pose>& saved) {
    const auto found = saved.find(model.Name());
    reader.read(
        model, "",
        found == saved.end() ? resolved(model, fmt::format("model '{}'", printable(model.Name()))) : found->second);
  };
  for (std::uint64_t w = 0; w < parsed.root.WorldCount(); ++w) {
    const sdf::World& world = *parsed.root.WorldByIndex(w);
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      read(*world.ModelByIndex(i), sdf_saved_poses(world));
    }
  }
  if (parsed.root.Model() != nullptr) {
    read(*parsed.root.Model(), {});
  }
  return reader.take();
}

}  // namespace insonify
