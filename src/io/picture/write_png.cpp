// write_png.cpp -- writes pictures as PNG files.

#include <fmt/format.h>
#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "insonify/error.h"
#include "insonify/files.h"
#include "io/file/unfinished_file.h"

namespace insonify {
namespace {

void write(std::FILE* file, const Picture& picture, const UnfinishedFile& unfinished) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  // No row filters and light compression: three times as fast, and for speckled pictures smaller than with them.
  image.flags = PNG_IMAGE_FLAG_FAST;
  errno = 0;
  if (png_image_write_to_stdio(&image, file, 0, picture.rgb.data(), 0, nullptr) == 0) {
    unfinished.fail(errno != 0 ? std::strerror(errno) : std::data(image.message));
  }
  if (std::fflush(file) != 0) {
    unfinished.fail_by_errno();
  }
}

}  // namespace

void write_png(const std::filesystem::path& path, const Picture& picture) {
  const std::size_t bytes =
      3 * static_cast<std::size_t>(std::max(0, picture.width)) * static_cast<std::size_t>(std::max(0, picture.height));
  if (bytes == 0 || picture.rgb.size() != bytes) {
    throw Error(fmt::format("{}: a picture of {} x {} pixels must have at least one pixel and 3 bytes for each, not {}",
                            path.string(), picture.width, picture.height, picture.rgb.size()));
  }
  UnfinishedFile unfinished(path, "cannot write the picture");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(fdopen(unfinished.descriptor(), "wb"), &std::fclose);
  if (file == nullptr) {
    unfinished.fail_by_errno();
  }
  static_cast<void>(unfinished.release());  // The stream closes it.
  write(file.get(), picture, unfinished);
  unfinished.put_in_place();
}

}  // namespace insonify
