// budgets_test.cpp -- small files that ask for much are one line, which names the key that allows it.

#include "io/file/budgets.h"

#include <fmt/format.h>
#include <stdlib.h>
#include <zlib.h>

#include <nlohmann/json.hpp>

#include "io/mesh_texts.h"
#include "io/sdf_files.h"

namespace insonify::budgets_test {
namespace {

using nlohmann::json;
using testing::ElementsAre;

class BudgetsTest : public SdfTest {
 protected:
  ~BudgetsTest() override { unsetenv("INSONIFY_LIMITS"); }

  static void limit(const std::string& words) { setenv("INSONIFY_LIMITS", words.c_str(), 1); }

  std::string error_of_mesh(const std::string& name, const std::string& text) {
    const std::string path = write(name, text);
    return without_folder(message_of([&] { (void)load_scene(path); }));
  }

  // Nodes that each have the next one as a child twice.
  static std::string doubling_gltf(int depth) {
    json file = json::parse(gltf_text("data:application/octet-stream;base64," + base64(gltf_buffer())));
    file["scenes"] = {{{"nodes", {0}}}};
    file["nodes"] = json::array();
    for (int i = 0; i < depth; ++i) {
      file["nodes"].push_back({{"children", {i + 1, i + 1}}});
    }
    file["nodes"].push_back({{"mesh", 0}});
    return file.dump();
  }

  static std::string base64(const std::string& bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      std::uint32_t bits = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        bits = bits << 8U | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0U);
      }
      for (int shift = 18; shift >= 0; shift -= 6) {
        text += kDigits[bits >> shift & 63U];
      }
    }
    return text;
  }

  static std::string doubling_dae(int depth) {
    std::string nodes;
    for (int i = 0; i < depth; ++i) {
      nodes += fmt::format("<node id='n{0}'><instance_node url='#n{1}'/><instance_node url='#n{1}'/></node>", i, i + 1);
    }
    nodes += fmt::format("<node id='n{}'><instance_geometry url='#g'/></node>", depth);
    std::string text = dae_text();
    const std::size_t scene = text.find("<library_visual_scenes>"), begin = text.find("<instance_geometry"),
                      end = text.find('>', begin) + 1;
    text.replace(begin, end - begin, "<instance_node url='#n0'/>");
    return text.insert(scene, "<library_nodes>" + nodes + "</library_nodes>");
  }

  // A world with a model of two of the next models, and so on.
  std::string doubling_sdf(int depth) const {
    for (int i = 0; i <= depth; ++i) {
      std::string inside =
          "<link name='l'><visual name='v'><geometry><box><size>1 1 1</size></box></geometry></visual></link>";
      if (i < depth) {
        inside = fmt::format(
            "<include><name>a</name><uri>m{0}.sdf</uri></include><include><name>b</name><uri>m{0}.sdf</uri></include>",
            i + 1);
      }
      write(fmt::format("m{}.sdf", i),
            fmt::format("<sdf version='1.9'><model name='m{}'><static>true</static>{}</model></sdf>", i, inside));
    }
    return write("w.sdf", "<sdf version='1.9'><world name='w'><include><uri>m0.sdf</uri></include></world></sdf>");
  }

  static std::string chunk(const std::string& kind, const std::string& data) {
    const auto big_endian = [](std::uint32_t number) {
      std::string bytes;
      for (int shift = 24; shift >= 0; shift -= 8) {
        bytes += static_cast<char>(number >> shift & 255U);
      }
      return bytes;
    };
    const std::string whole = kind + data;
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(whole.data()), static_cast<uInt>(whole.size()));
    return big_endian(static_cast<std::uint32_t>(data.size())) + whole + big_endian(static_cast<std::uint32_t>(sum));
  }

  // A grey picture without a pixel.
  static std::string empty_png(std::uint16_t side) {
    const std::string length{0, 0, static_cast<char>(side >> 8U), static_cast<char>(side & 255U)};
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", length + length + std::string("\x08\0\0\0\0", 5)) + chunk("IDAT", "") +
           chunk("IEND", "");
  }
};

TEST_F(BudgetsTest, NodesWithSeveralParentsAreCountedBeforeTheyAreUnfolded) {
  // 2^22 leaves, and 2^22 - 1 nodes above them.
  const std::string reason =
      "has 8388607 instances, more than 100000; for a file that you trust: INSONIFY_LIMITS=instances=8388607";
  EXPECT_EQ(error_of_mesh("a.gltf", doubling_gltf(22)), "a.gltf: " + reason);
  EXPECT_EQ(error_of_mesh("a.dae", doubling_dae(22)),
            "a.dae: " + std::string(reason).replace(4, 7, "8388608").replace(reason.size() - 7, 7, "8388608"));
  EXPECT_EQ(error_of_mesh("a.gltf", doubling_gltf(60)),
            "a.gltf: has 2.31e+18 instances, more than 100000; for a file that you trust: "
            "INSONIFY_LIMITS=instances=2.31e+18");
  EXPECT_EQ(load_mesh(write("a.gltf", doubling_gltf(3))).triangles.size(),
            8 * load_mesh(write("b.gltf", doubling_gltf(0))).triangles.size());
  limit("instances=15");
  EXPECT_EQ(error_of_mesh("a.gltf", doubling_gltf(3)), "no error");
  limit("instances=14");
  EXPECT_EQ(error_of_mesh("a.gltf", doubling_gltf(3)),
            "a.gltf: has 15 instances, more than 14; for a file that you trust: INSONIFY_LIMITS=instances=15");
}

TEST_F(BudgetsTest, NodesWithinThemselvesOrManyOthersAreRefused) {
  json file = json::parse(doubling_gltf(1));
  file["nodes"][1]["children"] = {0};
  EXPECT_EQ(error_of_mesh("a.gltf", file.dump()), "a.gltf: nodes[0] is inside itself");
  std::string text = doubling_dae(1);
  text.insert(text.find("<instance_geometry"), "<instance_node url='#n0'/>");
  EXPECT_EQ(error_of_mesh("a.dae", text), "a.dae: node 'n0' is inside itself");
  for (int i = 0; i < 20'000; ++i) {
    file["nodes"][i] = {{"children", {i + 1}}};
  }
  file["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(error_of_mesh("a.gltf", file.dump()), "a.gltf: more than 1000 nodes are within each other");
}

TEST_F(BudgetsTest, ModelsThatIncludeEachOtherAreCountedBeforeTheyAreParsed) {
  limit("memory=1e9");
  // 512 leaves of a model, a link and a visual each, 511 models above them.
  EXPECT_EQ(error_of_file(doubling_sdf(10), {}),
            "m1.sdf: its models would take libsdformat some 2.05 GB, more than 2; for a file that you trust: "
            "INSONIFY_LIMITS=memory=6141000000");
  EXPECT_THAT(error_of_file(doubling_sdf(22), {}), testing::StartsWith("m"));
  EXPECT_EQ(load_file(doubling_sdf(3)).instances.size(), 8U);
}

TEST_F(BudgetsTest, TrianglesAreCounted) {
  limit("triangles=11");
  const std::string end = "triangles, more than 11; for a file that you trust: INSONIFY_LIMITS=triangles=";
  EXPECT_EQ(error_of_mesh("a.gltf", doubling_gltf(3)), fmt::format("a.gltf: has 32 {}32", end));
  EXPECT_EQ(error_of_mesh("a.dae", doubling_dae(3)), fmt::format("a.dae: has 32 {}32", end));
  std::string obj = obj_text();
  for (int i = 0; i < 12; ++i) {
    obj += "f 1 2 3\n";
  }
  EXPECT_EQ(error_of_mesh("a.obj", obj), fmt::format("a.obj: has 16 {}16", end));
  EXPECT_EQ(error_of_mesh("a.asc", "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n0 1 2\n3 4 5\n6 7 8\n"),
            fmt::format("a.asc: has 18 {}18", end));
}

TEST_F(BudgetsTest, AccessorsThatNeedNoBytesAreCounted) {
  json file = json::parse(doubling_gltf(0));
  file["accessors"][0] = {{"componentType", 5126}, {"count", 4'000'000'000}, {"type", "VEC3"}};
  const std::string reason =
      "a.gltf: has 1333333334 triangles, more than 50000000; for a file that you trust: "
      "INSONIFY_LIMITS=triangles=1333333334";
  EXPECT_EQ(error_of_mesh("a.gltf", file.dump()), reason);
  file["accessors"][0]["sparse"] = {
      {"count", 1}, {"indices", {{"bufferView", 1}, {"componentType", 5123}}}, {"values", {{"bufferView", 0}}}};
  EXPECT_EQ(error_of_mesh("a.gltf", file.dump()), reason);
  // Within the budget, they would take gigabytes all the same.
  file["accessors"][0]["count"] = 100'000'000;
  EXPECT_EQ(error_of_mesh("a.gltf", file.dump()),
            "a.gltf: accessors[0] has 100000000 elements without bytes for them, more than 3333333");
}

TEST_F(BudgetsTest, PixelsAreCountedBeforeTheyAreUnpacked) {
  EXPECT_EQ(empty_png(30'000).size(), 57U);
  EXPECT_EQ(error_of_mesh("a.png", empty_png(30'000)),
            "a.png: has 900000000 pixels, more than 100000000; for a file that you trust: "
            "INSONIFY_LIMITS=pixels=900000000");
  limit("pixels=8");
  EXPECT_EQ(error_of_mesh("a.asc", "ncols 3\nnrows 3\ncellsize 1\n0 1 2\n3 4 5\n6 7 8\n"),
            "a.asc: has 9 pixels, more than 8; for a file that you trust: INSONIFY_LIMITS=pixels=9");
}

TEST_F(BudgetsTest, BytesAreCountedBeforeTheyAreRead) {
  for (const char* name : {"a.obj", "a.gltf", "a.stl", "a.dae", "a.asc", "a.png", "a.sdf", "a.scn"}) {
    const std::string path = write(name, "x");
    std::filesystem::resize_file(path, 5'000'000'000);  // A hole.
    EXPECT_EQ(without_folder(message_of([&] { (void)load_scene(path); })),
              std::string(name) +
                  ": has 5000000000 bytes, more than 4000000000; for a file that you trust: "
                  "INSONIFY_LIMITS=bytes=5000000000");
  }
}

TEST_F(BudgetsTest, ElementsOfXmlAreCountedBeforeTheyAreParsed) {
  limit("nodes=10");
  EXPECT_EQ(error_of(sdf_of("<box><size>1 1 1</size></box>")),
            "scene.sdf: has 13 nodes, more than 10; for a file that you trust: INSONIFY_LIMITS=nodes=13");
  limit("nodes=13");
  EXPECT_EQ(error_of(sdf_of("<box><size>1 1 1</size></box>")), "no error");
  // Included files count each time.
  write("b.scn", "<scenario><a b='1'/><c d='2'/></scenario>");
  const std::string scene = write("a.scn", "<scenario><include file='b.scn'/><include file='b.scn'/></scenario>");
  EXPECT_EQ(error_of_file(scene, {}),
            "b.scn: has 15 nodes, more than 13; for a file that you trust: INSONIFY_LIMITS=nodes=15");
}

}  // namespace
}  // namespace insonify::budgets_test
