// cdr_read.h -- reads back what a RosWriter has written, for tests.

#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace insonify {

class CdrRead {
 public:
  explicit CdrRead(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {
    EXPECT_EQ(bytes_.at(0), std::byte{0});
    EXPECT_EQ(bytes_.at(1), std::byte{1});  // Little-endian.
  }

  template <typename Number>
  Number number() {
    while ((at_ - 4) % sizeof(Number) != 0) {
      ++at_;
    }
    Number value{};
    EXPECT_LE(at_ + sizeof value, bytes_.size());
    std::memcpy(&value, &bytes_.at(at_), sizeof value);
    at_ += sizeof value;
    return value;
  }

  std::string text() {
    const auto length = number<std::uint32_t>();
    std::string text(reinterpret_cast<const char*>(&bytes_.at(at_)), length - 1);
    EXPECT_EQ(bytes_.at(at_ + length - 1), std::byte{0});
    at_ += length;
    return text;
  }

  template <typename Number>
  std::vector<Number> numbers() {
    std::vector<Number> values(number<std::uint32_t>());
    for (Number& value : values) {
      value = number<Number>();
    }
    return values;
  }

  // Seconds, nanoseconds and frame.
  std::tuple<int, unsigned, std::string> header() {
    const auto seconds = number<std::int32_t>();
    const auto nanoseconds = number<std::uint32_t>();
    return {seconds, nanoseconds, text()};
  }

  std::vector<double> doubles(int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) {
      values.push_back(number<double>());
    }
    return values;
  }

  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::vector<std::byte> bytes_;
  std::size_t at_ = 4;
};

}  // namespace insonify
