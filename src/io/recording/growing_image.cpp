// growing_image.cpp -- lets HDF5 create the whole file except its rows, in memory.

#include "io/recording/growing_image.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/recording/growing_dataset.h"

namespace insonify {
namespace {

// HDF5 keeps its own structures together in blocks of this size [bytes]; the first block holds all that must share a
// page. Memory for the file grows by the same amount.
constexpr hsize_t kMetadataBlock = 65536;

// Half the entries of a node of a group's tree: small ones, the root's comes before the datasets' headers.
constexpr unsigned kHalfTreeNode = 2;

// Chunks of some rows each, in a file without any.
H5Handle growing_layout(const GrowingDataset& dataset, const std::filesystem::path& path) {
  H5Handle layout = h5_own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path, "create");
  const std::vector<std::uint64_t> chunk = dataset.chunk_shape();
  const std::vector<hsize_t> shape(chunk.begin(), chunk.end());
  h5_check(H5Pset_chunk(layout.get(), static_cast<int>(shape.size()), shape.data()), path, "create");
  h5_check(H5Pset_fill_time(layout.get(), H5D_FILL_TIME_NEVER), path, "create");
  h5_check(H5Pset_obj_track_times(layout.get(), false), path, "create");
  if (dataset.is_filtered()) {
    h5_check(H5Pset_shuffle(layout.get()), path, "create");
    h5_check(H5Pset_deflate(layout.get(), ChunkFilter::kLevel), path, "create");
  }
  h5_check(H5Pset_fletcher32(layout.get()), path, "create");
  return layout;
}

// Not in a group yet: the headers are adjacent, without the group's structures between them.
H5Handle create_dataset(hid_t file, const GrowingDataset& dataset, const std::filesystem::path& path) {
  std::vector<hsize_t> shape{0}, most{H5S_UNLIMITED};
  shape.insert(shape.end(), dataset.row.begin(), dataset.row.end());
  most.insert(most.end(), dataset.row.begin(), dataset.row.end());
  const H5Handle space =
      h5_own(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), most.data()), H5Sclose, path, "create");
  const H5Handle layout = growing_layout(dataset, path);
  return h5_own(H5Dcreate_anon(file, dataset.type, space.get(), layout.get(), H5P_DEFAULT), H5Dclose, path,
                "create /" + dataset.name);
}

// An object in no group, of the given length plus HDF5's overhead in multiples of 8 bytes.
H5Handle create_filler(hid_t file, hsize_t length, const std::filesystem::path& path) {
  const H5Handle layout = h5_own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path, "create");
  h5_check(H5Pset_layout(layout.get(), H5D_COMPACT), path, "create");
  h5_check(H5Pset_obj_track_times(layout.get(), false), path, "create");
  const H5Handle space = h5_own(H5Screate_simple(1, &length, nullptr), H5Sclose, path, "create");
  return h5_own(H5Dcreate_anon(file, H5T_NATIVE_UINT8, space.get(), layout.get(), H5P_DEFAULT), H5Dclose, path,
                "create");
}

// Fills the rest of a page, so that the next objects have one to themselves: room for 15 datasets' headers. The fillers
// must stay open until then.
std::vector<H5Handle> fill_page(hid_t file, const std::filesystem::path& path) {
  constexpr hsize_t kLeast = 8;
  std::vector<H5Handle> fillers;
  fillers.push_back(create_filler(file, kLeast, path));
  H5O_info_t info;
  h5_check(H5Oget_info1(fillers.back().get(), &info), path, "create");
  const hsize_t begin = info.addr + info.hdr.space.total, smallest = begin + info.hdr.space.total;
  const hsize_t end = (smallest + kGrowingPage - 1) / kGrowingPage * kGrowingPage;
  fillers.push_back(create_filler(file, kLeast + (end - smallest), path));
  return fillers;
}

// A value that no other 8 bytes of a file have.
constexpr std::uint64_t kStateMark = 0xd1ce'5a7e'0f17'b1e5;

void create_state(hid_t file, const std::filesystem::path& path) {
  const H5Handle space = h5_own(H5Screate(H5S_SCALAR), H5Sclose, path, "create");
  const H5Handle attribute =
      h5_own(H5Acreate2(file, kStateAttribute, H5T_STD_U64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, path,
             "create");
  h5_check(H5Awrite(attribute.get(), H5T_NATIVE_UINT64, &kStateMark), path, "create");
}

// Position of the state; its value becomes kGrowing.
std::uint64_t find_state(std::vector<std::byte>& image, const std::filesystem::path& path) {
  const auto mark = std::as_bytes(std::span(&kStateMark, 1));
  const auto found = std::ranges::search(image, mark);
  const auto again = found.empty() ? found : std::ranges::search(found.end(), image.end(), mark.begin(), mark.end());
  if (found.empty() || !again.empty()) {
    throw Error(fmt::format("{}: cannot create: HDF5 has put the state of the file elsewhere", path.string()));
  }
  std::ranges::fill(found, std::byte{0});
  return static_cast<std::uint64_t>(found.begin() - image.begin());
}

}  // namespace

// Has HDF5 make the whole file but the rows, in memory: a disk that fills up could leave it with handles that it can
// never close, and then it fails when the program ends.
GrowingImage make_growing_image(const std::filesystem::path& path, std::span<const GrowingDataset> datasets,
                                const std::function<void(hid_t file)>& describe) {
  GrowingImage image;
  const H5Quiet quiet;
  // The earliest formats: no checksums over what is to change, and what every program reads.
  const H5Handle access = h5_own(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path, "create");
  h5_check(H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST), path, "create");
  h5_check(H5Pset_meta_block_size(access.get(), kMetadataBlock), path, "create");
  h5_check(H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG), path, "create");
  constexpr bool kOnDisk = false;
  h5_check(H5Pset_fapl_core(access.get(), kMetadataBlock, kOnDisk), path, "create");
  // No file can have this name: HDF5 would read an existing one completely, even to overwrite it.
  constexpr const char* kNowhere = "/dev/null/recording";
  const H5Handle creation = h5_own(H5Pcreate(H5P_FILE_CREATE), H5Pclose, path, "create");
  h5_check(H5Pset_sym_k(creation.get(), kHalfTreeNode, 0), path, "create");
  const H5Handle file =
      h5_own(H5Fcreate(kNowhere, H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose, path, "create");
  std::vector<H5Handle> fillers = fill_page(file.get(), path);
  std::vector<H5Handle> made;
  for (const GrowingDataset& dataset : datasets) {
    made.push_back(create_dataset(file.get(), dataset, path));
    H5O_info_t info;
    h5_check(H5Oget_info1(made.back().get(), &info), path, "create /" + dataset.name);
    image.addresses.push_back(info.addr);
  }
  for (std::size_t i = 0; i < datasets.size(); ++i) {
    const std::string& name = datasets[i].name;
    h5_check(H5Olink(made[i].get(), file.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), path, "create /" + name);
  }
  made.clear();
  fillers.clear();
  describe(file.get());
  create_state(file.get(), path);
  h5_check(H5Fflush(file.get(), H5F_SCOPE_LOCAL), path, "create");
  image.bytes.resize(static_cast<std::size_t>(h5_check(H5Fget_file_image(file.get(), nullptr, 0), path, "create")));
  h5_check(H5Fget_file_image(file.get(), image.bytes.data(), image.bytes.size()), path, "create");
  image.state_address = find_state(image.bytes, path);
  return image;
}

}  // namespace insonify
