// write_png.cpp -- pictures as files that every viewer opens.

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "insonify/error.h"
#include "insonify/files.h"

namespace insonify {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw Error(fmt::format("{}: cannot write the picture: {}", path.string(), reason));
}

}  // namespace

void write_png(const std::filesystem::path& path, const Picture& picture) {
  const std::size_t bytes =
      3 * static_cast<std::size_t>(std::max(0, picture.width)) * static_cast<std::size_t>(std::max(0, picture.height));
  if (bytes == 0 || picture.rgb.size() != bytes) {
    throw Error(fmt::format("{}: a picture of {} x {} pixels must have at least one pixel and 3 bytes for each, not {}",
                            path.string(), picture.width, picture.height, picture.rgb.size()));
  }
  std::error_code unknown;
  if (std::filesystem::exists(path, unknown) && !std::filesystem::is_regular_file(path, unknown)) {
    fail(path, "it is there and is no regular file");
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  // No row filters and light compression: three times as fast, and for speckled pictures smaller than with them.
  image.flags = PNG_IMAGE_FLAG_FAST;
  // Under another name until it is whole: libpng removes what it could not finish.
  std::filesystem::path unfinished = path;
  unfinished += ".new";
  errno = 0;
  if (png_image_write_to_file(&image, unfinished.c_str(), 0, picture.rgb.data(), 0, nullptr) == 0) {
    fail(path, errno != 0 ? std::strerror(errno) : std::data(image.message));
  }
  std::error_code error;
  std::filesystem::rename(unfinished, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    fail(path, error.message());
  }
}

}  // namespace insonify
