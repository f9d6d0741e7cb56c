// preset_test.cpp -- every preset loads in every mode and cites its sources.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "insonify/files.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::preset_test {
namespace {

using testing::AnyOf;
using testing::Contains;
using testing::ElementsAre;
using testing::IsSupersetOf;
using testing::Not;

// Tolerance: one digit more than the data sheets have.
constexpr double kSheetTolerance = 1e-9;

TEST(PresetTest, EveryInstrumentOfTheListIsThere) {
  EXPECT_THAT(
      preset_names(),
      ElementsAre("blueprint-oculus-m1200d", "blueprint-oculus-m3000d", "blueprint-oculus-m370s",
                  "blueprint-oculus-m750d", "bluerobotics-ping360", "cerulean-surveyor-240-16", "deepvision-de680",
                  "edgetech-4125", "edgetech-4200", "imagenex-881a", "klein-3500", "kongsberg-em2040", "kongsberg-m3",
                  "marinesonic-arc-scout", "norbit-iwbms", "r2sonic-2024", "reson-seabat-t50-p",
                  "soundmetrics-aris-explorer-1800", "soundmetrics-aris-explorer-3000", "soundmetrics-didson",
                  "starfish-452f", "starfish-990f", "teledyne-blueview-m900-2250", "teledyne-blueview-p900-130",
                  "teledyne-blueview-p900-45", "tritech-gemini-1200ik", "tritech-gemini-720i", "tritech-gemini-720im",
                  "tritech-gemini-720is", "tritech-micron-dst", "tritech-super-seaking"));
}

TEST(PresetTest, EveryPresetLoadsInEveryMode) {
  for (const std::string& name : preset_names()) {
    for (const std::string& mode : load_preset(name).modes) {
      SCOPED_TRACE(name + " " + mode);
      const Preset preset = load_preset(name, mode);
      EXPECT_EQ(preset.name, name);
      EXPECT_THAT(preset.modes, Contains(preset.default_mode));
      EXPECT_NO_THROW(preset.sonar.validate());
      EXPECT_LE(preset.sonar.bin_count, preset.instrument.bin_limit);
      // A gap between beams much wider than a beam would be a typing error. The DIDSON's spacing is 1.5 beam widths.
      const double spacing = preset.sonar.azimuth_aperture / preset.sonar.beam_count;
      EXPECT_LT(spacing, 1.6 * preset.sonar.azimuth_resolution.value());
    }
  }
}

TEST(PresetTest, EveryFactHasItsConfidenceAndItsSource) {
  for (const std::string& name : preset_names()) {
    for (const std::string& mode : load_preset(name).modes) {
      for (const PresetFact& fact : load_preset(name, mode).facts) {
        SCOPED_TRACE(name + " " + mode + " " + fact.field);
        EXPECT_THAT(fact.confidence, AnyOf("A", "B", "C"));
        EXPECT_GT(fact.source.size(), 10U);
        EXPECT_FALSE(fact.value.empty());
      }
    }
  }
}

TEST(PresetTest, EveryPresetGivesWhatItsInstrumentNeeds) {
  for (const std::string& name : preset_names()) {
    for (const std::string& mode : load_preset(name).modes) {
      const Preset preset = load_preset(name, mode);
      std::vector<std::string> fields;
      for (const PresetFact& fact : preset.facts) {
        fields.push_back(fact.field);
      }
      for (const char* needed : {"type", "frequency", "beam_count", "azimuth_aperture_deg", "elevation_aperture_deg",
                                 "azimuth_resolution_deg", "min_range", "max_range", "bin_limit", "bit_depths",
                                 "source_level_db", "bandwidth", "mapping", "elevation_pattern"}) {
        EXPECT_THAT(fields, Contains(needed)) << name << " " << mode;
      }
    }
  }
}

// Counts of the ARIS are 0 to 80 dB (Sound Metrics, aris-file-sdk), those of the DIDSON 0 to 90 dB (Echoview).
TEST(PresetTest, CountsOfTheLensesHaveTheirPublishedRange) {
  for (const auto& [name, range_db] : {std::pair{"soundmetrics-aris-explorer-3000", 80.0},
                                       {"soundmetrics-aris-explorer-1800", 80.0},
                                       {"soundmetrics-didson", 90.0}}) {
    const SonarConfig sonar = load_preset(name).sonar;
    EXPECT_EQ(sonar.mapping, Mapping::kLogarithmic);
    EXPECT_EQ(sonar.mapping_range_db, range_db) << name;
  }
}

// Half power at the edges of the fan; elements half a wavelength wide: sinc^2(0.5 u) is a half at u = 0.8859. Lenses
// send and receive each beam alone.
TEST(PresetTest, FansHaveTransmittersAndElements) {
  for (const std::string& name : preset_names()) {
    for (const std::string& mode : load_preset(name).modes) {
      SCOPED_TRACE(name + " " + mode);
      const SonarConfig sonar = load_preset(name, mode).sonar;
      EXPECT_EQ(sonar.elevation_pattern, BeamPattern::kRectangular);
      EXPECT_EQ(sonar.elevation_element_error_db, 1);
      EXPECT_NEAR(degrees_from_radians(sonar.elevation_element_error), 10, kSheetTolerance);
      const bool fan =
          sonar.is_multibeam() || (sonar.type == SonarType::kForwardLooking && sonar.steering == Steering::kElectronic);
      ASSERT_EQ(sonar.transmit_width.has_value(), fan);
      ASSERT_EQ(sonar.element_width.has_value(), fan);
      if (fan) {
        EXPECT_NEAR(*sonar.transmit_width, sonar.azimuth_aperture, kSheetTolerance);
        EXPECT_NEAR(std::sin(0.5 * *sonar.element_width), 0.8859, 0.0003);
      }
    }
  }
}

TEST(PresetTest, TheGemini720isLooksDown) {
  EXPECT_NEAR(degrees_from_radians(load_preset("tritech-gemini-720is").sonar.elevation_center), -10, kSheetTolerance);
}

// A gradian is 0.9 degrees; the Micron's unit is a sixteenth of one, 0.05625 degrees, of which 0.9 degrees are 16.
TEST(PresetTest, HeadsTurnBySteps) {
  EXPECT_NEAR(degrees_from_radians(load_preset("bluerobotics-ping360").sonar.head.step), 0.9, kSheetTolerance);
  const Preset micron = load_preset("tritech-micron-dst");
  EXPECT_NEAR(degrees_from_radians(micron.sonar.head.step), 0.9, kSheetTolerance);
  EXPECT_NEAR(degrees_from_radians(micron.sonar.head.sector_width), 360, kSheetTolerance);
  ASSERT_EQ(micron.instrument.steps.size(), 4U);
  EXPECT_NEAR(degrees_from_radians(micron.instrument.steps[3]), 3.6, kSheetTolerance);
}

TEST(PresetTest, FactsAreThoseOfTheMode) {
  const Preset preset = load_preset("blueprint-oculus-m750d", "high");
  const auto fact = std::ranges::find(preset.facts, "azimuth_aperture_deg", &PresetFact::field);
  ASSERT_NE(fact, preset.facts.end());
  EXPECT_EQ(fact->value, "70");
  EXPECT_EQ(fact->unit, "deg");
  EXPECT_EQ(fact->confidence, "B");
  EXPECT_EQ(fact->source, "Blueprint Subsea data sheet, recalled");
}

// ---------------------------------------------------------------- Range and rate

TEST(PresetTest, BinsFollowFromTheRange) {
  const Preset aris = load_preset("soundmetrics-aris-explorer-3000");
  SonarConfig sonar = aris.sonar;
  sonar.max_range = 2.2;  // 1.5 m in bins of 3 mm.
  aris.fit_to_range(sonar, 1500);
  EXPECT_EQ(sonar.bin_count, 500);
  sonar.max_range = 2.201;  // A third of a bin more takes a whole one.
  aris.fit_to_range(sonar, 1500);
  EXPECT_EQ(sonar.bin_count, 501);
  sonar.max_range = 15;
  aris.fit_to_range(sonar, 1500);
  EXPECT_EQ(sonar.bin_count, 1000);
}

// ---------------------------------------------------------------- Pulse

TEST(PresetTest, EveryInstrumentHasAPulseThatEndsBeforeItsShortestRange) {
  for (const std::string& name : preset_names()) {
    for (const std::string& mode : load_preset(name).modes) {
      SCOPED_TRACE(name + " " + mode);
      const SonarConfig& sonar = load_preset(name, mode).sonar;
      EXPECT_NE(sonar.pulse, PulseKind::kNone);
      if (sonar.pulse == PulseKind::kLfm) {
        EXPECT_LE(sonar.pulse_duration, 2 * sonar.min_range / 1500);
        EXPECT_NE(sonar.pulse_window, PulseWindow::kRectangular);
      }
    }
  }
}

// Durations: of the Ping360 8000 range / c microseconds, from 5 to 500; of the ARIS 3000 2 us a metre from 5 to 16
// (high) and 7 + 1.75 (range - 4) from 8 to 24 (low); of the ARIS 1800 2 (range - 5) from 6 to 25 and 7 + range up
// to 40; of the Gemini 720i 4 cycles below 10 m, 18 at 30 m, 32 at 50 m, 80 at 75 m and 128 from 100 m on.
TEST(PresetTest, PulsesGrowWithTheRangeAsTheInstrumentsDo) {
  const auto microseconds = [](const char* name, const char* mode, double range) {
    const Preset preset = load_preset(name, mode);
    SonarConfig sonar = preset.sonar;
    sonar.max_range = range;
    preset.fit_to_range(sonar, 1500);
    EXPECT_EQ(sonar.pulse, PulseKind::kCw);
    return std::round(sonar.pulse_duration * 1e9) / 1e3;
  };
  const auto over = [&](const char* name, const char* mode, std::vector<double> ranges) {
    std::ranges::transform(ranges, ranges.begin(), [&](double range) { return microseconds(name, mode, range); });
    return ranges;
  };
  EXPECT_THAT(over("bluerobotics-ping360", "", {0.8, 3, 20, 50}), ElementsAre(5, 16, 107, 267));
  EXPECT_THAT(over("soundmetrics-aris-explorer-3000", "high", {1, 3, 4.2, 5}), ElementsAre(5, 6, 8, 10));
  EXPECT_THAT(over("soundmetrics-aris-explorer-3000", "low", {4, 8, 12, 15}), ElementsAre(8, 14, 21, 24));
  EXPECT_THAT(over("soundmetrics-aris-explorer-1800", "high", {7, 10, 15}), ElementsAre(6, 10, 20));
  EXPECT_THAT(over("soundmetrics-aris-explorer-1800", "low", {6, 20, 35}), ElementsAre(13, 27, 40));
  EXPECT_THAT(over("tritech-gemini-720i", "", {5, 30, 50, 75, 120}), ElementsAre(6, 25, 44, 111, 178));
  EXPECT_THAT(over("tritech-gemini-720im", "", {5, 30, 50}), ElementsAre(6, 25, 44));
}

TEST(PresetTest, AScenariosOwnPulseDurationStays) {
  const WorkingFolder folder;
  folder.write("a.yaml",
               "world: none\nsonars: [{preset: bluerobotics-ping360, max_range: 20}, {name: b, preset: "
               "bluerobotics-ping360, max_range: 20, pulse_duration: 30e-6}]\n");
  const Scenario scenario = load_scenario("a.yaml");
  EXPECT_NEAR(scenario.sonars[0].pulse_duration, 107e-6, 1e-12);
  EXPECT_EQ(scenario.sonars[1].pulse_duration, 30e-6);
}

TEST(PresetTest, TheDidsonHas512BinsOverAnyRange) {
  const Preset didson = load_preset("soundmetrics-didson");
  SonarConfig sonar = didson.sonar;
  sonar.max_range = 3.7;
  didson.fit_to_range(sonar, 1500);
  EXPECT_EQ(sonar.bin_count, 512);
}

TEST(PresetTest, PingsComeAtTheInstrumentsRateOrTheSounds) {
  const Preset gemini = load_preset("tritech-gemini-720i");
  SonarConfig sonar = gemini.sonar;
  EXPECT_FALSE(sonar.ping_period.has_value());  // 120 m and back take longer than 1/30 s.
  sonar.max_range = 10;
  gemini.fit_to_range(sonar, 1500);
  EXPECT_EQ(sonar.ping_period, 1.0 / 30);
  sonar.max_range = 50;
  gemini.fit_to_range(sonar, 1500);
  EXPECT_FALSE(sonar.ping_period.has_value());
}

// The beams, which reach 5 degrees up, hit the cone at up to 3.8 m of its height of 8 m.

class OwnPresetTest : public testing::Test {
 protected:
  OwnPresetTest() { setenv("INSONIFY_PRESETS", folder.path().c_str(), 1); }
  ~OwnPresetTest() override { unsetenv("INSONIFY_PRESETS"); }

  std::string message(const std::string& yaml) const {
    folder.write("mine.yaml", yaml);
    std::string text = message_of([] { (void)load_preset("mine"); });
    const std::string path = folder.path().string() + "/";
    return text.starts_with(path) ? text.substr(path.size()) : text;
  }

  WorkingFolder folder;
};

constexpr const char* kHead = "title: Mine\ndefault_mode: wide\nsources: {sheet: My own data sheet}\n";

TEST_F(OwnPresetTest, IsReadFromTheFolderOfTheEnvironment) {
  folder.write("mine.yaml",
               std::string(kHead) + "modes:\n  wide:\n    beam_count: {value: 99, confidence: C, source: sheet}\n");
  EXPECT_THAT(preset_names(), IsSupersetOf({"mine", "tritech-gemini-720i"}));  // Beside the installed ones.
  EXPECT_EQ(load_preset("mine").sonar.beam_count, 99);
  EXPECT_EQ(load_preset("mine").sonar.model, "Mine");
  EXPECT_EQ(load_preset("mine").facts.at(0).source, "My own data sheet");
}

TEST_F(OwnPresetTest, ReplacesAShippedOneOfTheSameName) {
  folder.write("tritech-gemini-720i.yaml",
               std::string(kHead) + "modes:\n  wide:\n    beam_count: {value: 99, confidence: C, source: sheet}\n");
  EXPECT_EQ(load_preset("tritech-gemini-720i").sonar.beam_count, 99);
  EXPECT_EQ(std::ranges::count(preset_names(), "tritech-gemini-720i"), 1);
}

TEST_F(OwnPresetTest, ComesFromTheFirstOfSeveralFoldersThatHasIt) {
  const auto write = [&](const std::string& name, int beams) {
    folder.write(name, fmt::format("{}modes:\n  wide:\n    beam_count: {{value: {}, confidence: C, source: sheet}}\n",
                                   kHead, beams));
  };
  std::filesystem::create_directories(folder.path() / "a");
  std::filesystem::create_directories(folder.path() / "b");
  write("a/both.yaml", 11);
  write("b/both.yaml", 22);
  write("b/second.yaml", 33);
  const std::string folders = fmt::format("{0}/a:{0}/b:", folder.path().string());
  setenv("INSONIFY_PRESETS", folders.c_str(), 1);
  EXPECT_EQ(load_preset("both").sonar.beam_count, 11);
  EXPECT_EQ(load_preset("second").sonar.beam_count, 33);
  EXPECT_EQ(load_preset("second").file, folder.path() / "b/second.yaml");
}

TEST_F(OwnPresetTest, NeedsItsParts) {
  EXPECT_EQ(message("default_mode: wide\n"), "mine.yaml:1:1: title is missing");
  EXPECT_EQ(message("title: Mine\ndefault_mode: wide\n"), "mine.yaml:1:1: modes is missing");
  EXPECT_EQ(message("title: Mine\ndefault_mode: wdie\nsources: {}\nmodes: {wide: {}}\n"),
            "mine.yaml:2:1: \"wdie\" is not a mode of mine, which has wide");
}

TEST_F(OwnPresetTest, EveryFactNeedsItsConfidenceAndASourceThatIsTold) {
  EXPECT_EQ(message(std::string(kHead) + "modes:\n  wide:\n    beam_count: 99\n"),
            "mine.yaml:6:5: modes.wide.beam_count = 99 must be a map of the keys value, confidence and source");
  EXPECT_EQ(message(std::string(kHead) + "modes:\n  wide:\n    beam_count: {value: 99, source: sheet}\n"),
            "mine.yaml:6:5: modes.wide.beam_count.confidence is missing");
  EXPECT_EQ(
      message(std::string(kHead) + "modes:\n  wide:\n    beam_count: {value: 99, confidence: D, source: sheet}\n"),
      "mine.yaml:6:5: modes.wide.beam_count.confidence = \"D\" must be A, B or C");
  EXPECT_EQ(
      message(std::string(kHead) + "modes:\n  wide:\n    beam_count: {value: 99, confidence: C, source: shete}\n"),
      "mine.yaml:6:5: modes.wide.beam_count.source = \"shete\" is not one of the sources; did you mean sheet?");
}

TEST_F(OwnPresetTest, RefusesWhatASonarRefuses) {
  EXPECT_EQ(message(std::string(kHead) + "modes:\n  wide:\n    beam_count: {value: 0, confidence: C, source: sheet}\n"),
            "mine.yaml:6:5: beam_count = 0 must be from 1 to 4096");
  EXPECT_EQ(message(std::string(kHead) + "modes:\n  wide:\n    beam_cont: {value: 9, confidence: C, source: sheet}\n"),
            "mine.yaml:6:5: modes.wide.beam_cont is not a known key; did you mean beam_count?");
  EXPECT_EQ(
      message(std::string(kHead) + "modes:\n  wide:\n    max_range: {value: 0.1, confidence: C, source: sheet}\n"),
      "mine.yaml:1:1: mine.max_range = 0.1 m must be greater than min_range = 0.2 m");
  const auto pulses = [&](const char* ranges, const char* durations) {
    return message(
        fmt::format("{}modes:\n  wide:\n    pulse_ranges: {{value: {}, confidence: C, source: sheet}}\n    "
                    "pulse_durations: {{value: {}, confidence: C, source: sheet}}\n",
                    kHead, ranges, durations));
  };
  EXPECT_EQ(pulses("[1, 2]", "[1e-5]"),
            "mine.yaml:1:1: mine.pulse_durations has 1 values, must have one for each of the 2 of pulse_ranges");
  EXPECT_EQ(pulses("[2, 2]", "[1e-5, 2e-5]"), "mine.yaml:1:1: mine.pulse_ranges = [2, 2] must rise");
  EXPECT_EQ(pulses("[1, 2]", "[1e-5, -2e-5]"),
            "mine.yaml:7:37: pulse_durations[1] = -2e-05 s must be greater than 0, at most 1 s");
}

TEST(PresetNameTest, TheNearestIsNamed) {
  EXPECT_EQ(message_of([] { (void)load_preset("tritech-micron"); }),
            "\"tritech-micron\" is not a preset; did you mean tritech-micron-dst?");
  EXPECT_EQ(message_of([] { (void)load_preset("tritech-micron-dst", "fast"); }),
            "\"fast\" is not a mode of tritech-micron-dst, which has standard");
  EXPECT_THAT(preset_names(), Not(Contains("tritech-micron")));
}

TEST(PresetNameTest, AnEntryThatIsNoFolderIsNamed) {
  setenv("INSONIFY_PRESETS", "/tmp:/nowhere", 1);
  EXPECT_EQ(message_of([] { (void)preset_names(); }), "INSONIFY_PRESETS = \"/nowhere\" must be a folder of presets");
  unsetenv("INSONIFY_PRESETS");
}

}  // namespace
}  // namespace insonify::preset_test
