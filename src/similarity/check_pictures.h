// check_pictures.h -- checks of pictures that all similarity measures need.

#pragma once

#include "insonify/similarity.h"

namespace insonify {

/// @throws Error unless the picture has at least one pixel and as many values as pixels.
void check_table(const GreyPicture& picture);

/// @throws Error unless both pass check_table() and have the same shape.
void check_pair(const GreyPicture& a, const GreyPicture& b);

/// @throws Error if a side is shorter than `side`, the least that `measure` needs.
void check_side(const GreyPicture& picture, int side, const char* measure);

}  // namespace insonify
