// noise_level.h -- mean intensity of the noise that a beam receives.

#pragma once

#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Solid angle of the receive pattern of an unsteered beam, the integral of |g p|^2 over all directions [sr]: with it
/// the directivity index is 10 log10(4 pi / solid angle) (Urick, Principles of Underwater Sound (1983), ch. 3).
///
/// In bearing it is that of the array without faults, beam_width() wide at half power, by Parseval's theorem; that of a
/// top hat is slice_width(), from which its echoes come. In elevation it is that of the aperture or of the elevation
/// pattern. It is the same for all beams: the directivity of a line array does not depend on steering (Van Trees,
/// Optimum Array Processing (2002), section 2.6).
[[nodiscard]] double receive_solid_angle(const SonarConfig& sonar, const ReceiverConfig& receiver);

/// Spectral level at the sonar's carrier of thermal noise, its own noise, the receiver's `ambient_noise_db`, and wind,
/// rain and ship noise, summed in power [dB re 1 uPa^2/Hz].
[[nodiscard]] double noise_spectrum_db(const SonarConfig& sonar, const ReceiverConfig& receiver);

/// Spectral level of the receiver's wind and rain noise, summed in power; -infinity without any [dB re 1 uPa^2/Hz].
[[nodiscard]] double weather_spectrum_db(const ReceiverConfig& receiver, double frequency);

/// Mean intensity of the noise in a beam, re the source's at 1 m: noise_spectrum_db() in the receiver's
/// bandwidth, less the directivity index (Urick 1983, ch. 2). The bandwidth is that of the pulse's filter, so that a
/// matched filter has a signal to noise ratio of 2 E / N0, whatever the pulse (Turin, IRE Trans. IT-6, 311 (1960));
/// without a pulse it is the sonar's `bandwidth`.
[[nodiscard]] double noise_intensity(const SonarConfig& sonar, const ReceiverConfig& receiver, const Pulse& pulse);

/// The same for noise of a given spectral level, received from a given solid angle [sr].
[[nodiscard]] double noise_intensity(const SonarConfig& sonar, const Pulse& pulse, double spectrum_db,
                                     double solid_angle);

/// Integral of |g|^2 over the sine of the bearing; the same for all beams.
[[nodiscard]] double receive_bearing_width(const SonarConfig& sonar, const ReceiverConfig& receiver);

}  // namespace insonify
