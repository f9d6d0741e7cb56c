// dds_names.cpp -- the hashes of the bridge's message types.

#include "dds/dds_names.h"

#include <dds/dds.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace insonify {
namespace {

struct TypeHash {
  std::string_view type, hash;
};

// A test computes them from the definitions of the MCAP recording: tests/bridges/type_hash_test.py.
constexpr std::array<TypeHash, 11> kHashes{{
    {"geometry_msgs::msg::dds_::PoseStamped_",
     "RIHS01_10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8"},
    {"marine_acoustic_msgs::msg::dds_::ProjectedSonarImage_",
     "RIHS01_e9d0b934ee8332c9f79e04c361de0793c165b2dee14f2c0d25c3227cd50d46f1"},
    {"marine_acoustic_msgs::msg::dds_::RawSonarImage_",
     "RIHS01_668954b8ea9854ec5c25c3ebdbdd9d53452169c7e1e365cad5baf0dc56ac9607"},
    {"marine_acoustic_msgs::msg::dds_::SonarDetections_",
     "RIHS01_2be9466b1dff9d71d6c8e21379e805805a5d315d899023961f183bc32182e60d"},
    {"nav_msgs::msg::dds_::Odometry_", "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0"},
    {"rosgraph_msgs::msg::dds_::Clock_", "RIHS01_692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564"},
    {"sensor_msgs::msg::dds_::Image_", "RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47"},
    {"sensor_msgs::msg::dds_::LaserScan_", "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828"},
    {"sensor_msgs::msg::dds_::PointCloud2_", "RIHS01_9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5"},
    {"std_msgs::msg::dds_::String_", "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"},
    {"tf2_msgs::msg::dds_::TFMessage_", "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"},
}};

}  // namespace

std::string_view type_hash(std::string_view type) {
  const auto* const found = std::ranges::find(kHashes, type, &TypeHash::type);
  return found == kHashes.end() ? std::string_view() : found->hash;
}

void add_type_hash(dds_qos* qos, std::string_view type) {
  if (const std::string_view hash = type_hash(type); !hash.empty()) {
    const std::string text = fmt::format("typehash={};", hash);
    dds_qset_userdata(qos, text.data(), text.size());
  }
}

}  // namespace insonify
