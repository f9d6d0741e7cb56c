// gpu_reliefs.h -- the reliefs of a scene's surfaces on a device.

#pragma once

#include <map>
#include <memory>
#include <vector>

#include "echo/gpu/shaders/layout.h"
#include "gpu/device.h"
#include "insonify/scene.h"

namespace insonify {

/// Tiles and texture coordinates, once each; relief.glsl evaluates them.
class GpuReliefs {
 public:
  /// Uploads what the device does not hold yet, and drops what is gone.
  void set(gpu::Device& device, const Scene& scene);

  /// Whether any surface has a relief.
  [[nodiscard]] bool any() const { return slots_.bytes() > 0; }

  /// Addresses of an instance's shader::ReliefTiles[slot], and of its mesh's texture coordinates; 0: none.
  [[nodiscard]] std::uint64_t tiles(std::size_t instance) const { return of_[instance].tiles; }
  [[nodiscard]] std::uint64_t texture(std::size_t instance) const { return of_[instance].texture; }

  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Tiles {
    std::shared_ptr<const Relief> relief;
    gpu::Buffer slopes, factors;
  };
  struct Texture {
    std::shared_ptr<const Mesh> mesh;
    gpu::Buffer coordinates;
  };
  struct Addresses {
    std::uint64_t tiles = 0, texture = 0;
  };
  [[nodiscard]] static shader::ReliefTiles tiles_of(const Tiles& tiles);

  std::map<const Relief*, Tiles> tiles_;
  std::map<const Mesh*, Texture> textures_;
  gpu::Buffer slots_;          // ReliefTiles of all instances that have any, slot by slot.
  std::vector<Addresses> of_;  // [instance]
};

}  // namespace insonify
