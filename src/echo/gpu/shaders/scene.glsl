// scene.glsl -- finds the nearest surface along a ray, and its normal there.

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "layout.h"

// Nodes and triangles are read in words of 64 bits: drivers on the processor read lane by lane, word by word.
struct NodeWords {
  u64vec2 words[5];
};
struct TriangleWords {
  uint64_t words[5];
};
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer TreeNodes { NodeWords at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer TreeTriangles { TriangleWords at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer PlacedMeshes { PlacedMesh at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer PlacedSceneAt { PlacedScene scene; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Numbers { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Places { vec3 at[]; };

// Number of the group: a dispatch that is too long for one row of groups is several rows of them, in z.
#define GROUP (gl_WorkGroupID.z * gl_NumWorkGroups.x + gl_WorkGroupID.x)
#define INVOCATION (GROUP * gl_WorkGroupSize.x + gl_LocalInvocationIndex)

const uint kNoSurface = 0xffffffffu;
const uint kNoInstance = 0xffffffffu;

// The nearest hit of a ray.
struct SceneHit {
  float distance;
  uint instance;  // kNoInstance: none.
  uint triangle;  // In the order of the mesh.
  float u, v;
};

// A ray as the boxes of a tree need it.
struct TreeRay {
  vec3 origin, direction, inverse;
  uint octant;  // Slots are visited in the order of their number, exclusive-or this, from the greatest.
};

TreeRay tree_ray(vec3 origin, vec3 direction) {
  const float kLeast = 1e-20;
  const vec3 held = mix(direction, vec3(kLeast), lessThan(abs(direction), vec3(kLeast)));
  const uint octant = (held.x < 0.0 ? 0 : 4) | (held.y < 0.0 ? 0 : 2) | (held.z < 0.0 ? 0 : 1);
  return TreeRay(origin, direction, vec3(1.0) / held, octant);
}

// Children of a node that a ray meets: bits 24..31 are nodes, in the order of TreeRay::octant; bits 0..23 are what leaves
// hold.
struct Met {
  uint first_child, first_leaf, bits, nodes;
};

vec4 bytes_of(uint word) {
  return vec4(word & 255u, word >> 8 & 255u, word >> 16 & 255u, word >> 24);
}

// Which of four slots a ray meets: the planes of their boxes that it passes first and last, in units of `scale` from
// `shift`.
bvec4 meets_four(uvec3 first, uvec3 last, vec3 scale, vec3 shift, float near, float far) {
  // A box is a little longer than it is, so that rounding loses no triangle in its faces.
  const float kLonger = 1.0000005;
  const vec4 enters = max(max(bytes_of(first.x) * scale.x + shift.x, bytes_of(first.y) * scale.y + shift.y),
                          max(bytes_of(first.z) * scale.z + shift.z, vec4(near)));
  const vec4 leaves = min(min(bytes_of(last.x) * scale.x + shift.x, bytes_of(last.y) * scale.y + shift.y),
                          bytes_of(last.z) * scale.z + shift.z);
  return lessThanEqual(enters, min(leaves * kLonger, vec4(far)));
}

// The bits of four slots, as TreeNode::kinds has them, of those that a ray meets.
uint bits_of(uint kinds, uint octants, bvec4 met) {
  const uint nodes = (kinds & kinds << 1) >> 4 & 0x01010101u;  // Those whose place is from 24 on.
  const uint places = (kinds ^ octants & nodes * 7u) & 0x1f1f1f1fu, bits = kinds >> 5 & 0x07070707u;
  return (met.x ? (bits & 255u) << (places & 255u) : 0u) |
         (met.y ? (bits >> 8 & 255u) << (places >> 8 & 255u) : 0u) |
         (met.z ? (bits >> 16 & 255u) << (places >> 16 & 255u) : 0u) | (met.w ? bits >> 24 << (places >> 24) : 0u);
}

Met meet_node(NodeWords node, TreeRay ray, float near, float far) {
  const uvec2 a = unpack32(node.words[0].x), b = unpack32(node.words[0].y);
  const uvec2 children = unpack32(node.words[1].x), kinds = unpack32(node.words[1].y);
  const uvec2 low_x = unpack32(node.words[2].x), low_y = unpack32(node.words[2].y), low_z = unpack32(node.words[3].x);
  const uvec2 high_x = unpack32(node.words[3].y), high_y = unpack32(node.words[4].x),
              high_z = unpack32(node.words[4].y);
  const bvec3 falls = lessThan(ray.inverse, vec3(0.0));
  const uvec2 first_x = falls.x ? high_x : low_x, last_x = falls.x ? low_x : high_x;
  const uvec2 first_y = falls.y ? high_y : low_y, last_y = falls.y ? low_y : high_y;
  const uvec2 first_z = falls.z ? high_z : low_z, last_z = falls.z ? low_z : high_z;
  const vec3 corner = uintBitsToFloat(uvec3(a, b.x));
  const vec3 unit = uintBitsToFloat(uvec3(b.y << 23, b.y << 15, b.y << 7) & 0x7f800000u);
  const vec3 scale = unit * ray.inverse, shift = (corner - ray.origin) * ray.inverse;
  const bvec4 one = meets_four(uvec3(first_x.x, first_y.x, first_z.x), uvec3(last_x.x, last_y.x, last_z.x), scale, shift,
                               near, far);
  const bvec4 two = meets_four(uvec3(first_x.y, first_y.y, first_z.y), uvec3(last_x.y, last_y.y, last_z.y), scale, shift,
                               near, far);
  const uint octants = ray.octant * 0x01010101u;
  return Met(children.x, children.y, bits_of(kinds.x, octants, one) | bits_of(kinds.y, octants, two), b.y >> 24);
}

TreeTriangle triangle_of(TriangleWords packed) {
  const uvec2 a = unpack32(packed.words[0]), b = unpack32(packed.words[1]), c = unpack32(packed.words[2]),
              d = unpack32(packed.words[3]), e = unpack32(packed.words[4]);
  return TreeTriangle(uintBitsToFloat(uvec3(a, b.x)), b.y, uintBitsToFloat(uvec3(c, d.x)),
                      uintBitsToFloat(uvec3(d.y, e)));
}

// Tests one triangle: as Embree does, so that both find the same.
void meet(TreeTriangle triangle, vec3 origin, vec3 direction, float near, uint instance, inout SceneHit hit) {
  const vec3 normal = cross(triangle.edge2, triangle.edge1);
  const vec3 from = triangle.corner - origin;
  const vec3 across = cross(from, direction);
  const float slope = dot(normal, direction);
  const float side = slope < 0.0 ? -1.0 : 1.0;
  const float size = abs(slope);
  const float u = side * dot(across, triangle.edge2), v = side * dot(across, triangle.edge1);
  const float reach = side * dot(normal, from);
  if (size > 0.0 && u >= 0.0 && v >= 0.0 && u + v <= size && reach > size * near && reach <= size * hit.distance) {
    const float scale = 1.0 / size;
    hit = SceneHit(reach * scale, instance, triangle.index, u * scale, v * scale);
  }
}

// What is left to visit: the first child of a node, with the bits of Met that are nodes and below them Met::nodes; or
// the first of what leaves hold, with the bits of that.
#define Group uvec2
const uint kNodeBits = 0xff000000u, kLeafBits = 0x00ffffffu;

bool has_nodes(Group group) {
  return (group.y & kNodeBits) != 0;
}

// The root, as if it were the only child of a node.
Group root_group(TreeRay ray) {
  return Group(0, 1u << (24 + ray.octant) | 1u);
}

// Nearest hit between `near` and `far`. With `any`, ends at the first hit found.
//
// Lanes walk together on all kinds of hardware, so they go down until each has found a leaf before any tests
// triangles; what is rarely needed is in a loop that is skipped where no lane needs it.
SceneHit trace(PlacedScene scene, vec3 origin, vec3 direction, float near, float far, const bool any) {
  SceneHit hit = SceneHit(far, kNoInstance, 0, 0.0, 0.0);
  PlacedMeshes instances = PlacedMeshes(scene.instances);
  TreeNodes nodes = TreeNodes(scene.nodes);
  TreeTriangles triangles = TreeTriangles(scene.nodes);
  TreeRay ray = tree_ray(origin, direction);
  uint instance = kNoInstance;  // The one whose tree is walked; kNoInstance in the upper level.
  Group stack[kTreeStack];
  int depth = 0, floor_of_tree = 0;
  Group group = root_group(ray), found = Group(0);
  while (true) {
    while (found.y == 0 && has_nodes(group)) {
      const uint bit = findMSB(group.y);
      const uint slot = (bit - 24) ^ ray.octant;
      const uint child = group.x + bitCount(group.y & 255u & ((1u << slot) - 1u));
      group.y &= ~(1u << bit);
      if (has_nodes(group)) {
        stack[depth++] = group;
      }
      const Met met = meet_node(nodes.at[child], ray, near, hit.distance);
      found = Group(met.first_leaf, met.bits & kLeafBits);
      group = Group(met.first_child, met.bits & kNodeBits | met.nodes);
      if (found.y == 0 && !has_nodes(group) && depth > floor_of_tree) {
        group = stack[--depth];
        if (!has_nodes(group)) {
          found = group;
        }
      }
    }
    while (instance != kNoInstance && found.y != 0) {
      const uint bit = findMSB(found.y);
      found.y &= ~(1u << bit);
      meet(triangle_of(triangles.at[found.x + bit]), ray.origin, ray.direction, near, instance, hit);
    }
    if (any && hit.instance != kNoInstance) {
      return hit;
    }
    // A leaf of the upper level holds an instance: its tree is next.
    for (bool enters = found.y != 0; enters; enters = false) {
      const uint bit = findMSB(found.y);
      found.y &= ~(1u << bit);
      if (found.y != 0) {
        stack[depth++] = found;
      }
      if (has_nodes(group)) {
        stack[depth++] = group;
      }
      instance = Numbers(scene.leaves).at[found.x + bit];
      const mat4x3 mesh_from_scene = instances.at[instance].mesh_from_scene;
      ray = tree_ray(mesh_from_scene * vec4(origin, 1.0), mat3(mesh_from_scene) * direction);
      nodes = TreeNodes(instances.at[instance].nodes);
      triangles = TreeTriangles(instances.at[instance].triangles);
      floor_of_tree = depth;
      found.y = 0;
      group = root_group(ray);
    }
    for (bool leaves = instance != kNoInstance && !has_nodes(group) && depth == floor_of_tree; leaves; leaves = false) {
      instance = kNoInstance;
      ray = tree_ray(origin, direction);
      nodes = TreeNodes(scene.nodes);
      floor_of_tree = 0;
    }
    if (!has_nodes(group)) {
      if (depth == floor_of_tree) {
        return hit;
      }
      group = stack[--depth];
      if (!has_nodes(group)) {
        found = group;
      }
    }
  }
}

// A surface as a ray hits it.
struct Surface {
  uint label;     // SurfaceLabel
  uint triangle;
  uint slot;      // Index of the material in the mesh.
  vec3 normal;    // Shading normal, of any length and side.
};

Surface surface_at(PlacedScene scene, SceneHit hit) {
  if (hit.instance == kNoInstance) {
    return Surface(kNoSurface, 0, 0, vec3(0.0));
  }
  const PlacedMesh placed = PlacedMeshes(scene.instances).at[hit.instance];
  Numbers corners = Numbers(placed.corners);
  Places normals = Places(placed.normals);
  const uint first = 3 * hit.triangle;
  const vec3 normal = (1.0 - hit.u - hit.v) * normals.at[corners.at[first]] + hit.u * normals.at[corners.at[first + 1]] +
                      hit.v * normals.at[corners.at[first + 2]];
  const uint slot = placed.slots == 0 ? 0 : Numbers(placed.slots).at[hit.triangle];
  return Surface(Numbers(placed.surfaces).at[slot], hit.triangle, slot, mat3(placed.scene_from_mesh) * normal);
}
