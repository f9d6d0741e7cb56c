// sound_speed_test.cpp -- sound-speed formulas against values from the papers, and refraction in a constant gradient.

#include "insonify/acoustics/sound_speed.h"

#include <gtest/gtest.h>

#include <cmath>

#include "insonify/geometry.h"
#include "support/message_of.h"
#include "support/relative.h"

namespace insonify::sound_speed_test {
namespace {

// Computed from the published equations in double precision, independently of this code.
struct Site {
  double temperature_c, salinity, depth, latitude_deg;
  double pressure_mpa, mackenzie, medwin, chen_millero, del_grosso, leroy;

  double latitude() const { return radians_from_degrees(latitude_deg); }
};

constexpr Site kSites[] = {
    {10, 35, 0, 45, 0.0, 1489.8034, 1489.99, 1489.8321158656643, 1489.7893816900003, 1489.8195},
    {10, 35, 100, 45, 1.0028164339682568, 1491.435067861, 1491.59, 1491.4832900856118, 1491.4205830081883,
     1491.4350832},
    {2, 34.7, 4000, 30, 40.62527883102861, 1525.32451, 1521.78632, 1526.0058131371209, 1525.3670541861122,
     1525.4023756},
    {25, 35, 10, 0, 0.09958390327034508, 1534.4573917321525, 1534.51625, 1534.5779855689937, 1534.5208702867817,
     1534.6342404689497},
    {20, 38, 500, 40, 5.033345206838714, 1533.05829025, 1532.94, 1533.221360940828, 1533.1129323758419, 1533.1235625},
    {15, 30, 50, 55, 0.5009690872365629, 1501.5763924114376, 1501.65375, 1501.6887833963606, 1501.6653182347645,
     1501.7270598062503},
    {20, 0, 1, 45, 0.009976715293652101, 1481.7545001674857, 1481.636, 1482.375008714944, 1482.391979199074,
     1482.4357202549736},
    {4, 0, 10, 45, 0.09985037945416415, 1421.1885703471444, 1421.39856, 1421.788468963029, 1421.7581961200804,
     1421.7991134888998},
};

class SoundSpeedTest : public testing::TestWithParam<Site> {};

TEST_P(SoundSpeedTest, IsThatOfEachPaper) {
  const Site p = GetParam();
  const double latitude = p.latitude();
  EXPECT_THAT(pressure_mpa(p.depth, latitude), RelativelyNear(p.pressure_mpa));
  EXPECT_THAT(mackenzie_sound_speed(p.temperature_c, p.salinity, p.depth), RelativelyNear(p.mackenzie));
  EXPECT_THAT(medwin_sound_speed(p.temperature_c, p.salinity, p.depth), RelativelyNear(p.medwin));
  EXPECT_THAT(chen_millero_sound_speed(p.temperature_c, p.salinity, p.depth, latitude), RelativelyNear(p.chen_millero));
  EXPECT_THAT(del_grosso_sound_speed(p.temperature_c, p.salinity, p.depth, latitude), RelativelyNear(p.del_grosso));
  EXPECT_THAT(leroy_sound_speed(p.temperature_c, p.salinity, p.depth, latitude), RelativelyNear(p.leroy));
}

INSTANTIATE_TEST_SUITE_P(Sites, SoundSpeedTest, testing::ValuesIn(kSites));

// Within the limits of all five: sea water, no deeper than Medwin's 1000 m. They were fitted to the same few
// measurements.
TEST(SoundSpeedValuesTest, AgreeBetweenPapersInTheSea) {
  constexpr double kSpread = 0.7;  // [m/s]
  for (const Site& p : kSites) {
    if (p.salinity >= 30 && p.depth <= 1000) {
      const double speed = chen_millero_sound_speed(p.temperature_c, p.salinity, p.depth, p.latitude());
      EXPECT_NEAR(mackenzie_sound_speed(p.temperature_c, p.salinity, p.depth), speed, kSpread);
      EXPECT_NEAR(medwin_sound_speed(p.temperature_c, p.salinity, p.depth), speed, kSpread);
      EXPECT_NEAR(del_grosso_sound_speed(p.temperature_c, p.salinity, p.depth, p.latitude()), speed, kSpread);
      EXPECT_NEAR(leroy_sound_speed(p.temperature_c, p.salinity, p.depth, p.latitude()), speed, kSpread);
    }
  }
}

// The check value that Mackenzie printed.
TEST(SoundSpeedValuesTest, MackenziesOwnCheckValue) {
  EXPECT_NEAR(mackenzie_sound_speed(25, 35, 1000), 1550.744, 5e-4);
}

TEST(SoundSpeedValuesTest, LatitudeIs45DegreesUnlessGiven) {
  const double at_45 = radians_from_degrees(45);
  EXPECT_EQ(chen_millero_sound_speed(8, 34, 800), chen_millero_sound_speed(8, 34, 800, at_45));
  EXPECT_EQ(del_grosso_sound_speed(8, 34, 800), del_grosso_sound_speed(8, 34, 800, at_45));
}

TEST(PressureTest, IsThatOfLeroyAndParthiot) {
  EXPECT_THAT(pressure_mpa(10, radians_from_degrees(45)), RelativelyNear(0.09985037945416415));
  EXPECT_THAT(pressure_mpa(100, radians_from_degrees(45)), RelativelyNear(1.0028164339682568));
  EXPECT_THAT(pressure_mpa(1000, radians_from_degrees(45)), RelativelyNear(10.091135365795802));
  EXPECT_THAT(pressure_mpa(5000, 0), RelativelyNear(50.8333009668935));
  EXPECT_THAT(pressure_mpa(10000, radians_from_degrees(45)), RelativelyNear(103.08994923730143));
}

// A sonar that assumes 1500 m/s shows ranges 1500/c times too long: in a lake of 5 degC, five metres down, by 5.171 %.
TEST(SoundSpeedValuesTest, AColdLakeShowsRangesFivePercentTooLong) {
  constexpr double kPrinted = 5e-4;  // The expected value has been rounded to this.
  EXPECT_NEAR((1500 / chen_millero_sound_speed(5, 0, 5) - 1) * 100, 5.171, kPrinted);
}

// ---------------------------------------------------------------- Bent paths

struct Bend {
  double sound_speed, gradient, launch_deg, distance;
  double radius, drop, angle_deg, time;
};

// Closed form, which a Runge-Kutta integration of the ray equations confirmed to 1e-11.
constexpr Bend kBends[] = {
    {1500, 0.017, 0, 100, 88235.29411764705, -0.0566666848640896, -0.06493523068244775, 0.06666669520989854},
    {1500, -1, 0, 50, -1500, 0.8335649435050052, 1.9102131717099304, 0.033345687249336106},
    {1520, -2, 5, 60, -762.903076532944, 7.656306010055174, 9.543867677897108, 0.03998507733566325},
    {1490, 0.5, -3, 40, 2984.0895910738045, -2.36570656856449, -3.7693646944118897, 0.02690302567400217},
};

class BentPathTest : public testing::TestWithParam<Bend> {};

TEST_P(BentPathTest, IsAnArcOfTheRightRadius) {
  const Bend b = GetParam();
  const BentPath path = bent_path(b.sound_speed, b.gradient, radians_from_degrees(b.launch_deg), b.distance);
  EXPECT_THAT(path.radius, RelativelyNear(b.radius));
  EXPECT_THAT(path.drop, RelativelyNear(b.drop));
  EXPECT_THAT(degrees_from_radians(path.angle), RelativelyNear(b.angle_deg));
  EXPECT_THAT(path.time, RelativelyNear(b.time));
}

INSTANTIATE_TEST_SUITE_P(Bends, BentPathTest, testing::ValuesIn(kBends));

// Snell's law: cos(angle)/c is the same at both ends, c at the far end being that of the depth reached there.
TEST(BentPathLawTest, ObeysSnell) {
  const double launch = radians_from_degrees(-20);
  const BentPath path = bent_path(1480, 0.8, launch, 300);
  const double speed_there = 1480 + 0.8 * path.drop;
  EXPECT_THAT(std::cos(path.angle) / speed_there, RelativelyNear(std::cos(launch) / 1480));
}

// A gradient of nothing much leaves a straight line: drop x tan(launch), time x / (c cos(launch)).
TEST(BentPathLawTest, BecomesStraightAsTheGradientVanishes) {
  const double launch = radians_from_degrees(12);
  const BentPath path = bent_path(1500, 1e-9, launch, 80);
  EXPECT_THAT(path.drop, RelativelyNear(80 * std::tan(launch)));
  EXPECT_THAT(path.angle, RelativelyNear(launch));
  EXPECT_THAT(path.time, RelativelyNear(80 / (1500 * std::cos(launch))));
}

TEST(BentPathLawTest, StartsAtItsLaunchPoint) {
  const BentPath path = bent_path(1500, -0.3, 0.1, 0);
  EXPECT_EQ(path.drop, 0);
  EXPECT_EQ(path.time, 0);
  EXPECT_THAT(path.angle, RelativelyNear(0.1));
}

// 1500 m/s falling by 5 m/s a metre: a circle of 300 m, upright after 300 m. Launched at 30 deg down it starts half way
// along: 300/cos(30) = 346.41 m radius, of which 1 - sin(30) is left, 173.21 m.
TEST(BentPathMessagesTest, NamesTheDistanceItCannotCover) {
  EXPECT_EQ(message_of([] { static_cast<void>(bent_path(1500, -5, 0, 300)); }),
            "bent_path.distance = 300 m must be less than 300 m, where the path stands upright");
  EXPECT_EQ(message_of([] { static_cast<void>(bent_path(1500, -5, radians_from_degrees(30), 200)); }),
            "bent_path.distance = 200 m must be less than 173.2050808 m, where the path stands upright");
}

TEST(BentPathMessagesTest, NamesTheArgumentOutOfItsLimits) {
  const auto message = [](double speed, double gradient, double launch_deg, double distance) {
    return message_of(
        [&] { static_cast<void>(bent_path(speed, gradient, radians_from_degrees(launch_deg), distance)); });
  };
  EXPECT_EQ(message(0, 1, 2, 3), "bent_path.sound_speed = 0 m/s must be greater than 0 m/s");
  EXPECT_EQ(message(1500, 0, 2, 3), "bent_path.gradient = 0 1/s must not be 0: the path is straight");
  EXPECT_EQ(message(1500, NAN, 2, 3), "bent_path.gradient = nan 1/s must be a finite number");
  EXPECT_EQ(message(1500, 1, 90, 3), "bent_path.launch_angle_deg = 90 deg must be greater than -90, less than 90 deg");
  EXPECT_EQ(message(1500, 1, 2, -3), "bent_path.distance = -3 m must be at least 0 m");
}

}  // namespace
}  // namespace insonify::sound_speed_test
