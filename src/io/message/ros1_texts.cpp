// ros1_texts.cpp -- ROS 1's own definitions of its messages, comments included.
//
// From common_msgs, std_msgs and geometry2: copyright 2008-2010 Willow Garage, Inc., BSD-3-Clause
// (share/licences/ros-messages.txt).

#include "io/message/ros1_texts.h"

#include <algorithm>
#include <utility>

namespace insonify {
namespace {

// Blanks at the ends of lines are ROS's.
// clang-format off
constexpr std::pair<std::string_view, std::string_view> kTexts[] = {
    {"geometry_msgs/Point", R"(# This contains the position of a point in free space
float64 x
float64 y
float64 z
)"},
    {"geometry_msgs/Pose", R"(# A representation of pose in free space, composed of position and orientation. 
Point position
Quaternion orientation
)"},
    {"geometry_msgs/PoseStamped", R"(# A Pose with reference coordinate frame and timestamp
Header header
Pose pose
)"},
    {"geometry_msgs/Quaternion", R"(# This represents an orientation in free space in quaternion form.

float64 x
float64 y
float64 z
float64 w
)"},
    {"geometry_msgs/Transform", R"(# This represents the transform between two coordinate frames in free space.

Vector3 translation
Quaternion rotation
)"},
    {"geometry_msgs/TransformStamped", R"(# This expresses a transform from coordinate frame header.frame_id
# to the coordinate frame child_frame_id
#
# This message is mostly used by the 
# <a href="http://wiki.ros.org/tf">tf</a> package. 
# See its documentation for more information.

Header header
string child_frame_id # the frame id of the child frame
Transform transform
)"},
    {"geometry_msgs/Vector3", R"(# This represents a vector in free space. 
# It is only meant to represent a direction. Therefore, it does not
# make sense to apply a translation to it (e.g., when applying a 
# generic rigid transformation to a Vector3, tf2 will only apply the
# rotation). If you want your data to be translatable too, use the
# geometry_msgs/Point message instead.

float64 x
float64 y
float64 z)"},
    {"sensor_msgs/Image", R"(# This message contains an uncompressed image
# (0, 0) is at top-left corner of image
#

Header header        # Header timestamp should be acquisition time of image
                     # Header frame_id should be optical frame of camera
                     # origin of frame should be optical center of camera
                     # +x should point to the right in the image
                     # +y should point down in the image
                     # +z should point into to plane of the image
                     # If the frame_id here and the frame_id of the CameraInfo
                     # message associated with the image conflict
                     # the behavior is undefined

uint32 height         # image height, that is, number of rows
uint32 width          # image width, that is, number of columns

# The legal values for encoding are in file src/image_encodings.cpp
# If you want to standardize a new string format, join
# ros-users@lists.sourceforge.net and send an email proposing a new encoding.

string encoding       # Encoding of pixels -- channel meaning, ordering, size
                      # taken from the list of strings in include/sensor_msgs/image_encodings.h

uint8 is_bigendian    # is this data bigendian?
uint32 step           # Full row length in bytes
uint8[] data          # actual matrix data, size is (step * rows)
)"},
    {"sensor_msgs/LaserScan", R"(# Single scan from a planar laser range-finder
#
# If you have another ranging device with different behavior (e.g. a sonar
# array), please find or create a different message, since applications
# will make fairly laser-specific assumptions about this data

Header header            # timestamp in the header is the acquisition time of 
                         # the first ray in the scan.
                         #
                         # in frame frame_id, angles are measured around 
                         # the positive Z axis (counterclockwise, if Z is up)
                         # with zero angle being forward along the x axis
                         
float32 angle_min        # start angle of the scan [rad]
float32 angle_max        # end angle of the scan [rad]
float32 angle_increment  # angular distance between measurements [rad]

float32 time_increment   # time between measurements [seconds] - if your scanner
                         # is moving, this will be used in interpolating position
                         # of 3d points
float32 scan_time        # time between scans [seconds]

float32 range_min        # minimum range value [m]
float32 range_max        # maximum range value [m]

float32[] ranges         # range data [m] (Note: values < range_min or > range_max should be discarded)
float32[] intensities    # intensity data [device-specific units].  If your
                         # device does not provide intensities, please leave
                         # the array empty.
)"},
    {"sensor_msgs/PointCloud2", R"(# This message holds a collection of N-dimensional points, which may
# contain additional information such as normals, intensity, etc. The
# point data is stored as a binary blob, its layout described by the
# contents of the "fields" array.

# The point cloud data may be organized 2d (image-like) or 1d
# (unordered). Point clouds organized as 2d images may be produced by
# camera depth sensors such as stereo or time-of-flight.

# Time of sensor data acquisition, and the coordinate frame ID (for 3d
# points).
Header header

# 2D structure of the point cloud. If the cloud is unordered, height is
# 1 and width is the length of the point cloud.
uint32 height
uint32 width

# Describes the channels and their layout in the binary data blob.
PointField[] fields

bool    is_bigendian # Is this data bigendian?
uint32  point_step   # Length of a point in bytes
uint32  row_step     # Length of a row in bytes
uint8[] data         # Actual point data, size is (row_step*height)

bool is_dense        # True if there are no invalid points
)"},
    {"sensor_msgs/PointField", R"(# This message holds the description of one point entry in the
# PointCloud2 message format.
uint8 INT8    = 1
uint8 UINT8   = 2
uint8 INT16   = 3
uint8 UINT16  = 4
uint8 INT32   = 5
uint8 UINT32  = 6
uint8 FLOAT32 = 7
uint8 FLOAT64 = 8

string name      # Name of field
uint32 offset    # Offset from start of point struct
uint8  datatype  # Datatype enumeration, see above
uint32 count     # How many elements in the field
)"},
    {"std_msgs/Header", R"(# Standard metadata for higher-level stamped data types.
# This is generally used to communicate timestamped data 
# in a particular coordinate frame.
# 
# sequence ID: consecutively increasing ID 
uint32 seq
#Two-integer timestamp that is expressed as:
# * stamp.sec: seconds (stamp_secs) since epoch (in Python the variable is called 'secs')
# * stamp.nsec: nanoseconds since stamp_secs (in Python the variable is called 'nsecs')
# time-handling sugar is provided by the client library
time stamp
#Frame this data is associated with
string frame_id
)"},
    {"tf2_msgs/TFMessage", R"(geometry_msgs/TransformStamped[] transforms
)"},
};
// clang-format on

}  // namespace

std::string_view ros1_text(std::string_view type) {
  const auto* const found = std::ranges::find_if(kTexts, [&](const auto& entry) { return entry.first == type; });
  return found == std::end(kTexts) ? std::string_view() : found->second;
}

}  // namespace insonify
