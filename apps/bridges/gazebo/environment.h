// environment.h -- the environment of Gazebo's transport.

#pragma once

#include <string>

namespace insonify {

/// Has the transport read the variables of the newer Gazebo too: GZ_PARTITION and others where IGN_PARTITION is not
/// set. To be called before there is a node.
void take_gz_environment();

/// The partition that nodes are in, "" for the usual one.
[[nodiscard]] std::string gazebo_partition();

}  // namespace insonify
