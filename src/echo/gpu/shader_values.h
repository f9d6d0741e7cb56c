// shader_values.h -- what the host's files about kernels have in common: numbers of groups, and vectors as shaders have
// them.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "echo/gpu/shaders/layout.h"

namespace insonify {

/// Number of groups of `each` that hold `count`.
[[nodiscard]] constexpr std::uint32_t groups_for(std::uint32_t count, std::uint32_t each = shader::kGroup) {
  return (count + each - 1) / each;
}

template <typename Derived>
[[nodiscard]] shader::vec3 plain(const Eigen::MatrixBase<Derived>& vector) {
  return {static_cast<float>(vector[0]), static_cast<float>(vector[1]), static_cast<float>(vector[2])};
}

}  // namespace insonify
