// cone.cpp -- the cone of the paper's figure on attenuation.

#include "tank/cone.h"

Shape make_cone() {
  constexpr int kSides = 96;
  return revolve("steel", {{0, 0}, {kConeRadius, 0}, {0, kConeHeight}}, kSides);
}
