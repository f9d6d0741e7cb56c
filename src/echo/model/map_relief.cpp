// map_relief.cpp -- look-ups of triangles and texels one by one, and the laws between them in vector loops.

#include "echo/model/map_relief.h"

#include <algorithm>

#include "base/vector_math.h"

namespace insonify {
namespace {

// TextureFrames.
struct alignas(64) TextureFrames {
  float u[kHitLanes], v[kHitLanes];  // 0 where they are not usable.
  float right_x[kHitLanes], right_y[kHitLanes], right_z[kHitLanes];
  float up_x[kHitLanes], up_y[kHitLanes], up_z[kHitLanes];
};

// Slopes of a tile.
struct alignas(64) Slopes {
  float right[kHitLanes], up[kHitLanes];
};

// The triangles of the points, and their texture coordinates.
struct alignas(64) Corners {
  float x[3][kHitLanes], y[3][kHitLanes], z[3][kHitLanes];
  float u[3][kHitLanes], v[3][kHitLanes];
};

void gather_corners(const Mesh& mesh, const MeshPoints& points, Corners& corners) {
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const std::uint32_t triangle = points.triangle[lane];
    for (int k = 0; k < 3; ++k) {
      const Vec3f& vertex = mesh.vertices[mesh.triangles[triangle][k]];
      const Eigen::Vector2f& texture = mesh.texture_coordinates[triangle][k];
      corners.x[k][lane] = vertex.x();
      corners.y[k][lane] = vertex.y();
      corners.z[k][lane] = vertex.z();
      corners.u[k][lane] = texture.x();
      corners.v[k][lane] = texture.y();
    }
  }
}

INSONIFY_VECTOR_CLONES
void find_frames(const MeshPoints& __restrict__ points, const Corners& __restrict__ corners,
                 TextureFrames& __restrict__ frames, std::int32_t* __restrict__ usable) {
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const Triple corner = {corners.x[0][lane], corners.y[0][lane], corners.z[0][lane]};
    const float u = corners.u[0][lane], v = corners.v[0][lane];
    const TextureFrame frame = texture_frame(
        Triple{corners.x[1][lane], corners.y[1][lane], corners.z[1][lane]} - corner,
        Triple{corners.x[2][lane], corners.y[2][lane], corners.z[2][lane]} - corner,
        {u, v, corners.u[1][lane] - u, corners.v[1][lane] - v, corners.u[2][lane] - u, corners.v[2][lane] - v},
        Triple{points.x[lane], points.y[lane], points.z[lane]} - corner);
    usable[lane] = frame.usable ? -1 : 0;
    frames.u[lane] = frame.usable ? frame.u : 0.0F;
    frames.v[lane] = frame.usable ? frame.v : 0.0F;
    frames.right_x[lane] = frame.right.x;
    frames.right_y[lane] = frame.right.y;
    frames.right_z[lane] = frame.right.z;
    frames.up_x[lane] = frame.up.x;
    frames.up_y[lane] = frame.up.y;
    frames.up_z[lane] = frame.up.z;
  }
}

// TexelPlaces.
struct alignas(64) TexelPlaces {
  std::int32_t left[kHitLanes], right[kHitLanes], top[kHitLanes], bottom[kHitLanes];
  float right_share[kHitLanes], bottom_share[kHitLanes];
};

INSONIFY_VECTOR_CLONES
void find_places(int columns, int rows, const float* __restrict__ u, const float* __restrict__ v,
                 TexelPlaces& __restrict__ places) {
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const TexelPlace place = texel_place(u[lane], v[lane], columns, rows);
    places.left[lane] = place.left;
    places.right[lane] = place.right;
    places.top[lane] = place.top;
    places.bottom[lane] = place.bottom;
    places.right_share[lane] = place.right_share;
    places.bottom_share[lane] = place.bottom_share;
  }
}

// The values of the four texels of each place.
struct alignas(64) Texels {
  float top_left[kHitLanes], top_right[kHitLanes], bottom_left[kHitLanes], bottom_right[kHitLanes];
};

// @param parts  The parts of a texel are gathered apart.
template <typename Texel, std::size_t parts, typename Part>
void gather(const Tile<Texel>& tile, const TexelPlaces& places, Texels (&texels)[parts], const Part& part) {
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const Texel* const top = &tile.texels[static_cast<std::size_t>(places.top[lane]) * tile.columns];
    const Texel* const bottom = &tile.texels[static_cast<std::size_t>(places.bottom[lane]) * tile.columns];
    for (std::size_t i = 0; i < parts; ++i) {
      texels[i].top_left[lane] = part(top[places.left[lane]], i);
      texels[i].top_right[lane] = part(top[places.right[lane]], i);
      texels[i].bottom_left[lane] = part(bottom[places.left[lane]], i);
      texels[i].bottom_right[lane] = part(bottom[places.right[lane]], i);
    }
  }
}

INSONIFY_VECTOR_CLONES
void find_means(const Texels& __restrict__ texels, const TexelPlaces& __restrict__ places, float* __restrict__ means) {
  for (int lane = 0; lane < kHitLanes; ++lane) {
    means[lane] = texel_mean(texels.top_left[lane], texels.top_right[lane], texels.bottom_left[lane],
                             texels.bottom_right[lane], places.right_share[lane], places.bottom_share[lane]);
  }
}

void read_slopes(const Tile<Eigen::Vector2f>& tile, const float* u, const float* v, Slopes& slopes) {
  TexelPlaces places;
  find_places(tile.columns, tile.rows, u, v, places);
  Texels texels[2];
  gather(tile, places, texels, [](const Eigen::Vector2f& slope, std::size_t i) { return slope[i]; });
  find_means(texels[0], places, slopes.right);
  find_means(texels[1], places, slopes.up);
}

void read_factors(const Tile<float>& tile, const float* u, const float* v, float* factors) {
  TexelPlaces places;
  find_places(tile.columns, tile.rows, u, v, places);
  Texels texels[1];
  gather(tile, places, texels, [](float factor, std::size_t) { return factor; });
  find_means(texels[0], places, factors);
}

template <bool rise_per_tile>
[[gnu::always_inline]] inline void add_gradients(const Slopes& slopes, const TextureFrames& frames,
                                                 const MeshPoints& points, ReliefLanes& reliefs) {
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const Triple right = {frames.right_x[lane], frames.right_y[lane], frames.right_z[lane]};
    const Triple up = {frames.up_x[lane], frames.up_y[lane], frames.up_z[lane]};
    const Triple normal = points.normal(lane);
    const Triple gradient =
        finite_gradient(rise_per_tile ? gradient_of_rise(slopes.right[lane], slopes.up[lane], right, up, normal)
                                      : gradient_of_slopes(slopes.right[lane], slopes.up[lane], right, up, normal));
    reliefs.gradient_x[lane] = gradient.x;
    reliefs.gradient_y[lane] = gradient.y;
    reliefs.gradient_z[lane] = gradient.z;
  }
}

INSONIFY_VECTOR_CLONES
void add_slope_gradients(const Slopes& __restrict__ slopes, const TextureFrames& __restrict__ frames,
                         const MeshPoints& __restrict__ points, ReliefLanes& __restrict__ reliefs) {
  add_gradients<false>(slopes, frames, points, reliefs);
}

INSONIFY_VECTOR_CLONES
void add_rise_gradients(const Slopes& __restrict__ slopes, const TextureFrames& __restrict__ frames,
                        const MeshPoints& __restrict__ points, ReliefLanes& __restrict__ reliefs) {
  add_gradients<true>(slopes, frames, points, reliefs);
}

// Points of a relief that is mapped by position: `along` of kRight and kUp are its texture coordinates in the
// projections along x, y and z.
struct alignas(64) Projections {
  float along[3][kHitLanes];   // Position [tiles].
  float shares[3][kHitLanes];  // projection_shares()
};
constexpr int kRight[] = {1, 0, 0}, kUp[] = {2, 2, 1};

INSONIFY_VECTOR_CLONES
void project(const MeshPoints& __restrict__ points, float tiles_a_metre, Projections& __restrict__ projections) {
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const Triple shares = projection_shares(points.normal(lane));
    projections.shares[0][lane] = shares.x;
    projections.shares[1][lane] = shares.y;
    projections.shares[2][lane] = shares.z;
    projections.along[0][lane] = points.x[lane] * tiles_a_metre;
    projections.along[1][lane] = points.y[lane] * tiles_a_metre;
    projections.along[2][lane] = points.z[lane] * tiles_a_metre;
  }
}

INSONIFY_VECTOR_CLONES
void add_projected_gradients(const Slopes* __restrict__ slopes, const Projections& __restrict__ projections,
                             float scale, const MeshPoints& __restrict__ points, ReliefLanes& __restrict__ reliefs) {
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const Triple gradient =
        gradient_of_projections({slopes[0].right[lane], slopes[0].up[lane], slopes[1].right[lane], slopes[1].up[lane],
                                 slopes[2].right[lane], slopes[2].up[lane]},
                                {projections.shares[0][lane], projections.shares[1][lane], projections.shares[2][lane]},
                                scale, points.normal(lane));
    reliefs.gradient_x[lane] = gradient.x;
    reliefs.gradient_y[lane] = gradient.y;
    reliefs.gradient_z[lane] = gradient.z;
  }
}

INSONIFY_VECTOR_CLONES
void mean_factors(const float (*__restrict__ factors)[kHitLanes], const Projections& __restrict__ projections,
                  float* __restrict__ mean) {
  for (int lane = 0; lane < kHitLanes; ++lane) {
    mean[lane] =
        mean_of_projections({factors[0][lane], factors[1][lane], factors[2][lane]},
                            {projections.shares[0][lane], projections.shares[1][lane], projections.shares[2][lane]});
  }
}

}  // namespace

void map_by_texture(const Relief& relief, const Mesh& mesh, const MeshPoints& points, std::int32_t* usable,
                    ReliefLanes& reliefs) {
  Corners corners;
  gather_corners(mesh, points, corners);
  TextureFrames frames;
  find_frames(points, corners, frames, usable);
  if (!relief.slopes.empty()) {
    Slopes slopes;
    read_slopes(relief.slopes, frames.u, frames.v, slopes);
    (relief.rise_per_tile ? add_rise_gradients : add_slope_gradients)(slopes, frames, points, reliefs);
  }
  if (!relief.reflectivity.empty()) {
    read_factors(relief.reflectivity, frames.u, frames.v, reliefs.reflectivity);
  }
}

void map_by_position(const Relief& relief, const MeshPoints& points, ReliefLanes& reliefs) {
  const auto tiles_a_metre = static_cast<float>(1 / relief.tile_size);
  Projections projections;
  project(points, tiles_a_metre, projections);
  Slopes slopes[3] = {};
  alignas(64) float factors[3][kHitLanes] = {};
  for (int view = 0; view < 3; ++view) {
    if (std::ranges::all_of(projections.shares[view], [](float share) { return share == 0; })) {
      continue;
    }
    const float *const u = projections.along[kRight[view]], *const v = projections.along[kUp[view]];
    if (!relief.slopes.empty()) {
      read_slopes(relief.slopes, u, v, slopes[view]);
    }
    if (!relief.reflectivity.empty()) {
      read_factors(relief.reflectivity, u, v, factors[view]);
    }
  }
  if (!relief.slopes.empty()) {
    add_projected_gradients(slopes, projections, relief.rise_per_tile ? tiles_a_metre : 1.0F, points, reliefs);
  }
  if (!relief.reflectivity.empty()) {
    mean_factors(factors, projections, reliefs.reflectivity);
  }
}

}  // namespace insonify
