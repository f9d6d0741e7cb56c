// sonar_validate_test.cpp -- what a SonarConfig refuses, in one line with the value and its limit.

#include <gtest/gtest.h>

#include <cmath>

#include "insonify/scenario.h"
#include "sonar/sonars.h"
#include "support/message_of.h"

namespace insonify::sonar_validate_test {
namespace {

std::string fault(const SonarConfig& sonar) {
  return message_of([&] { sonar.validate("sonars[1]"); });
}

// The message for a forward-looking sonar, or a scanning one, after one change.
template <typename Change>
std::string fls(Change&& change) {
  SonarConfig sonar;
  change(sonar);
  return fault(sonar);
}

template <typename Change>
std::string msis(Change&& change) {
  SonarConfig sonar = scanner(0.9);
  change(sonar);
  return fault(sonar);
}

TEST(SonarValidateTest, DefaultsAreValid) {
  EXPECT_EQ(fault(SonarConfig{}), "no error");
  EXPECT_EQ(fault(scanner(0.9)), "no error");
}

TEST(SonarValidateTest, WidthsOfBeamsFitBetweenEachOther) {
  EXPECT_EQ(fls([](auto& s) {
              s.beam_count = 3, s.beam_widths = {deg(1), deg(2)};
            }),
            "sonars[1].beam_widths_deg has 2 widths, must have one for all or one for each of beam_count = 3");
  EXPECT_EQ(fls([](auto& s) { s.beam_count = 3, s.azimuth_aperture = deg(60), s.beam_widths = {deg(21)}; }),
            "sonars[1].beam_widths_deg must not make beams overlap: beam 0 ends at 9.5 deg, beam 1 begins at 10.5 deg");
  EXPECT_EQ(fls([](auto& s) { s.beam_count = 3, s.azimuth_aperture = deg(60), s.beam_widths = {deg(20)}; }),
            "no error");
  EXPECT_EQ(msis([](auto& s) { s.beam_widths = {deg(1)}; }),
            "sonars[1].beam_widths_deg belongs to a fan; the beam of a msis is as wide as azimuth_aperture_deg");
  EXPECT_EQ(fls([](auto& s) { s.beam_widths = {deg(0)}; }),
            "sonars[1].beam_widths_deg[0] = 0 deg must be greater than 0, at most 360 deg");
}

TEST(SonarValidateTest, TransmittersOfTheirOwnMakeSense) {
  EXPECT_EQ(
      fls([](auto& s) {
        s.elevation_center = deg(80), s.elevation_aperture = deg(10), s.transmit_elevation_aperture = deg(20);
      }),
      "sonars[1].transmit_elevation_aperture_deg = 20 deg with elevation_center_deg = 80 deg reaches 90 deg, must "
      "stay within 89 deg of level");
  EXPECT_EQ(fls([](auto& s) { s.two_way_array = true; }),
            "sonars[1].two_way_array = true transmits one beam, must be false with beam_count = 256");
  EXPECT_EQ(fls([](auto& s) { s.two_way_array = true, s.beam_count = 1; }), "no error");
  EXPECT_EQ(fls([](auto& s) { s.two_way_array = true, s.beam_count = 1, s.transmit_width = deg(90); }),
            "sonars[1].transmit_width_deg belongs to a transmitter of its own; with two_way_array the array transmits");
}

TEST(SonarValidateTest, NamesTheFieldOutOfItsLimits) {
  EXPECT_EQ(fls([](auto& s) { s.frequency = 0; }),
            "sonars[1].frequency = 0 Hz must be greater than 0, at most 100000000 Hz");
  EXPECT_EQ(fls([](auto& s) { s.frequency = NAN; }),
            "sonars[1].frequency = nan Hz must be greater than 0, at most 100000000 Hz");
  EXPECT_EQ(fls([](auto& s) { s.beam_count = 0; }), "sonars[1].beam_count = 0 must be from 1 to 4096");
  EXPECT_EQ(fls([](auto& s) { s.azimuth_aperture = deg(361); }),
            "sonars[1].azimuth_aperture_deg = 361 deg must be greater than 0, at most 360 deg");
  EXPECT_EQ(fls([](auto& s) { s.elevation_aperture = deg(171); }),
            "sonars[1].elevation_aperture_deg = 171 deg must be greater than 0, at most 170 deg");
  EXPECT_EQ(fls([](auto& s) { s.elevation_center = deg(-86); }),
            "sonars[1].elevation_center_deg = -86 deg must be from -85 to 85 deg");
  EXPECT_EQ(fls([](auto& s) { s.bin_count = 65537; }), "sonars[1].bin_count = 65537 must be from 1 to 65536");
  EXPECT_EQ(fls([](auto& s) { s.beam_count = 4096, s.bin_count = 8193; }),
            "sonars[1].bin_count = 8193 makes 33558528 cells with beam_count = 4096, must be at most 33554432");
  EXPECT_EQ(fls([](auto& s) { s.min_range = -1; }), "sonars[1].min_range = -1 m must be from 0 to 100000 m");
  EXPECT_EQ(fls([](auto& s) { s.max_range = 0; }),
            "sonars[1].max_range = 0 m must be greater than 0, at most 100000 m");
  EXPECT_EQ(fls([](auto& s) { s.blanking_range = -2; }), "sonars[1].blanking_range = -2 m must be from 0 to 100000 m");
  EXPECT_EQ(fls([](auto& s) { s.gain = 0; }), "sonars[1].gain = 0 must be greater than 0, at most 1000000000");
  EXPECT_EQ(fls([](auto& s) { s.assumed_sound_speed = 150; }),
            "sonars[1].assumed_sound_speed = 150 m/s must be from 1300 to 1700 m/s");
  EXPECT_EQ(fls([](auto& s) { s.ping_period = 0; }),
            "sonars[1].ping_period = 0 s must be greater than 0, at most 1000000 s");
  EXPECT_EQ(fls([](auto& s) { s.head.step = deg(181); }), "sonars[1].step_deg = 181 deg must be from -180 to 180 deg");
  EXPECT_EQ(fls([](auto& s) { s.head.sector_center = deg(181); }),
            "sonars[1].sector_center_deg = 181 deg must be from -180 to 180 deg");
  EXPECT_EQ(fls([](auto& s) { s.head.sector_width = 0; }),
            "sonars[1].sector_width_deg = 0 deg must be greater than 0, at most 360 deg");
  EXPECT_EQ(fls([](auto& s) { s.position.y() = NAN; }),
            "sonars[1].position[1] = nan m must be from -10000000 to 10000000 m");
  EXPECT_EQ(fls([](auto& s) { s.orientation.z() = INFINITY; }),
            "sonars[1].orientation_deg[2] = inf deg must be finite and from -1000000 to 1000000 deg");
  EXPECT_EQ(fls([](auto& s) { s.sampling.columns_per_beam = 0; }),
            "sonars[1].sampling.columns_per_beam = 0 must be from 1 to 256");
  EXPECT_EQ(fls([](auto& s) { s.sampling.rows = 1; }), "sonars[1].sampling.rows = 1 must be from 2 to 8192");
}

TEST(SonarValidateTest, TheNameMustMakeAFileName) {
  const std::string expected =
      "sonars[1].name must not be empty, start with '.' or hold a slash, a backslash or a control character";
  EXPECT_EQ(fls([](auto& s) { s.name = ""; }), expected);
  EXPECT_EQ(fls([](auto& s) { s.name = "../fls"; }), expected);
  EXPECT_EQ(fls([](auto& s) { s.name = "a/b"; }), expected);
  EXPECT_EQ(fls([](auto& s) { s.name = "a\nb"; }), expected);
  EXPECT_EQ(fls([](auto& s) { s.name = "Vorwärts 2.1"; }), "no error");
  EXPECT_EQ(fls([](auto& s) { s.name = std::string(200, 'x'); }), "no error");
  EXPECT_EQ(fls([](auto& s) { s.name = std::string(201, 'x'); }),
            "sonars[1].name has 201 bytes; must have at most 200");
  EXPECT_EQ(fls([](auto& s) { s.name = "  "; }), "sonars[1].name must not be blank");
}

TEST(SonarValidateTest, RangesMustFollowEachOther) {
  EXPECT_EQ(fls([](auto& s) { s.min_range = 5, s.max_range = 2; }),
            "sonars[1].max_range = 2 m must be greater than min_range = 5 m");
  EXPECT_EQ(fls([](auto& s) { s.min_range = 5, s.max_range = 5; }),
            "sonars[1].max_range = 5 m must be greater than min_range = 5 m");
  EXPECT_EQ(fls([](auto& s) { s.blanking_range = 60, s.max_range = 40; }),
            "sonars[1].blanking_range = 60 m must be at most max_range = 40 m");
  EXPECT_EQ(fls([](auto& s) { s.blanking_range = 40, s.max_range = 40; }), "no error");
  EXPECT_EQ(fls([](auto& s) { s.dead_range = 45, s.max_range = 40; }),
            "sonars[1].dead_range = 45 m must be at most max_range = 40 m");
  EXPECT_EQ(fls([](auto& s) { s.ring_down = 100; }),
            "sonars[1].ring_down = 100 dB/s must be from 1000 to 1000000000 dB/s");
}

TEST(SonarValidateTest, BeamAzimuthsMustFallOneForEachBeam) {
  EXPECT_EQ(fls([](auto& s) {
              s.beam_count = 3, s.beam_azimuths = {deg(10), deg(0)};
            }),
            "sonars[1].beam_azimuths_deg has 2 angles, must have one for each of beam_count = 3");
  EXPECT_EQ(fls([](auto& s) {
              s.beam_count = 3, s.beam_azimuths = {deg(10), deg(-5), deg(-5)};
            }),
            "sonars[1].beam_azimuths_deg[2] = -5 deg must be less than beam_azimuths_deg[1] = -5 deg: beams run from "
            "port to starboard");
  EXPECT_EQ(fls([](auto& s) {
              s.beam_count = 2, s.beam_azimuths = {deg(10), deg(200)};
            }),
            "sonars[1].beam_azimuths_deg[1] = 200 deg must be from -180 to 180 deg");
  EXPECT_EQ(fls([](auto& s) {
              s.beam_count = 3, s.beam_azimuths = {deg(170), deg(0), deg(-170)};
            }),
            "sonars[1].beam_azimuths_deg make a fan of 510 deg, must be at most 360 deg");
  EXPECT_EQ(fls([](auto& s) { s.beam_count = 3, s.beam_azimuths = {deg(120), deg(0), deg(-120)}; }), "no error");
}

TEST(SonarValidateTest, ElevationsMustStayOffTheVertical) {
  EXPECT_EQ(fls([](auto& s) { s.elevation_center = deg(-80), s.elevation_aperture = deg(40); }),
            "sonars[1].elevation_center_deg = -80 deg with elevation_aperture_deg = 40 deg reaches 100 deg, must stay "
            "within 89 deg of level");
  EXPECT_EQ(fls([](auto& s) { s.elevation_center = deg(69), s.elevation_aperture = deg(40); }), "no error");
}

TEST(SonarValidateTest, AScanningHeadMustTurnASingleBeam) {
  EXPECT_EQ(msis([](auto& s) { s.beam_count = 4; }),
            "sonars[1].beam_count = 4 must be 1 for type msis, whose head turns a single beam: say beam_count: 1");
  EXPECT_EQ(msis([](auto& s) { s.head.step = 0; }), "sonars[1].step_deg = 0 deg must not be 0 for type msis");
  EXPECT_EQ(msis([](auto& s) { s.head.step = deg(-2), s.head.sector_width = deg(1.5); }),
            "sonars[1].sector_width_deg = 1.5 deg must be at least one step_deg = -2 deg");
  EXPECT_EQ(msis([](auto& s) { s.head.step = deg(-2), s.head.sector_width = deg(2); }), "no error");
}

TEST(SonarValidateTest, AFanIgnoresTheSettingsOfAHead) {
  EXPECT_EQ(fls([](auto& s) { s.head.step = 0; }), "no error");
}

}  // namespace
}  // namespace insonify::sonar_validate_test
