// hdf5_heap.cpp -- reads references into global heaps, and walks over the objects of those heaps.

#include "io/file/hdf5_heap.h"

#include <cstdint>
#include <cstring>
#include <map>
#include <span>

#include "io/file/hdf5_bytes.h"
#include "io/file/hdf5_type.h"

namespace insonify {
namespace {

constexpr std::uint64_t kHeader = 16;                           // Header of a heap, and of each of its objects [bytes].
constexpr std::uint64_t kLargestHeap = std::uint64_t{1} << 28;  // More would be a broken length [bytes].
constexpr std::uint64_t kReferenceSize = 16;                    // Length 4, address 8, number in the heap 4 [bytes].

// HDF5 would get memory for each of a text's characters of that size.
constexpr const char* kWideCharacters = "its characters do not have 1 byte";

class HeapCheck : public Hdf5Bytes {
 public:
  using Hdf5Bytes::Hdf5Bytes;

  // Fails unless each reference names an object of its own length.
  void check_references(std::span<const char> references) {
    for (std::size_t place = 0; references.size() - place >= kReferenceSize; place += kReferenceSize) {
      const auto length = number_at<std::uint32_t>(references, place);
      const auto address = number_at<std::uint64_t>(references, place + 4);
      const auto index = number_at<std::uint32_t>(references, place + 12);
      if (address == 0) {
        continue;  // No text. HDF5 follows the reference of an empty one.
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
    if (address > end()) {
      fail("it points past the end of the file");
    }
    const std::vector<char> start = read(base() + address, kHeader);
    const auto size = number_at<std::uint64_t>(start, 8);
    if (std::memcmp(start.data(), "GCOL\1", 5) != 0 || size < kHeader || size > kLargestHeap) {
      fail("it points to no heap of texts");
    }
    const std::vector<char> bytes = read(base() + address, size);
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

  std::map<std::uint64_t, std::map<std::uint16_t, std::uint64_t>> heaps_;
};

// Name of the attribute that a message holds, after a check of its type, and of its data if they are texts of variable
// length.
std::string checked_attribute(HeapCheck& check, std::span<const char> message) {
  constexpr std::uint8_t kVariableLength = 9;  // Class of a datatype.
  const Hdf5Attribute attribute = attribute_parts(check, message);
  if (attribute.shared) {
    check.fail("an attribute is of a kind that recordings do not have");
  }
  if (const std::string fault = datatype_fault(attribute.type); !fault.empty()) {
    check.fail(fault);
  }
  if ((number_at<std::uint8_t>(attribute.type, 0) & 0x0f) == kVariableLength) {
    const bool is_text = (number_at<std::uint8_t>(attribute.type, 1) & 0x0f) == 1;
    if (is_text && number_at<std::uint32_t>(attribute.type, 12) != 1) {  // Size of the type that it is a list of.
      check.fail(kWideCharacters);
    }
    check.check_references(attribute.data);
  }
  return attribute.name;
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
  if (count > kLargestHeap / kReferenceSize) {
    check.fail("it has too many texts");
  }
  check.check_references(check.read(offset, count * kReferenceSize));
}

std::vector<std::string> checked_attributes(hid_t object, const std::filesystem::path& path, const std::string& name) {
  const std::string doing = "read the attributes of " + name;
  const H5Handle file = h5_own(H5Iget_file_id(object), H5Fclose, path, doing);
  H5O_info_t info;
  h5_check(H5Oget_info(object, &info), path, doing);
  HeapCheck check(file.get(), path, name);
  std::vector<std::string> names;
  const bool visited = check.each_message(info.addr, [&](const Hdf5Message& message) {
    if (message.type == Hdf5Message::kAttribute) {
      names.push_back(checked_attribute(check, message.content));
    }
  });
  return visited ? names : listed_attributes(object, path, doing);  // A version 2 header, which no recording has.
}

}  // namespace insonify
