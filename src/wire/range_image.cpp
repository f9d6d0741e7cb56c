// range_image.cpp -- writes the fields of a range image, their envelope, and the packet around it.

#include "insonify/wire/range_image.h"

#include <cassert>
#include <string_view>

#include "wire/little_endian.h"

namespace insonify {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Fields of Protocol Buffers: a varint has seven bits in each byte, the lowest first.
void put_varint(Bytes& bytes, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) {
    bytes.push_back(static_cast<std::uint8_t>(value | 0x80));
  }
  bytes.push_back(static_cast<std::uint8_t>(value));
}

void put_number(Bytes& bytes, unsigned field, std::uint64_t value) {
  put_varint(bytes, field << 3);
  put_varint(bytes, value);
}

void put_float(Bytes& bytes, unsigned field, float value) {
  put_varint(bytes, field << 3 | 5);
  put(bytes, value);
}

void put_part(Bytes& bytes, unsigned field, const auto& part) {
  put_varint(bytes, field << 3 | 2);
  put_varint(bytes, part.size());
  bytes.insert(bytes.end(), part.begin(), part.end());
}

Bytes header_of(const RangeImage& image) {
  constexpr std::uint64_t kNanoseconds = 1'000'000'000;
  Bytes time, header;
  put_number(time, 1, image.time_ns / kNanoseconds);
  put_number(time, 2, image.time_ns % kNanoseconds);
  put_part(header, 1, time);
  put_number(header, 2, image.sequence);
  return header;
}

Bytes message_of(const RangeImage& image) {
  Bytes pixels, message;
  for (const std::uint16_t pixel : image.pixels) {
    put_varint(pixels, pixel);
  }
  put_part(message, 1, header_of(image));
  put_float(message, 2, image.sound_speed);
  put_float(message, 3, image.range);
  put_number(message, 4, image.frequency);
  put_number(message, 5, image.width);
  put_number(message, 6, image.height);
  put_float(message, 7, image.horizontal_fov_deg);
  put_float(message, 8, image.vertical_fov_deg);
  put_float(message, 9, image.pixel_scale);
  put_part(message, 10, pixels);
  return message;
}

// A Snappy block (github.com/google/snappy, format_description.txt) of one literal, without compression.
Bytes snappy_block(const Bytes& contents) {
  constexpr std::uint8_t kLiteralOfTwoByteLength = 61 << 2;
  assert(!contents.empty() && contents.size() <= 65536);
  Bytes block;
  put_varint(block, contents.size());
  put(block, kLiteralOfTwoByteLength, static_cast<std::uint16_t>(contents.size() - 1));
  block.insert(block.end(), contents.begin(), contents.end());
  return block;
}

// CRC-32 of ISO 3309, as zlib has it.
std::uint32_t crc32_of(const Bytes& bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc >> 1) ^ (0xedb88320U & (0U - (crc & 1U)));
    }
  }
  return ~crc;
}

}  // namespace

Bytes encode_rip2(const RangeImage& image) {
  constexpr std::string_view kType = "type.googleapis.com/waterlinked.sonar.protocol.RangeImage";
  constexpr std::size_t kAround = 12;  // Identifier, length and CRC.
  Bytes any, contents;
  put_part(any, 1, kType);
  put_part(any, 2, message_of(image));
  put_part(contents, 1, any);
  const Bytes block = snappy_block(contents);
  Bytes packet = {'R', 'I', 'P', '2'};
  put(packet, static_cast<std::uint32_t>(block.size() + kAround));
  packet.insert(packet.end(), block.begin(), block.end());
  put(packet, crc32_of(packet));
  return packet;
}

}  // namespace insonify
