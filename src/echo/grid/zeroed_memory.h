// zeroed_memory.h -- for large tables of which little may ever be used.

#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

namespace insonify {

/// An allocator whose memory is zero from the start and is not touched by std::vector(count): pages that nothing is
/// written to cost neither time nor memory. Elements made without a value are all bits zero, so that vectors with it
/// must not shrink and grow again.
template <typename Value>
struct ZeroedMemory {
  using value_type = Value;

  ZeroedMemory() = default;
  template <typename Other>
  explicit ZeroedMemory(const ZeroedMemory<Other>&) {}

  [[nodiscard]] Value* allocate(std::size_t count) {
    void* memory = std::calloc(count, sizeof(Value));
    if (memory == nullptr) {
      throw std::bad_alloc();
    }
    return static_cast<Value*>(memory);
  }
  void deallocate(Value* memory, std::size_t) { std::free(memory); }

  template <typename Other>
  void construct(Other*) noexcept {}
  template <typename Other, typename... Arguments>
  void construct(Other* place, Arguments&&... arguments) {
    std::construct_at(place, std::forward<Arguments>(arguments)...);
  }

  bool operator==(const ZeroedMemory&) const = default;
};

}  // namespace insonify
