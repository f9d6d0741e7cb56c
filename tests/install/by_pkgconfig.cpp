// by_pkgconfig.cpp -- what pkg-config's flags must lead to: our headers, Eigen, C++20 and the library.
// Headers that are parsed at once: main.cpp includes all of them.

#include <insonify/acoustics/sound_speed.h>
#include <insonify/version.h>

#include <cstdio>
#include <span>

#if !__has_include(<Eigen/Geometry>) || __cplusplus < 202002L
#error "Neither our headers nor their users compile with these flags"
#endif

int main() {
  const double speed = insonify::mackenzie_sound_speed(25, 35, 1000);
  std::printf("insonify %s: %.3f m/s\n", insonify::kVersion, speed);
  return speed > 1550.74 && speed < 1550.75 ? 0 : 1;  // Mackenzie (1981): 1550.744 m/s.
}
