// hdf5_bytes.h -- reads the bytes of an HDF5 file, for checks that HDF5 does not make.

#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/file/hdf5.h"

namespace insonify {

// What hdf5_type.h and hdf5_heap.h answer their threats with: HDF5's own calls are what crashes, so the bytes are read
// beside it.

/// A number at an offset; 0 if it is out of bounds.
template <typename Number>
[[nodiscard]] Number number_at(std::span<const char> bytes, std::uint64_t place) {
  Number value{};
  if (place <= bytes.size() && sizeof value <= bytes.size() - place) {
    std::memcpy(&value, bytes.data() + place, sizeof value);
  }
  return value;
}

/// A message of a version 1 object header.
struct Hdf5Message {
  static constexpr std::uint16_t kDatatype = 0x0003, kAttribute = 0x000c, kContinuation = 0x0010;

  std::uint16_t type = 0;
  bool shared = false;  ///< Whether its content is only a pointer.
  std::span<const char> content;
};

/// Reads from a file, for checks of one of its objects.
class Hdf5Bytes {
 public:
  /// @param name  Of the object, for messages.
  /// @throws Error for a file whose addresses do not have 8 bytes.
  Hdf5Bytes(hid_t file, std::filesystem::path path, std::string name);

  /// Where the addresses in the file count from [bytes].
  [[nodiscard]] std::uint64_t base() const { return base_; }
  [[nodiscard]] std::uint64_t end() const { return end_; }

  /// @throws Error "PATH: NAME is damaged: REASON"
  [[noreturn]] void fail(const std::string& reason) const;

  /// @throws Error by fail() if they are not in the file.
  std::vector<char> read(std::uint64_t place, std::uint64_t count);

  /// Visits the messages of an object's header; follows its continuations without visiting them.
  /// @param address  Of the header, counted from base().
  /// @return         Whether there is a version 1 header; others are not visited.
  bool each_message(std::uint64_t address, const std::function<void(const Hdf5Message&)>& visit);

 private:
  std::filesystem::path path_;
  std::string name_;
  std::uint64_t base_ = 0;
  std::ifstream file_;
  std::uint64_t end_;
};

/// The parts of an attribute message (HDF5 File Format Specification 3.0, IV.A.2.m).
struct Hdf5Attribute {
  std::string name;
  std::span<const char> type, data;
  bool shared = false;  ///< Whether its type or its shape is only a pointer.
};

/// @throws Error by bytes.fail() for parts that leave the message.
[[nodiscard]] Hdf5Attribute attribute_parts(const Hdf5Bytes& bytes, std::span<const char> message);

}  // namespace insonify
