// stonefish_error_test.cpp -- one line about whatever is wrong with a Stonefish scenario, hostile ones included.

#include <fstream>
#include <sstream>

#include "io/stonefish_files.h"

namespace insonify::stonefish_error_test {
namespace {

using testing::HasSubstr;

class StonefishErrorTest : public StonefishTest {
 protected:
  // The scenario that fuzzing begins with.
  static std::string text_of_seed() {
    std::ifstream file(std::string(INSONIFY_SOURCE_DIR) + "/tests/fuzz/seeds/stonefish/pool.scn");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
};

TEST_F(StonefishErrorTest, TellsWhatIsNoScenario) {
  EXPECT_EQ(error_of_file(write("a.scn", "")), "a.scn: the file is empty");
  EXPECT_EQ(error_of_file(write("a.scn", "<sdf version='1.6'/>")),
            "a.scn:1:1: the root element is <sdf>, not <scenario>");
  EXPECT_THAT(error_of_file(write("a.scn", "<scenario><static></scenario>")), HasSubstr("a.scn:1:"));
  EXPECT_EQ(error_of_file((scratch.path() / "gone.scn").string()), "gone.scn: no such file");
  EXPECT_EQ(error_of(""), "pool.scn: there is no body to insonify");
}

struct Fault {
  std::string element, message;
};

TEST_F(StonefishErrorTest, TellsWhatIsWrongWithABody) {
  const std::string at = transform("world_transform", "0 0 0");
  const auto box = [&](const std::string& inside) { return "<static name='w' type='box'>" + inside + "</static>"; };
  const std::vector<Fault> faults = {
      {"<static type='box'/>", "<static>: name is missing"},
      {"<static name='' type='box'/>", "<static>: name is empty"},
      {"<static name='w'>" + at + "</static>", "static 'w': type is missing"},
      {box(""), "static 'w': <world_transform> is missing"},
      {box("<world_transform xyz='0 0 0'/>"), "static 'w': <world_transform> rpy is missing"},
      {box(transform("world_transform", "0 0")), "static 'w': <world_transform> xyz = '0 0' must be three numbers"},
      {box(transform("world_transform", "0 0 nan")),
       "static 'w': <world_transform> xyz = '0 0 nan' must be three numbers"},
      {box(transform("world_transform", "0 0 1e9")),
       "static 'w': <world_transform> xyz = 0 0 1000000000 m must be from -10000000 to 10000000 m in each direction"},
      {box(at), "static 'w': <dimensions> is missing"},
      {box(at + "<dimensions radius='1'/>"), "static 'w': <dimensions> xyz is missing"},
      {box(at + "<dimensions xyz='1 2x 3'/>"), "static 'w': <dimensions> xyz = '1 2x 3' must be three numbers"},
      {box(at + "<dimensions xyz='1 -2 3'/>"),
       "static 'w': <dimensions> xyz = 1 -2 3 m must be greater than 0 m in each direction"},
      {"<static name='w' type='sphere'><dimensions radius='0'/>" + at + "</static>",
       "static 'w': <dimensions> radius = 0 m must be greater than 0 m"},
      {"<static name='w' type='model'>" + at + "</static>", "static 'w': <physical> is missing"},
      {"<animated name='w' type='box'/>", "animated 'w': <trajectory> is missing"},
      {"<robot name='w' fixed='false'>" + at + "</robot>", "robot 'w': <base_link> is missing"},
  };
  for (const Fault& fault : faults) {
    EXPECT_EQ(error_of(fault.element), "pool.scn:2:1: " + fault.message);
  }
  EXPECT_THAT(error_of("<static name='w' type='sphere'><dimensions radius='9000000'/>" +
                       transform("world_transform", "5000000 0 0") + "</static>"),
              HasSubstr("pool.scn:2:1: static 'w' reaches x = "));
}

TEST_F(StonefishErrorTest, DamagedFilesAreLeftOutWithTheirReason) {
  write("bad.obj", "v 1 2\nf 1 1 1\n");
  write("bad.scn", "<scenario><static</scenario>");
  load(
      "<include file='bad.scn'/>\n<static name='m' type='model'><physical><mesh filename='bad.obj'/>"
      "<origin xyz='0 0 0' rpy='0 0 0'/></physical>" +
      transform("world_transform", "0 0 0") + "</static>" + ball("a", "0 0 0"));
  ASSERT_FALSE(said.empty());
  EXPECT_THAT(said[0], HasSubstr("pool.scn: 2 parts of the world are skipped"));
  EXPECT_THAT(said[0], HasSubstr("pool.scn:2:1: <include> 'bad.scn': bad.scn:1:"));
  EXPECT_THAT(said[0], HasSubstr("pool.scn:3:1: static 'm': bad.obj:1:"));
}

TEST_F(StonefishErrorTest, FilesThatIncludeThemselvesAreRefused) {
  EXPECT_EQ(error_of("<include file='pool.scn'/>"), "pool.scn:2:1: <include> 'pool.scn' includes itself");
  write("a.scn", scenario("<include file='b.scn'/>"));
  write("b.scn", scenario("<include file='a.scn'/>"));
  EXPECT_EQ(error_of_file(write("c.scn", scenario("<include file='a.scn'/>"))),
            "b.scn:2:1: <include> 'a.scn' includes itself");
}

// Each file includes the next one twice: 2^20 of the last.
TEST_F(StonefishErrorTest, IncludesAreCounted) {
  for (int i = 0; i < 20; ++i) {
    const std::string next = fmt::format("<include file='{}.scn'/>", i + 1);
    write(fmt::format("{}.scn", i), scenario(next + "\n" + next));
  }
  write("20.scn", scenario(ball("a", "0 0 0")));
  EXPECT_THAT(error_of("<include file='0.scn'/>"), HasSubstr("is one of more than 1000 files that are included"));
}

// Each file passes its argument on twice as long.
TEST_F(StonefishErrorTest, ArgumentsStayShort) {
  for (int i = 0; i < 40; ++i) {
    write(fmt::format("{}.scn", i),
          scenario(fmt::format("<include file='{}.scn'><arg name='x' value='$(arg x)$(arg x)'/></include>", i + 1)));
  }
  EXPECT_EQ(error_of("<include file='0.scn'><arg name='x' value='12345678'/></include>"),
            "9.scn:2:24: <arg> value has 8192 bytes with its arguments, must be at most 4096");
  EXPECT_EQ(error_of("<include file='0.scn'><arg name='x'/></include>"),
            "pool.scn:2:23: <arg> must have a name and a value");
}

TEST_F(StonefishErrorTest, HostileTextsAreEscapedAndShortened) {
  const std::string name = "wall\x1b[2J" + std::string(500, 'x');
  const std::string message = error_of("<static name='" + name + "' type='box'/>");
  EXPECT_THAT(message, HasSubstr("static 'wall\\x1b[2Jxxx"));
  EXPECT_EQ(message.find('\x1b'), std::string::npos);
  EXPECT_LT(message.size(), 300U);
}

// Whatever one damaged byte or a missing end makes of a scenario, it is an error in one line or a scenario.
TEST_F(StonefishErrorTest, DamageIsAnErrorOrAScenario) {
  const std::string whole = text_of_seed();
  ASSERT_GT(whole.size(), 1000U);
  int errors = 0, scenes = 0;
  const auto expect_one = [&](const std::string& text) {
    const std::string path = write("damaged.scn", text);
    const std::string scene = message_of([&] { (void)load_scene(path); });
    const std::string sonars = message_of([&] { (void)load_scenario(path); });
    EXPECT_EQ((scene + sonars).find('\n'), std::string::npos) << text;
    (scene == "no error" ? scenes : errors) += 1;
  };
  for (std::size_t i = 0; i < whole.size(); i += 29) {
    expect_one(whole.substr(0, i));
    for (const char byte : {'"', '<', '-', '9', '\0'}) {
      std::string text = whole;
      text[i] = byte;
      expect_one(text);
    }
  }
  EXPECT_GT(errors, 40);
  EXPECT_GT(scenes, 40);
}

TEST_F(StonefishErrorTest, ElementsAreNotNestedForEver) {
  std::string deep;
  for (int i = 0; i < 5000; ++i) {
    deep += "<external_part>";
  }
  EXPECT_THAT(error_of(deep), HasSubstr("pool.scn:"));
}

}  // namespace
}  // namespace insonify::stonefish_error_test
