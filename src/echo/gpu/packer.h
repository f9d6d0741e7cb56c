// packer.h -- puts tables into the bytes of one buffer.

#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

#include "echo/gpu/shaders/layout.h"

namespace insonify {

/// Appends tables to bytes that will be at an address on the device.
class Packer {
 public:
  Packer(shader::address start, std::vector<std::byte>& bytes) : start_(start), bytes_(bytes) {}

  /// @return Address of the table.
  template <typename Values>
  shader::address add(const Values& table) {
    const std::size_t offset = bytes_.size(), size = table.size() * sizeof(*table.data());
    bytes_.resize(offset + size);
    if (size > 0) {
      std::memcpy(&bytes_[offset], table.data(), size);
    }
    return start_ + offset;
  }

  /// Makes the next table begin where addresses may.
  void align() {
    constexpr std::size_t kAddress = sizeof(shader::address);
    bytes_.resize((bytes_.size() + kAddress - 1) / kAddress * kAddress);
  }

 private:
  shader::address start_;
  std::vector<std::byte>& bytes_;
};

}  // namespace insonify
