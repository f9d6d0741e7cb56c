// gltf_test.cpp -- glTF files with number types, instances, URIs and looks that assimp reads wrong or refuses.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "insonify/files.h"
#include "io/loaded_mesh.h"
#include "io/mesh_texts.h"
#include "support/message_of.h"

namespace insonify::gltf_test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;

// A box of 2 x 1 x 3 m with its 12 triangles, whose corners are stored as `Number`, in thousandths if those are whole
// numbers; y is up. In our frame 2 m along x, 1 m along y, 3 m along z.
template <typename Number>
struct Box {
  json document;
  std::string bytes;

  Box() {
    const double unit = std::is_integral_v<Number> ? 1000 / kShrink : 1;
    for (int i = 0; i < 8; ++i) {
      const std::array<double, 3> corner = {(i & 4) != 0 ? 1.0 : -1.0, (i & 1) != 0 ? 3.0 : 0.0,
                                            (i & 2) != 0 ? -0.5 : 0.5};
      for (const double value : corner) {
        bytes += bytes_of(static_cast<Number>(value * unit));
      }
      bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    }
    const std::size_t positions = bytes.size();
    constexpr std::array<std::uint16_t, 36> kIndices = {0, 1, 2, 1, 3, 2, 4, 6, 5, 5, 6, 7, 0, 4, 1, 4, 5, 1,
                                                        2, 3, 6, 3, 7, 6, 0, 2, 4, 2, 6, 4, 1, 5, 3, 5, 7, 3};
    bytes += bytes_of(kIndices);
    document = json::parse(fmt::format(
        R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
            "nodes": [{{"name": "box", "mesh": 0, "scale": [{0}, {0}, {0}]}}],
            "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1}}]}}],
            "accessors": [{{"bufferView": 0, "componentType": {1}, "count": 8, "type": "VEC3"}},
                          {{"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}}],
            "bufferViews": [{{"buffer": 0, "byteLength": {2}, "byteStride": {3}}},
                            {{"buffer": 0, "byteOffset": {2}, "byteLength": 72}}],
            "buffers": [{{"uri": "box.bin", "byteLength": {4}}}]}})",
        1 / unit, kType, positions, positions / 8, bytes.size()));
  }

  static constexpr double kShrink = sizeof(Number) == 1 ? 25 : 1;  // 3 m are 120 in 8 bits.
  static constexpr int kType = std::is_floating_point_v<Number> ? 5126
                               : sizeof(Number) == 1            ? (std::is_signed_v<Number> ? 5120 : 5121)
                                                                : (std::is_signed_v<Number> ? 5122 : 5123);
};

class GltfTest : public testing::Test {
 protected:
  std::filesystem::path write(const json& document, const std::string& bytes, const std::string& buffer = "box.bin") {
    folder.write(buffer, bytes);
    return folder.write("a.gltf", document.dump());
  }
  std::string error_of(const json& document, const std::string& bytes) {
    const std::string path = write(document, bytes).string(), message = message_of([&] { (void)load_mesh(path); });
    EXPECT_TRUE(message.starts_with(path)) << message;
    return message.substr(std::min(path.size(), message.size()));
  }
  ScratchFolder folder;
};

TEST_F(GltfTest, CornersMayBeWholeNumbers) {
  const auto expect_box = [&](auto box) {
    box.document["extensionsRequired"] = json::array({"KHR_mesh_quantization"});
    const Loaded loaded = load(write(box.document, box.bytes));
    EXPECT_THAT(loaded.notes, IsEmpty());
    expect_bounds(loaded.mesh, {-1, -0.5, 0}, {1, 0.5, 3});
    EXPECT_EQ(loaded.mesh.triangles.size(), 12U);
  };
  expect_box(Box<float>());
  expect_box(Box<std::int16_t>());
  expect_box(Box<std::int8_t>());
}

// 127 is 1 and 0 is 0, as is 32767 of 16 bits.
TEST_F(GltfTest, NormalizedCornersAreFractions) {
  Box<std::int8_t> box;
  box.document["accessors"][0]["normalized"] = true;
  box.document["nodes"][0]["scale"] = json::array({127 / 40.0, 127 / 40.0, 127 / 40.0});
  expect_bounds(load_mesh(write(box.document, box.bytes)), {-1, -0.5, 0}, {1, 0.5, 3});
}

TEST_F(GltfTest, NormalsMayBeWholeNumbers) {
  Box<float> box;
  const std::size_t at = box.bytes.size();
  for (int i = 0; i < 8; ++i) {  // All up, in a frame with y up.
    box.bytes += bytes_of(std::array<std::int8_t, 4>{0, 127, 0, 0});
  }
  box.document["buffers"][0]["byteLength"] = box.bytes.size();
  box.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", 32}, {"byteStride", 4}});
  box.document["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5120}, {"normalized", true}, {"count", 8}, {"type", "VEC3"}});
  box.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
  for (const Vec3f& normal : load_mesh(write(box.document, box.bytes)).normals) {
    EXPECT_NEAR(std::abs(normal.z()), 1, kFloat);
  }
}

// The corner (1, 3, -.5) of glTF is moved to (1, 4, -.5): 4 m high.
TEST_F(GltfTest, SparseCornersReplaceOthers) {
  Box<float> box;
  const std::size_t at = box.bytes.size();
  box.bytes += bytes_of(std::uint32_t{7}) + bytes_of(std::array<float, 3>{1, 4, -0.5F});
  box.document["buffers"][0]["byteLength"] = box.bytes.size();
  box.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", 4}});
  box.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at + 4}, {"byteLength", 12}});
  box.document["accessors"][0]["sparse"] = {
      {"count", 1}, {"indices", {{"bufferView", 2}, {"componentType", 5125}}}, {"values", {{"bufferView", 3}}}};
  expect_bounds(load_mesh(write(box.document, box.bytes)), {-1, -0.5, 0}, {1, 0.5, 4});
}

TEST_F(GltfTest, InstancesAreNodes) {
  Box<float> box;
  const std::size_t at = box.bytes.size();
  box.bytes += bytes_of(std::array<float, 9>{0, 0, 0, 10, 0, 0, 20, 0, 0});
  // A quarter turn about glTF's x takes its y, our z, to its z, our -y.
  box.bytes += bytes_of(std::array<std::int16_t, 12>{0, 0, 0, 32767, 0, 0, 0, 32767, 23170, 0, 0, 23170});
  box.document["buffers"][0]["byteLength"] = box.bytes.size();
  box.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", 36}});
  box.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at + 36}, {"byteLength", 24}});
  box.document["accessors"].push_back({{"bufferView", 2}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  box.document["accessors"].push_back(
      {{"bufferView", 3}, {"componentType", 5122}, {"normalized", true}, {"count", 3}, {"type", "VEC4"}});
  box.document["extensionsRequired"] = json::array({"EXT_mesh_gpu_instancing"});
  box.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 2},
                                                                                     {"ROTATION", 3}};
  const Mesh mesh = load_mesh(write(box.document, box.bytes));
  EXPECT_EQ(mesh.triangles.size(), 36U);
  expect_bounds(mesh, {-1, -3, -0.5}, {21, 0.5, 3});

  box.document["accessors"][3]["count"] = 2;
  EXPECT_EQ(error_of(box.document, box.bytes), ": the instances of nodes[0] have attributes of different counts");
}

TEST_F(GltfTest, OtherRequiredExtensionsAreErrors) {
  Box<float> box;
  for (const std::string extension : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "ACME_shapes"}) {
    box.document["extensionsRequired"] = json::array({"KHR_materials_unlit", extension});
    EXPECT_EQ(error_of(box.document, box.bytes), ": requires the glTF extension " + extension + ", which is not read");
  }
  box.document["extensionsRequired"] =
      json::array({"KHR_materials_unlit", "KHR_texture_transform", "KHR_lights_punctual"});
  EXPECT_EQ(load_mesh(write(box.document, box.bytes)).triangles.size(), 12U);
}

TEST_F(GltfTest, UrisArePercentEncoded) {
  Box<float> box;
  box.document["buffers"][0]["uri"] = "my%20b%C3%B6x.bin";
  EXPECT_EQ(load_mesh(write(box.document, box.bytes, "my b\u00f6x.bin")).triangles.size(), 12U);
  EXPECT_EQ(load_mesh(write(box.document, box.bytes, "my%20b%C3%B6x.bin")).triangles.size(), 12U);
}

TEST_F(GltfTest, BytesThatAreNoTextAreEscaped) {
  Box<float> box;
  box.document["materials"] = json::parse(R"([{"name": "cafX"}])");
  box.document["meshes"][0]["primitives"][0]["material"] = 0;
  folder.write("box.bin", box.bytes);
  std::string text = box.document.dump();
  text.replace(text.find("cafX"), 4, "caf\xe9");
  EXPECT_THAT(load_mesh(folder.write("a.gltf", text)).material_names, ElementsAre("caf\\xe9"));
}

TEST_F(GltfTest, BuffersMayBeWithin) {
  Box<std::int16_t> box;
  const auto encoded = [](std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i + 3 <= bytes.size(); i += 3) {
      unsigned bits = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        bits = bits << 8U | static_cast<unsigned char>(bytes[i + j]);
      }
      for (const unsigned shift : {18U, 12U, 6U, 0U}) {
        text += kDigits[bits >> shift & 63U];
      }
    }
    return text;
  };
  box.bytes.resize((box.bytes.size() + 2) / 3 * 3, '\0');
  box.document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + encoded(box.bytes);
  expect_bounds(load_mesh(write(box.document, "unused")), {-1, -0.5, 0}, {1, 0.5, 3});
}

TEST_F(GltfTest, TrianglesWithoutCornersAreCounted) {
  Box<float> box;
  const std::size_t index = box.bytes.size() - 2;
  box.bytes.replace(index, 2, bytes_of(std::uint16_t{200}));
  const Loaded loaded = load(write(box.document, box.bytes));
  EXPECT_EQ(loaded.mesh.triangles.size(), 11U);
  EXPECT_THAT(loaded.notes,
              ElementsAre("warning: a.gltf: 1 of 12 triangles dropped (1 with corners that do not exist)"));

  box.document["accessors"][1]["count"] = 35;  // The last triangle, that with index 200, has two corners.
  EXPECT_THAT(load(write(box.document, box.bytes)).notes,
              ElementsAre("warning: a.gltf: 1 of 12 triangles dropped (1 with corners that do not exist)"));
}

TEST_F(GltfTest, LooksDoNotStopShapes) {
  Box<float> box;
  json& primitive = box.document["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  primitive["attributes"]["COLOR_0"] = 99;
  primitive["targets"] = json::parse(R"([{"POSITION": 99}])");
  box.document["materials"] = json::parse(
      R"([{"name": "steel", "pbrMetallicRoughness": {"baseColorFactor": [1, 1], "baseColorTexture": "red"},
           "normalTexture": {"index": 7}, "alphaMode": 3}])");
  box.document["textures"] = json::parse(R"([{"source": 5, "sampler": 9}])");
  box.document["animations"] = json::parse(R"([{"channels": 1}])");
  box.document["cameras"] = "none";
  box.document["nodes"][0]["camera"] = 3;
  box.document["nodes"][0]["skin"] = 3;
  const Loaded loaded = load(write(box.document, box.bytes));
  EXPECT_THAT(loaded.notes, IsEmpty());
  EXPECT_EQ(loaded.mesh.triangles.size(), 12U);
  EXPECT_THAT(loaded.mesh.material_names, ElementsAre("steel"));
}

TEST_F(GltfTest, FaultsAreTold) {
  Box<std::int16_t> box;
  const auto changed = [&](const std::string& pointer, const json& value) {
    json document = box.document;
    document[json::json_pointer(pointer)] = value;
    return error_of(document, box.bytes);
  };
  EXPECT_EQ(changed("/accessors/0/count", 9), ": an accessor of 9 elements leads out of its buffer");
  EXPECT_EQ(changed("/accessors/0/count", -1), ": \"count\" must be a whole number");
  EXPECT_EQ(changed("/accessors/0/componentType", 5124), ": there is no component type 5124");
  EXPECT_EQ(changed("/accessors/0/type", "MAT4"), ": accessors[0] has no type that is read");
  EXPECT_EQ(changed("/accessors/0/bufferView", 7), ": there is no bufferViews[7]");
  EXPECT_EQ(changed("/meshes/0/primitives/0/attributes/POSITION", 7), ": there is no accessors[7]");
  EXPECT_EQ(changed("/meshes/0/primitives", 7), ": is not glTF 2.0: cannot use value() with number");
  EXPECT_EQ(changed("/buffers/0/uri", 7), ": is not glTF 2.0: type must be string, but is number");
}

}  // namespace
}  // namespace insonify::gltf_test
