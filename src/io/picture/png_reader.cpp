// png_reader.cpp -- libpng's simplified interface, which returns failures instead of jumping out of them.

#include "io/picture/png_reader.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <memory>

#include "insonify/error.h"
#include "io/file/budgets.h"
#include "io/file/input_file.h"
#include "io/file/reader_process.h"

namespace insonify {
namespace {

// The last chunk: no data, its kind and its checksum.
constexpr std::string_view kEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);

// Removes the chunks that declare a gamma value or a colour space, because the simplified interface would convert
// levels accordingly. Heights and normals are numbers, not shades. Without these chunks libpng assumes sRGB for 8 bits
// and linear levels for 16 bits, which are also its output formats, so that nothing is converted.
std::string without_colour_space(std::string_view file) {
  constexpr std::size_t kSignature = 8, kAroundData = 12;  // Length, kind and checksum [bytes].
  constexpr std::array<std::string_view, 5> kDropped = {"gAMA", "cHRM", "sRGB", "iCCP", "cICP"};
  std::string kept(file.substr(0, kSignature));
  for (std::size_t at = kSignature; at < file.size() && !kept.ends_with(kEnd);) {
    std::size_t length = kAroundData;
    for (std::size_t i = 0; i < 4 && at + i < file.size(); ++i) {
      length += static_cast<std::size_t>(static_cast<unsigned char>(file[at + i])) << (8 * (3 - i));
    }
    const std::string_view chunk = file.substr(at, length);
    if (std::ranges::count(kDropped, chunk.substr(std::min<std::size_t>(4, chunk.size()), 4)) == 0) {
      kept += chunk;
    }
    at += chunk.size();
  }
  return kept;
}

}  // namespace

PngReader::PngReader(const std::filesystem::path& path) : PngReader(path.string(), read_text(path)) {}

PngReader::PngReader(std::string name, std::span<const char> bytes) : name_(std::move(name)) {
  const std::string_view file(bytes.data(), bytes.size());
  png_ = reads_here() ? decode_png(name_, file)
                      : read_apart<DecodedPng>({name_, "PNG"}, ReaderTask::kPicture, name_, file);
}

int PngReader::grey(std::size_t column, std::size_t row, std::string_view purpose) const {
  const int level = value(column, row, 0);
  const int colors = png_.channels - (png_.has_alpha ? 1 : 0);
  for (int channel = 1; channel < colors; ++channel) {
    if (value(column, row, channel) != level) {
      throw Error(fmt::format("{}: the pixel in column {}, row {} is coloured; {} a grey picture", name_, column, row,
                              purpose));
    }
  }
  if (png_.has_alpha && value(column, row, colors) != full_scale()) {
    throw Error(fmt::format("{}: the pixel in column {}, row {} is transparent; {} an opaque picture", name_, column,
                            row, purpose));
  }
  return level;
}

int PngReader::value(std::size_t column, std::size_t row, int channel) const {
  const std::size_t at =
      (row * png_.width + column) * static_cast<std::size_t>(png_.channels) + static_cast<std::size_t>(channel);
  return png_.is_deep ? png_.pixels[at] : reinterpret_cast<const std::uint8_t*>(png_.pixels.data())[at];
}

DecodedPng decode_png(const std::string& name, std::string_view file) {
  const std::string bytes = without_colour_space(file);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> freed(&image, png_image_free);
  const auto check = [&](int good) {
    if (good == 0 || PNG_IMAGE_FAILED(image)) {
      throw Error(fmt::format("{}: cannot be read: {}", name, foreign_reason(std::data(image.message))));
    }
  };
  check(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
  check_budget(Budget::kPixels, static_cast<double>(image.width) * image.height, name);
  image.format &= ~PNG_FORMAT_FLAG_COLORMAP;
  DecodedPng png;
  png.width = image.width;
  png.height = image.height;
  png.channels = static_cast<int>(PNG_IMAGE_PIXEL_CHANNELS(image.format));
  png.has_alpha = (image.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  png.is_deep = (image.format & PNG_FORMAT_FLAG_LINEAR) != 0;
  png.pixels.resize((PNG_IMAGE_SIZE(image) + 1) / 2);
  check(png_image_finish_read(&image, nullptr, png.pixels.data(), 0, nullptr));
  if (!bytes.ends_with(kEnd)) {  // libpng stops after the last pixel.
    throw Error(name + ": cannot be read: the file ends before its IEND");
  }
  return png;
}

}  // namespace insonify
