// shader_values.h -- what the host's files about kernels have in common: sizes of groups, and vectors as shaders have
// them.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "echo/gpu/shaders/layout.h"

namespace insonify {

/// Invocations of a group, in all shaders that work through a list.
inline constexpr std::uint32_t kGroup = 64;

[[nodiscard]] constexpr std::uint32_t groups_for(std::uint32_t count, std::uint32_t each = kGroup) {
  return (count + each - 1) / each;
}

template <typename Derived>
[[nodiscard]] shader::vec3 plain(const Eigen::MatrixBase<Derived>& vector) {
  return {static_cast<float>(vector[0]), static_cast<float>(vector[1]), static_cast<float>(vector[2])};
}

}  // namespace insonify
