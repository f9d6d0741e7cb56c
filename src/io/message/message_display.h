// message_display.h -- the fixed mapping of intensities to the values of images, and back.

#pragma once

#include "insonify/messages.h"

namespace insonify {

/// The levels that values of images cover, as SonarMessages::levels() tells.
[[nodiscard]] MessageLevels message_levels(const MessageSource& source, const MessageOptions& options);

/// The display that draws them: shown_level() of an intensity raised by range is its value's share of the greatest.
[[nodiscard]] Display message_display(const MessageSource& source, const MessageOptions& options);

/// The intensity of a value, without the gain over range: the inverse of the mapping. 0 for the value 0.
/// @param share  The value's share of the greatest, 0..1.
/// @param range  Of its bin [m].
[[nodiscard]] double intensity_of_share(const MessageLevels& levels, double share, double range);

}  // namespace insonify
