// gpu_reliefs.cpp -- uploads reliefs, and the texture coordinates of meshes that have them.

#include "echo/gpu/gpu_reliefs.h"

#include <algorithm>
#include <utility>

namespace insonify {
namespace {

// Moves the entry of an object from the scene before, or makes one.
template <typename Key, typename Value, typename Make>
Value& keep(std::map<Key, Value>& before, std::map<Key, Value>& now, Key key, const Make& make) {
  if (const auto known = now.find(key); known != now.end()) {
    return known->second;
  }
  const auto old = before.find(key);
  return now.emplace(key, old != before.end() ? std::move(old->second) : make()).first->second;
}

template <typename Values>
gpu::Buffer uploaded(gpu::Device& device, const Values& values) {
  gpu::Buffer buffer;
  if (!values.empty()) {
    gpu::upload(device, values, buffer);
  }
  return buffer;
}

}  // namespace

shader::ReliefTiles GpuReliefs::tiles_of(const Tiles& tiles) {
  const Relief& relief = *tiles.relief;
  return {.slopes = tiles.slopes.address(),
          .factors = tiles.factors.address(),
          .slope_columns = relief.slopes.columns,
          .slope_rows = relief.slopes.rows,
          .factor_columns = relief.reflectivity.columns,
          .factor_rows = relief.reflectivity.rows,
          .tile_size = static_cast<float>(relief.tile_size),
          .rise_per_tile = relief.rise_per_tile ? 1U : 0U,
          .by_position = relief.by_position ? 1U : 0U};
}

void GpuReliefs::set(gpu::Device& device, const Scene& scene) {
  std::map<const Relief*, Tiles> tiles;
  std::map<const Mesh*, Texture> textures;
  std::vector<shader::ReliefTiles> slots;
  std::vector<std::pair<std::size_t, std::size_t>> first_slots;  // Instance with a relief, its first slot.
  of_.assign(scene.instances.size(), {});
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const auto has_relief = [](const std::shared_ptr<const Relief>& relief) { return relief != nullptr; };
    if (!instance.present || std::ranges::none_of(instance.reliefs, has_relief)) {
      continue;
    }
    first_slots.emplace_back(i, slots.size());
    for (const std::shared_ptr<const Relief>& relief : instance.reliefs) {
      slots.push_back(relief == nullptr ? shader::ReliefTiles{} : tiles_of(keep(tiles_, tiles, relief.get(), [&] {
        return Tiles{relief, uploaded(device, relief->slopes.texels), uploaded(device, relief->reflectivity.texels)};
      })));
    }
    of_[i].texture = keep(textures_, textures, instance.mesh.get(), [&] {
                       return Texture{instance.mesh, uploaded(device, instance.mesh->texture_coordinates)};
                     }).coordinates.address();
  }
  tiles_ = std::move(tiles);
  textures_ = std::move(textures);
  slots_ = uploaded(device, slots);
  for (const auto& [instance, first] : first_slots) {
    of_[instance].tiles = slots_.address() + first * sizeof(shader::ReliefTiles);
  }
}

std::size_t GpuReliefs::bytes() const {
  std::size_t sum = slots_.bytes();
  for (const auto& [of, tiles] : tiles_) {
    sum += tiles.slopes.bytes() + tiles.factors.bytes();
  }
  for (const auto& [of, texture] : textures_) {
    sum += texture.coordinates.bytes();
  }
  return sum;
}

}  // namespace insonify
