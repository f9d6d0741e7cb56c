// bad_value_test.cpp -- invalid values of a scenario: types, words, limits, and rules between values.

#include "io/bad_scenario.h"

namespace insonify::bad_value_test {
namespace {

class BadValueTest : public BadScenarioTest {};

TEST_P(BadValueTest, IsToldInOneLine) {
  expect_told_in_one_line();
}

const BadScenario kCases[] = {
    // Types.
    {"WordForANumber", "world: floor.obj\nsonars:\n  - max_range: far\n",
     "scenario.yaml:3:5: sonars[0].max_range = \"far\" must be a number, greater than 0, at most 100000 m"},
    {"UnitInANumber", "world: floor.obj\nsonars:\n  - max_range: 20 m\n",
     "scenario.yaml:3:5: sonars[0].max_range = \"20 m\" must be a number, greater than 0, at most 100000 m"},
    {"QuotedNumber", "world: floor.obj\nwater: {depth: \"3\"}\n",
     "scenario.yaml:2:9: water.depth = \"3\" must be a number, from 0 to 7000 m"},
    {"NoNumber", "world: floor.obj\nwater: {depth: }\n",
     "scenario.yaml:2:9: water.depth has no value; it must be a number, from 0 to 7000 m"},
    {"ListForANumber", "world: floor.obj\nwater: {depth: [1, 2]}\n",
     "scenario.yaml:2:9: water.depth = [1, 2] must be a number, from 0 to 7000 m"},
    {"MapForANumber", "world: floor.obj\nwater: {depth: {m: 3}}\n",
     "scenario.yaml:2:9: water.depth = {...} must be a number, from 0 to 7000 m"},
    {"FractionOfAPing", "world: floor.obj\npings: 2.5\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: pings = 2.5 must be a whole number, from 1 to 1000000000"},
    {"HugeCount", "world: floor.obj\npings: 3e9\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: pings = 3000000000 must be from 1 to 1000000000"},
    {"NegativeSeed", "world: floor.obj\nseed: -1\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: seed = -1 must be a whole number, from 0 to 18446744073709551615"},
    {"HugeSeed", "world: floor.obj\nseed: 18446744073709551616\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: seed = 18446744073709551616 must be a whole number, from 0 to 18446744073709551615"},
    {"YesForTrue", "world: floor.obj\ncollisions: yes\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: collisions = \"yes\" must be true or false"},
    {"TwoCoordinates", "world: floor.obj\nsonars:\n  - position: [1, 2]\n",
     "scenario.yaml:3:5: sonars[0].position = [1, 2] must be a list of three numbers"},
    {"WordForACoordinate", "world: floor.obj\nsonars:\n  - position: [1, up, 2]\n",
     "scenario.yaml:3:19: sonars[0].position[1] = \"up\" must be a number, from -10000000 to 10000000 m"},
    {"NumberForAPosition", "world: floor.obj\nsonars:\n  - position: 5\n",
     "scenario.yaml:3:5: sonars[0].position = 5 must be a list of three numbers"},
    {"WordForAnAngle", "world: floor.obj\nsonars:\n  - orientation_deg: [0, down, 0]\n",
     "scenario.yaml:3:26: sonars[0].orientation_deg[1] = \"down\" must be a number, from -1000000 to 1000000 deg"},
    {"TrajectoryIsAMap", "world: floor.obj\ntrajectory: {time: 0}\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: trajectory = {...} must be a list of waypoints"},
    {"WaterIsANumber", "world: floor.obj\nwater: 1500\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: water = 1500 must be a map of keys such as temperature_c"},

    // Words.
    {"UnknownType", "world: floor.obj\nsonars:\n  - type: sas\n",
     "scenario.yaml:3:5: sonars[0].type = \"sas\" must be fls, msis, sss or mbes"},
    {"SidesAreTwo", "world: floor.obj\nsonars:\n  - type: sss\n    azimuth_aperture_deg: 1\n    beam_count: 3\n",
     "scenario.yaml:5:5: sonars[0].beam_count = 3 must be 2 for type sss, one beam to port and one to starboard"},
    {"SidesAreNarrow", "world: floor.obj\nsonars:\n  - type: sss\n",
     "scenario.yaml:3:5: sonars[0].azimuth_aperture_deg = 120 deg must be at most 60 deg for type sss, whose beams are "
     "narrow along the track"},
    {"SidesDoNotTurn", "world: floor.obj\nsonars:\n  - type: sss\n    azimuth_aperture_deg: 1\n    step_deg: 1\n",
     "scenario.yaml:5:5: sonars[0].step_deg belongs to a scanning sonar; this one's type is sss"},
    {"DepressionOfAFan", "world: floor.obj\nsonars:\n  - depression_deg: 20\n",
     "scenario.yaml:3:5: sonars[0].depression_deg belongs to a side-scan sonar (type: sss); this one's type is fls"},
    {"UnknownMounting", "world: floor.obj\nsonars:\n  - type: msis\n    mounting: sideways\n",
     "scenario.yaml:4:5: sonars[0].mounting = \"sideways\" must be horizontal or vertical"},
    {"UnknownSigmoid", "world: floor.obj\npaper: {sigmoid: tanh}\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:9: paper.sigmoid = \"tanh\" must be logistic, authors or none"},
    {"UnknownSecondary", "world: floor.obj\nsecondary: some\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: secondary = \"some\" must be none, selective or all"},
    {"UnknownEngine", "world: floor.obj\nengine: abacus\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: engine = \"abacus\" must be auto or cpu or gpu or reference"},
    {"UnknownModel", "world: floor.obj\nmodel: papre\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: model = \"papre\" must be paper or calibrated"},
    {"FourSurfaces", "world: floor.obj\nmax_surfaces: 4\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: max_surfaces = 4 must be from 1 to 3"},
    {"PointFarOff",
     "world: floor.obj\nmodel: calibrated\npoints: [{position: [9, 0, 1e9]}]\n"
     "sonars: [{name: fls}]\n",
     "scenario.yaml:3:28: points[0].position[2] = 1000000000 m must be from -10000000 to 10000000 m"},
    {"ChirpWithoutBand", "world: floor.obj\nreceiver: {pulse: lfm, pulse_bandwidth: 1000}\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:24: receiver.pulse_bandwidth = 1000 Hz times receiver.pulse_duration = 5e-05 s is 0.05, must be "
     "at "
     "least 10 for a chirp"},
    {"GainBeyondNumbers",
     "world: floor.obj\nwater: {absorption_db_per_m: 10}\nreceiver: {time_varied_gain: 40}\nsonars: [{name: fls}]\n",
     "scenario.yaml:3:12: receiver.time_varied_gain comes to 1067 dB at 49.95 m, the far end of sonars[0]; must be at "
     "most 300 dB: nothing is left to raise there"},
    {"SonarInTheAir", "world: floor.obj\nsurface: {level: -1}\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:11: surface.level = -1 m must be above the sonars; sonars[0] is at a height of 0 m at time 0 s"},
    {"ArrayAllRound",
     "world: floor.obj\nreceiver: {azimuth_pattern: hann}\nsonars: [{name: fls, azimuth_aperture_deg: 200}]\n",
     "scenario.yaml:2:12: receiver.azimuth_pattern must be top_hat for fans of more than 180 deg; sonars[0] has 200"},
    {"ConeAllRound",
     "world: floor.obj\nreceiver: {azimuth_pattern: top_hat, beam_shape: cone}\nsonars: [{name: fls, "
     "azimuth_aperture_deg: 200}]\n",
     "scenario.yaml:2:38: receiver.beam_shape must be wedge for fans of more than 180 deg; sonars[0] has 200"},
    {"UnknownBeamShape", "world: floor.obj\nreceiver: {beam_shape: pencil}\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:12: receiver.beam_shape = \"pencil\" must be wedge or cone"},
    {"DolphOfTooManyElements",
     "world: floor.obj\nreceiver: {azimuth_pattern: dolph_chebyshev}\n"
     "sonars: [{name: fls, azimuth_resolution_deg: 0.05}]\n",
     "scenario.yaml:2:12: receiver.azimuth_pattern = dolph_chebyshev takes more than 1024 elements for a beam of "
     "0.05 deg"},
    {"RasterOfAnArray",
     "world: floor.obj\nmodel: calibrated\nprimary: raster\nreceiver: {elevation_pattern: hann}\n"
     "sonars: [{name: fls}]\n",
     "scenario.yaml:3:1: primary = raster needs receiver.beam_shape = wedge and receiver.elevation_pattern = top_hat; "
     "auto or rays takes any"},
    {"UnknownElevationPattern", "world: floor.obj\nreceiver: {elevation_pattern: sinc}\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:12: receiver.elevation_pattern = \"sinc\" must be top_hat, rectangular, hann, hamming, cosine, "
     "taylor, dolph_chebyshev or instrument"},
    {"UnknownPattern", "world: floor.obj\nreceiver: {azimuth_pattern: sinc}\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:12: receiver.azimuth_pattern = \"sinc\" must be top_hat, rectangular, hann, hamming, cosine, "
     "taylor, dolph_chebyshev or instrument"},
    {"AzimuthPatternOfTheInstrument",
     "world: floor.obj\nreceiver: {azimuth_pattern: instrument}\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:12: receiver.azimuth_pattern = instrument must be top_hat or a window: a sonar's "
     "azimuth_resolution_deg is its own"},
    {"InstrumentsPatternOfTheInstrument", "world: floor.obj\nsonars: [{name: fls, elevation_pattern: instrument}]\n",
     "scenario.yaml:2:22: sonars[0].elevation_pattern = instrument must be top_hat or a window: it is the "
     "instrument's"},
    {"ErrorsAcrossElevationsTooLarge", "world: floor.obj\nsonars: [{name: fls, elevation_element_error_db: 21}]\n",
     "scenario.yaml:2:22: sonars[0].elevation_element_error_db = 21 dB must be from 0 to 20 dB"},
    {"ErrorsOfMoreThanHalfATurn", "world: floor.obj\nsonars: [{name: fls, elevation_element_error_deg: 181}]\n",
     "scenario.yaml:2:22: sonars[0].elevation_element_error_deg = 181 deg must be from 0 to 180 deg"},
    {"SelfNoiseTooLoud", "world: floor.obj\nsonars: [{name: fls, self_noise_db: 201}]\n",
     "scenario.yaml:2:22: sonars[0].self_noise_db = 201 dB must be from -100 to 200 dB"},
    {"TransmitterOfAHead",
     "world: floor.obj\nsonars: [{name: head, type: msis, beam_count: 1, transmit_width_deg: 60}]\n",
     "scenario.yaml:2:50: sonars[0].transmit_width_deg belongs to a fan; this one's type is msis, whose "
     "azimuth_pattern applies both ways"},
    {"MutualInterferenceAtOnePlace",
     "world: floor.obj\nmutual_interference: true\nsonars: [{name: fls}, {name: other}]\n",
     "scenario.yaml:2:1: sonars[1].position is 0 m from that of sonars[0]; with mutual_interference at least 0.01 m"},
    {"GainTooSteep", "world: floor.obj\nreceiver: {time_varied_gain: 80}\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:12: receiver.time_varied_gain = 80 dB/decade must be from 0 to 60 dB/decade"},
    {"WhiterThanWhite", "world: floor.obj\nmaterials: {sand: {lambert_db: -3}}\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:20: materials.sand.lambert_db = -3 dB must be from -200 to -4.971498727 dB"},
    {"PresetLikeNoOther", "world: floor.obj\nsonars:\n  - preset: x\n",
     "scenario.yaml:3:5: sonars[0].preset = \"x\" is not a preset; there are PRESETS"},
    {"UnknownPreset", "world: floor.obj\nsonars:\n  - preset: gemini-720i\n",
     "scenario.yaml:3:5: sonars[0].preset = \"gemini-720i\" is not a preset; did you mean tritech-gemini-720i?"},
    {"UnknownMode", "world: floor.obj\nsonars:\n  - preset: blueprint-oculus-m750d\n    mode: hihg\n",
     "scenario.yaml:4:5: sonars[0].mode = \"hihg\" is not a mode of blueprint-oculus-m750d, which has low and high"},
    {"ModeWithoutPreset", "world: floor.obj\nsonars:\n  - mode: high\n",
     "scenario.yaml:3:5: sonars[0].mode belongs to a preset, and none is named"},

    // Limits.
    {"NotANumber", "world: floor.obj\nsonars:\n  - max_range: .nan\n",
     "scenario.yaml:3:5: sonars[0].max_range = nan m must be greater than 0, at most 100000 m"},
    {"Infinite", "world: floor.obj\nsonars:\n  - position: [0, .inf, 0]\n",
     "scenario.yaml:3:19: sonars[0].position[1] = inf m must be finite and from -10000000 to 10000000 m"},
    {"BeyondADouble", "world: floor.obj\nsonars:\n  - max_range: 1e999\n",
     "scenario.yaml:3:5: sonars[0].max_range = inf m must be finite and greater than 0, at most 100000 m"},
    {"NegativeRange", "world: floor.obj\nsonars:\n  - max_range: -2\n",
     "scenario.yaml:3:5: sonars[0].max_range = -2 m must be greater than 0, at most 100000 m"},
    {"SonarBeyondTheWorld", "world: floor.obj\nsonars:\n  - position: [0, 0, -1e18]\n",
     "scenario.yaml:3:22: sonars[0].position[2] = -1e+18 m must be from -10000000 to 10000000 m"},
    {"WaypointBeyondTheWorld",
     "world: floor.obj\nsonars: [{name: fls}]\ntrajectory:\n  - {time: 0, position: [1e30, 0, 0]}\n",
     "scenario.yaml:4:26: trajectory[0].position[0] = 1e+30 m must be from -10000000 to 10000000 m"},
    {"CameraBeyondTheWorld", "world: floor.obj\nsonars: [{name: fls}]\nview:\n  position: [0, 2e8, 0]\n",
     "scenario.yaml:4:17: view.position[1] = 200000000 m must be from -100000000 to 100000000 m"},
    {"EndlessRange", "world: floor.obj\nsonars:\n  - max_range: 1e300\n",
     "scenario.yaml:3:5: sonars[0].max_range = 1e+300 m must be greater than 0, at most 100000 m"},
    {"EndlessPeriod", "world: floor.obj\nsonars:\n  - ping_period: 1e300\n",
     "scenario.yaml:3:5: sonars[0].ping_period = 1e+300 s must be greater than 0, at most 1000000 s"},
    {"EndlessTurns", "world: floor.obj\nsonars:\n  - orientation_deg: [0, 0, 1e7]\n",
     "scenario.yaml:3:29: sonars[0].orientation_deg[2] = 10000000 deg must be from -1000000 to 1000000 deg"},
    {"NoPings", "world: floor.obj\npings: 0\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:1: pings = 0 must be from 1 to 1000000000"},
    {"BeamsOutOfLimits", "world: floor.obj\nsonars:\n  - beam_count: 5000\n",
     "scenario.yaml:3:5: sonars[0].beam_count = 5000 must be from 1 to 4096"},
    {"WideFan", "world: floor.obj\nsonars:\n  - azimuth_aperture_deg: 400\n",
     "scenario.yaml:3:5: sonars[0].azimuth_aperture_deg = 400 deg must be greater than 0, at most 360 deg"},
    {"WarmWater", "world: floor.obj\nwater: {temperature_c: 60}\n",
     "scenario.yaml:2:9: water.temperature_c = 60 degC must be from -6 to 35 degC"},
    {"SlowSound", "world: floor.obj\nwater: {sound_speed: 340}\n",
     "scenario.yaml:2:9: water.sound_speed = 340 m/s must be from 1300 to 1700 m/s"},
    {"Reflectivity", "world: floor.obj\nmaterials:\n  hull: {reflectivity: 1.2}\nsonars: [{name: fls}]\n",
     "scenario.yaml:3:10: materials.hull.reflectivity = 1.2 must be from 0 to 1"},
    {"ImpossibleDensity", "world: floor.obj\nmaterials:\n  hull: {density: 1e300}\nsonars: [{name: fls}]\n",
     "scenario.yaml:3:10: materials.hull.density = 1e+300 kg/m^3 must be greater than 0, at most 30000 kg/m^3"},
    {"MaterialWithoutAName", "world: floor.obj\nmaterials:\n  \"\": steel\n",
     "scenario.yaml:3:3: materials has an entry without a name"},
    {"MaterialOfNoName", "world: floor.obj\nmaterials:\n  hull: \"\"\n",
     "scenario.yaml:3:3: materials.hull must name a material"},
    {"MaterialLikeNone", "world: floor.obj\nmaterials:\n  hull: {like: \"\"}\n",
     "scenario.yaml:3:10: materials.hull.like must name a material"},
    {"NoDefaultMaterial", "world: floor.obj\ndefault_material: \"\"\n",
     "scenario.yaml:2:1: default_material must name a material"},
    {"NoBeamAzimuths", "world: floor.obj\nsonars:\n  - beam_azimuths_deg: []\n",
     "scenario.yaml:3:5: sonars[0].beam_azimuths_deg must have at least one angle"},
    {"BeamAzimuth", "world: floor.obj\nsonars:\n  - beam_count: 2\n    beam_azimuths_deg: [200, 0]\n",
     "scenario.yaml:4:25: sonars[0].beam_azimuths_deg[0] = 200 deg must be from -180 to 180 deg"},
    {"SamplingRows", "world: floor.obj\nsonars:\n  - sampling: {rows: 1}\n",
     "scenario.yaml:3:16: sonars[0].sampling.rows = 1 must be from 2 to 8192"},
    {"ViewAngle", "world: floor.obj\nview: {field_of_view_deg: 175}\nsonars: [{name: fls}]\n",
     "scenario.yaml:2:8: view.field_of_view_deg = 175 deg must be greater than 0, at most 170 deg"},

    {"QuaternionOfThree", "world: floor.obj\nsonars:\n  - orientation_wxyz: [1, 0, 0]\n",
     "scenario.yaml:3:5: sonars[0].orientation_wxyz = [1, 0, 0] must be a list of four numbers, w x y z"},
    {"QuaternionOfWords", "world: floor.obj\nsonars:\n  - orientation_wxyz: [1, 0, 0, w]\n",
     "scenario.yaml:3:33: sonars[0].orientation_wxyz[3] = \"w\" must be a number, from -2 to 2"},
    {"QuaternionTooLong", "world: floor.obj\nsonars: [{}]\ntrajectory:\n  - {orientation_wxyz: [1, 0, 0, 1]}\n",
     "scenario.yaml:4:6: trajectory[0].orientation_wxyz = [1, 0, 0, 1] must have a norm of 1, not 1.414"},
    {"TwoOrientations",
     "world: floor.obj\nsonars:\n  - orientation_deg: [0, 0, 0]\n    orientation_wxyz: [1, 0, 0, 0]\n",
     "scenario.yaml:4:5: sonars[0].orientation_wxyz cannot go with orientation_deg: one orientation"},
    {"TrajectoryWithoutItsFile", "world: floor.obj\nsonars: [{}]\ntrajectory: {start: 3}\n",
     "scenario.yaml:3:1: trajectory.file is missing: a CSV or TUM file of waypoints"},
    {"TrajectoryOfAnotherKind", "world: floor.obj\nsonars: [{}]\ntrajectory: track.bag\n",
     "scenario.yaml:3:1: track.bag: is not a trajectory: CSV ends in .csv, TUM in .tum or .txt, KITTI in .txt or "
     ".kitti"},

    // Keys of the other model.
    {"GainInTheCalibratedModel", "world: floor.obj\nsonars:\n  - gain: 2\n",
     "scenario.yaml:3:5: sonars[0].gain has no effect with model = calibrated; set receiver.gain_ranges and "
     "receiver.gains_db for levels, receiver.full_scale_db for counts"},
    {"PaperInTheCalibratedModel", "world: floor.obj\nmodel: calibrated\npaper: {sigmoid: none}\nsonars: [{}]\n",
     "scenario.yaml:3:9: paper.sigmoid has no effect with model = calibrated; it needs model = paper"},
    {"ReflectivityInTheCalibratedModel", "world: floor.obj\nmaterials: {sand: {reflectivity: 0.5}}\nsonars: [{}]\n",
     "scenario.yaml:2:20: materials.sand.reflectivity has no effect with model = calibrated; set reflection for "
     "mirrors "
     "and glints, lambert_db for diffuse echoes"},
    {"PulseInThePaperModel", "world: floor.obj\nmodel: paper\nreceiver: {pulse: cw}\nsonars: [{}]\n",
     "scenario.yaml:3:12: receiver.pulse has no effect with model = paper; it needs model = calibrated"},
    {"RangeGainInThePaperModel", "world: floor.obj\nmodel: paper\nsonars:\n  - receiver: {time_varied_gain: 30}\n",
     "scenario.yaml:4:16: sonars[0].receiver.time_varied_gain has no effect with model = paper; set a sonar's gain"},
    {"SourceLevelInThePaperModel", "world: floor.obj\nmodel: paper\nsonars: [{source_level_db: 210}]\n",
     "scenario.yaml:3:11: sonars[0].source_level_db has no effect with model = paper; set gain"},
    {"LambertInThePaperModel", "world: floor.obj\nmodel: paper\nmaterials: {sand: {lambert_db: -20}}\nsonars: [{}]\n",
     "scenario.yaml:3:20: materials.sand.lambert_db has no effect with model = paper; set reflectivity"},
    {"OwnReceiverOutOfLimits", "world: floor.obj\nsonars:\n  - receiver: {elements: 1}\n",
     "scenario.yaml:3:16: sonars[0].receiver.elements = 1 must be 0 (a continuous line) or at least 2"},

    // Rules between values.
    {"ChirpWiderThanItsCarrier",
     "world: floor.obj\nsonars:\n  - {frequency: 50e3, pulse: lfm, pulse_bandwidth: 100e3, pulse_duration: 1e-3}\n",
     "scenario.yaml:3:35: sonars[0].pulse_bandwidth = 100000 Hz must be less than 100000 Hz, twice "
     "sonars[0].frequency"},
    {"ReceivedChirpWiderThanTheCarrier",
     "world: floor.obj\nreceiver: {pulse: lfm, pulse_duration: 1e-3}\nsonars: [{frequency: 90e3}]\n",
     "scenario.yaml:2:12: receiver.pulse_bandwidth = 200000 Hz must be less than 180000 Hz, twice the frequency of "
     "sonars[0]"},
    // A continuous line has beams of 0.886 wavelengths over its length: 0.886 x 2 mm / (2 sin 0.5 deg) = 0.1015 m.
    {"FocusWithinTheArray",
     "world: floor.obj\nwater: {sound_speed: 1500}\nreceiver: {azimuth_pattern: rectangular}\nsonars:\n  - {frequency: "
     "750e3, azimuth_resolution_deg: 1, focus_range: 0.1}\n",
     "scenario.yaml:5:51: sonars[0].focus_range = 0.1 m must be at least 0.102 m, the length of the array that makes "
     "beams of 1 deg"},
    {"HalfABeamMissing", "world: floor.obj\nsonars:\n  - missing_beams: [3, 2.5]\n",
     "scenario.yaml:3:24: sonars[0].missing_beams[1] = 2.5 must be a whole number, from 0 to 4095"},
    {"RangesCross", "world: floor.obj\nsonars:\n  - max_range: 2\n    min_range: 5\n",
     "scenario.yaml:3:5: sonars[0].max_range = 2 m must be greater than min_range = 5 m"},
    {"BlankingBeyondRange", "world: floor.obj\nsonars:\n  - max_range: 2\n    blanking_range: 5\n",
     "scenario.yaml:4:5: sonars[0].blanking_range = 5 m must be at most max_range = 2 m"},
    {"HastyPings", "world: floor.obj\nwater: {sound_speed: 1500}\nsonars:\n  - ping_period: 0.01\n",
     "scenario.yaml:4:5: sonars[0].ping_period = 0.01 s must be at least 0.0667 s, the time sound takes to max_range = "
     "50 m and back"},
    {"SameNames", "world: floor.obj\nsonars:\n  - name: fls\n  - max_range: 20\n    name: fls\n",
     "scenario.yaml:5:5: sonars[1].name = \"fls\" must differ from that of sonars[0]"},
    {"TwoSonarsWithoutNames", "world: floor.obj\nsonars:\n  - max_range: 30\n  - max_range: 20\n",
     "scenario.yaml:4:5: sonars[1].name = \"sonar\" must differ from that of sonars[0]"},
    {"NameWithASlash", "world: floor.obj\nsonars:\n  - name: a/b\n",
     "scenario.yaml:3:5: sonars[0].name must not be empty, start with '.' or hold a slash, a backslash or a control "
     "character"},
    {"TooFewBeamAzimuths", "world: floor.obj\nsonars:\n  - beam_azimuths_deg: [20, 0, -20]\n    beam_count: 256\n",
     "scenario.yaml:3:5: sonars[0].beam_azimuths_deg has 3 angles, must have one for each of beam_count = 256"},
    {"BeamAzimuthsFromStarboard", "world: floor.obj\nsonars:\n  - beam_azimuths_deg: [-20, 0, 20]\n",
     "scenario.yaml:3:5: sonars[0].beam_azimuths_deg[1] = 0 deg must be less than beam_azimuths_deg[0] = -20 deg: "
     "beams "
     "run from port to starboard"},
    {"ApertureBesideBeamAzimuths",
     "world: floor.obj\nsonars:\n  - beam_azimuths_deg: [20, 0, -20]\n    azimuth_aperture_deg: 90\n",
     "scenario.yaml:4:5: sonars[0].azimuth_aperture_deg follows from beam_azimuths_deg; leave it out"},
    {"FanThatTurns", "world: floor.obj\nsonars:\n  - type: msis\n",
     "scenario.yaml:3:5: sonars[0].beam_count = 256 must be 1 for type msis, whose head turns a single beam: say "
     "beam_count: 1"},
    {"TimeStandsStill",
     "world: floor.obj\nsonars: [{name: fls}]\ntrajectory:\n  - {time: 0}\n  - {time: 2}\n  - time: 2\n",
     "scenario.yaml:6:5: trajectory[2].time = 2 s must be greater than trajectory[1].time = 2 s"},
    {"MotionOfNothing", "world: floor.obj\nsonars: [{name: fls}]\nmotions:\n  - trajectory: [{time: 0}]\n",
     "scenario.yaml:4:5: motions[0].object is missing: the name of what moves"},
    {"MotionWithoutTrajectory", "world: floor.obj\nsonars: [{name: fls}]\nmotions:\n  - object: ship\n",
     "scenario.yaml:4:5: motions[0].trajectory must have at least one waypoint"},
    {"MotionBackInTime",
     "world: floor.obj\nsonars: [{name: fls}]\nmotions:\n  - object: ship\n    trajectory:\n      - {time: 5}\n      - "
     "{time: 4}\n",
     "scenario.yaml:7:10: motions[0].trajectory[1].time = 4 s must be greater than motions[0].trajectory[0].time = 5 "
     "s"},
    {"ViewOfItself", "world: floor.obj\nsonars: [{name: fls}]\nview: {position: [1, 2, 3], look_at: [1, 2, 3]}\n",
     "scenario.yaml:3:29: view.look_at must differ from view.position"},

};

INSTANTIATE_TEST_SUITE_P(Scenario, BadValueTest, testing::ValuesIn(kCases),
                         [](const auto& bad) { return std::string(bad.param.name); });

}  // namespace
}  // namespace insonify::bad_value_test
