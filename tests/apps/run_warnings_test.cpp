// run_warnings_test.cpp -- what `insonify run` warns of: odd worlds, keys without effect, silence, black pictures.

#include "apps/cli.h"

namespace insonify::run_warnings_test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

// Each is reported in one line before the first ping.
TEST_F(CliTest, RunTellsWhatIsOddAboutTheWorldAndTheTrajectory) {
  folder.write("inside.sdf",
               "<sdf version='1.9'><model name='crate'><link name='l'><visual name='sides'><geometry><box><size>2 2 "
               "2</size></box></geometry></visual></link></model></sdf>");
  EXPECT_THAT(shell("insonify run fan.yaml --no-pictures -o a --set world=inside.sdf").err,
              HasSubstr("warning: ahead begins inside of crate::l::sides, and receives its inner surface\n"));
  EXPECT_EQ(shell("insonify run fan.yaml --no-pictures -o b --set position=[0,0,1]").err, "");
  const std::string into = "--set 'trajectory=[{time: 0, position: [-9,0,0]}, {time: 30, position: [-6,0,0]}]'";
  // The sonar never reaches a crate that moves away as fast; it passes the side of one that lies at -7 to -5 after 20
  // s.
  EXPECT_THAT(shell("insonify run fan.yaml --no-pictures -o f --pings 31 --set ping_period=1 --set world=inside.sdf "
                    "--set 'motions=[{object: crate, trajectory: [{time: 0, position: [0,0,0]}, {time: 30, position: "
                    "[3,0,0]}]}]' --set max_range=20 --set orientation_deg=[0,0,0] " +
                    into)
                  .err,
              "");
  EXPECT_THAT(shell("insonify run fan.yaml --no-pictures -o g --pings 31 --set ping_period=1 --set world=inside.sdf "
                    "--set 'motions=[{object: crate, trajectory: [{time: 0, position: [0,0,0]}, {time: 0.5, position: "
                    "[-6,0,0]}]}]' --set max_range=20 --set orientation_deg=[0,0,0] " +
                    into)
                  .err,
              HasSubstr("warning: ahead is at ping 21 inside of crate::l::sides, and receives its inner surface\n"));
  folder.write("millimetres.obj",
               "v -20000 -20000 -2000\nv 20000 -20000 -2000\nv 20000 20000 -2000\nv -20000 20000 -2000\nf 1 2 3 4\n");
  EXPECT_THAT(shell("insonify run fan.yaml --no-pictures -o c --set world=millimetres.obj").err,
              HasSubstr("warning: the world is 4e+04 m across, 3.33e+03 times the range of ahead; if its files are in "
                        "millimetres, scale them by 0.001\n"));
  // A plane without a size is 10 km wide, and stands for a ground without an end.
  folder.write("ground.sdf",
               "<sdf version='1.9'><model name='m'><static>true</static><link name='l'><visual name='ground'><pose>0 0 "
               "-2 0 0 0</pose><geometry><plane/></geometry></visual><visual name='pile'><pose>6 0 -1 0 0 0</pose>"
               "<geometry><box><size>1 1 2</size></box></geometry></visual></link></model></sdf>");
  EXPECT_EQ(shell("insonify run fan.yaml --no-pictures -o h --set world=ground.sdf").err, "");
  const std::string moving = "--set 'trajectory=[{time: 0, position: [0,0,0]}, {time: 9, position: [1,0,0]}]'";
  EXPECT_THAT(
      shell("insonify run fan.yaml --no-pictures -o d --set ping_period=0.5 " + moving).out,
      HasSubstr(
          "note: the last ping of ahead is at 1 s, the trajectory ends at 9 s; --duration 9 would ping until then\n"));
  EXPECT_THAT(
      shell("insonify run fan.yaml --no-pictures -o e --pings 4 --set ping_period=8 " + moving).out,
      HasSubstr("note: the last ping of ahead is at 24 s, the trajectory ends at 9 s: nothing moves after that\n"));
}

TEST_F(CliTest, RunTellsWhereATrajectoryBeginsAfterItsPings) {
  EXPECT_THAT(
      shell("insonify run fan.yaml --no-pictures -o a --set ping_period=0.5 --set 'trajectory=[{time: 1669110000, "
            "position: [0,0,0]}, {time: 1669110009, position: [1,0,0]}]'")
          .out,
      HasSubstr("note: the last ping of ahead is at 1 s, the trajectory begins at 1669110000 s: nothing moves before "
                "that; for a file, `start: 1669110000` makes that time 0\n"));
}

TEST_F(CliTest, AModelFromTheCommandLineLeavesKeysOfTheFileWithoutEffectAndSaysSo) {
  folder.write("paper.yaml", "world: floor.obj\nmodel: paper\npings: 1\nsonars: [{name: a, gain: 3, max_range: 12}]\n");
  EXPECT_THAT(shell("insonify run paper.yaml --no-pictures -o out --set model=calibrated").err,
              HasSubstr("warning: a key of the file has no effect with model = calibrated: sonars[0].gain\n"));
  EXPECT_THAT(shell("insonify run paper.yaml --no-pictures -o out --force --set model=calibrated --set gain=2").err,
              HasSubstr("sonars[0].gain has no effect with model = calibrated"));
}

TEST_F(CliTest, RunWarnsOfValuesThatAPresetsInstrumentCannotHave) {
  const Outcome outcome = shell("insonify run scan.yaml --no-pictures -o a --set frequency=720 --set max_range=15000");
  EXPECT_THAT(outcome.err,
              ContainsRegex("warning: --set frequency=720: sonars\\[0\\].frequency = 720 Hz, and a Tritech Micron "
                            "DST transmits at [0-9.e+]+ Hz\n"));
  EXPECT_THAT(outcome.err,
              ContainsRegex("warning: --set max_range=15000: sonars\\[0\\].max_range = 15000 m, and a Tritech Micron "
                            "DST reaches [0-9]+ m\n"));
}

TEST_F(CliTest, KeysThatAnotherKeepsFromActingAreToldOf) {
  EXPECT_EQ(
      shell("insonify run fan.yaml -q --no-pictures -o out --set receiver.pulse_bandwidth=3e5 --set "
            "receiver.ambient_noise_db=30 --set receiver.noise=false")
          .err,
      "insonify: warning: --set receiver.pulse_bandwidth=3e5: receiver.pulse_bandwidth has no effect unless pulse is "
      "lfm\ninsonify: warning: --set receiver.ambient_noise_db=30: receiver.ambient_noise_db has no effect unless "
      "noise is true\n");
  EXPECT_EQ(shell("insonify run fan.yaml -q --no-pictures -o deaf --set 'thrusters=[{position: [1, 0, 0]}]' --set "
                  "receiver.noise=false")
                .err,
            "insonify: warning: --set thrusters=[{position: [1, 0, 0]}]: thrusters has no effect unless receiver.noise "
            "is true\n");
  // The sonar's own receiver starts from the common one, whose bandwidth acts in it.
  EXPECT_EQ(shell("insonify run fan.yaml -q --no-pictures -o own --set receiver.pulse_bandwidth=3e5 --set "
                  "sonars.ahead.receiver.pulse=lfm")
                .err,
            "");
  EXPECT_EQ(
      shell("insonify run fan.yaml -q --no-pictures -o lfm --set receiver='{pulse: lfm, pulse_bandwidth: 3e5}'").err,
      "");
}

TEST_F(CliTest, KeysOfArraysCountsAndSpeckleThatDoNotActAreToldOf) {
  const auto told = [](const std::string& settings) {
    return shell("insonify run fan.yaml -q --no-pictures --force -o out --set receiver.noise=false " + settings).err;
  };
  EXPECT_EQ(told("--set receiver.azimuth_pattern=top_hat --set receiver.elements=64"),
            "insonify: warning: --set receiver.elements=64: receiver.elements has no effect unless azimuth_pattern is "
            "that of an array\n");
  EXPECT_EQ(told("--set sonars.ahead.elevation_element_error_deg=10"),
            "insonify: warning: --set sonars.ahead.elevation_element_error_deg=10: "
            "sonars[0].elevation_element_error_deg has no effect unless an elevation pattern is that of an array\n");
  EXPECT_EQ(told("--set sonars.ahead.elevation_element_error_deg=10 --set sonars.ahead.elevation_pattern=hann"), "");
  EXPECT_EQ(told("--set sonars.ahead.self_noise_db=60"),
            "insonify: warning: --set sonars.ahead.self_noise_db=60: sonars[0].self_noise_db has no effect unless "
            "receiver.noise is true\n");
  EXPECT_EQ(told("--set sonars.ahead.bits=12"),
            "insonify: warning: --set sonars.ahead.bits=12: sonars[0].bits has no effect unless receiver.counts is "
            "true\n");
  EXPECT_EQ(told("--set sonars.ahead.mapping_exponent=0.5 --set receiver='{counts: true, full_scale_db: -40}'"),
            "insonify: warning: --set sonars.ahead.mapping_exponent=0.5: sonars[0].mapping_exponent has no effect "
            "unless receiver.counts is true and mapping is gamma\n");
  EXPECT_EQ(told("--set mutual_interference=true"),
            "insonify: warning: --set mutual_interference=true: mutual_interference has no effect unless there are "
            "several sonars\n");
  EXPECT_EQ(told("--set receiver.speckle=false --set materials.sand.clutter_shape=2"),
            "insonify: warning: --set materials.sand.clutter_shape=2: materials.sand.clutter_shape has no effect "
            "unless receiver.speckle is true\n");
}

TEST_F(CliTest, KeysOfPartsThatDoNotActAreToldOf) {
  const auto told = [](const std::string& settings, const char* file = "fan.yaml") {
    return shell(fmt::format("insonify run {} -q --no-pictures --force -o out {}", file, settings)).err;
  };
  EXPECT_EQ(told("--set receiver.speckle=true --set materials.sand.clutter_length=2"),
            "insonify: warning: --set materials.sand.clutter_length=2: materials.sand.clutter_length has no effect "
            "unless clutter_shape is given\n");
  EXPECT_EQ(told("--set receiver.speckle=true --set materials.sand='{clutter_length: 2, clutter_shape: 1}'"), "");
  // Without a library material of its name it starts from the default one.
  EXPECT_EQ(told("--set receiver.speckle=true --set default_material=weed --set materials='{weed: {like: sand, "
                 "clutter_shape: 1}, floor: {clutter_length: 2}}'"),
            "");
  EXPECT_EQ(told("--set receiver.noise=true --set 'thrusters=[{position: [1, 0, 0], blade_phase_deg: 30}]'"),
            "insonify: warning: --set thrusters=[{position: [1, 0, 0], blade_phase_deg: 30}]: "
            "thrusters[0].blade_phase_deg has no effect unless blade_rate is given\n");
  EXPECT_EQ(
      told("--set steering=lens", "scan.yaml"),
      "insonify: warning: --set steering=lens: sonars[0].steering has no effect unless type is fls or mbes and its fan "
      "at most 180 deg wide\n");
  EXPECT_EQ(told("--set steering=lens"), "");
}

TEST_F(CliTest, MotionInPingOfASonarAtRestIsToldOf) {
  const auto told = [](const std::string& settings) {
    return shell("insonify run fan.yaml -q --no-pictures --force -o out --set motion_in_ping=true " + settings).err;
  };
  const char* const kLine =
      "insonify: warning: --set motion_in_ping=true: motion_in_ping has no effect unless there is a trajectory along "
      "which the sonars move\n";
  EXPECT_EQ(told(""), kLine);
  EXPECT_EQ(told("--set 'trajectory=[{time: 0, position: [1, 0, 0]}, {time: 9, position: [1, 0, 0]}]'"), kLine);
  EXPECT_EQ(told("--set 'trajectory=[{time: 0}, {time: 9, orientation_deg: [0, 0, 5]}]'"), "");
}

TEST_F(CliTest, DepthBesideASurfaceAndSourcesAboveItAreToldOf) {
  const auto told = [](const std::string& settings) {
    return shell("insonify run fan.yaml -q --no-pictures --force -o out --set surface.level=5 " + settings).err;
  };
  EXPECT_EQ(told("--set water.depth=5"),
            "insonify: warning: --set water.depth=5: water.depth has no effect beside surface: each sonar's depth is "
            "that below surface.level\n");
  EXPECT_EQ(told("--set 'points=[{position: [4, 0, 4]}, {position: [4, 0, 6]}, {position: [4, 0, 7]}]'"),
            "insonify: warning: --set points=[{position: [4, 0, 4]}, {position: [4, 0, 6]}, {position: [4, 0, 7]}]: "
            "points[1].position[2] = 6 m is above surface.level = 5 m, so that it is not received, nor 1 other\n");
  EXPECT_EQ(told("--set 'interferers=[{position: [4, 0, 6]}]'"),
            "insonify: warning: --set interferers=[{position: [4, 0, 6]}]: interferers[0].position[2] = 6 m is above "
            "surface.level = 5 m, so that it is not received\n");
}

TEST_F(CliTest, APulseThatOutlastsItsPingIsToldOf) {
  const auto told = [](const std::string& settings) {
    return shell("insonify run fan.yaml -q --no-pictures --force -o out --set water.sound_speed=1500 " + settings).err;
  };
  // 24 m there and back take 16 ms.
  EXPECT_EQ(told("--set sonars.ahead.pulse=cw --set sonars.ahead.pulse_duration=0.02"),
            "insonify: warning: --set sonars.ahead.pulse_duration=0.02: sonars[0].pulse_duration = 0.02 s is longer "
            "than the 0.016 s in which sonars[0] receives echoes up to max_range = 12 m\n");
  EXPECT_EQ(told("--set receiver='{pulse: cw, pulse_duration: 0.02}'"),
            "insonify: warning: --set receiver={pulse: cw, pulse_duration: 0.02}: receiver.pulse_duration = 0.02 s is "
            "longer than the 0.016 s in which sonars[0] receives echoes up to max_range = 12 m\n");
  EXPECT_EQ(told("--set sonars.ahead.pulse=cw --set sonars.ahead.pulse_duration=0.016"), "");
}

// A bin as long as the range is longer than any world in it.
TEST_F(CliTest, AWorldIsSmallByTheRangeAndNotByLongBins) {
  EXPECT_EQ(shell("insonify run fan.yaml -q --no-pictures -o one --set bin_count=1 --set max_range=20").err, "");
  folder.write("kilometres.obj",
               "v -0.02 -0.02 -0.002\nv 0.02 -0.02 -0.002\nv 0.02 0.02 -0.002\nv -0.02 0.02 -0.002\nf 1 2 3 4\n");
  EXPECT_THAT(
      shell("insonify run fan.yaml -q --no-pictures -o small --set world=kilometres.obj").err,
      HasSubstr("warning: the world is 0.04 m across, 0.14 bins of ahead; if its files are in kilometres, scale "
                "them by 1000\n"));
}

TEST_F(CliTest, KeysOfAnInstrumentsPulseThatDoNotActAreToldOf) {
  const auto told = [](const std::string& settings) {
    return shell("insonify run fan.yaml -q --no-pictures --force -o out " + settings).err;
  };
  EXPECT_EQ(told("--set sonars.ahead.pulse_duration=1e-4"),
            "insonify: warning: --set sonars.ahead.pulse_duration=1e-4: sonars[0].pulse_duration has no effect unless "
            "pulse is cw or lfm\n");
  EXPECT_EQ(told("--set sonars.ahead.pulse=cw --set receiver.pulse=none"),
            "insonify: warning: --set sonars.ahead.pulse=cw: sonars[0].pulse has no effect unless receiver.pulse is "
            "instrument\n");
  EXPECT_EQ(
      told("--set sonars.ahead.pulse=cw --set sonars.ahead.bandwidth=3e4"),
      "insonify: warning: --set sonars.ahead.bandwidth=3e4: sonars[0].bandwidth has no effect unless noise is true "
      "and the pulse is none\n");
  EXPECT_EQ(told("--set sonars.ahead.pulse=cw --set sonars.ahead.pulse_duration=1e-4 --set receiver.decimation=mean"),
            "");
  EXPECT_EQ(
      told("--set sonars.ahead.pulse=instrument"),
      "insonify: --set sonars.ahead.pulse=instrument: sonars[0].pulse = instrument must be none, cw or lfm: it is "
      "the instrument's\n");
  EXPECT_EQ(told("--set sonars.ahead.pulse=lfm --set sonars.ahead.pulse_bandwidth=1e4"),
            "insonify: --set sonars.ahead.pulse_bandwidth=1e4: sonars[0].pulse_bandwidth = 1e+04 Hz times "
            "sonars[0].pulse_duration = 5e-05 s is 0.5, must be at least 10 for a chirp\n");
}

TEST_F(CliTest, SilenceIsToldWithWhereTheWorldIs) {
  const Outcome outcome = shell("insonify run fan.yaml -o out -q --no-pictures --set orientation_deg=[0,-90,0]");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(
      outcome.err,
      "insonify: warning: nothing was received in any ping of ahead: the world reaches from (-20, -20, -2) to (20, "
      "20, -2) m, the sonar was at (0, 0, 0) m at first, looking along (0, 0, 1), and receives from 0.2 to 12 m\n");
}

TEST_F(CliTest, SilenceOfMissingBeamsAndDeadBinsIsToldWithTheirKeys) {
  const auto told = [](const std::string& settings) {
    const std::string text = shell("insonify run fan.yaml --force -o out -q --no-pictures " + settings).err;
    return text.substr(std::min(text.find("and receives"), text.size()));
  };
  EXPECT_EQ(told("--set dead_range=12"), "and receives from 12 to 12 m; dead_range = 12 m leaves it no bin\n");
  EXPECT_EQ(told("--set dead_range=9 --set azimuth_aperture_deg=20 --set elevation_aperture_deg=4"),
            "and receives from 9 to 12 m (dead_range)\n");
  EXPECT_EQ(told("--set missing_beams=[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,15]"),
            "and receives from 0.2 to 12 m; all of its 16 beams are missing (missing_beams)\n");
  EXPECT_EQ(told("--set missing_beams=[3,7] --set orientation_deg=[0,-90,0]"),
            "and receives from 0.2 to 12 m; 2 of its 16 beams are missing (missing_beams)\n");
}

TEST_F(CliTest, EchoesOfPointsAreNoSilence) {
  const Outcome outcome = shell(
      "insonify run fan.yaml -o out -q --no-pictures --set orientation_deg=[0,-90,0] --set 'points=[{position: [0, 0, "
      "5]}]'");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(CliTest, PicturesThatAreNearlyBlackAreToldWithTheKeyToChange) {
  const Outcome outcome = shell("insonify run fan.yaml -o out --no-view --set model=paper --set gain=0.001");
  EXPECT_THAT(outcome.out,
              ContainsRegex("\nhint: the loudest echo of ahead is 0\\.[0-9]+ % of full scale, nearly black: "
                            "--scale db shows it, or raise its gain: --set sonars.ahead.gain=[0-9.]+\n"));
  EXPECT_THAT(shell("insonify run fan.yaml -o out --no-view --set model=paper").out, Not(HasSubstr("hint")));
}

}  // namespace
}  // namespace insonify::run_warnings_test
