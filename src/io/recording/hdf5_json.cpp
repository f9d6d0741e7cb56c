// hdf5_json.cpp -- converts HDF5's texts, numbers and truth values to JSON.

#include "io/recording/hdf5_json.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace insonify {
namespace {

constexpr hsize_t kMostValues = 1'000'000;  // Most values of a list that is read as a whole.

// Texts of fixed or variable length, read by `read(type, buffer)`.
std::vector<std::string> read_texts(hid_t type, const H5Handle& space, hsize_t count,
                                    const std::function<void(hid_t, void*)>& read) {
  std::vector<std::string> texts;
  if (H5Tis_variable_str(type) <= 0) {
    const std::size_t length = H5Tget_size(type);
    std::string all(length * count, '\0');
    read(type, all.data());
    for (std::size_t start = 0; start < all.size(); start += length) {
      const std::string text = all.substr(start, length);
      texts.push_back(text.substr(0, text.find('\0')));
    }
    return texts;
  }
  std::vector<char*> pointers(count, nullptr);
  read(type, pointers.data());
  for (const char* const pointer : pointers) {
    texts.emplace_back(pointer != nullptr ? pointer : "");
  }
  H5Dvlen_reclaim(type, space.get(), H5P_DEFAULT, pointers.data());
  return texts;
}

// A JSON number cannot be infinite or NaN.
nlohmann::json number_of(double value) {
  if (std::isnan(value)) {
    return "nan";
  }
  return std::isinf(value) ? nlohmann::json(value > 0 ? "inf" : "-inf") : nlohmann::json(value);
}

// The value of a small object with a type and a space, as JSON: a text, a number, a truth value or lists of those.
nlohmann::json json_of(hid_t type_id, const H5Handle& space, const std::function<void(hid_t, void*)>& read) {
  const std::vector<hsize_t> shape = hdf5_shape(space.get());
  if (!product_is_at_most(shape, kMostValues)) {
    return nullptr;
  }
  const hsize_t count = std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
  std::vector<nlohmann::json> values;
  const H5T_class_t kind = H5Tget_class(type_id);
  if (kind == H5T_STRING) {
    for (std::string& text : read_texts(type_id, space, count, read)) {
      values.emplace_back(std::move(text));
    }
  } else if (kind == H5T_ENUM) {
    std::vector<std::int8_t> bits(count);
    if (H5Tget_size(type_id) != 1 || H5Tget_nmembers(type_id) != 2) {  // Truth values; HDF5 is slow with thousands.
      return nullptr;
    }
    read(type_id, bits.data());
    for (const std::int8_t bit : bits) {
      values.emplace_back(bit != 0);
    }
  } else if (kind == H5T_INTEGER && H5Tget_sign(type_id) == H5T_SGN_NONE) {
    std::vector<std::uint64_t> numbers(count);
    read(H5T_NATIVE_UINT64, numbers.data());
    values.assign(numbers.begin(), numbers.end());
  } else if (kind == H5T_INTEGER) {
    std::vector<std::int64_t> numbers(count);
    read(H5T_NATIVE_INT64, numbers.data());
    values.assign(numbers.begin(), numbers.end());
  } else if (kind == H5T_FLOAT) {
    std::vector<double> numbers(count);
    read(H5T_NATIVE_DOUBLE, numbers.data());
    std::ranges::transform(numbers, std::back_inserter(values), number_of);
  } else {
    return nullptr;
  }
  if (shape.empty()) {
    return values.empty() ? nlohmann::json() : values.front();
  }
  if (shape.size() == 1) {
    return values;
  }
  nlohmann::json rows = nlohmann::json::array();
  const std::size_t width = values.size() / std::max<hsize_t>(1, shape[0]);
  for (std::size_t i = 0; width > 0 && i < values.size(); i += width) {
    rows.push_back(nlohmann::json(std::vector(values.begin() + static_cast<std::ptrdiff_t>(i),
                                              values.begin() + static_cast<std::ptrdiff_t>(i + width))));
  }
  return rows;
}

std::vector<std::string> attribute_names(hid_t object, const std::filesystem::path& path, const std::string& doing) {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->emplace_back(name);
    return 0;
  };
  h5_check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names), path, doing);
  return names;
}

}  // namespace

std::vector<hsize_t> hdf5_shape(hid_t space) {
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

bool product_is_at_most(const std::vector<hsize_t>& shape, hsize_t most) {
  hsize_t product = 1;
  for (const hsize_t length : shape) {
    if (length > most || (length > 0 && product > most / length)) {
      return false;
    }
    product *= length;
  }
  return true;
}

nlohmann::json hdf5_attributes_json(hid_t object, const std::filesystem::path& path, const std::string& owner) {
  const std::string doing = "read the attributes of " + owner;
  nlohmann::json found = nlohmann::json::object();
  for (const std::string& name : attribute_names(object, path, doing)) {
    const H5Handle attribute = h5_own(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, path, doing);
    const H5Handle type = h5_own(H5Aget_type(attribute.get()), H5Tclose, path, doing);
    const H5Handle space = h5_own(H5Aget_space(attribute.get()), H5Sclose, path, doing);
    found[name] = json_of(type.get(), space, [&](hid_t memory, void* buffer) {
      h5_check(H5Aread(attribute.get(), memory, buffer), path, doing);
    });
  }
  return found;
}

nlohmann::json hdf5_dataset_json(hid_t dataset, const std::filesystem::path& path, const std::string& name) {
  const H5Handle type = h5_own(H5Dget_type(dataset), H5Tclose, path, "read " + name);
  const H5Handle space = h5_own(H5Dget_space(dataset), H5Sclose, path, "read " + name);
  return json_of(type.get(), space, [&](hid_t memory, void* buffer) {
    h5_check(H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer), path, "read " + name);
  });
}

}  // namespace insonify
