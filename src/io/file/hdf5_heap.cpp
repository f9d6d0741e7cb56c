// hdf5_heap.cpp -- reads references into global heaps, and walks over the objects of those heaps.

#include "io/file/hdf5_heap.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <span>
#include <vector>

namespace insonify {
namespace {

constexpr std::uint64_t kHeader = 16;                           // Of a heap, and of each of its objects [bytes].
constexpr std::uint64_t kLargestHeap = std::uint64_t{1} << 28;  // More would be a broken length [bytes].
constexpr std::uint64_t kReference = 16;                        // Length 4, address 8, number in the heap 4 [bytes].

// HDF5 would get memory for each of a text's characters of that size.
constexpr const char* kWideCharacters = "its characters do not have 1 byte";

template <typename Number>
Number number_at(std::span<const char> bytes, std::uint64_t place) {
  Number value{};
  if (place <= bytes.size() && sizeof value <= bytes.size() - place) {
    std::memcpy(&value, bytes.data() + place, sizeof value);
  }
  return value;
}

class HeapCheck {
 public:
  HeapCheck(hid_t file, const std::filesystem::path& path, const std::string& name)
      : path_(path), name_(name), file_(path, std::ios::binary), end_(std::filesystem::file_size(path)) {
    const std::string doing = "read " + name;
    const H5Handle made = h5_own(H5Fget_create_plist(file), H5Pclose, path, doing);
    std::size_t address_bytes = 0, length_bytes = 0;
    hsize_t base = 0;
    h5_check(H5Pget_sizes(made.get(), &address_bytes, &length_bytes), path, doing);
    h5_check(H5Pget_userblock(made.get(), &base), path, doing);
    base_ = base;
    if (address_bytes != 8 || length_bytes != 8) {
      fail("its addresses do not have 8 bytes");
    }
  }

  // Where the addresses in the file count from [bytes].
  [[nodiscard]] std::uint64_t base() const { return base_; }

  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(fmt::format("{}: {} is damaged: {}", path_.string(), name_, reason));
  }

  std::vector<char> read(std::uint64_t place, std::uint64_t count) {
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

  // Fails unless each reference names an object of its own length.
  void check_references(std::span<const char> references) {
    for (std::size_t place = 0; references.size() - place >= kReference; place += kReference) {
      const auto length = number_at<std::uint32_t>(references, place);
      const auto address = number_at<std::uint64_t>(references, place + 4);
      const auto index = number_at<std::uint32_t>(references, place + 12);
      if (address == 0 || length == 0) {
        continue;  // No text; HDF5 does not follow it.
      }
      const auto& objects = heap(address);
      const auto object = index <= UINT16_MAX ? objects.find(static_cast<std::uint16_t>(index)) : objects.end();
      if (object == objects.end() || object->second != length) {
        fail("its text is not in the heap of texts");
      }
    }
  }

 private:
  // Sizes of the objects of one heap by their numbers.
  const std::map<std::uint16_t, std::uint64_t>& heap(std::uint64_t address) {
    const auto found = heaps_.find(address);
    return found != heaps_.end() ? found->second : heaps_.emplace(address, walk(address)).first->second;
  }

  std::map<std::uint16_t, std::uint64_t> walk(std::uint64_t address) {
    if (address > end_) {
      fail("it points past the end of the file");
    }
    const std::vector<char> start = read(base_ + address, kHeader);
    const auto size = number_at<std::uint64_t>(start, 8);
    if (std::memcmp(start.data(), "GCOL\1", 5) != 0 || size < kHeader || size > kLargestHeap) {
      fail("there is no heap of texts where it points");
    }
    const std::vector<char> bytes = read(base_ + address, size);
    std::map<std::uint16_t, std::uint64_t> objects;
    for (std::uint64_t place = kHeader; size - place >= kHeader;) {
      const auto index = number_at<std::uint16_t>(bytes, place);
      const auto length = number_at<std::uint64_t>(bytes, place + 8);
      const std::uint64_t left = size - place;
      if (length > left) {
        fail("its heap of texts has an object larger than itself");
      }
      const std::uint64_t taken = index == 0 ? length : kHeader + (length + 7) / 8 * 8;  // Free space counts itself.
      if (taken < kHeader || taken > left || (index != 0 && !objects.emplace(index, length).second)) {
        fail("its heap of texts has a broken object");
      }
      place += taken;
    }
    return objects;
  }

  const std::filesystem::path& path_;
  const std::string& name_;
  std::uint64_t base_ = 0;
  std::ifstream file_;
  std::uint64_t end_;
  std::map<std::uint64_t, std::map<std::uint16_t, std::uint64_t>> heaps_;
};

// Name of the attribute that a message holds (HDF5 File Format Specification 3.0, IV.A.2.m), after a check of its data
// if they are texts of variable length. Parts are name, datatype, dataspace, data; version 1 pads the first three to 8
// bytes.
std::string checked_attribute(HeapCheck& check, std::span<const char> message) {
  constexpr std::uint8_t kVariableLength = 9;  // Class of a datatype.
  const auto version = number_at<std::uint8_t>(message, 0);
  const std::uint64_t padding = version == 1 ? 8 : 1;
  const auto padded = [&](std::uint64_t size) { return (size + padding - 1) / padding * padding; };
  if (version < 1 || version > 3 || (version > 1 && number_at<std::uint8_t>(message, 1) != 0)) {
    check.fail("an attribute is of a kind that recordings do not have");
  }
  const std::uint64_t type = (version == 3 ? 9 : 8) + padded(number_at<std::uint16_t>(message, 2));
  const std::uint64_t data =
      type + padded(number_at<std::uint16_t>(message, 4)) + padded(number_at<std::uint16_t>(message, 6));
  if (data > message.size()) {
    check.fail("an attribute is larger than its message");
  }
  if ((number_at<std::uint8_t>(message, type) & 0x0f) == kVariableLength) {
    const bool is_text = (number_at<std::uint8_t>(message, type + 1) & 0x0f) == 1;
    if (is_text && number_at<std::uint32_t>(message, type + 12) != 1) {  // Of the type that it is a list of.
      check.fail(kWideCharacters);
    }
    check.check_references(message.subspan(data));
  }
  const std::size_t first = version == 3 ? 9 : 8;
  const std::string name(message.begin() + static_cast<std::ptrdiff_t>(first),
                         message.begin() + static_cast<std::ptrdiff_t>(first + number_at<std::uint16_t>(message, 2)));
  return name.substr(0, name.find('\0'));
}

std::vector<std::string> listed_attributes(hid_t object, const std::filesystem::path& path, const std::string& doing) {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->emplace_back(name);
    return 0;
  };
  h5_check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names), path, doing);
  return names;
}

}  // namespace

void check_heap_texts(hid_t file, hid_t dataset, const std::filesystem::path& path, const std::string& name) {
  const haddr_t offset = H5Dget_offset(dataset);
  if (offset == HADDR_UNDEF) {
    return;  // Nothing has been written to it, or it is not contiguous.
  }
  const std::string doing = "read " + name;
  HeapCheck check(file, path, name);
  const H5Handle type = h5_own(H5Dget_type(dataset), H5Tclose, path, doing);
  const H5Handle character = h5_own(H5Tget_super(type.get()), H5Tclose, path, doing);
  if (H5Tget_size(character.get()) != 1) {
    check.fail(kWideCharacters);
  }
  const H5Handle space = h5_own(H5Dget_space(dataset), H5Sclose, path, doing);
  const auto count = static_cast<std::uint64_t>(h5_check(H5Sget_simple_extent_npoints(space.get()), path, doing));
  if (count > kLargestHeap / kReference) {
    check.fail("it has too many texts");
  }
  check.check_references(check.read(offset, count * kReference));
}

std::vector<std::string> checked_attributes(hid_t object, const std::filesystem::path& path, const std::string& name) {
  constexpr std::uint64_t kPrefix = 16;        // Version, message count, reference count, size, padding.
  constexpr std::uint64_t kMessagePrefix = 8;  // Type, size, flags, reserved.
  constexpr std::uint16_t kAttribute = 0x000c, kContinuation = 0x0010;
  constexpr std::size_t kMostBlocks = 1024;
  const std::string doing = "read the attributes of " + name;
  const H5Handle file = h5_own(H5Iget_file_id(object), H5Fclose, path, doing);
  H5O_info_t info;
  h5_check(H5Oget_info(object, &info), path, doing);
  HeapCheck check(file.get(), path, name);
  const std::vector<char> prefix = check.read(check.base() + info.addr, kPrefix);
  if (number_at<std::uint8_t>(prefix, 0) != 1) {
    return listed_attributes(object, path, doing);  // A version 2 header, which no recording has.
  }
  std::vector<std::string> names;
  struct Block {
    std::uint64_t place, size;
  };
  std::vector<Block> blocks = {{check.base() + info.addr + kPrefix, number_at<std::uint32_t>(prefix, 8)}};
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const std::vector<char> block = check.read(blocks[i].place, blocks[i].size);
    for (std::uint64_t at = 0; block.size() - at >= kMessagePrefix;) {
      const auto type = number_at<std::uint16_t>(block, at);
      const auto size = number_at<std::uint16_t>(block, at + 2);
      at += kMessagePrefix;
      if (size > block.size() - at) {
        check.fail("a message of its header is larger than the header");
      }
      const std::span<const char> message = std::span(block).subspan(at, size);
      if (type == kAttribute) {
        names.push_back(checked_attribute(check, message));
      } else if (type == kContinuation) {
        if (blocks.size() == kMostBlocks) {
          check.fail("its header does not end");
        }
        blocks.push_back({check.base() + number_at<std::uint64_t>(message, 0), number_at<std::uint64_t>(message, 8)});
      }
      at += size;
    }
  }
  return names;
}

}  // namespace insonify
