// mistake_test.cpp -- mistakes on the command line and in scenarios: one line and an exit status each.

#include "apps/cli.h"

namespace insonify::mistake_test {
namespace {

using testing::Not;

struct Mistake {
  const char* name;
  const char* line;
  int status;
  const char* message;
};

class MistakeTest : public CliTest, public testing::WithParamInterface<Mistake> {};

TEST_P(MistakeTest, IsOneLineAndAnExitStatus) {
  folder.write("wrong.yaml", "world: floor.obj\nsonars:\n  - name: ahead\n    max_rnage: 12\n");
  folder.write("likeness.yaml", "world: floor.obj\nmaterials:\n  post: {density: 3000}\nsonars: [{name: ahead}]\n");
  folder.write("taken", "");
  const Outcome outcome = shell(GetParam().line);
  EXPECT_EQ(outcome.err, GetParam().message + std::string("\n"));
  EXPECT_EQ(outcome.status, GetParam().status);
  EXPECT_EQ(outcome.out, "");
}

constexpr Mistake kMistakes[] = {
    {"NoCommand", "insonify", 2,
     "insonify: name a command; the commands are run, serve, emulate, bridge, draw, replay, info, export, mosaic, "
     "grid, "
     "scenes, "
     "sonars, "
     "describe, "
     "compare, survey, "
     "bench, version, completion, "
     "manual "
     "(insonify --help)"},
    {"UnknownCommand", "insonify rnu fan.yaml", 2,
     "insonify: there is no command rnu; the commands are run, serve, emulate, bridge, draw, replay, info, export, "
     "mosaic, grid, "
     "scenes, sonars, "
     "describe, "
     "compare, survey, bench, version, "
     "completion, "
     "manual (insonify "
     "--help)"},
    {"UnknownOption", "insonify run fan.yaml --frob", 2, "insonify: not understood: --frob (insonify run --help)"},
    {"UnknownOptionBeforeTheCommand", "insonify --frob", 2,
     "insonify: there is no option --frob; the commands are run, serve, emulate, bridge, draw, replay, info, export, "
     "mosaic, grid, "
     "scenes, sonars, "
     "describe, "
     "compare, survey, bench, version, "
     "completion, manual (insonify "
     "--help)"},
    {"ValueOfAFlag", "insonify run fan.yaml --force=5", 2, "insonify: --force takes no value (insonify run --help)"},
    {"NoScenario", "insonify run", 2, "insonify: SCENARIO is required (insonify run --help)"},
    {"TwoScenarios", "insonify run fan.yaml scan.yaml", 2, "insonify: not understood: scan.yaml (insonify run --help)"},
    {"MissingScenario", "insonify run nowhere.yaml", 2, "insonify: nowhere.yaml: no such file"},
    {"MissingScene", "insonify run fery", 2,
     "insonify: fery: no such file, nor a scene that comes with insonify; did you mean ferry?"},
    {"MissingSceneLikeNone", "insonify serve nowhere", 2,
     "insonify: nowhere: no such file, nor a scene that comes with insonify (insonify scenes lists them)"},
    {"MeshForAScenario", "insonify run floor.obj", 2,
     "insonify: floor.obj: is a mesh, not a scenario; write a YAML file that says world: floor.obj and lists sonars"},
    {"WrongScenario", "insonify run wrong.yaml", 2,
     "insonify: wrong.yaml:4:5: sonars[0].max_rnage is not a known key; did you mean max_range?"},
    {"WrongSetting", "insonify run fan.yaml --set max_range=-3", 2,
     "insonify: --set max_range=-3: sonars[0].max_range = -3 m must be greater than 0, at most 100000 m"},
    {"NoPings", "insonify run fan.yaml --pings 0", 2,
     "insonify: --pings: 0 must be a whole number, from 1 to 1000000000 (insonify run --help)"},
    {"UnknownEngine", "insonify run fan.yaml --engine abacus", 2,
     "insonify: --engine: abacus must be auto or cpu or gpu or reference (insonify run --help)"},
    {"NegativeSeed", "insonify run fan.yaml --seed -1", 2,
     "insonify: --seed: -1 must be a whole number, from 0 to 18446744073709551615 (insonify run --help)"},
    {"WordForThreads", "insonify run fan.yaml --threads many", 2,
     "insonify: --threads: many must be a whole number, from 0 to 1024 (insonify run --help)"},
    {"UnknownPictures", "insonify run fan.yaml --pictures some", 2,
     "insonify: --pictures some must be all, last, none or a number of pings"},
    {"UnknownColourMap", "insonify run fan.yaml --colour-map jet", 2,
     "insonify: colour map \"jet\" must be one of inferno, copper, grey, blue"},
    {"UnknownScale", "insonify run fan.yaml --scale log", 2,
     "insonify: --scale: log must be linear or db (insonify run --help)"},
    {"FloorAboveZero", "insonify run fan.yaml --scale db --floor-db 3", 2,
     "insonify: --floor-db: 3 must be a number, at least -300, less than 0 (insonify run --help)"},
    {"LevelsThatFall", "insonify run fan.yaml --levels -40:-90", 2,
     "insonify: --levels: -40:-90 must be LOW:HIGH, two rising levels from -400 to 400 dB, as -90:-40 (insonify run "
     "--help)"},
    {"LevelsWithAFloor", "insonify run fan.yaml --levels -90:-40 --floor-db -30", 2,
     "insonify: --floor-db excludes --levels (insonify run --help)"},
    {"TinyPicture", "insonify run fan.yaml --height 3", 2,
     "insonify: --height: 3 must be a whole number, from 240 to 8192 (insonify run --help)"},
    {"SeveralWords", "insonify run fan.yaml a b c", 2, "insonify: not understood: a b c (insonify run --help)"},
    {"NoFolder", "insonify run fan.yaml -o ''", 2,
     "insonify: --output: must not be empty: name a folder, or . for this one (insonify run --help)"},
    {"FarSonar", "insonify run fan.yaml --set position=[0,1e18,0]", 2,
     "insonify: --set position=[0,1e18,0]: sonars[0].position[1] = 1e+18 m must be from -10000000 to 10000000 m"},
    {"UnknownLikeness", "insonify run likeness.yaml -q --set materials.post.like=stele", 2,
     "insonify: --set materials.post.like=stele: materials.post.like = stele is not a known material; did you mean "
     "steel?"},
    {"EndlessStream", "insonify run /dev/zero -q", 2, "insonify: /dev/zero: is not a regular file and does not end"},
    {"EmptyStream", "insonify run /dev/null -q", 2, "insonify: /dev/null: the file is empty"},
    {"FolderThatIsAFile", "insonify run fan.yaml -q -o taken", 1,
     "insonify: taken: cannot make this folder: Not a directory"},
    {"FolderInAFile", "insonify run fan.yaml -q -o taken/out", 1,
     "insonify: taken/out: cannot make this folder: Not a directory"},
    {"UnknownPreset", "insonify sonars gemini", 2,
     "insonify: \"gemini\" is not a preset; did you mean tritech-gemini-720i?"},
    {"UnknownMode", "insonify sonars soundmetrics-didson --mode medium", 2,
     "insonify: \"medium\" is not a mode of soundmetrics-didson, which has high and low"},
    {"ModeOfNoPreset", "insonify sonars --mode high", 2,
     "insonify: --mode high belongs to a preset, and none is named"},
    {"NoInstrument", "insonify emulate", 2,
     "insonify: emulate: name one of oculus, ping360, omniscan450, surveyor240, sonar3d15 (insonify emulate --help)"},
    {"UnknownInstrument", "insonify emulate ping36 scan.yaml", 2,
     "insonify: there is no emulate ping36: name one of oculus, ping360, omniscan450, surveyor240, sonar3d15 (insonify "
     "emulate --help)"},
    {"NoBridge", "insonify bridge", 2, "insonify: bridge: name one of ros1, dds, gazebo (insonify bridge --help)"},
    {"UnknownBridge", "insonify bridge ros fan.yaml", 2,
     "insonify: there is no bridge ros: name one of ros1, dds, gazebo (insonify bridge --help)"},
    {"NothingToBridge", "insonify bridge ros1", 2, "insonify: SCENARIO is required (insonify bridge ros1 --help)"},
    {"UnknownWordForABridge", "insonify bridge ros1 fan.yaml __name:=sonar more", 2,
     "insonify: not understood: more (insonify bridge ros1 --help)"},
    {"WordsOfRos1ForAnotherBridge", "insonify bridge dds fan.yaml __name:=sonar", 2,
     "insonify: not understood: __name:=sonar (insonify bridge dds --help)"},
    {"BitsOfABridge", "insonify bridge dds fan.yaml --bits 12", 2,
     "insonify: --bits: 12 must be 8 or 16 (insonify bridge dds --help)"},
    {"LevelsOfABridge", "insonify bridge gazebo fan.yaml --levels -40:-90", 2,
     "insonify: --levels: -40:-90 must be LOW:HIGH, two rising levels from -400 to 400 dB, as -90:-40 (insonify bridge "
     "gazebo --help)"},
    {"NothingToEmulate", "insonify emulate oculus", 2,
     "insonify: SCENARIO is required (insonify emulate oculus --help)"},
    {"UnknownSonarToEmulate", "insonify emulate oculus scan.yaml --sonar nobody --port 0", 2,
     "insonify: --sonar nobody: scan.yaml has no such sonar; it has around"},
    {"UnknownSection", "insonify describe sea", 2,
     "insonify: there is no section sea; there are scenario, water, profile, materials, sonars, sampling, receiver, "
     "paper, "
     "surface, points, interferers, thrusters, trajectory, pattern, lines, motion_noise, ping_spans, motions, view"},
};

INSTANTIATE_TEST_SUITE_P(All, MistakeTest, testing::ValuesIn(kMistakes),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

}  // namespace
}  // namespace insonify::mistake_test
