// shared_bytes.h -- values in memory that two processes share, written by one and read by the other.

#pragma once

#include <cstdint>
#include <memory>
#include <ranges>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace insonify {

/// Writes values to the beginning of a memory file (memfd_create), or reads them in the same order.
class SharedBytes {
 public:
  /// @param file  Not owned.
  /// @param size  Bytes that may be read.
  explicit SharedBytes(int file, std::uint64_t size = 0) : file_(file), size_(size) {}

  /// Bytes written or read so far.
  [[nodiscard]] std::uint64_t place() const { return place_; }
  [[nodiscard]] std::uint64_t left() const { return size_ - place_; }

  /// @throws std::bad_alloc if the memory cannot grow.
  void put_bytes(const void* from, std::uint64_t count);
  /// @throws BrokenAnswer if there are not so many left: the other process is not to be trusted.
  void get_bytes(void* to, std::uint64_t count);

 private:
  int file_;
  std::uint64_t size_, place_ = 0;
};

struct BrokenAnswer {};

/// @throws BrokenAnswer unless it holds.
inline void require_whole(bool holds) {
  if (!holds) {
    throw BrokenAnswer();
  }
}

namespace shared_bytes {

// Types that are their bytes. Not std::is_trivially_copyable, which Eigen's vectors of fixed size are not.
template <typename Value>
inline constexpr bool kIsPlain =
    std::is_trivially_destructible_v<Value> && !std::is_pointer_v<Value> && !std::ranges::view<Value>;

}  // namespace shared_bytes

/// Writes a number, a vector of fixed size, a text, a list, a pointer that may be null, or a struct for which there is
/// members(value), the tuple of references to all of them.
template <typename Value>
void put(SharedBytes& to, const Value& value) {
  if constexpr (shared_bytes::kIsPlain<Value>) {
    to.put_bytes(&value, sizeof value);
  } else if constexpr (requires { value.size(); }) {
    using Element = std::remove_cvref_t<decltype(*value.data())>;
    put(to, std::uint64_t{value.size()});
    if constexpr (shared_bytes::kIsPlain<Element>) {
      to.put_bytes(value.data(), value.size() * sizeof(Element));
    } else {
      for (const Element& element : value) {
        put(to, element);
      }
    }
  } else if constexpr (requires { value.get(); }) {
    put(to, value != nullptr);
    if (value != nullptr) {
      put(to, *value);
    }
  } else {
    std::apply([&](const auto&... member) { (put(to, member), ...); }, members(value));
  }
}

/// Reads what put() has written.
/// @throws BrokenAnswer where it cannot be that.
template <typename Value>
void get(SharedBytes& from, Value& value) {
  if constexpr (std::is_same_v<Value, bool>) {
    std::uint8_t byte = 0;
    from.get_bytes(&byte, 1);
    value = byte != 0;
  } else if constexpr (shared_bytes::kIsPlain<Value>) {
    from.get_bytes(&value, sizeof value);
  } else if constexpr (requires { value.resize(1); }) {
    using Element = std::remove_cvref_t<decltype(*value.data())>;
    constexpr bool kPlain = shared_bytes::kIsPlain<Element>;
    std::uint64_t count = 0;
    get(from, count);
    require_whole(count <= from.left() / (kPlain ? sizeof(Element) : 1));
    value.resize(count);
    if constexpr (kPlain) {
      from.get_bytes(value.data(), count * sizeof(Element));
    } else {
      for (Element& element : value) {
        get(from, element);
      }
    }
  } else if constexpr (requires { value.get(); }) {
    bool there = false;
    get(from, there);
    if (there) {
      const auto made = std::make_shared<std::remove_cvref_t<decltype(*value)>>();
      get(from, *made);
      value = made;
    }
  } else {
    std::apply([&](auto&... member) { (get(from, member), ...); }, members(value));
  }
}

}  // namespace insonify
