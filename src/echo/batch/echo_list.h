// echo_list.h -- echoes of one ping that no samples of the fan give, on their way from a source to the grid.

#pragma once

#include <optional>
#include <vector>

#include "echo/grid/echo.h"
#include "insonify/geometry.h"

namespace insonify {

/// What one EchoSource finds at one ping.
struct EchoList {
  std::vector<Echo> spread;            ///< Echoes that are summed in cells, in the order in which they are added.
  std::vector<DiscreteEcho> discrete;  ///< Echoes with a bearing and a phase of their own.
  std::vector<std::optional<Vec3>> thrusters;  ///< [thruster] Its position in the sonar frame [m]; none where hidden.

  void clear() {
    spread.clear();
    discrete.clear();
    thrusters.clear();
  }
};

}  // namespace insonify
