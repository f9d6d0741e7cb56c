// hdf5_type.cpp -- walks over a datatype message as HDF5 does, within its bounds.

#include "io/file/hdf5_type.h"

#include <algorithm>
#include <cstring>

#include "insonify/printable.h"
#include "io/file/hdf5_bytes.h"

namespace insonify {
namespace {

enum Class : std::uint8_t {
  kInteger,
  kFloat,
  kTime,
  kString,
  kBits,
  kOpaque,
  kCompound,
  kReference,
  kEnumeration,
  kVariableLength,
  kArray
};

// Reads a datatype and those that it is made of, one after the other; throws the fault.
class TypeWalk {
 public:
  explicit TypeWalk(std::span<const char> message) : rest_(message) {}

  struct Type {
    Class kind = kInteger;
    std::uint64_t size = 0;  // Size of a value [bytes].
  };

  Type walk(int depth = 0) {
    constexpr int kDeepest = 8;
    require(depth < kDeepest, "its type is nested too deeply");
    const auto first = get<std::uint8_t>();
    version_ = first >> 4U;
    const auto kind = static_cast<Class>(first & 0x0fU);
    const std::span<const char> bits = take(3);
    const Type type{kind, get<std::uint32_t>()};
    const std::uint64_t count = number_at<std::uint16_t>(bits, 0);  // Members, of those that have them.
    require(kind <= kArray && version_ >= 1 && version_ <= 3, "its type is of an unknown kind");
    require(type.size > 0, "its type has no size");
    if (kind == kInteger || kind == kBits) {
      require_bits(type.size);
    } else if (kind == kFloat) {
      require_bits(type.size);
      take(8);
    } else if (kind == kTime) {
      take(2);
    } else if (kind == kOpaque) {
      take(number_at<std::uint8_t>(bits, 0));
    } else if (kind == kCompound) {
      walk_members(type, count, depth);
    } else if (kind == kEnumeration) {
      walk_enumeration(type, count, depth);
    } else if (kind == kVariableLength) {
      constexpr std::uint64_t kStored = 16;  // Length, address of the heap, number in it.
      require(type.size == kStored, "its texts do not have 16 bytes");
      walk(depth + 1);
    } else if (kind == kArray) {
      walk_array(type, depth);
    }
    return type;
  }

 private:
  static void require(bool holds, const char* otherwise) {
    if (!holds) {
      throw Error(otherwise);
    }
  }

  std::span<const char> take(std::uint64_t count) {
    require(count <= rest_.size(), "its type is longer than its message");
    const std::span<const char> taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  template <typename Number>
  Number get() {
    return number_at<Number>(take(sizeof(Number)), 0);
  }

  // A name with its zero; up to version 2 padded to 8 bytes.
  void take_name(unsigned version) {
    const auto end = std::ranges::find(rest_, '\0');
    require(end != rest_.end(), "a name in its type does not end");
    const auto length = static_cast<std::uint64_t>(end - rest_.begin()) + 1;
    take(version >= 3 ? length : (length + 7) / 8 * 8);
  }

  // First bit and number of bits of a number. HDF5 would get memory for one of gigabytes.
  void require_bits(std::uint64_t size) {
    constexpr std::uint64_t kLargest = 64;
    require(size <= kLargest, "a number has more than 64 bytes");
    const std::uint64_t offset = get<std::uint16_t>(), precision = get<std::uint16_t>();
    require(precision > 0 && offset + precision <= 8 * size, "a number has more bits than its type");
  }

  void walk_members(const Type& type, std::uint64_t count, int depth) {
    const unsigned version = version_;
    require(count > 0, "its type has no members");
    for (std::uint64_t i = 0; i < count; ++i) {
      take_name(version);
      std::uint64_t offset = 0;
      if (version == 1) {
        offset = get<std::uint32_t>();
        const auto axes = get<std::uint8_t>();
        take(3 + 4 + 4 + 4 * 4);  // Reserved, permutation, reserved, lengths of the axes.
        require(axes == 0, "a member of its type is an array of an old kind");
      } else if (version == 2) {
        offset = get<std::uint32_t>();
      } else {
        for (std::uint64_t scale = 1; scale <= type.size; scale <<= 8U) {  // In as few bytes as the size needs.
          offset += scale * get<std::uint8_t>();
        }
      }
      const Type member = walk(depth + 1);
      require(offset <= type.size && member.size <= type.size - offset, "a member is larger than its type");
    }
  }

  void walk_enumeration(const Type& type, std::uint64_t count, int depth) {
    const unsigned version = version_;
    const Type base = walk(depth + 1);
    require(base.kind == kInteger && base.size == type.size, "its words are not numbers of their type");
    for (std::uint64_t i = 0; i < count; ++i) {
      take_name(version);
    }
    take(count * base.size);
  }

  void walk_array(const Type& type, int depth) {
    const unsigned version = version_;
    constexpr unsigned kMostAxes = 32;
    const auto axes = get<std::uint8_t>();
    require(axes >= 1 && axes <= kMostAxes && version >= 2, "an array in its type has a broken shape");
    take(version == 2 ? 3 : 0);
    std::uint64_t values = 1;
    for (unsigned axis = 0; axis < axes; ++axis) {
      const std::uint64_t length = get<std::uint32_t>();
      require(length > 0 && values <= type.size / length, "an array is larger than its type");
      values *= length;
    }
    take(version == 2 ? std::uint64_t{4} * axes : 0);  // Permutations.
    require(values * walk(depth + 1).size == type.size, "an array is not as large as its type");
  }

  std::span<const char> rest_;
  unsigned version_ = 0;
};

}  // namespace

std::string datatype_fault(std::span<const char> message) {
  try {
    TypeWalk(message).walk();
    return "";
  } catch (const Error& fault) {
    return fault.what();
  }
}

void check_object(hid_t file, const std::string& name, const std::filesystem::path& path) {
  const std::string shown = printable(name);
  const std::string doing = "read " + shown;
  H5O_info_t info;
  h5_check(H5Oget_info_by_name2(file, name.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT), path, doing);
  const H5Handle own = h5_own(H5Iget_file_id(file), H5Fclose, path, doing);
  Hdf5Bytes bytes(own.get(), path, shown);
  bytes.each_message(info.addr, [&](const Hdf5Message& message) {
    std::span<const char> type;
    if (message.type == Hdf5Message::kDatatype && !message.shared) {
      type = message.content;
    } else if (message.type == Hdf5Message::kAttribute && !message.shared) {
      const Hdf5Attribute attribute = attribute_parts(bytes, message.content);
      type = attribute.shared ? std::span<const char>() : attribute.type;
    }
    if (const std::string fault = type.empty() ? "" : datatype_fault(type); !fault.empty()) {
      bytes.fail(fault);
    }
  });
}

}  // namespace insonify
