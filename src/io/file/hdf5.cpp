// hdf5.cpp -- reads HDF5's error stack.

#include "io/file/hdf5.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "insonify/printable.h"

namespace insonify {
namespace {

// Callback for H5Ewalk2: takes the first entry, which is that of the innermost function and says why it failed.
herr_t take_first(unsigned, const H5E_error2_t* entry, void* text) {
  *static_cast<std::string*>(text) = entry->desc != nullptr ? entry->desc : "";
  return 1;  // Stop.
}

// Entries of the file driver hold a date (with a line break), addresses and flags around the reason.
std::string system_reason(const std::string& description) {
  static constexpr std::string_view kStart = "error message = '";
  const std::size_t start = description.find(kStart);
  if (start == std::string::npos) {
    return description;
  }
  const std::size_t first = start + kStart.size();
  return description.substr(first, description.find('\'', first) - first);
}

}  // namespace

std::string h5_failure() {
  std::string description;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &description);
  if (description.empty()) {
    return "unknown HDF5 failure";
  }
  std::string reason = system_reason(description);
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  return reason;
}

H5Handle h5_open_object(hid_t where, const std::string& name, const std::filesystem::path& path) {
  const std::string doing = "open " + printable(name);
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    H5L_info_t link{};
    if (H5Lget_info(where, name.substr(0, end).c_str(), &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_EXTERNAL) {
      throw Error(fmt::format("{}: {} is a link to another file, which is not read", path.string(), printable(name)));
    }
    if (end == std::string::npos) {
      break;
    }
  }
  H5Handle object = h5_own(H5Oopen(where, name.c_str(), H5P_DEFAULT), H5Oclose, path, doing);
  if (H5Iget_type(object.get()) == H5I_DATASET) {
    const H5Handle made = h5_own(H5Dget_create_plist(object.get()), H5Pclose, path, doing);
    if (H5Pget_external_count(made.get()) > 0 || H5Pget_layout(made.get()) == H5D_VIRTUAL) {
      throw Error(
          fmt::format("{}: {} has its values in other files, which are not read", path.string(), printable(name)));
    }
  }
  return object;
}

H5Handle h5_open_to_read(const std::filesystem::path& path) {
  constexpr int kTries = 4;  // A recording grows once in several pings.
  // Without HDF5's own lock, which file systems such as NFS may refuse (ENOLCK).
  const H5Handle access = h5_own(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path, "open it as HDF5");
  h5_check(H5Pset_file_locking(access.get(), false, true), path, "open it as HDF5");
  hid_t file = H5I_INVALID_HID;
  for (int i = 0; i < kTries && file < 0; ++i) {
    file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get());
  }
  return h5_own(file, H5Fclose, path, "open it as HDF5");
}

H5Handle h5_open_recording(const std::filesystem::path& path) {
  // The signature may follow a user block: at 512 bytes, 1024, 2048 ...
  constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);
  std::ifstream in(path, std::ios::binary);
  std::string found(kSignature.size(), '\0');
  bool is_bag = false;
  for (std::streamoff at = 0; in && found != kSignature; at = at == 0 ? 512 : 2 * at) {
    in.seekg(at);
    in.read(found.data(), static_cast<std::streamsize>(found.size()));
    is_bag = is_bag || (at == 0 && found.starts_with("#ROSBAG"));
  }
  if (in.is_open() && found != kSignature) {
    throw Error(
        fmt::format("{}: is not a recording: it is {}", path.string(),
                    is_bag ? "a bag of ROS, which insonify writes and does not read" : "neither HDF5 nor MCAP"));
  }
  return h5_open_to_read(path);
}

}  // namespace insonify
