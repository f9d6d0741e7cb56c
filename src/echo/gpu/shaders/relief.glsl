// relief.glsl -- relief of the surfaces that rays hit: Reliefs of the host. Uses scene.glsl and echo/laws/relief.h.

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ReliefsOfSlots { ReliefTiles at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Slopes { vec2 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Factors { float at[]; };

// As on the host; the gradient in the frame of the scene.
struct ReliefPoint {
  vec3 gradient;
  float reflectivity;
};

const ReliefPoint kNoRelief = ReliefPoint(vec3(0.0), 1.0);

// The four texels of a place, as indices.
uvec4 texels_of(TexelPlace place, int columns) {
  return uvec4(place.top * columns + place.left, place.top * columns + place.right, place.bottom * columns + place.left,
               place.bottom * columns + place.right);
}

vec2 slopes_at(ReliefTiles tiles, vec2 texture) {
  const TexelPlace place = texel_place(texture.x, texture.y, tiles.slope_columns, tiles.slope_rows);
  const uvec4 at = texels_of(place, tiles.slope_columns);
  Slopes slopes = Slopes(tiles.slopes);
  const vec2 a = slopes.at[at.x], b = slopes.at[at.y], c = slopes.at[at.z], d = slopes.at[at.w];
  return vec2(texel_mean(a.x, b.x, c.x, d.x, place.right_share, place.bottom_share),
              texel_mean(a.y, b.y, c.y, d.y, place.right_share, place.bottom_share));
}

float factor_at(ReliefTiles tiles, vec2 texture) {
  const TexelPlace place = texel_place(texture.x, texture.y, tiles.factor_columns, tiles.factor_rows);
  const uvec4 at = texels_of(place, tiles.factor_columns);
  Factors factors = Factors(tiles.factors);
  return texel_mean(factors.at[at.x], factors.at[at.y], factors.at[at.z], factors.at[at.w], place.right_share,
                    place.bottom_share);
}

TextureFrame texture_frame_at(PlacedMesh placed, uint triangle, vec3 point) {
  Numbers corners = Numbers(placed.corners);
  Places vertices = Places(placed.vertices);
  Slopes texture = Slopes(placed.texture);
  const uint first = 3 * triangle;
  const vec3 corner = vertices.at[corners.at[first]];
  const vec2 a = texture.at[first], along = texture.at[first + 1] - a, across = texture.at[first + 2] - a;
  return texture_frame(vertices.at[corners.at[first + 1]] - corner, vertices.at[corners.at[first + 2]] - corner,
                       TriangleTexture(a.x, a.y, along.x, along.y, across.x, across.y), point - corner);
}

// Frame, normal and gradient are in the frame of the mesh.
ReliefPoint relief_by_texture(ReliefTiles tiles, TextureFrame frame, vec3 normal) {
  ReliefPoint relief = kNoRelief;
  const vec2 texture = vec2(frame.u, frame.v);
  if (tiles.slopes != 0) {
    const vec2 slopes = slopes_at(tiles, texture);
    relief.gradient = finite_gradient(
        tiles.rise_per_tile != 0 ? gradient_of_rise(slopes.x, slopes.y, frame.right, frame.up, normal)
                                 : gradient_of_slopes(slopes.x, slopes.y, frame.right, frame.up, normal));
  }
  if (tiles.factors != 0) {
    relief.reflectivity = factor_at(tiles, texture);
  }
  return relief;
}

ReliefPoint relief_by_position(ReliefTiles tiles, vec3 point, vec3 normal) {
  ReliefPoint relief = kNoRelief;
  const float tiles_a_metre = 1.0 / tiles.tile_size;
  const vec3 along = tiles_a_metre * point, shares = projection_shares(normal);
  const vec2 views[3] = vec2[](along.yz, along.xz, along.xy);
  vec2 slopes[3] = vec2[](vec2(0.0), vec2(0.0), vec2(0.0));
  vec3 factors = vec3(0.0);
  for (int view = 0; view < 3; ++view) {
    if (shares[view] > 0.0 && tiles.slopes != 0) {
      slopes[view] = slopes_at(tiles, views[view]);
    }
    if (shares[view] > 0.0 && tiles.factors != 0) {
      factors[view] = factor_at(tiles, views[view]);
    }
  }
  if (tiles.slopes != 0) {
    const ProjectedSlopes projected =
        ProjectedSlopes(slopes[0].x, slopes[0].y, slopes[1].x, slopes[1].y, slopes[2].x, slopes[2].y);
    relief.gradient =
        gradient_of_projections(projected, shares, tiles.rise_per_tile != 0 ? tiles_a_metre : 1.0, normal);
  }
  if (tiles.factors != 0) {
    relief.reflectivity = mean_of_projections(factors, shares);
  }
  return relief;
}

// @param point  The hit, in the scene.
ReliefPoint relief_at(PlacedScene scene, SceneHit hit, Surface surface, vec3 point) {
  if (hit.instance == kNoInstance || PlacedMeshes(scene.instances).at[hit.instance].reliefs == 0) {
    return kNoRelief;
  }
  const PlacedMesh placed = PlacedMeshes(scene.instances).at[hit.instance];
  const ReliefTiles tiles = ReliefsOfSlots(placed.reliefs).at[surface.slot];
  const vec3 in_mesh = placed.mesh_from_scene * vec4(point, 1.0);
  const vec3 normal = direction_of(mat3(placed.mesh_from_scene) * surface.normal);
  ReliefPoint relief = kNoRelief;
  bool mapped = false;
  if (tiles.by_position == 0 && placed.texture != 0) {
    const TextureFrame frame = texture_frame_at(placed, surface.triangle, in_mesh);
    mapped = frame.usable;
    if (mapped) {
      relief = relief_by_texture(tiles, frame, normal);
    }
  }
  if (!mapped && tiles.tile_size > 0.0) {
    relief = relief_by_position(tiles, in_mesh, normal);
  }
  relief.gradient = mat3(placed.scene_from_mesh) * relief.gradient;
  return relief;
}

// Tilts the normal of a surface. Returns the factor on its reflectivity.
float add_relief(PlacedScene scene, SceneHit hit, vec3 point, inout Surface surface) {
  if (hit.instance == kNoInstance || PlacedMeshes(scene.instances).at[hit.instance].reliefs == 0) {
    return 1.0;
  }
  const ReliefPoint relief = relief_at(scene, hit, surface, point);
  surface.normal = bent_normal(surface.normal, relief.gradient);
  return relief.reflectivity;
}
