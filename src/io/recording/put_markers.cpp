// put_markers.cpp -- adds an operator's markers to a recording that is closed.

#include "io/recording/put_markers.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <numeric>
#include <system_error>

#include "io/recording/hdf5_writer.h"

namespace insonify {
namespace {

// Reserves room behind the file's end: HDF5 would leave a file that cannot be opened where the disk is full.
void reserve_room(const std::filesystem::path& path, const std::vector<std::string>& texts) {
  constexpr std::size_t kAround = 65536;  // Heap, object header and nodes of indices.
  const std::size_t bytes = std::accumulate(texts.begin(), texts.end(), kAround, [](std::size_t sum, const auto& text) {
    return sum + 2 * text.size() + 64;
  });
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  const auto end = static_cast<off_t>(std::filesystem::file_size(path));
  const bool reserved = file >= 0 && fallocate(file, FALLOC_FL_KEEP_SIZE, end, static_cast<off_t>(bytes)) == 0;
  const int reason = errno;
  if (file >= 0) {
    close(file);
  }
  if (!reserved && reason != EOPNOTSUPP) {
    throw Error(
        fmt::format("{}: cannot write the markers: {}", path.string(), std::generic_category().message(reason)));
  }
}

}  // namespace

void put_markers(const std::filesystem::path& path, const std::vector<Marker>& markers) {
  const std::vector<std::string> texts = marker_texts(markers);
  reserve_room(path, texts);
  const H5Quiet quiet;
  const H5Handle access = h5_own(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path, "write the markers");
  h5_check(H5Pset_file_locking(access.get(), false, true), path, "write the markers");  // Others may be reading it.
  H5Handle file = h5_own(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get()), H5Fclose, path, "write the markers");
  H5Writer(file.get(), path)
      .put("markers", texts,
           {"",
            "What an operator has marked, JSON: name, position [m], time [s], sonar, ping; perhaps range [m], side."});
  h5_check(H5Fclose(file.release()), path, "write the markers");
}

}  // namespace insonify
