// write_png.cpp -- writes pictures as PNG files.

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "insonify/error.h"
#include "insonify/files.h"
#include "io/file/unfinished_file.h"

namespace insonify {
namespace {

struct Pixels {
  int width, height;
  png_uint_32 format;
  const void* data;
};

void write(std::FILE* file, const Pixels& pixels, const UnfinishedFile& unfinished) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(pixels.width);
  image.height = static_cast<png_uint_32>(pixels.height);
  image.format = pixels.format;
  // No row filters and light compression: three times as fast, and for speckled pictures smaller than with them.
  image.flags = PNG_IMAGE_FLAG_FAST;
  errno = 0;
  if (png_image_write_to_stdio(&image, file, 0, pixels.data, 0, nullptr) == 0) {
    unfinished.fail(errno != 0 ? std::strerror(errno) : std::data(image.message));
  }
  if (std::fflush(file) != 0) {
    unfinished.fail_by_errno();
  }
}

void write_file(const std::filesystem::path& path, const Pixels& pixels) {
  UnfinishedFile unfinished(path, "cannot write the picture");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(fdopen(unfinished.descriptor(), "wb"), &std::fclose);
  if (file == nullptr) {
    unfinished.fail_by_errno();
  }
  static_cast<void>(unfinished.release());  // The stream closes it.
  write(file.get(), pixels, unfinished);
  unfinished.put_in_place();
}

}  // namespace

void write_png(const std::filesystem::path& path, const NumberPicture& picture, int bits) {
  const std::size_t pixels =
      static_cast<std::size_t>(std::max(0, picture.width)) * static_cast<std::size_t>(std::max(0, picture.height));
  if (pixels == 0 || picture.numbers.size() != pixels) {
    throw Error(fmt::format("{}: a picture of {} x {} pixels must have at least one, and a number for each, not {}",
                            path.string(), picture.width, picture.height, picture.numbers.size()));
  }
  const int greatest = *std::ranges::max_element(picture.numbers);
  if ((bits != 8 && bits != 16) || greatest >> bits != 0) {
    throw Error(fmt::format("{}: numbers up to {} must have 8 or 16 bits and fit into them, not {}", path.string(),
                            greatest, bits));
  }
  const std::vector<std::uint8_t> bytes(picture.numbers.begin(), picture.numbers.end());
  const bool wide = bits == 16;
  write_file(path, {picture.width, picture.height, wide ? PNG_FORMAT_LINEAR_Y : PNG_FORMAT_GRAY,
                    wide ? static_cast<const void*>(picture.numbers.data()) : bytes.data()});
}

void write_png(const std::filesystem::path& path, const Picture& picture) {
  const std::size_t bytes =
      3 * static_cast<std::size_t>(std::max(0, picture.width)) * static_cast<std::size_t>(std::max(0, picture.height));
  if (bytes == 0 || picture.rgb.size() != bytes) {
    throw Error(fmt::format("{}: a picture of {} x {} pixels must have at least one pixel and 3 bytes for each, not {}",
                            path.string(), picture.width, picture.height, picture.rgb.size()));
  }
  write_file(path, {picture.width, picture.height, PNG_FORMAT_RGB, picture.rgb.data()});
}

}  // namespace insonify
