// growing_file.cpp -- writes out what HDF5 has made in memory and adds rows, both by plain writes.

#include "io/recording/growing_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "io/file/unfinished_file.h"
#include "io/recording/file_lock.h"
#include "io/recording/growing_image.h"

namespace insonify {
namespace {

static_assert(std::endian::native == std::endian::little, "rows are written as they lie in memory");

// In a superblock of version 0, the end of the file: what lies before it is in use.
constexpr std::size_t kEndOfFileField = 40;

// Rows begin at multiples of this, so that a program that maps the file may read them in place.
constexpr std::uint64_t kAlignment = 64;

std::string system_reason() {
  return std::generic_category().message(errno);
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw Error(fmt::format("{}: {}", path.string(), what));
}

void refuse_while_another_writes(const std::filesystem::path& path) {
  if (is_being_written(path)) {
    fail(path, "cannot create: another run is writing it; choose another folder");
  }
}

// Bytes of all rows of all datasets.
std::uint64_t total_bytes(const std::filesystem::path& path, std::span<const GrowingDataset> datasets,
                          std::uint64_t capacity) {
  // Half of what an off_t holds: room for HDF5's own.
  constexpr std::uint64_t kMost = std::uint64_t{1} << 62;
  std::uint64_t row = 0;
  for (const GrowingDataset& dataset : datasets) {
    row += dataset.row_bytes();
  }
  if (capacity > kMost / row) {
    fail(path, fmt::format("cannot hold {} pings of {} bytes, at most {}", capacity, row, kMost / row));
  }
  return capacity * row;
}

}  // namespace

std::uint64_t GrowingDataset::row_bytes() const {
  std::uint64_t bytes = H5Tget_size(type);
  for (const hsize_t length : row) {
    bytes *= length;
  }
  return bytes;
}

GrowingFile::GrowingFile(std::filesystem::path path, std::vector<GrowingDataset> datasets, std::uint64_t capacity,
                         const std::function<void(hid_t file)>& describe)
    : path_(std::move(path)),
      place_(std::filesystem::absolute(path_)),
      datasets_(std::move(datasets)),
      capacity_(capacity) {
  assert(capacity >= 1 && !datasets_.empty());
  const std::uint64_t bytes = total_bytes(path_, datasets_, capacity_);
  refuse_while_another_writes(path_);
  auto [image, addresses] = make_growing_image(path_, datasets_, capacity_, describe);
  addresses_ = std::move(addresses);
  find_fields(image);
  const std::uint64_t end = place_rows(image);

  UnfinishedFile unfinished(path_, "cannot create");
  file_ = unfinished.descriptor();
  mark_as_being_written(file_);
  if (ftruncate(file_, static_cast<off_t>(end)) != 0) {
    fail(path_, fmt::format("cannot make room for {} bytes: {}", bytes, system_reason()));
  }
  set_count(0);
  std::ranges::copy(fields_bytes_, image.begin() + static_cast<std::ptrdiff_t>(fields_begin_));
  if (!write_at(0, image)) {
    unfinished.fail_by_errno();
  }
  refuse_while_another_writes(path_);
  unfinished.put_in_place();
  file_ = unfinished.release();
}

GrowingFile::~GrowingFile() {
  if (file_ >= 0) {
    fsync(file_);
    ::close(file_);
  }
}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : path_(std::move(other.path_)),
      place_(std::move(other.place_)),
      datasets_(std::move(other.datasets_)),
      capacity_(other.capacity_),
      count_(other.count_),
      file_(std::exchange(other.file_, -1)),
      addresses_(std::move(other.addresses_)),
      data_(std::move(other.data_)),
      fields_(std::move(other.fields_)),
      fields_begin_(other.fields_begin_),
      fields_bytes_(std::move(other.fields_bytes_)) {}

// Finds what tells the length and place of each dataset, and makes sure that it is what we take it for and lies in one
// page.
void GrowingFile::find_fields(std::span<const std::byte> image) {
  std::uint64_t first = ~std::uint64_t{0};
  std::uint64_t last = 0;
  for (const std::uint64_t address : addresses_) {
    const GrowthFields& fields = fields_.emplace_back(find_growth_fields(image, address));
    for (const std::uint64_t field : {fields.dimension, fields.maximum, fields.address, fields.size}) {
      first = std::min(first, field);
      last = std::max(last, field + sizeof(std::uint64_t) - 1);
    }
  }
  const auto value_at = [image](std::uint64_t position) {
    std::uint64_t value = 0;
    std::memcpy(&value, &image[position], sizeof value);
    return value;
  };
  bool as_expected = first != 0 && first / kGrowingPage == last / kGrowingPage && last < image.size() &&
                     value_at(kEndOfFileField) == image.size();
  for (std::size_t i = 0; as_expected && i < datasets_.size(); ++i) {
    as_expected = value_at(fields_[i].dimension) == capacity_ && value_at(fields_[i].maximum) == capacity_ &&
                  value_at(fields_[i].address) == HADDR_UNDEF &&
                  value_at(fields_[i].size) == capacity_ * datasets_[i].row_bytes();
  }
  if (!as_expected) {
    unsigned major = 0;
    unsigned minor = 0;
    unsigned release = 0;
    H5get_libversion(&major, &minor, &release);
    fail(path_,
         fmt::format("cannot create: HDF5 {}.{}.{} arranges its files in an unknown way", major, minor, release));
  }
  fields_begin_ = first;
  fields_bytes_.assign(image.begin() + static_cast<std::ptrdiff_t>(first),
                       image.begin() + static_cast<std::ptrdiff_t>(last + 1));
}

// Puts the rows behind what HDF5 made, dataset after dataset, and tells HDF5 where the file ends.
// @return  Where that is [bytes].
std::uint64_t GrowingFile::place_rows(std::span<std::byte> image) {
  std::uint64_t end = image.size();
  for (const GrowingDataset& dataset : datasets_) {
    data_.push_back((end + kAlignment - 1) / kAlignment * kAlignment);
    end = data_.back() + capacity_ * dataset.row_bytes();
  }
  std::memcpy(&image[kEndOfFileField], &end, sizeof end);
  return end;
}

// Makes every dataset `count` rows long, in memory.
void GrowingFile::set_count(std::uint64_t count) {
  const auto set = [this](std::uint64_t position, std::uint64_t value) {
    std::memcpy(&fields_bytes_[position - fields_begin_], &value, sizeof value);
  };
  for (std::size_t i = 0; i < datasets_.size(); ++i) {
    set(fields_[i].dimension, count);
    set(fields_[i].maximum, count);
    // HDF5 2.0 takes an empty dataset that has an address for a damaged one.
    set(fields_[i].address, count > 0 ? data_[i] : HADDR_UNDEF);
    set(fields_[i].size, count * datasets_[i].row_bytes());
  }
}

// @return  Whether all went well; else errno tells why not.
bool GrowingFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno != EINTR) {
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(std::max(written, ssize_t{0})));
    offset += static_cast<std::uint64_t>(std::max(written, ssize_t{0}));
  }
  return true;
}

void GrowingFile::check_is_there() const {
  if (!is_still_there(file_, place_)) {
    fail(path_, "is no longer there: it was removed, moved or replaced while it was being written");
  }
}

void GrowingFile::append(std::span<const std::span<const std::byte>> rows) {
  assert(rows.size() == datasets_.size());
  if (file_ < 0) {
    fail(path_, "cannot write: it is closed");
  }
  if (count_ == capacity_) {
    fail(path_, fmt::format("cannot write ping {}: the file was made for {}", count_, capacity_));
  }
  check_is_there();
  bool written = true;
  for (std::size_t i = 0; written && i < rows.size(); ++i) {
    assert(rows[i].size() == datasets_[i].row_bytes());
    written = write_at(data_[i] + count_ * rows[i].size(), rows[i]);
  }
  // One write makes the row a part of every dataset.
  set_count(count_ + 1);
  if (!written || !write_at(fields_begin_, fields_bytes_)) {
    fail(path_, fmt::format("cannot write ping {}: {}; those before it stay readable", count_, system_reason()));
  }
  ++count_;
}

void GrowingFile::close() {
  if (file_ < 0) {
    return;
  }
  check_is_there();
  const int file = std::exchange(file_, -1);
  const bool stored = fsync(file) == 0;
  const std::string reason = stored ? "" : system_reason();
  ::close(file);
  if (!stored) {
    fail(path_, "cannot write: " + reason);
  }
}

}  // namespace insonify
