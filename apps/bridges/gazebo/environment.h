// environment.h -- the environment of Gazebo's transport.

#pragma once

#include <string>

namespace insonify {

/// Makes the transport honour the variables of newer Gazebo releases: GZ_PARTITION etc. where IGN_PARTITION etc. is not
/// set. To be called before the first node is made.
void copy_gz_environment();

/// The partition of the nodes; "": the default one.
[[nodiscard]] std::string gazebo_partition();

}  // namespace insonify
