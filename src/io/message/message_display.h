// message_display.h -- the fixed mapping of intensities to the values of images, and back.

#pragma once

#include "insonify/messages.h"

namespace insonify {

/// The levels covered by values of images, see SonarMessages::levels().
[[nodiscard]] MessageLevels message_levels(const MessageSource& source, const MessageOptions& options);

/// The display of these levels: shown_level() of an intensity with gain is its value relative to the greatest.
[[nodiscard]] Display message_display(const MessageSource& source, const MessageOptions& options);

/// The intensity of a value, without the gain over range: the inverse of the mapping. 0 for the value 0.
/// @param share  The value relative to the greatest, 0..1.
/// @param range  Range of its bin [m].
[[nodiscard]] double intensity_of_share(const MessageLevels& levels, double share, double range);

}  // namespace insonify
