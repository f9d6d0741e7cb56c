// noise_test.cpp -- noise in whole pings: its level by beam width, pulse and bandwidth, and its correlation along range
// and between beams (T23 of docs/concepts/physics-tests.md).

#include <complex>

#include "validation/calibrated_scene.h"

namespace insonify::validation::noise_test {
namespace {

// A fan of 90 degrees with beams of 1.2 x 16 degrees, and nothing to echo.
SonarConfig listening(int beams) {
  SonarConfig sonar;
  sonar.frequency = 600e3;
  sonar.source_level_db = 205;
  sonar.bandwidth = 30e3;
  sonar.beam_count = beams;
  sonar.azimuth_aperture = 90 * kDegree;
  sonar.azimuth_resolution = 1.2 * kDegree;
  sonar.elevation_aperture = 16 * kDegree;
  sonar.sampling = {1, 20};
  return sonar;
}

Scenario noisy(const SonarConfig& sonar, BeamPattern pattern) {
  Scenario scenario = calibrated(sonar, kRays);
  scenario.receiver.noise = true;
  scenario.receiver.azimuth_pattern = pattern;
  return scenario;
}

double mean_db(const Ping& ping) {
  return total_db(ping) - 10 * std::log10(static_cast<double>(ping.intensity.size()));
}

// -15 + 20 log10(600) + 10 log10(30e3) - 205 = -119.66576 dB, less the directivity index: 10 log10 of 4 pi over
// 1.2 deg x 2 sin(8 deg) = 0.00582967 sr is 33.33566 dB; without a window the beam collects 1 / 0.88589 times as much.
// A top hat is as wide as the slice that its echoes come from.
TEST(NoiseTest, BelongsToTheBeamNotToTheSpacing) {
  for (const int beams : {45, 90, 360}) {
    for (const auto& [pattern, expected] :
         {std::pair{BeamPattern::kTopHat, -153.00142}, {BeamPattern::kRectangular, -152.47531}}) {
      for (const bool speckle : {false, true}) {
        Scenario scenario = noisy(listening(beams), pattern);
        scenario.receiver.speckle = speckle;
        const Ping ping = ping_of(scenario, {});
        const double wider = pattern == BeamPattern::kTopHat ? 10 * std::log10(90.0 / beams / 1.2) : 0;
        // At least 45 x 500 / 8 independent samples, where beams overlap: four standard errors.
        EXPECT_NEAR(mean_db(ping), expected + wider, 10 * std::log10(1 + 4 / std::sqrt(45 * 500 / 8.0)))
            << beams << ", " << static_cast<int>(pattern);
      }
    }
  }
}

double mean_db_of(const Scenario& scenario) {
  return mean_db(ping_of(scenario, {}));
}

// A matched filter has the signal to noise ratio 2 E / N0: with unit gain for the echo its noise falls as the pulse
// grows longer, by 13.0103 dB from 50 us to 1 ms, for a tone as for a chirp; the sonar's own bandwidth of 30 kHz no
// longer matters. A Hann window has 1.5 times (1.76 dB) the noise of the matched filter.
TEST(NoiseTest, MatchedFilterGainsWithTheLengthOfThePulse) {
  const double bare = -152.47531 - 10 * std::log10(30e3);  // In 1 Hz.
  for (const auto& [kind, window, duration, expected] :
       {std::tuple{PulseKind::kCw, PulseWindow::kRectangular, 50e-6, bare + 43.0103},
        {PulseKind::kCw, PulseWindow::kRectangular, 1e-3, bare + 30},
        {PulseKind::kLfm, PulseWindow::kRectangular, 50e-6, bare + 43.0103},
        {PulseKind::kLfm, PulseWindow::kRectangular, 1e-3, bare + 30},
        {PulseKind::kLfm, PulseWindow::kHann, 1e-3, bare + 30 + 1.7609}}) {
    Scenario scenario = noisy(listening(90), BeamPattern::kRectangular);
    scenario.receiver.pulse = kind;
    scenario.receiver.pulse_window = window;
    scenario.receiver.pulse_duration = duration;
    scenario.receiver.pulse_bandwidth = 250e3;
    scenario.sonars[0].max_range = 200;  // Bins of 0.4 m, half as long as the tone of 1 ms.
    const double independent = 75 * 500 / 2.0;
    EXPECT_NEAR(mean_db_of(scenario), expected, 10 * std::log10(1 + 4 / std::sqrt(independent)))
        << static_cast<int>(kind) << ", " << duration;
  }
}

// Correlation of the complex noise of two cells that are so many bins and beams apart, over all pairs of one ping; for
// beams, over pairs from `first` on only, as many as `count`.
double correlation(const Ping& ping, int bins, int beams, int first = 0, int count = 1000) {
  double product = 0, power = 0;
  const int last = std::min(ping.beam_count - beams, first + count);
  for (int bin = 0; bin + bins < ping.bin_count; ++bin) {
    for (int beam = first; beam < last; ++beam) {
      const std::complex<double> one = ping.field[ping.index(bin, beam)];
      const std::complex<double> other = ping.field[ping.index(bin + bins, beam + beams)];
      product += (one * std::conj(other)).real();
      power += 0.5 * (std::norm(one) + std::norm(other));
    }
  }
  return product / power;
}

Ping noise_of(Scenario scenario) {
  scenario.receiver.speckle = scenario.receiver.field = true;
  return ping_of(scenario, {});
}

double sinc(double x) {
  return x == 0 ? 1 : std::sin(3.14159265358979 * x) / (3.14159265358979 * x);
}

// Along range, noise has the correlation of the matched filter's output: a triangle for a tone, 1 - 2 dr / (c tau); for
// a chirp sinc(2 B dr / c), with a Hann window the transform of cos^4. Bins of 45 mm and c = 1500 m/s.
TEST(NoiseTest, HasTheCorrelationOfTheFilterAlongRange) {
  const auto hann = [](double x) {
    return sinc(x) + 2.0 / 3 * (sinc(x - 1) + sinc(x + 1)) + (sinc(x - 2) + sinc(x + 2)) / 6;
  };
  struct Case {
    PulseKind kind;
    PulseWindow window;
    double duration, bandwidth;
    std::function<double(double)> expected;
  };
  const Case cases[] = {
      {PulseKind::kNone, PulseWindow::kRectangular, 1e-3, 1e5, [](double dr) { return dr == 0 ? 1.0 : 0.0; }},
      {PulseKind::kCw, PulseWindow::kRectangular, 100e-6, 1e5, [](double dr) { return std::max(0.0, 1 - dr / 0.075); }},
      {PulseKind::kCw, PulseWindow::kRectangular, 400e-6, 1e5, [](double dr) { return std::max(0.0, 1 - dr / 0.3); }},
      {PulseKind::kCw, PulseWindow::kRectangular, 3e-3, 1e5, [](double dr) { return std::max(0.0, 1 - dr / 2.25); }},
      {PulseKind::kLfm, PulseWindow::kRectangular, 2e-3, 6e3, [](double dr) { return sinc(dr / 0.125); }},
      {PulseKind::kLfm, PulseWindow::kRectangular, 2e-3, 100e3, [](double dr) { return sinc(dr / 0.0075); }},
      {PulseKind::kLfm, PulseWindow::kHann, 2e-3, 6e3, [&](double dr) { return hann(dr / 0.125); }}};
  for (const BeamPattern pattern : {BeamPattern::kTopHat, BeamPattern::kTaylor}) {
    for (const Case& c : cases) {
      Scenario scenario = noisy(listening(180), pattern);
      scenario.water.sound_speed = 1500;
      scenario.sonars[0].min_range = 0;
      scenario.sonars[0].max_range = 22.5;
      scenario.receiver.pulse = c.kind;
      scenario.receiver.pulse_window = c.window;
      scenario.receiver.pulse_duration = c.duration;
      scenario.receiver.pulse_bandwidth = c.bandwidth;
      const Ping ping = noise_of(scenario);
      // Independent samples: as many beams as fit side by side, bins by the length of the filter.
      double cells = 1;
      for (int k = 1; k < 100; ++k) {
        cells += 2 * std::pow(c.expected(k * 0.045), 2);
      }
      const double beams = pattern == BeamPattern::kTopHat ? 180 : 67;
      const double tolerance = 4 * std::sqrt(0.5 * cells / (beams * 500));
      for (const int lag : {1, 2, 3, 7}) {
        // The side lobes of a chirp's correlation are tapered: those three resolution lengths away by a fifth.
        EXPECT_NEAR(correlation(ping, lag, 0), c.expected(lag * 0.045), tolerance + (lag < 7 ? 0.015 : 0.03))
            << static_cast<int>(pattern) << ", " << static_cast<int>(c.kind) << ", " << c.duration << ", " << lag;
      }
    }
  }
}

// Between beams whose sines differ by du, noise has the correlation of isotropic noise at the array: sinc(D du /
// wavelength) for a line of length D without a window, D / wavelength = 0.88589 / (2 sin(width / 2)); with a cosine
// window the transform of its square, sinc(x) + (sinc(x - 1) + sinc(x + 1)) / 2. All beams have the same level, at the
// edges of the fan too.
TEST(NoiseTest, HasTheCorrelationOfTheBeams) {
  const double shortest = 1 / (2 * std::sin(0.6 * kDegree));
  for (const auto& [pattern, width, expected] :
       {std::tuple{BeamPattern::kRectangular, 0.8858929, +[](double x) { return sinc(x); }},
        {BeamPattern::kCosine, 1.1889, +[](double x) { return sinc(x) + 0.5 * (sinc(x - 1) + sinc(x + 1)); }}}) {
    Scenario scenario = noisy(listening(300), pattern);
    scenario.sonars[0].bin_count = 4000;
    scenario.receiver.pulse = PulseKind::kCw;  // Shorter than a bin, or nearly so: crossed with the filter along range.
    scenario.receiver.pulse_duration = 20e-6;
    const SonarConfig sonar = scenario.sonars[0];
    const Ping ping = noise_of(scenario);
    for (const int beam : {0, 60, 149, 290}) {
      for (const int lag : {1, 2, 4, 8}) {
        const double du = std::sin(sonar.beam_azimuth(beam)) - std::sin(sonar.beam_azimuth(beam + lag));
        EXPECT_NEAR(correlation(ping, 0, lag, beam, 1), expected(width * shortest * du),
                    4 / std::sqrt(2 * 3000.0) + 0.01)
            << beam << ", " << lag;
      }
    }
    for (const int beam : {0, 1, 150, 298, 299}) {
      double sum = 0, all = 0;
      for (int bin = 0; bin < ping.bin_count; ++bin) {
        sum += ping.intensity[ping.index(bin, beam)];
        for (int other = 0; other < 300; ++other) {
          all += ping.intensity[ping.index(bin, other)] / 300;
        }
      }
      EXPECT_NEAR(sum / all, 1, 4 / std::sqrt(3000.0)) << beam;
    }
  }
}

// Beams of a lens have transducers of their own, whose noises are independent; its level is that of an array's.
TEST(NoiseTest, IsIndependentInTheBeamsOfALens) {
  Scenario scenario = noisy(listening(300), BeamPattern::kTaylor);
  scenario.sonars[0].bin_count = 2000;
  const double level = total_db(noise_of(scenario));
  EXPECT_GT(correlation(noise_of(scenario), 0, 1), 0.2);
  scenario.sonars[0].steering = Steering::kLens;
  const Ping ping = noise_of(scenario);
  EXPECT_NEAR(total_db(ping), level, 0.05);
  for (const int lag : {1, 2, 3}) {
    EXPECT_NEAR(correlation(ping, 0, lag), 0, 4 / std::sqrt(2 * 300 * 2000.0));
  }
}

// Intensities of filtered noise are still exponentially distributed, are independent for each ping, and do not depend
// on the number of threads.
TEST(NoiseTest, IsExponentialAndDrawnAnewForEachPing) {
  Scenario scenario = noisy(listening(64), BeamPattern::kTaylor);
  scenario.sonars[0].bin_count = 2000;
  scenario.receiver.pulse = PulseKind::kLfm;
  scenario.receiver.pulse_duration = 1e-3;
  scenario.receiver.pulse_bandwidth = 20e3;
  const Ping ping = ping_of(scenario, {});
  double sum = 0, squares = 0;
  for (const double value : ping.intensity) {
    sum += value, squares += value * value;
  }
  const double n = static_cast<double>(ping.intensity.size());
  EXPECT_NEAR(std::sqrt(squares / n / std::pow(sum / n, 2) - 1), 1, 4 / std::sqrt(n / 4));
  for (const int threads : {1, 3}) {
    Simulator simulator(scenario, {}, threads);
    EXPECT_EQ(simulator.make_ping(0, 0).intensity, ping.intensity);
    EXPECT_NE(simulator.make_ping(0, 1).intensity, ping.intensity);
  }
}

// In whole pings, by what noise alone has: at 100 kHz wind of 10 m/s raises thermal noise of 25 dB to 33.6477 + 25 in
// powers, 34.2035 dB, by 9.2035 dB; with a pulse, an array and speckle too.
TEST(NoiseTest, RisesWithTheWind) {
  for (const PulseKind pulse : {PulseKind::kNone, PulseKind::kCw}) {
    Scenario scenario = noisy(listening(90), BeamPattern::kRectangular);
    scenario.sonars[0].frequency = 100e3;
    scenario.receiver.pulse = pulse;
    scenario.receiver.speckle = true;
    const double calm = mean_db_of(scenario);
    scenario.receiver.wind_noise = 10;
    EXPECT_NEAR(mean_db_of(scenario) - calm, 9.2035, 1e-3) << static_cast<int>(pulse);  // The same numbers are drawn.
  }
}

}  // namespace
}  // namespace insonify::validation::noise_test
