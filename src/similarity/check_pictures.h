// check_pictures.h -- what every measure asks of its two pictures.

#pragma once

#include "insonify/similarity.h"

namespace insonify {

/// @throws Error unless it holds as many values as it has pixels, at least one.
void check_table(const GreyPicture& picture);

/// @throws Error unless both do and are of the same shape.
void check_pair(const GreyPicture& a, const GreyPicture& b);

/// @throws Error where a side is shorter than `side`; `measure` needs that.
void check_side(const GreyPicture& picture, int side, const char* measure);

}  // namespace insonify
