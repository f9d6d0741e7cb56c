// zip_archive.cpp -- unpacks entries, whose stated sizes are compared with what their bytes can hold.

#include "io/foreign/zip_archive.h"

#include <fmt/format.h>
#include <minizip/unzip.h>

#include <algorithm>

#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

constexpr std::uint64_t kDeflateMost = 1032;  // Times as many bytes as are stored, zlib's technical details.
constexpr std::size_t kLongestEntryName = 500, kMostEntries = 10'000;
constexpr unsigned kZipPart = 1U << 30U;

}  // namespace

ZipArchive::ZipArchive(const std::filesystem::path& path) : path_(path), zip_(unzOpen64(path.c_str())) {
  if (zip_ == nullptr) {
    throw Error(fmt::format("{}: is not a whole ZIP archive: it has no directory at its end", path_.string()));
  }
  int more = unzGoToFirstFile(zip_);
  for (; more == UNZ_OK && names_.size() <= kMostEntries; more = unzGoToNextFile(zip_)) {
    std::string name(kLongestEntryName, '\0');
    unz_file_info64 about{};
    more = unzGetCurrentFileInfo64(zip_, &about, name.data(), name.size(), nullptr, 0, nullptr, 0);
    if (more != UNZ_OK) {
      break;
    }
    name.resize(std::min<std::size_t>(about.size_filename, name.size()));
    names_.push_back(std::move(name));
  }
  if (more != UNZ_END_OF_LIST_OF_FILE) {
    unzClose(zip_);
    throw Error(fmt::format("{}: {}", path_.string(),
                            names_.size() > kMostEntries ? fmt::format("has more than {} entries", kMostEntries)
                                                         : std::string("its directory of entries is damaged")));
  }
}

ZipArchive::~ZipArchive() {
  unzClose(zip_);
}

void ZipArchive::fail(const std::string& name, const std::string& what) const {
  throw Error(fmt::format("{}: {}: {}", path_.string(), printable(name), what));
}

void ZipArchive::open(const std::string& name) const {
  constexpr int kCase = 1;
  if (unzLocateFile(zip_, name.c_str(), kCase) != UNZ_OK || unzOpenCurrentFile(zip_) != UNZ_OK) {
    fail(name, "cannot be unpacked: it is damaged, encrypted or compressed otherwise than by deflate");
  }
}

std::string ZipArchive::head(const std::string& name, std::size_t most) const {
  open(name);
  std::string bytes(most, '\0');
  const int got = unzReadCurrentFile(zip_, bytes.data(), static_cast<unsigned>(bytes.size()));
  unzCloseCurrentFile(zip_);
  if (got < 0) {
    fail(name, "cannot be unpacked: its bytes are damaged");
  }
  bytes.resize(static_cast<std::size_t>(got));
  return bytes;
}

std::vector<std::byte> ZipArchive::read(const std::string& name, std::uint64_t skip, std::uint64_t count) const {
  open(name);
  unz_file_info64 about{};
  unzGetCurrentFileInfo64(zip_, &about, nullptr, 0, nullptr, 0, nullptr, 0);
  if (about.uncompressed_size != skip + count || about.uncompressed_size > (about.compressed_size + 1) * kDeflateMost) {
    unzCloseCurrentFile(zip_);
    fail(name, fmt::format("has {} bytes, {} packed; must have {}", about.uncompressed_size, about.compressed_size,
                           skip + count));
  }
  std::vector<std::byte> bytes(skip + count);
  std::size_t place = 0;
  int got = 1;
  while (place < bytes.size() && got > 0) {
    got = unzReadCurrentFile(zip_, &bytes[place],
                             static_cast<unsigned>(std::min<std::size_t>(kZipPart, bytes.size() - place)));
    place += static_cast<std::size_t>(std::max(got, 0));
  }
  if (unzCloseCurrentFile(zip_) != UNZ_OK || place < bytes.size()) {
    fail(name, "cannot be unpacked: its bytes are damaged");
  }
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(skip));
  return bytes;
}

}  // namespace insonify
