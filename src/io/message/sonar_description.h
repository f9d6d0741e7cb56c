// sonar_description.h -- what a sonar is, as a text for those who read its messages.

#pragma once

#include <string>

#include "insonify/messages.h"

namespace insonify {

/// A JSON object, docs/reference/messages.md has its members.
/// @param frame  Of the housing.
[[nodiscard]] std::string sonar_description(const MessageSource& source, const MessageOptions& options,
                                            const std::string& frame);

}  // namespace insonify
