// ros_pings.cpp -- waits for the image of each ping that a client asks for.

#include "ros1/ros_pings.h"

#include <fmt/format.h>

#include <future>
#include <memory>
#include <utility>

#include "insonify/error.h"
#include "insonify/messages.h"
#include "insonify/printable.h"
#include "ros1/ros_inputs.h"
#include "ros1/ros_ping_service.h"

namespace insonify {

RosPings::RosPings(Bridge& bridge, const std::string& world_frame)
    : bridge_(bridge), world_frame_(bare_frame(world_frame)) {
  node_.setCallbackQueue(&queue_);
  const auto world = bridge.loop().world();
  for (std::size_t i = 0; i < world->sonars.size(); ++i) {
    const std::string name = message_source(world->scenario, world->sonars[i]).name;
    // Absolute, as topics are: names of sonars may begin with "_".
    const std::string service = node_.getNamespace() + (world->sonars.size() == 1 ? "" : "/" + name) + "/ping";
    services_.push_back(serve_pings(node_, service, [this, i](const RosPlace& place) { return make(i, place); }));
  }
  spinner_.start();
}

std::vector<std::byte> RosPings::make(std::size_t sonar, const RosPlace& place) const {
  if (!place.frame.empty() && place.frame != world_frame_) {
    throw Error(fmt::format("the pose is in the frame {}; it must be in {} (--world-frame)", printable(place.frame),
                            printable(world_frame_)));
  }
  const auto answer = std::make_shared<std::promise<std::vector<std::byte>>>();
  bridge_.ask(drive_of(place, false), sonar, [answer](std::vector<std::byte> image, const std::string& error) {
    if (error.empty()) {
      answer->set_value(std::move(image));
    } else {
      answer->set_exception(std::make_exception_ptr(Error(error)));
    }
  });
  return answer->get_future().get();
}

std::vector<std::string> RosPings::services() const {
  std::vector<std::string> names;
  for (const ros::ServiceServer& service : services_) {
    names.push_back(service.getService());
  }
  return names;
}

}  // namespace insonify
