// zeroed_memory.h -- allocator of zeroed memory for large tables that are mostly unused.

#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

namespace insonify {

/// Allocates memory that the system has zeroed, and default-constructs elements without touching it: std::vector(count)
/// costs neither time nor physical memory for pages that are never written. Elements made without a value therefore
/// rely on the memory being zero, so a vector with this allocator must not shrink and grow again.
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
