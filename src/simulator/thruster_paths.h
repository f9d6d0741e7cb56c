// thruster_paths.h -- positions of the vehicle's thrusters in the frame of a sonar's head, and whether they are hidden.

#pragma once

#include <span>

#include "echo/batch/echo_source.h"
#include "insonify/thruster.h"

namespace insonify {

/// Finds EchoList::thrusters: thrusters make noise, no echoes. Any surface in the way hides one.
class ThrusterPaths final : public EchoSource {
 public:
  explicit ThrusterPaths(std::span<const Thruster> thrusters) : thrusters_(thrusters) {}

  void ask(const PingView& view, Workers& workers, RayList& rays) override;
  void answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList& more, EchoList& found) override;

 private:
  std::span<const Thruster> thrusters_;
};

}  // namespace insonify
