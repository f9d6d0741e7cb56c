// sonar_fields.h -- key, unit, limits and help text of every setting of a sonar. Included by sonar_config.h.

#pragma once

#include <numbers>

#include "insonify/sonar_config.h"

namespace insonify {

template <typename Self, typename Visit>
void SonarConfig::visit_fields(Self& self, Visit&& visit) {
  constexpr double kPi = std::numbers::pi;
  visit(Field{"name", "", {}, "Name in messages and file names."}, self.name);
  visit(Field{"model", "", {}, "Make and model, for titles."}, self.model);
  visit(Field{"type",
              "",
              {},
              "fls (the whole fan at once), msis (one beam, turned by a step each ping), sss (side-scan: two beams, "
              "to port and starboard) or mbes (multibeam: a fan across the track, looking down, with soundings)."},
        self.type);
  visit(Field{"frequency", "Hz", above_to(0, 1e8), "Carrier frequency."}, self.frequency);
  visit(Field{"source_level_db", "dB", from_to(100, 260), "Source level re 1 uPa at 1 m, on the acoustic axis.",
              ActsIn::kCalibrated, "gain"},
        self.source_level_db);
  visit(Field{"bandwidth", "Hz", above_to(0, 1e8),
              "Bandwidth of the receiver, which sets the noise if the pulse is none (calibrated model).",
              ActsIn::kCalibrated, "paper.additive_deviation"},
        self.bandwidth);
  visit(Field{"self_noise_db", "dB", from_to(-100, 200),
              "Spectrum level of the instrument's own noise, added to the water's, re 1 uPa^2/Hz of isotropic noise "
              "(calibrated model); none when absent.",
              ActsIn::kCalibrated, "paper.additive_deviation"},
        self.self_noise_db);
  visit(Field{"pulse",
              "",
              {},
              "Transmitted pulse: none (as long as a bin), cw (a tone) or lfm (a chirp). Used if receiver.pulse is "
              "instrument (calibrated model).",
              ActsIn::kCalibrated},
        self.pulse);
  visit(Field{"pulse_duration", "s", above_to(0, 1), "Duration of the tone or chirp.", ActsIn::kCalibrated},
        self.pulse_duration);
  visit(Field{"pulse_bandwidth", "Hz", above_to(0, 1e7), "Bandwidth of the chirp, less than twice the frequency.",
              ActsIn::kCalibrated},
        self.pulse_bandwidth);
  visit(
      Field{
          "pulse_window", "", {}, "Window over the chirp's band; lowers the side lobes in range.", ActsIn::kCalibrated},
      self.pulse_window);
  visit(Field{"beam_count", "", from_to(1, 4096), "Beams across the azimuth aperture."}, self.beam_count);
  visit(Field{"azimuth_aperture", "rad", above_to(0, 2 * kPi),
              "Full width of the fan, or of each side's beam along the track (sss)."},
        self.azimuth_aperture);
  visit(Field{"beam_azimuths", "rad", from_to(-kPi, kPi),
              "Centres of the beams, falling from port to starboard; they determine beam_count and azimuth_aperture. "
              "Evenly spaced in angle when absent."},
        self.beam_azimuths);
  visit(Field{"beam_spacing",
              "",
              {},
              "equiangular, or equidistant on a level bottom; for evenly spaced beams without beam_azimuths (mbes)."},
        self.beam_spacing);
  visit(Field{"beam_widths", "rad", above_to(0, 2 * kPi),
              "Width of the azimuth slice of each beam, one value for all or one per beam. Slices narrower than the "
              "spacing leave gaps, from which nothing is received; beams touch when absent."},
        self.beam_widths);
  visit(Field{"azimuth_resolution", "rad", above_to(0, 0.5 * kPi),
              "One-way width at half power of an unsteered beam; the beam spacing when absent (calibrated model, with "
              "an azimuth_pattern).",
              ActsIn::kCalibrated},
        self.azimuth_resolution);
  visit(Field{"elevation_aperture", "rad", above_to(0, radians_from_degrees(170)),
              "Full vertical width of every beam; with an elevation_pattern, its one-way width at half power."},
        self.elevation_aperture);
  visit(Field{"elevation_center", "rad", from_to(radians_from_degrees(-85), radians_from_degrees(85)),
              "Middle of the elevation aperture."},
        self.elevation_center);
  visit(Field{"elevation_pattern",
              "",
              {},
              "Transmit and receive pattern across elevations: top_hat, or the window of an array. Used if "
              "receiver.elevation_pattern is instrument (calibrated model).",
              ActsIn::kCalibrated},
        self.elevation_pattern);
  visit(Field{"transmit_elevation_pattern",
              "",
              {},
              "Transmit pattern across elevations: top_hat, the window of an array, or instrument for that of the "
              "receiver (calibrated model).",
              ActsIn::kCalibrated},
        self.transmit_elevation_pattern);
  visit(Field{"transmit_elevation_aperture", "rad", above_to(0, radians_from_degrees(170)),
              "Full vertical width of the transmitted beam, defined as elevation_aperture; the same as that when "
              "absent (calibrated model).",
              ActsIn::kCalibrated},
        self.transmit_elevation_aperture);
  visit(
      Field{"elevation_element_error_db", "dB", from_to(0, 20),
            "Standard deviation of the amplitudes of the half-wavelength parts of the arrays across elevations, which "
            "fills the pattern's nulls (calibrated model).",
            ActsIn::kCalibrated},
      self.elevation_element_error_db);
  visit(Field{"elevation_element_error", "rad", from_to(0, kPi), "Standard deviation of their phases.",
              ActsIn::kCalibrated},
        self.elevation_element_error);
  visit(Field{"two_way_array",
              "",
              {},
              "Whether the array of a sonar with one beam also transmits, so that azimuth_pattern applies both ways; "
              "always so for msis and sss (calibrated model).",
              ActsIn::kCalibrated},
        self.two_way_array);
  visit(Field{"transmit_width", "rad", above_to(0, kWidestElement),
              "Azimuth width at half power of a fan's transmitter; omnidirectional in azimuth when absent (calibrated "
              "model).",
              ActsIn::kCalibrated},
        self.transmit_width);
  visit(Field{"element_width", "rad", above_to(0, kWidestElement),
              "Azimuth width at half power of one element of a fan's receiver; omnidirectional in azimuth when absent "
              "(calibrated model).",
              ActsIn::kCalibrated},
        self.element_width);
  visit(Field{"focus_range", "m", above_to(0, 1e6),
              "Range at which the beams are focused, at least the array's length; 1e6 for the far field. Focused at "
              "every range when absent (calibrated model, with an azimuth_pattern).",
              ActsIn::kCalibrated},
        self.focus_range);
  visit(Field{"bin_count", "", from_to(1, 65536), "Range bins per beam."}, self.bin_count);
  visit(Field{"min_range", "m", from_to(0, 1e5), "Near edge of bin 0; nearer echoes are dropped."}, self.min_range);
  visit(Field{"max_range", "m", above_to(0, 1e5), "Far edge of the last bin."}, self.max_range);
  visit(Field{"blanking_range", "m", from_to(0, 1e5),
              "Near field: the amplitude gain rises linearly from 0 at min_range to 1 at this range."},
        self.blanking_range);
  visit(
      Field{"gain", "", above_to(0, 1e9), "Multiplies the intensity before it is clipped to 1 (paper model).",
            ActsIn::kPaper, "receiver.gain_ranges and receiver.gains_db for levels, receiver.full_scale_db for counts"},
      self.gain);
  visit(Field{"leak_db", "dB", from_to(-300, 100),
              "Level of the outgoing pulse in the receiver, re the source level (calibrated); no leak when absent.",
              ActsIn::kCalibrated},
        self.leak_db);
  visit(Field{"ring_down", "dB/s", from_to(1e3, 1e9),
              "Decay rate of the transducer's ringing after the pulse (leak_db).", ActsIn::kCalibrated},
        self.ring_down);
  visit(Field{"leak_spread_db", "dB", from_to(0, 20),
              "Standard deviation of the leak's level between beams, or directions of a scanning head, drawn from the "
              "seed (leak_db).",
              ActsIn::kCalibrated},
        self.leak_spread_db);
  visit(Field{"dead_range", "m", from_to(0, 1e5),
              "Range below which the receiver, overloaded by the transmission, receives neither echoes nor noise "
              "(calibrated).",
              ActsIn::kCalibrated, "blanking_range"},
        self.dead_range);
  visit(Field{"group_gains_db", "dB", from_to(-300, 60),
              "Gains of equal groups of neighbouring beams, one value per group, starting at port (calibrated).",
              ActsIn::kCalibrated},
        self.group_gains_db);
  visit(Field{"missing_beams", "", from_to(0, 4095),
              "Indices of beams that deliver nothing; 0 is at port (calibrated).", ActsIn::kCalibrated},
        self.missing_beams);
  visit(Field{"crosstalk_db", "dB", from_to(-200, 0),
              "Level at which each beam also receives the sum of all beams' echoes at the same range (calibrated); "
              "none when absent.",
              ActsIn::kCalibrated},
        self.crosstalk_db);
  visit(Field{"bits", "", from_to(1, 16), "Bits per count (receiver.counts).", ActsIn::kCalibrated}, self.bits);
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
              "electronic (a fan's bearings depend on the assumed sound speed too) or lens (each beam has its own "
              "transducer, whose noise is independent) (calibrated).",
              ActsIn::kCalibrated},
        self.steering);
  visit(Field{"ping_period", "s", above_to(0, 1e6), "Time between pings; 2 max_range / c when absent, and never less."},
        self.ping_period);
  visit(Field{"step", "rad", from_to(-kPi, kPi), "Turn of a scanning head between pings, positive to port."},
        self.head.step);
  visit(Field{"sector_center", "rad", from_to(-kPi, kPi), "Middle of the scanned sector."}, self.head.sector_center);
  visit(Field{"sector_width", "rad", above_to(0, 2 * kPi),
              "Width of the scanned sector; at 360 the head keeps turning, below that it sweeps back and forth."},
        self.head.sector_width);
  visit(Field{"mounting", "", {}, "horizontal (a plan view) or vertical (a slice) scanning head."}, self.head.mounting);
  visit(Field{"depression", "rad", from_to(0, radians_from_degrees(90)),
              "Angle of both sides' acoustic axes below the horizontal of the housing (sss)."},
        self.depression);
  visit(Field{"roll_stabilised",
              "",
              {},
              "Whether beams stay at their angles from the vertical, steered against the vehicle's roll (mbes)."},
        self.roll_stabilised);
  visit(Field{"pitch_stabilised", "", {}, "Whether the swath stays vertical, steered against its pitch (mbes)."},
        self.pitch_stabilised);
  visit(Field{"yaw_stabilised", "", {}, "Whether the swath stays across the course, steered against its yaw (mbes)."},
        self.yaw_stabilised);
  visit(
      Field{"position", "m", coordinate(), "Position on the vehicle, or in the world without a trajectory: [x, y, z]."},
      self.position);
  visit(Field{"orientation", "rad", turn(), "[roll, pitch, yaw] as in SDF: positive pitch looks down."},
        self.orientation);
}

}  // namespace insonify
