// hdf5_bytes.cpp -- walks over version 1 object headers (HDF5 File Format Specification 3.0, IV.A.1.a).

#include "io/file/hdf5_bytes.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace insonify {

Hdf5Bytes::Hdf5Bytes(hid_t file, std::filesystem::path path, std::string name)
    : path_(std::move(path)),
      name_(std::move(name)),
      file_(path_, std::ios::binary),
      end_(std::filesystem::file_size(path_)) {
  const std::string doing = "read " + name_;
  const H5Handle made = h5_own(H5Fget_create_plist(file), H5Pclose, path_, doing);
  std::size_t address_bytes = 0, length_bytes = 0;
  hsize_t base = 0;
  h5_check(H5Pget_sizes(made.get(), &address_bytes, &length_bytes), path_, doing);
  h5_check(H5Pget_userblock(made.get(), &base), path_, doing);
  base_ = base;
  if (address_bytes != 8 || length_bytes != 8) {
    fail("its addresses do not have 8 bytes");
  }
}

void Hdf5Bytes::fail(const std::string& reason) const {
  throw Error(fmt::format("{}: {} is damaged: {}", path_.string(), name_, reason));
}

std::vector<char> Hdf5Bytes::read(std::uint64_t place, std::uint64_t count) {
  if (place > end_ || count > end_ - place) {
    fail("it points past the end of the file");
  }
  std::vector<char> bytes(count);
  file_.seekg(static_cast<std::streamoff>(place));
  if (!file_.read(bytes.data(), static_cast<std::streamsize>(count))) {
    fail("it cannot be read");
  }
  return bytes;
}

bool Hdf5Bytes::each_message(std::uint64_t address, const std::function<void(const Hdf5Message&)>& visit) {
  constexpr std::uint64_t kPrefix = 16;        // Version, message count, reference count, size, padding.
  constexpr std::uint64_t kMessagePrefix = 8;  // Type, size, flags, reserved.
  constexpr std::size_t kMostBlocks = 1024;
  constexpr unsigned kShared = 0x02;  // Bit of the flags.
  const std::vector<char> prefix = read(base_ + address, kPrefix);
  if (number_at<std::uint8_t>(prefix, 0) != 1) {
    return false;
  }
  struct Block {
    std::uint64_t place, size;
  };
  std::vector<Block> blocks = {{base_ + address + kPrefix, number_at<std::uint32_t>(prefix, 8)}};
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const std::vector<char> block = read(blocks[i].place, blocks[i].size);
    for (std::uint64_t at = 0; block.size() - at >= kMessagePrefix;) {
      const auto size = number_at<std::uint16_t>(block, at + 2);
      Hdf5Message message{
          number_at<std::uint16_t>(block, at), (number_at<std::uint8_t>(block, at + 4) & kShared) != 0, {}};
      at += kMessagePrefix;
      if (size > block.size() - at) {
        fail("a message of its header is larger than the header");
      }
      message.content = std::span(block).subspan(at, size);
      if (message.type != Hdf5Message::kContinuation) {
        visit(message);
      } else if (blocks.size() == kMostBlocks) {
        fail("its header does not end");
      } else {
        blocks.push_back(
            {base_ + number_at<std::uint64_t>(message.content, 0), number_at<std::uint64_t>(message.content, 8)});
      }
      at += size;
    }
  }
  return true;
}

namespace {

// Values that a dataspace message says there are (IV.A.2.b); too many for a number become the most it can be.
std::uint64_t points_of(std::span<const char> space) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  const auto version = number_at<std::uint8_t>(space, 0), axes = number_at<std::uint8_t>(space, 1);
  const bool none = version == 2 && number_at<std::uint8_t>(space, 3) == 2;
  std::uint64_t points = none ? 0 : 1;
  for (std::uint64_t axis = 0; axis < axes; ++axis) {
    const auto length = number_at<std::uint64_t>(space, (version == 1 ? 8 : 4) + 8 * axis);
    points = length != 0 && points > kMost / length ? kMost : points * length;
  }
  return points;
}

}  // namespace

// Parts are name, datatype, dataspace, data; version 1 pads the first three to 8 bytes.
Hdf5Attribute attribute_parts(const Hdf5Bytes& bytes, std::span<const char> message) {
  const auto version = number_at<std::uint8_t>(message, 0);
  if (version < 1 || version > 3) {
    bytes.fail("an attribute is of a kind that recordings do not have");
  }
  const std::uint64_t padding = version == 1 ? 8 : 1;
  const auto padded = [&](std::uint64_t size) { return (size + padding - 1) / padding * padding; };
  const auto name_size = number_at<std::uint16_t>(message, 2), type_size = number_at<std::uint16_t>(message, 4);
  const std::uint64_t first = version == 3 ? 9 : 8;
  const std::uint64_t type = first + padded(name_size);
  const auto space_size = number_at<std::uint16_t>(message, 6);
  const std::uint64_t space = type + padded(type_size), data = space + padded(space_size);
  if (data > message.size()) {
    bytes.fail("an attribute is larger than its message");
  }
  const bool shared = version > 1 && number_at<std::uint8_t>(message, 1) != 0;
  const auto value_size = number_at<std::uint32_t>(message.subspan(type, type_size), 4);
  const std::uint64_t points = shared ? 0 : points_of(message.subspan(space, space_size));
  if (value_size > 0 && points > (message.size() - data) / value_size) {
    bytes.fail("an attribute has more values than its message");
  }
  const std::string name(message.begin() + static_cast<std::ptrdiff_t>(first),
                         message.begin() + static_cast<std::ptrdiff_t>(first + name_size));
  return {name.substr(0, name.find('\0')), message.subspan(type, type_size), message.subspan(data), shared};
}

}  // namespace insonify
