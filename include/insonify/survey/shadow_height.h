// shadow_height.h -- how high an object stands on the bed, by the length of its shadow.

#pragma once

namespace insonify {

// A sonar at the altitude H above a level bed sees an object of the height h at the ground range x. Its shadow ends at
// the ground range X where the ray over its top meets the bed. By similar triangles h / H = (X - x) / X. In slant
// ranges the same ray has the top at r and the bed at R: h / H = (R - r) / R. Blondel, The Handbook of Sidescan Sonar
// (Springer 2009), section 3.4.

/// Height of an object whose shadow begins at its foot, such as a post or a wall [m]: H (X - x) / X with
/// x = sqrt(begin^2 - H^2) and X = sqrt(end^2 - H^2).
/// @param altitude  H, height of the sonar above the bed [m], > 0.
/// @param begin     Slant range of the object's foot, where the shadow begins [m], > altitude.
/// @param end       Slant range at which the shadow ends [m], >= begin.
/// @throws Error for arguments out of limits.
[[nodiscard]] double height_from_shadow(double altitude, double begin, double end);

/// The same where the slant range of the top is known, as that of the nearest highlight of a boulder: H (R - r) / R.
/// @param top  r, slant range of the top that casts the end of the shadow [m], > 0.
/// @param end  R, slant range at which the shadow ends [m], >= top and > altitude.
[[nodiscard]] double height_from_highlight(double altitude, double top, double end);

/// Length on the bed of the shadow of an object: h x / (H - h) [m].
/// @param height        h, of the object [m], >= 0 and < altitude: the shadow of a higher one does not end.
/// @param ground_range  x, of its foot [m], > 0.
[[nodiscard]] double shadow_length(double altitude, double height, double ground_range);

}  // namespace insonify
