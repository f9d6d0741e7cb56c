// compare_test.cpp -- insonify compare: tables, JSON, options and errors.

#include <nlohmann/json.hpp>

#include "apps/cli.h"
#include "insonify/recorded_pings.h"
#include "similarity/reference_pictures.h"
#include "support/picture_files.h"

namespace insonify::compare_test {
namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;

// JSON has all digits.
constexpr double kExact = 1e-12;

std::vector<std::uint16_t> words_of(const GreyPicture& picture) {
  std::vector<std::uint16_t> words;
  for (const double value : picture.values) {
    words.push_back(static_cast<std::uint16_t>(std::lround(65535 * value)));
  }
  return words;
}

void write_picture(const std::string& path, const GreyPicture& picture) {
  write_levels(path, picture.columns, picture.rows, words_of(picture));
}

void write_recording(const std::string& path, const std::vector<GreyPicture>& pings, const std::string& sonar = "fls",
                     const std::string& model = "") {
  std::vector<double> values;
  for (const GreyPicture& ping : pings) {
    values.insert(values.end(), ping.values.begin(), ping.values.end());
  }
  write_intensity(path, {pings.size(), static_cast<hsize_t>(pings[0].rows), static_cast<hsize_t>(pings[0].columns)},
                  H5T_IEEE_F64LE, values, sonar, model);
}

class CompareTest : public CliTest {
 protected:
  static json compared(const std::string& arguments) {
    const Outcome outcome = shell("insonify compare --json " + arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return json::parse(outcome.out);
  }

  const GreyPicture a = waves_and_squares(176);
};

void expect_similarity(const json& told, const Similarity& expected) {
  Similarity::visit_fields(expected, [&](const Field& field, double value) {
    EXPECT_NEAR(told.at(std::string(field.name)).get<double>(), value, kExact) << field.name;
  });
}

// ---------------------------------------------------------------- Pictures

TEST_F(CompareTest, JsonHoldsWhatTheLibraryMeasures) {
  write_picture("a.png", a);
  write_picture("b.png", with_noise(a));
  const GreyPicture stored_a = load_grey_picture("a.png"), stored_b = load_grey_picture("b.png");
  const Similarity expected = compare_pictures(stored_a, stored_b);
  const json told = compared("a.png b.png");
  expect_similarity(told, expected);
  EXPECT_EQ(told.at("a"), "a.png");
  EXPECT_EQ(told.at("b"), "b.png");
  EXPECT_EQ(told.at("columns"), 176);
  EXPECT_EQ(told.at("rows"), 176);
  EXPECT_EQ(told.at("pictures"), 1);
  EXPECT_EQ(told.at("pings"), json::array());
  EXPECT_NEAR(told.at("normalised").at("mse").get<double>(), 1 - expected.mse, kExact);
  EXPECT_NEAR(told.at("normalised").at("psnr").get<double>(), expected.psnr_db / (20 * std::log10(255)), kExact);
  EXPECT_EQ(told.at("normalised").at("ssim"), told.at("ssim"));
  EXPECT_EQ(told.at("normalised").at("ms_ssim"), told.at("ms_ssim"));
  const ControlSimilarities controls = compare_controls(stored_a);
  expect_similarity(told.at("controls").at("flat_grey"), controls.flat_grey);
  expect_similarity(told.at("controls").at("range_profile"), controls.range_profile);
  expect_similarity(told.at("controls").at("pixel_shuffle"), controls.pixel_shuffle);
}

TEST_F(CompareTest, APictureAgainstItselfHasNoFinitePsnr) {
  write_picture("a.png", a);
  const json told = compared("a.png a.png");
  EXPECT_EQ(told.at("mse"), 0);
  EXPECT_TRUE(told.at("psnr_db").is_null());
  EXPECT_EQ(told.at("normalised").at("psnr"), 1);
  EXPECT_NEAR(told.at("ssim").get<double>(), 1, kExact);
  EXPECT_NEAR(told.at("ms_ssim").get<double>(), 1, kExact);
  EXPECT_THAT(shell("insonify compare a.png a.png").out,
              ContainsRegex("\npsnr_db +inf +1 +inf +the same in decibels\n"));
}

TEST_F(CompareTest, TheTableTellsValuesMeaningsAndControls) {
  write_picture("a.png", a);
  write_picture("b.png", with_gain(a));
  const std::string table = shell("insonify compare a.png b.png").out;
  EXPECT_THAT(table, HasSubstr("a.png and b.png: 176 columns x 176 rows\n\nmeasure "));
  EXPECT_THAT(table, ContainsRegex("\nmse +0.0007[0-9]* +0.999[0-9]* +0 +mean squared difference\n"));
  EXPECT_THAT(table, ContainsRegex("\nssim +0.976[0-9]* +0.976[0-9]* +1 +local structure\n"));
  EXPECT_THAT(table, ContainsRegex("\ncorrelation +1 +1 +rise and fall together\n"));
  EXPECT_THAT(table, HasSubstr("\nScores of controls made from a.png, without content of the scene:\n"));
  EXPECT_THAT(table, ContainsRegex("\nflat grey +0.0185[0-9]* +1[0-9.]+ .* its mean everywhere\n"));
  EXPECT_THAT(table, ContainsRegex("\npixel shuffle .* 0 \\* +its pixels in random order\n"));
  EXPECT_THAT(table, HasSubstr("\n* no worse than b.png: this number by itself says nothing for it.\n"));
}

// A picture of noise alone is no better a match than a flat grey one.
TEST_F(CompareTest, ControlsThatAreNoWorseAreMarked) {
  write_picture("a.png", a);
  write_picture("b.png", changed(a, [](double, double random) { return random; }));
  EXPECT_THAT(shell("insonify compare a.png b.png").out,
              ContainsRegex("\nflat grey +[0-9.]+ \\* +[0-9.]+ \\* +[0-9.]+ \\* +[0-9.]+"));
}

TEST_F(CompareTest, SmallPicturesHaveFewerScalesOfMsSsim) {
  const GreyPicture small = waves_and_squares(64);
  write_picture("a.png", small);
  write_picture("b.png", shifted(small));
  const json told = compared("a.png b.png");
  EXPECT_EQ(told.at("ms_ssim_scales"), 3);
  EXPECT_NEAR(told.at("ms_ssim").get<double>(), ms_ssim(load_grey_picture("a.png"), load_grey_picture("b.png")),
              kExact);
  EXPECT_NEAR(told.at("ssim").get<double>(), ssim(load_grey_picture("a.png"), load_grey_picture("b.png")), kExact);
  EXPECT_THAT(
      shell("insonify compare a.png b.png").out,
      ContainsRegex("\nms_ssim +0.9[0-9]* +0.9[0-9]* +1 +structure at 3 of five scales: the pictures are small\n"));
  const json skipped = compared("a.png b.png --no-ms-ssim");
  EXPECT_TRUE(skipped.at("ms_ssim").is_null());
  EXPECT_TRUE(skipped.at("normalised").at("ms_ssim").is_null());
  EXPECT_EQ(skipped.at("ms_ssim_scales"), 0);
}

// ---------------------------------------------------------------- Recordings

TEST_F(CompareTest, NumbersOfRecordingsAreMeansOverThePings) {
  write_recording("a.h5", {a, shifted(a), with_gain(a)});
  write_recording("b.h5", {with_noise(a), with_noise(shifted(a), 0.1)});
  const json told = compared("a.h5 b.h5");
  EXPECT_EQ(told.at("sonar"), "fls");
  EXPECT_EQ(told.at("pings"), (json{0, 1}));
  EXPECT_EQ(told.at("pictures"), 2);
  const Similarity first = compare_pictures(a, with_noise(a));
  const Similarity second = compare_pictures(shifted(a), with_noise(shifted(a), 0.1));
  expect_similarity(told.at("each").at(0), first);
  expect_similarity(told.at("each").at(1), second);
  EXPECT_NEAR(told.at("ssim").get<double>(), (first.ssim + second.ssim) / 2, kExact);
  EXPECT_NEAR(told.at("psnr_db").get<double>(), (first.psnr_db + second.psnr_db) / 2, kExact);
  EXPECT_NEAR(told.at("controls").at("flat_grey").at("mse").get<double>(), compare_controls(a).flat_grey.mse, kExact);
  EXPECT_THAT(shell("insonify compare a.h5 b.h5").out,
              HasSubstr("a.h5 and b.h5, sonar fls: 2 pings that both have (a.h5 has 3) of 176 beams x 176 bins; each "
                        "number is the mean over them\n"));
}

TEST_F(CompareTest, PingsCanBeChosen) {
  write_recording("a.h5", {a, shifted(a), a});
  write_recording("b.h5", {with_noise(a), with_gain(a), with_gain(a)});
  const json told = compared("--ping 2 a.h5 b.h5");
  EXPECT_EQ(told.at("pings"), json{2});
  expect_similarity(told, compare_pictures(a, with_gain(a)));
  EXPECT_EQ(compared("a.h5 b.h5 --ping 2 --ping 0").at("pings"), (json{2, 0}));
}

TEST_F(CompareTest, APictureStandsForEveryPing) {
  write_recording("a.h5", {a, shifted(a)});
  write_picture("b.png", a);
  const json told = compared("a.h5 b.png");
  EXPECT_EQ(told.at("pictures"), 2);
  EXPECT_GT(told.at("each").at(0).at("ssim").get<double>(), 0.999);
  EXPECT_LT(told.at("each").at(1).at("ssim").get<double>(), 0.8);
}

TEST_F(CompareTest, PingsOfOneBeamAreComparedSideBySide) {
  // The picture's columns as pings of a single beam.
  const auto scan_of = [](const GreyPicture& picture) {
    std::vector<GreyPicture> pings;
    for (int column = 0; column < picture.columns; ++column) {
      pings.push_back({"", 1, picture.rows, {}});
      for (int row = 0; row < picture.rows; ++row) {
        pings.back().values.push_back(picture.values[row * picture.columns + column]);
      }
    }
    return pings;
  };
  write_recording("a.h5", scan_of(a));
  write_recording("b.h5", scan_of(with_noise(a)));
  const json told = compared("a.h5 b.h5");
  expect_similarity(told, compare_pictures(a, with_noise(a)));
  EXPECT_EQ(told.at("pictures"), 1);
  EXPECT_THAT(shell("insonify compare a.h5 b.h5").out,
              HasSubstr("176 pings of one beam, side by side: 176 columns x 176 rows\n"));
}

TEST_F(CompareTest, OfAFolderTheSonarsRecordingIsTaken) {
  std::filesystem::create_directory("a");
  std::filesystem::create_directory("b");
  write_recording("a/ahead.h5", {a}, "ahead");
  write_recording("a/down.h5", {shifted(a)}, "down");
  write_recording("b/ahead.h5", {with_gain(a)}, "ahead");
  const json told = compared("a b --sonar ahead");
  EXPECT_EQ(told.at("a"), "a/ahead.h5");
  EXPECT_EQ(told.at("b"), "b/ahead.h5");
  expect_similarity(told, compare_pictures(a, with_gain(a)));
  EXPECT_EQ(compared("b b").at("a"), "b/ahead.h5");
}

TEST_F(CompareTest, IntensitiesCountAgainstFullScaleAndInDecibelsWhereAskedTo) {
  // Full scale 20, intensities 1e-4 to 1 of it: with a floor of -40 dB, levels range from 0 to 1.
  const auto loud = [](double value, double) { return 20 * std::pow(10, 4 * value - 4); };
  write_recording("a.h5", {changed(a, loud)});
  write_recording("b.h5", {changed(with_gain(a), loud)});
  const json told = compared("a.h5 b.h5 --full-scale 20 --scale db --floor-db -40");
  EXPECT_NEAR(told.at("mse").get<double>(), 0.0008, 1e-4);
  EXPECT_NEAR(told.at("ssim").get<double>(), ssim(a, with_gain(a)), 1e-9);
}

// Raw intensities of the calibrated model are compared in decibels below the largest of both, unless requested
// otherwise.
TEST_F(CompareTest, CalibratedRecordingsAreComparedInDecibelsBelowTheLoudest) {
  const auto quiet = [](double value, double) { return 1e-6 * std::pow(10, 5 * value - 5); };
  const auto louder = [](double value, double) { return 2e-6 * std::pow(10, 5 * value - 5); };
  write_recording("a.h5", {changed(a, quiet)}, "fls", "calibrated");
  write_recording("b.h5", {changed(a, louder)}, "fls", "calibrated");
  double loudest = 0;
  for (const double value : a.values) {
    loudest = std::max(loudest, louder(value, 0));
  }
  const json told = compared("a.h5 b.h5");
  EXPECT_EQ(told.at("levels").at("scale"), "db");
  EXPECT_NEAR(told.at("levels").at("full_scale").get<double>() / loudest, 1, 1e-6);  // Stored in single precision.
  // Where neither is below the floor they differ by 3.01 dB of 50.
  EXPECT_NEAR(std::sqrt(told.at("mse").get<double>()), 10 * std::log10(2) / 50, 2e-4);
  EXPECT_EQ(compared("a.h5 b.h5 --scale linear").at("levels").at("scale"), "linear");
  EXPECT_EQ(compared("a.h5 b.h5 --full-scale 1e-5").at("levels").at("full_scale"), 1e-5);
  EXPECT_THAT(shell("insonify compare a.h5 b.h5").out,
              HasSubstr("\nlevels from 0 to 1 are decibels from -50 to 0 re an intensity of "));
}

TEST_F(CompareTest, TheRunOfAScenarioIsLikeItselfAndLessLikeAnotherNoise) {
  const Outcome outcome = shell(
      "insonify run fan.yaml -q --no-pictures -o one --seed 1 && insonify run fan.yaml -q --no-pictures -o two --seed "
      "2 "
      "&& insonify compare one one && insonify compare one two");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("one/ahead.h5 and two/ahead.h5, sonar ahead: 3 pings of 16 beams x 40 bins"));
}

TEST_F(CompareTest, DifferentRangesAndAperturesAreToldOf) {
  const Outcome outcome = shell(
      "insonify run fan.yaml -q --no-pictures -o one && insonify run fan.yaml -q --no-pictures -o two --set "
      "max_range=9 --set azimuth_aperture_deg=100 && insonify compare one two && insonify compare one two --json");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string text = "different ranges of 0.2 to 12 m and 0.2 to 9 m, azimuth apertures of 120 and 100 deg";
  EXPECT_THAT(outcome.out,
              HasSubstr("warning: " + text + "; pixels of the same bin and beam are compared all the same\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\"differing\": \"ranges of 0.2 to 12 m"));
}

// ---------------------------------------------------------------- Errors

struct Refusal {
  const char* name;
  const char* arguments;
  const char* message;
};

class CompareRefusalTest : public CompareTest, public testing::WithParamInterface<Refusal> {};

TEST_P(CompareRefusalTest, IsOneLineAndStatusTwo) {
  write_picture("a.png", a);
  write_picture("small.png", waves_and_squares(64));
  write_picture("tiny.png", waves_and_squares(8));
  write_picture("flat.png", changed(a, [](double, double) { return 0.2; }));
  write_levels<std::uint8_t>("colour.png", 1, 1, {1, 2, 3}, 3);
  write_recording("a.h5", {a, a});
  write_recording("loud.h5", {a, changed(a, [](double value, double) { return 3 * value; })});
  write_recording("silent.h5", {a, changed(a, [](double, double) { return 0.0; })});
  write_intensity("none.h5", {0, 176, 176}, H5T_IEEE_F32LE, {});
  folder.write("a.bmp", "BM");
  for (const char* made : {"two", "no"}) {
    std::filesystem::create_directory(made);
  }
  write_recording("two/ahead.h5", {a});
  write_recording("two/down.h5", {a});
  const Outcome outcome = shell(fmt::format("insonify compare {}", GetParam().arguments));
  EXPECT_EQ(outcome.err, fmt::format("insonify: {}\n", GetParam().message));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
}

constexpr Refusal kRefusals[] = {
    {"OneFile", "a.png", "B is required (insonify compare --help)"},
    {"Missing", "a.png b.png", "b.png: no such file or folder"},
    {"OfAnotherShape", "a.png small.png", "small.png: 64 columns x 64 rows, but a.png has 176 columns x 176 rows"},
    {"TooSmall", "tiny.png tiny.png", "tiny.png: 8 columns x 8 rows; SSIM needs at least 11 x 11"},
    {"Constant", "a.png flat.png", "flat.png: every value is 0.2; there is nothing to compare in a constant picture"},
    {"Coloured", "colour.png a.png",
     "colour.png: the pixel in column 0, row 0 is coloured; a comparison needs a grey picture"},
    {"OfUnknownKind", "a.png a.bmp",
     "a.bmp: is neither a recording (.h5, .mcap, .raw, .oculus, .bin, .xtf, .npy, .npz) nor a picture (.png, .jpg, "
     ".jpeg, .pgm)"},
    {"AboveFullScale", "a.h5 loud.h5",
     "loud.h5 ping 1: an intensity is 1.2; it must be from 0 to full scale, 1 (--full-scale)"},
    {"ConstantPing", "a.h5 silent.h5",
     "silent.h5 ping 1: every value is 0; there is nothing to compare in a constant picture"},
    {"NoSuchPing", "a.h5 a.h5 --ping 2", "a.h5: there is no ping 2; it has 2, counted from 0"},
    {"NoPings", "a.h5 none.h5", "none.h5: there are no pings in it"},
    {"PingOfPictures", "a.png a.png --ping 0",
     "a.png and a.png are pictures; --sonar and --ping choose from recordings"},
    {"NegativePing", "a.h5 a.h5 --ping -1",
     "--ping: -1 must be a whole number, from 0 to 18446744073709551615 (insonify compare --help)"},
    {"OtherSonar", "a.h5 a.h5 --sonar down", "a.h5: has no sonar down; its sonar is fls"},
    {"NoSonarChosen", "two two", "two: there are recordings of ahead, down; choose one with --sonar"},
    {"NoSuchSonar", "two two --sonar up", "two: there is not a recording of up, only of ahead, down"},
    {"EmptyFolder", "no two", "no: there is not a recording (.h5, .mcap) in this folder"},
    {"EndlessFullScale", "a.h5 a.h5 --full-scale inf",
     "--full-scale: inf must be a number, greater than 0, at most 1e+30 (insonify compare --help)"},
};

INSTANTIATE_TEST_SUITE_P(All, CompareRefusalTest, testing::ValuesIn(kRefusals),
                         [](const auto& refusal) { return std::string(refusal.param.name); });

// ---------------------------------------------------------------- Counts

// 8-bit counts of a recording are compared as the grey levels of a picture that shows them: those of one ping with
// itself as a picture are equal.
TEST_F(CompareTest, CountsAreComparedAsTheInstrumentDeliversThem) {
  folder.write("wall.yaml", R"(world: wall.obj
receiver: {counts: true, full_scale_db: -60}
sonars: [{beam_count: 180, azimuth_aperture_deg: 60, bin_count: 180, max_range: 20, bits: 8}]
)");
  folder.write("wall.obj", "v 8 -9 -3\nv 8 9 -3\nv 12 9 3\nv 12 -9 3\nf 1 2 3 4\n");
  EXPECT_EQ(shell("insonify run wall.yaml -o wall --no-pictures").status, 0);
  const json told = compared("wall wall --counts");
  EXPECT_EQ(told.at("mse"), 0);
  EXPECT_EQ(told.at("levels").at("scale"), "linear");
  EXPECT_EQ(told.at("levels").at("full_scale"), 1);
  EXPECT_EQ(shell("insonify run wall.yaml -o other --no-pictures --set seed=2").status, 0);
  EXPECT_NE(compared("wall other --counts").at("mse"), compared("wall other").at("mse"));
  EXPECT_EQ(shell("insonify run wall.yaml -o none --no-pictures --set receiver.counts=false").status, 0);
  EXPECT_THAT(shell("insonify compare wall none --counts").err,
              HasSubstr("sonar.h5: has no counts (receiver.counts); --counts compares those of recordings"));
}

}  // namespace
}  // namespace insonify::compare_test
