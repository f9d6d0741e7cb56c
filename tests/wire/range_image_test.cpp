// range_image_test.cpp -- a small range image, byte by byte.

#include "insonify/wire/range_image.h"

#include <gmock/gmock.h>

#include <string>

namespace insonify::range_image_test {
namespace {

TEST(RangeImageTest, IsAPacketOfProtocolBuffersInASnappyBlock) {
  const RangeImage image{.time_ns = 5'000'000'300,
                         .sequence = 129,
                         .sound_speed = 1500,
                         .range = 16,
                         .frequency = 1'200'000,
                         .width = 2,
                         .height = 1,
                         .horizontal_fov_deg = 90,
                         .vertical_fov_deg = 40,
                         .pixel_scale = 0.5F,
                         .pixels = {0, 300}};
  const std::vector<std::uint8_t> packet = encode_rip2(image);
  const std::string bytes(packet.begin(), packet.end());
  // Header: seconds 5 and nanoseconds 300 = 0x2c + 2 x 128, then the number 129 = 1 + 128.
  const std::string header("\x0a\x05\x08\x05\x10\xac\x02\x10\x81\x01", 10);
  // Floats, least significant byte first: 1500 = 0x44bb8000, 16 = 0x41800000; 1200000 = 0x00 + 0x1f x 128 + 0x49 x
  // 2^14.
  const std::string message = std::string("\x0a\x0a", 2) + header +
                              std::string("\x15\0\x80\xbb\x44\x1d\0\0\x80\x41", 10) +
                              std::string("\x20\x80\x9f\x49\x28\x02\x30\x01", 8) +
                              std::string("\x3d\0\0\xb4\x42\x45\0\0\x20\x42\x4d\0\0\0\x3f", 15) +  // 90, 40 and 0.5.
                              std::string("\x52\x03\0\xac\x02", 5);
  const std::string type = "type.googleapis.com/waterlinked.sonar.protocol.RangeImage";
  const std::string any = std::string("\x0a\x39", 2) + type + '\x12' + static_cast<char>(message.size()) + message;
  const std::string contents = '\x0a' + std::string(1, static_cast<char>(any.size())) + any;
  ASSERT_EQ(type.size(), 0x39U);
  ASSERT_LT(contents.size(), 128U);
  const std::string block = static_cast<char>(contents.size()) + std::string(1, '\xf4') +
                            static_cast<char>(contents.size() - 1) + std::string(1, '\0') + contents;
  EXPECT_EQ(bytes.substr(0, 8), std::string("RIP2") + static_cast<char>(block.size() + 12) + std::string(3, '\0'));
  EXPECT_EQ(bytes.substr(8, bytes.size() - 12), block);
}

}  // namespace
}  // namespace insonify::range_image_test
