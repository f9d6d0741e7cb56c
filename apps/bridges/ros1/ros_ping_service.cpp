// ros_ping_service.cpp -- decodes requests; responses are encoded already.

#include "ros1/ros_ping_service.h"

#include <geometry_msgs/PoseStamped.h>
#include <ros/advertise_service_options.h>
#include <ros/serialization.h>
#include <ros/service_callback_helper.h>

#include <cstdint>
#include <cstring>
#include <utility>

#include "ros1/ros_place.h"

namespace insonify {
namespace {

// Checksum of ros1/srv/Ping.srv, as genmsg computes it.
constexpr const char* kMd5 = "fc4a8ab1cf7da417c018dd592cb4503d";

struct PingHelper : ros::ServiceCallbackHelper {
  explicit PingHelper(std::function<std::vector<std::byte>(const RosPlace&)> the_make) : make(std::move(the_make)) {}

  // A response is 1 for success, the length of what follows, and the message: one field, an image, has the bytes of an
  // image.
  bool call(ros::ServiceCallbackHelperCallParams& call) override {
    geometry_msgs::PoseStamped pose;
    ros::serialization::deserializeMessage(call.request, pose);
    const std::vector<std::byte> image = make(place_of(pose.header, pose.pose));
    constexpr std::size_t kHead = 5;  // [byte]
    ros::SerializedMessage& response = call.response;
    response.num_bytes = kHead + image.size();
    response.buf.reset(new std::uint8_t[response.num_bytes]);
    ros::serialization::OStream head(response.buf.get(), kHead);
    head.next(std::uint8_t{1});
    head.next(static_cast<std::uint32_t>(image.size()));
    std::memcpy(response.buf.get() + kHead, image.data(), image.size());
    return true;
  }

  std::function<std::vector<std::byte>(const RosPlace&)> make;
};

}  // namespace

ros::ServiceServer serve_pings(ros::NodeHandle& node, const std::string& name,
                               std::function<std::vector<std::byte>(const RosPlace&)> make) {
  ros::AdvertiseServiceOptions options;
  options.service = name;
  options.md5sum = kMd5;
  options.datatype = "insonify_ros1/Ping";
  options.req_datatype = "insonify_ros1/PingRequest";
  options.res_datatype = "insonify_ros1/PingResponse";
  options.helper = boost::make_shared<PingHelper>(std::move(make));
  return node.advertiseService(options);
}

}  // namespace insonify
