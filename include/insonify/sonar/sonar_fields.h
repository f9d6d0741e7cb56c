// sonar_fields.h -- key, unit, limits and help text of every setting of a sonar. Included by sonar_config.h.

#pragma once

#include <numbers>

#include "insonify/sonar_config.h"

namespace insonify {

template <typename Self, typename Visit>
void SonarConfig::visit_fields(Self& self, Visit&& visit) {
  constexpr double kPi = std::numbers::pi;
  visit(Field{"name", "", {}, "Used in messages and file names."}, self.name);
  visit(Field{"model", "", {}, "Make and model, for titles."}, self.model);
  visit(Field{"type", "", {}, "fls (the whole fan at once) or msis (one beam, turned by a step each ping)."},
        self.type);
  visit(Field{"frequency", "Hz", above_to(0, 1e8), "Carrier frequency."}, self.frequency);
  visit(Field{"source_level_db", "dB", from_to(100, 260), "Source level re 1 uPa at 1 m, on the acoustic axis.",
              ActsIn::kCalibrated, "gain"},
        self.source_level_db);
  visit(Field{"bandwidth", "Hz", above_to(0, 1e8),
              "Bandwidth of the receiver, for noise, where the pulse is none (calibrated model).", ActsIn::kCalibrated,
              "paper.additive_deviation"},
        self.bandwidth);
  visit(Field{"pulse",
              "",
              {},
              "What the instrument transmits: none (as long as a bin), cw (a tone) or lfm (a chirp), where "
              "receiver.pulse is instrument (calibrated model).",
              ActsIn::kCalibrated},
        self.pulse);
  visit(Field{"pulse_duration", "s", above_to(0, 1), "Duration of that tone or chirp.", ActsIn::kCalibrated},
        self.pulse_duration);
  visit(Field{"pulse_bandwidth", "Hz", above_to(0, 1e7), "Bandwidth of that chirp, less than twice the frequency.",
              ActsIn::kCalibrated},
        self.pulse_bandwidth);
  visit(Field{"pulse_window", "", {}, "Weights over its band, for lower side lobes in range.", ActsIn::kCalibrated},
        self.pulse_window);
  visit(Field{"beam_count", "", from_to(1, 4096), "Beams across the azimuth aperture."}, self.beam_count);
  visit(Field{"azimuth_aperture", "rad", above_to(0, 2 * kPi), "Full width of the fan."}, self.azimuth_aperture);
  visit(Field{"beam_azimuths", "rad", from_to(-kPi, kPi),
              "Explicit beam centres, falling from port to starboard: beam_count and azimuth_aperture follow from "
              "them. Evenly spaced in angle when absent."},
        self.beam_azimuths);
  visit(Field{"beam_widths", "rad", above_to(0, 2 * kPi),
              "Widths of the slices of azimuth that beams cover, one for all or one for each: narrower ones than the "
              "spacing leave gaps, from which nothing is received. Beams touch when absent."},
        self.beam_widths);
  visit(Field{"azimuth_resolution", "rad", above_to(0, 0.5 * kPi),
              "Width at half power of the unsteered beam, one way; the beam spacing when absent (calibrated model, "
              "with an azimuth_pattern).",
              ActsIn::kCalibrated},
        self.azimuth_resolution);
  visit(Field{"elevation_aperture", "rad", above_to(0, radians_from_degrees(170)),
              "Full height of every beam; at half power, one way, with an elevation_pattern."},
        self.elevation_aperture);
  visit(Field{"elevation_center", "rad", from_to(radians_from_degrees(-85), radians_from_degrees(85)),
              "Middle of the elevation aperture."},
        self.elevation_center);
  visit(Field{"elevation_pattern",
              "",
              {},
              "Pattern of the instrument's transmitter and receiver across elevations, where "
              "receiver.elevation_pattern is instrument: top_hat, or the window of an array (calibrated model).",
              ActsIn::kCalibrated},
        self.elevation_pattern);
  visit(
      Field{"transmit_elevation_pattern",
            "",
            {},
            "Pattern of the transmitter across elevations: top_hat, the window of an array, or instrument for that of "
            "the receiver (calibrated model).",
            ActsIn::kCalibrated},
      self.transmit_elevation_pattern);
  visit(
      Field{"transmit_elevation_aperture", "rad", above_to(0, radians_from_degrees(170)),
            "Full height of the transmitted beam, as elevation_aperture is of the received ones; the same when absent "
            "(calibrated model).",
            ActsIn::kCalibrated},
      self.transmit_elevation_aperture);
  visit(Field{"two_way_array",
              "",
              {},
              "Whether the array of a sonar with one beam transmits as well, so that its azimuth_pattern applies both "
              "ways; that of msis always does (calibrated model).",
              ActsIn::kCalibrated},
        self.two_way_array);
  visit(Field{"transmit_width", "rad", above_to(0, kWidestElement),
              "Azimuth width at half power of the transmitter of a fan; omnidirectional in azimuth when absent "
              "(calibrated model).",
              ActsIn::kCalibrated},
        self.transmit_width);
  visit(Field{"element_width", "rad", above_to(0, kWidestElement),
              "Azimuth width at half power of one element of a fan's receiver; omnidirectional in azimuth when absent "
              "(calibrated model).",
              ActsIn::kCalibrated},
        self.element_width);
  visit(Field{"focus_range", "m", above_to(0, 1e6),
              "Range at which the beams are focused, at least the array's length, 1e6 for the far field; at every "
              "range when absent (calibrated model, with an azimuth_pattern).",
              ActsIn::kCalibrated},
        self.focus_range);
  visit(Field{"bin_count", "", from_to(1, 65536), "Range bins per beam."}, self.bin_count);
  visit(Field{"min_range", "m", from_to(0, 1e5), "Near edge of bin 0; nearer echoes are dropped."}, self.min_range);
  visit(Field{"max_range", "m", above_to(0, 1e5), "Far edge of the last bin."}, self.max_range);
  visit(Field{"blanking_range", "m", from_to(0, 1e5),
              "Near field: the gain of amplitudes rises linearly from 0 at min_range to 1 here."},
        self.blanking_range);
  visit(
      Field{"gain", "", above_to(0, 1e9), "Multiplies the intensity before it is clipped to 1 (paper model).",
            ActsIn::kPaper, "receiver.gain_ranges and receiver.gains_db for levels, receiver.full_scale_db for counts"},
      self.gain);
  visit(Field{"leak_db", "dB", from_to(-300, 100),
              "Level of the outgoing pulse in the receiver, re the source's at 1 m (calibrated); no leak when absent.",
              ActsIn::kCalibrated},
        self.leak_db);
  visit(Field{"ring_down", "dB/s", from_to(1e3, 1e9), "Decay of the transducer's ringing after the pulse (leak_db).",
              ActsIn::kCalibrated},
        self.ring_down);
  visit(
      Field{"leak_spread_db", "dB", from_to(0, 20),
            "Standard deviation of the leak's level between beams, drawn by the seed (leak_db).", ActsIn::kCalibrated},
      self.leak_spread_db);
  visit(Field{"dead_range", "m", from_to(0, 1e5),
              "The receiver, overloaded by the transmission, receives no echo and no noise nearer than this "
              "(calibrated).",
              ActsIn::kCalibrated, "blanking_range"},
        self.dead_range);
  visit(Field{"group_gains_db", "dB", from_to(-300, 60),
              "Gains of equal groups of neighbouring beams, one value per group, from port (calibrated).",
              ActsIn::kCalibrated},
        self.group_gains_db);
  visit(Field{"missing_beams", "", from_to(0, 4095), "Beams that deliver nothing, from 0 at port (calibrated).",
              ActsIn::kCalibrated},
        self.missing_beams);
  visit(Field{"crosstalk_db", "dB", from_to(-200, 0),
              "Share of the sum of all beams' echoes at a range that each beam receives besides its own (calibrated); "
              "none when absent.",
              ActsIn::kCalibrated},
        self.crosstalk_db);
  visit(Field{"bits", "", from_to(1, 16), "Bits of a count (receiver.counts).", ActsIn::kCalibrated}, self.bits);
  visit(Field{"mapping",
              "",
              {},
              "gamma (counts follow a power of amplitude) or logarithmic (decibels).",
              ActsIn::kCalibrated},
        self.mapping);
  visit(Field{"mapping_range_db", "dB", above_to(0, 300), "Level range from count 0 to full scale (logarithmic).",
              ActsIn::kCalibrated},
        self.mapping_range_db);
  visit(
      Field{"mapping_exponent", "", above_to(0, 4), "Exponent of amplitude; 1 is linear (gamma).", ActsIn::kCalibrated},
      self.mapping_exponent);
  visit(Field{"assumed_sound_speed", "m/s", from_to(1300, 1700),
              "Sound speed with which the sonar converts time to range; the true one when absent."},
        self.assumed_sound_speed);
  visit(Field{"steering",
              "",
              {},
              "electronic (bearings of a fan are computed with the assumed sound speed as well) or lens (calibrated).",
              ActsIn::kCalibrated},
        self.steering);
  visit(Field{"ping_period", "s", above_to(0, 1e6), "Time between pings; 2 max_range / c when absent, and never less."},
        self.ping_period);
  visit(Field{"step", "rad", from_to(-kPi, kPi), "Turn of a scanning head between pings, positive to port."},
        self.head.step);
  visit(Field{"sector_center", "rad", from_to(-kPi, kPi), "Middle of the scanned sector."}, self.head.sector_center);
  visit(Field{"sector_width", "rad", above_to(0, 2 * kPi),
              "Scanned sector; at 360 the head keeps turning, at less it sweeps to and fro."},
        self.head.sector_width);
  visit(Field{"mounting", "", {}, "horizontal (a plan view) or vertical (a slice) scanning head."}, self.head.mounting);
  visit(
      Field{"position", "m", coordinate(), "On the vehicle, or in the world where there is no trajectory: [x, y, z]."},
      self.position);
  visit(Field{"orientation", "rad", turn(), "[roll, pitch, yaw] as in SDF: positive pitch looks down."},
        self.orientation);
}

}  // namespace insonify
