// hostile_text_test.cpp -- text from files is escaped and shortened in messages, whatever it contains.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "insonify/files.h"
#include "insonify/printable.h"
#include "io/mesh_texts.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::hostile_text_test {
namespace {

struct HostileCase {
  const char* name;
  const char* file;
  std::string text;     // TEXT stands for the hostile text.
  std::string message;  // Likewise; the part in braces is shortened.
};

void PrintTo(const HostileCase& one, std::ostream* out) {
  *out << one.name;
}

// Clears the screen, rings the bell and reverses the writing direction; the last two characters are printable.
const std::string kControls = "\x1b[2J\x07\u202e水ü";
// Keys of YAML may have 1024 bytes.
const std::string kLong = "b" + std::string(900, 'x') + "e";

std::string with_text(std::string pattern, const std::string& text) {
  for (std::size_t at = pattern.find("TEXT"); at != std::string::npos; at = pattern.find("TEXT", at + text.size())) {
    pattern.replace(at, 4, text);
  }
  return pattern;
}

// Expected message for a hostile text: the part in braces is shown as printable() shows it, with the length limit of
// scoped names.
std::string message_with(const std::string& pattern, const std::string& text) {
  std::string message;
  for (std::size_t at = 0; at < pattern.size();) {
    const std::size_t open = std::min(pattern.find('{', at), pattern.size());
    const std::size_t close = std::min(pattern.find('}', open), pattern.size());
    message += pattern.substr(at, open - at);
    if (open < close) {
      const std::string shown = pattern.substr(open + 1, close - open - 1);
      const bool scoped = shown.starts_with("materials.");
      message += printable(with_text(shown, text), scoped ? kLongestName : kLongestQuote);
    }
    at = close + 1;
  }
  return message;
}

// Text in a YAML file: double-quoted, with escapes.
std::string in_yaml(const std::string& text) {
  const std::string quoted = nlohmann::json(text).dump(-1, ' ', true);
  return quoted.substr(1, quoted.size() - 2);
}

std::string dae_without_geometry() {
  return dae_text({.nodes = R"(<node id="n" name="corner"><instance_geometry url="#TEXT"/></node>)"});
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

class HostileTextTest : public testing::TestWithParam<HostileCase> {
 protected:
  // The error or, if there is none, the last message of the log.
  std::string message(const std::string& hostile) const {
    const std::filesystem::path file = GetParam().file;
    std::string logged;
    const Log log = [&](Severity, const std::string& line) { logged = line; };
    folder.write("floor.obj", kTriangle + "f 1 2 3\n");
    const bool is_yaml = file.extension() == ".yaml";
    folder.write(file.string(), with_text(GetParam().text, is_yaml ? in_yaml(hostile) : hostile));
    const std::string error = message_of([&] {
      if (is_yaml) {
        (void)load_scene(load_scenario(file), log);
      } else {
        (void)load_scene(file, {.strict = true}, log);
      }
    });
    return error == "no error" ? logged : error;
  }

  WorkingFolder folder;
};

TEST_P(HostileTextTest, IsShownEscaped) {
  EXPECT_EQ(printable(kControls), "\\x1b[2J\\x07\\u202e水ü");
  EXPECT_EQ(message(kControls), message_with(GetParam().message, kControls));
}

TEST_P(HostileTextTest, IsShownShortened) {
  EXPECT_EQ(printable(kLong).size(), kLongestQuote);
  EXPECT_EQ(message(kLong), message_with(GetParam().message, kLong));
}

// A value of 3 MB; a path of that length is in a message twice, at its beginning and its end.
TEST(HugeTextTest, MakesNoHugeMessage) {
  const WorkingFolder folder;
  const std::string huge(3'000'000, 'x');
  folder.write("a.yaml", "world: " + huge + "\nsonars: [{}]\n");
  const std::string message = message_of([&] { (void)load_scenario("a.yaml"); });
  EXPECT_EQ(message.substr(0, 22), "a.yaml:1:1: world = \"x");
  EXPECT_LE(message.size(), kLongestMessage);
}

const std::string kNotFound =
    " not found beside this file, in the folders above it or in those of INSONIFY_MODEL_PATH, SDF_PATH, "
    "GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH, GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH";

const HostileCase kCases[] = {
    {"YamlKey", "a.yaml", "world: floor.obj\n\"TEXT\": 3\n", "a.yaml:2:1: {TEXT} is not a known key"},
    {"YamlValue", "a.yaml", "world: floor.obj\npings: \"TEXT\"\n",
     "a.yaml:2:1: pings = \"{TEXT}\" must be a whole number, from 1 to 1000000000"},
    {"YamlMaterial", "a.yaml", "world: floor.obj\nsonars: [{}]\nmaterials: {hull: {like: \"TEXT\"}}\n",
     "a.yaml:3:20: materials.hull.like = {TEXT} is not a known material"},
    {"YamlMaterialName", "a.yaml", "world: floor.obj\nsonars: [{}]\nmaterials:\n  \"TEXT\": {like: steel}\n",
     "a.yaml:4:3: {materials.TEXT} matches no object and no material; the scene has floor"},
    {"YamlDefaultMaterial", "a.yaml", "world: floor.obj\nsonars: [{}]\ndefault_material: \"TEXT\"\n",
     "a.yaml:3:1: default_material = {TEXT} is not a known material"},
    {"SdfVersion", "a.sdf", "<sdf version='TEXT'/>",
     "a.sdf:1:1: SDF version '{TEXT}' is not two numbers, 1.4 to 1.9 are read"},
    {"SdfModel", "a.sdf", "<sdf version='1.9'><model name='TEXT'/></sdf>",
     "a.sdf:1:20: model '{TEXT}' must have a link, or be static"},
    {"SdfInclude", "a.sdf", "<sdf version='1.9'><world name='w'><include><uri>TEXT</uri></include></world></sdf>",
     "a.sdf:1:45: include '{TEXT}'" + kNotFound},
    {"SdfUri", "a.sdf",
     "<sdf version='1.9'><model name='m'><static>true</static><link name='l'><visual name='v'><geometry><mesh>"
     "<uri>TEXT</uri></mesh></geometry></visual></link></model></sdf>",
     "a.sdf:1:72: visual 'm::l::v': '{TEXT}'" + kNotFound},
    {"SdfPose", "a.sdf", "<sdf version='1.9'><model name='m'><pose>TEXT</pose><link name='l'/></model></sdf>",
     "a.sdf:1:36: <pose> = '{TEXT}' must be 6 finite numbers"},
    {"ObjVertex", "a.obj", "v aTEXT 0 0\n", "a.obj:1: {v aTEXT 0 0}: {aTEXT} is not a number"},
    {"ObjFace", "a.obj", kTriangle + "f 1 2 TEXT\n", "a.obj:4: {f 1 2 TEXT}: {TEXT} is not a number of a vertex"},
    {"DaeInstance", "a.dae", dae_without_geometry(),
     "a.dae:9:72: <instance_geometry> names {#TEXT}, which is not in this file"},
    {"PlyCount", "a.ply", "ply\nformat ascii 1.0\nelement face TEXT\n",
     "a.ply:3: \"{TEXT}\" is not a number of elements"},
    {"PlyElement", "a.ply", "ply\nformat ascii 1.0\nelement TEXT 2\nend_header\n",
     "a.ply:3: element {TEXT} 2 has no properties"},
    {"AscKey", "a.asc", "TEXT 3\n",
     "a.asc:1: \"{TEXT}\" is neither a number nor a key of an ESRI ASCII grid; keys: ncols, nrows, xllcorner, "
     "xllcenter, yllcorner, yllcenter, cellsize, dx, dy, nodata_value"},
    {"AscHeight", "a.asc", "ncols 2\nnrows 2\ncellsize 1\n1 2 TEXT 4\n", "a.asc:4: \"{TEXT}\" is not a number"},
};

INSTANTIATE_TEST_SUITE_P(All, HostileTextTest, testing::ValuesIn(kCases),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace insonify::hostile_text_test
