// growing_file.cpp -- writes the file that HDF5 has made in memory, and makes its datasets grow by plain writes.

#include "io/recording/growing_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "io/file/unfinished_file.h"
#include "io/recording/growing_image.h"

namespace insonify {
namespace {

// In a superblock of version 0, the end of the file: what lies before it is in use.
constexpr std::size_t kEndOfFileField = 40;

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

}  // namespace

GrowingFile::GrowingFile(std::filesystem::path path, const std::vector<GrowingDataset>& datasets,
                         const std::function<void(hid_t file)>& describe, const GrowingFileOptions& options)
    : path_(std::move(path)) {
  assert(!datasets.empty());
  refuse_while_another_writes(path_);
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path_, ignored)) {
    if (!options.replace) {
      fail(path_, "cannot create: it exists already");
    }
    earlier_ = std::make_unique<WriteMark>(path_);
  }
  for (const GrowingDataset& dataset : datasets) {
    growths_.emplace_back(dataset);
  }
  if (std::ranges::any_of(datasets, &GrowingDataset::is_filtered)) {
    workers_ = std::make_unique<Workers>(options.threads);
  }
  const GrowingImage image = make_growing_image(path_, datasets, describe);
  find_fields(image.bytes, image.addresses);
  state_address_ = image.state_address;
  end_ = image.bytes.size();

  out_ = std::make_unique<UnfinishedFile>(path_, "cannot create");
  mark_as_being_written(out_->descriptor());
  if (!write_at(out_->descriptor(), 0, image.bytes) || !reserve(end_)) {
    out_->fail_by_errno();
  }
  if (!earlier_) {
    refuse_while_another_writes(path_);
    out_->put_in_place();
    out_->sync_folder();
  }
  absolute_ = std::filesystem::absolute(place());
}

GrowingFile::Growth::Growth(const GrowingDataset& dataset)
    : row_bytes(dataset.row_bytes()),
      chunk_rows(dataset.chunk_rows()),
      index(dataset.chunk_shape(), H5Tget_size(dataset.type)),
      next_index(index) {
  if (dataset.is_filtered()) {
    filter.emplace(H5Tget_size(dataset.type));
  }
  if (chunk_rows > 1) {
    rows.reserve(chunk_rows * row_bytes + kChecksumBytes);
  }
}

GrowingFile::~GrowingFile() {
  if (out_) {
    (void)finish();
    if (count_ > 0) {
      out_->keep();
    }
  }
}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept = default;

// Finds the fields with the length and the index of each dataset, and checks their values and that they lie in one
// page.
void GrowingFile::find_fields(std::span<const std::byte> image, std::span<const std::uint64_t> headers) {
  std::uint64_t first = ~std::uint64_t{0};
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < growths_.size(); ++i) {
    const GrowthFields& fields = growths_[i].fields = find_growth_fields(image, headers[i]);
    for (const std::uint64_t field : {fields.dimension, fields.maximum, fields.index}) {
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
  for (const Growth& growth : growths_) {
    as_expected = as_expected && value_at(growth.fields.dimension) == 0 &&
                  value_at(growth.fields.maximum) == H5S_UNLIMITED && value_at(growth.fields.index) == HADDR_UNDEF;
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

// Makes every dataset `count` rows long, in memory.
void GrowingFile::set_fields(std::uint64_t count) {
  const auto set = [this](std::uint64_t position, std::uint64_t value) {
    std::memcpy(&fields_bytes_[position - fields_begin_], &value, sizeof value);
  };
  for (const Growth& growth : growths_) {
    set(growth.fields.dimension, count);
    set(growth.fields.index, growth.next_index.root());
  }
}

bool GrowingFile::write_pieces() const {
  return std::ranges::all_of(pieces_.all(), [this](const FilePiece& piece) {
    return write_at(out_->descriptor(), piece.address, piece.bytes);
  });
}

// Sets the end of the file, for the system and for HDF5: the file is never shorter than HDF5's end field says.
bool GrowingFile::set_end(std::uint64_t end) {
  const auto truncate_file = [&] { return ftruncate(out_->descriptor(), static_cast<off_t>(end)) == 0; };
  const auto write_end_field = [&] {
    return write_at(out_->descriptor(), kEndOfFileField, std::as_bytes(std::span(&end, 1)));
  };
  if (!(end > reserved_ ? truncate_file() && write_end_field() : write_end_field() && truncate_file())) {
    return false;
  }
  reserved_ = end;
  return true;
}

void GrowingFile::check_is_there() const {
  if (!is_still_there(out_->descriptor(), absolute_)) {
    fail(path_, "no longer exists: it was removed, moved or replaced while it was being written");
  }
}

void GrowingFile::append(std::span<const std::span<const std::byte>> rows) {
  assert(rows.size() == growths_.size());
  if (!out_) {
    fail(path_, "cannot write: it is closed");
  }
  check_is_there();
  std::uint64_t end = end_;
  bool written = write_row(rows, end);
  if (written) {
    // One write makes the row a part of every dataset.
    set_fields(count_ + 1);
    written = write_at(out_->descriptor(), fields_begin_, fields_bytes_);
  }
  if (!written) {
    const std::string reason = system_reason();
    (void)set_end(end_);  // Nothing of this row is kept.
    state_ = GrowingState::kCutShort;
    fail(path_, fmt::format("cannot write ping {}: {}{}", count_, reason,
                            count_ > 0 ? "; those before it stay readable" : ""));
  }
  for (Growth& growth : growths_) {
    growth.chunk = growth.next_chunk;
    std::swap(growth.index, growth.next_index);
  }
  end_ = end;
  ++count_;
  state_ = GrowingState::kWhole;  // The disk may have room again.
}

// Completes the last chunks and the indices, trims the file, writes its state and flushes it to disk.
// @return  Whether it succeeded; else errno is the reason.
bool GrowingFile::finish() {
  seal_last_chunks();
  pieces_.clear();
  for (const Growth& growth : growths_) {
    growth.index.close(pieces_);
  }
  return write_pieces() && set_end(end_) &&
         write_at(out_->descriptor(), state_address_, std::as_bytes(std::span(&state_, 1))) &&
         fsync(out_->descriptor()) == 0;
}

void GrowingFile::close() {
  if (!out_) {
    return;
  }
  check_is_there();
  if (!finish()) {
    fail(path_, "cannot write: " + system_reason());
  }
  if (is_beside()) {
    out_->put_in_place();
  }
  out_->sync_folder();
  out_.reset();
  earlier_.reset();
}

}  // namespace insonify
