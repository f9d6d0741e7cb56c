// layout.h -- structures that the host writes and shaders read, and the constants that both need, in the common subset
// of C++ and GLSL. Scalar layout: as C++ lays them out, without padding of vectors. Addresses are those of buffers on
// the device.

#ifdef __cplusplus
#pragma once

#include <cstdint>

namespace insonify::shader {

#define SHARED inline constexpr
using uint = std::uint32_t;
using address = std::uint64_t;
using int64 = std::int64_t;
// NOLINTBEGIN(readability-identifier-naming): GLSL's names.
struct vec3 {
  float x, y, z;
};
struct mat3x4 {
  float values[12];  ///< Column after column.
};
// NOLINTEND(readability-identifier-naming)

#else
#define SHARED const
#define address uint64_t
#define int64 int64_t
#define mat3x4 mat4x3  // Four columns of three rows: a rotation and an offset.
#endif

/// Invocations of a group, in all kernels but count_groups.
SHARED uint kGroup = 64U;

/// Columns, and rows, of the tile of samples that a group of trace_primaries traces.
SHARED uint kTile = 8U;

/// Units of sums in fixed point that are one: 2^52.
SHARED float kUnits = 4503599627370496.0F;

/// Most entries that a ray's stack needs: TreeDepth::kInstances + kTriangles, and what is left of a leaf.
SHARED int kTreeStack = 40;

/// Most surfaces that sound passes through on the way to an echo, see see_through.h.
SHARED uint kMostPassed = 8U;

/// Beams of a block of gains: GainTable::kBlockBeams.
SHARED uint kGainBeams = 8U;

/// Numbers of a row of noise that one draw makes: FlatReceiver::kNoiseBlock.
SHARED uint kNoiseBlock = 64U;

/// RandomPurpose::kNoiseInPhase; that of the imaginary part is the next.
SHARED uint kNoiseInPhase = 4U;

/// SecondarySampling
SHARED uint kSampleNone = 0U, kSampleSome = 1U, kSampleAll = 2U;

/// Tables of a material in PlanTables::by_angle, see ScatterTable.
SHARED uint kAngleSteps = 512U, kAngleNodes = kAngleSteps + 2U, kReflectance = 0U, kBackscatter = kAngleNodes,
            kDiffuse = 2U * kAngleNodes, kMirrored = 3U * kAngleNodes, kAngleStride = 4U * kAngleNodes;

/// A node with up to eight children, whose boxes are rounded outwards to 1/255 of its own: Ylitie, Karras and Laine,
/// "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", HPG 2017. A child is in the slot of the
/// octant that it lies in, so that slots are visited from near to far for any direction.
struct TreeNode {
  vec3 low;     ///< Low corner of the node's box.
  uint scales;  ///< Byte 0..2: exponent + 127 of the unit of low and high along x, y, z; byte 3: bit s is set where
                ///< slot s is a node.
  uint first_child;  ///< Children that are nodes follow each other from here on, by slot.
  uint first_leaf;   ///< Leaves' contents follow each other from here on, by slot.
  uint kinds[2];  ///< A byte a slot. Node: 1 in the upper three bits, 24 + slot in the lower five. Leaf: as many ones
                  ///< as it holds in the upper three, its place after first_leaf in the lower five. Empty: 0.
  uint lows[6];   ///< A byte a slot, eight for each axis.
  uint highs[6];
};

/// A triangle in the order of the tree's leaves: a corner, and the edges that Moeller and Trumbore's test needs.
struct TreeTriangle {
  vec3 corner;
  uint index;  ///< In the mesh.
  vec3 edge1;  ///< Corner 0 - corner 1.
  vec3 edge2;  ///< Corner 2 - corner 0.
};

/// An instance of a mesh.
struct PlacedMesh {
  mat3x4 mesh_from_scene;
  mat3x4 scene_from_mesh;
  address nodes;      ///< TreeNode[]
  address triangles;  ///< TreeTriangle[]
  address corners;    ///< uint[3 * triangle]
  address vertices;   ///< vec3[]
  address normals;    ///< vec3[]
  address slots;      ///< uint[triangle]; 0: all are slot 0.
  address surfaces;   ///< uint[slot], SurfaceLabel.
  address thickness;  ///< float[triangle], see LeftOut; 0: none is thin.
  address glinting;   ///< uint[triangle], see LeftOut; 0: none glints.
  address face_of;    ///< uint[triangle], see MeshFaces; 0: all is curved.
  address faces;      ///< PlaneFace[]
  address reliefs;    ///< ReliefTiles[slot]; 0: no slot has a relief.
  address texture;    ///< vec2[triangle][corner], texture coordinates where a relief needs them; 0: none.
};

/// A Relief.
struct ReliefTiles {
  address slopes;   ///< vec2[row][column]; 0: flat.
  address factors;  ///< float[row][column] on the reflectivity; 0: all are 1.
  int slope_columns, slope_rows;
  int factor_columns, factor_rows;
  float tile_size;  ///< [m]; 0: only by texture coordinates.
  uint rise_per_tile, by_position;
};

/// A Face of the host, in the mesh frame.
struct PlaneFace {
  vec3 corner;
  vec3 axes[2];
  float middle[2], half_length[2];
};

/// A scene as it is at one ping.
struct PlacedScene {
  address nodes;      ///< TreeNode[] over the instances.
  address leaves;     ///< uint[], instances in the order of the leaves.
  address instances;  ///< PlacedMesh[]
  float water_level;  ///< z of the water's surface [m].
  uint water;         ///< Its SurfaceLabel; kNoSurface where the scene has none.
};

/// A ray to trace alone, and what it hits.
struct LooseRay {
  vec3 origin;
  float near;
  vec3 direction;
  float far;
};
struct LooseHit {
  float distance;  ///< Negative for a miss.
  uint surface;    ///< SurfaceLabel
  vec3 normal;     ///< Shading normal with relief, of any length, on the side that the ray comes from.
  float texture;   ///< Factor of the relief on the reflectivity.
};

/// What the kernel trace_rays is passed.
struct TraceRays {
  address scene;  ///< PlacedScene
  address rays;   ///< LooseRay[]
  address hits;   ///< LooseHit[]
  uint count;
};

/// What FlatPlan holds, see there: numbers, and addresses of tables.
struct PlanTables {
  uint columns, rows, columns_per_beam, beams, bins;
  uint cone;                             ///< 1 for BeamShape::kCone, 0 for kWedge.
  uint calibrated;                       ///< 1 for EchoModel::kCalibrated, 0 for kPaper.
  uint shaped;                           ///< `paper`: whether strengths go through the sigmoid.
  float slope, midpoint, scale, offset;  ///< `paper`: the sigmoid's.
  float neper_per_metre, true_max_range, reach, bins_per_metre, first_bin_at, middle_elevation, beams_per_radian;
  uint stagger;
  // `calibrated`:
  uint materials;      ///< Index of the zeros at the end of each table of materials.
  uint on_top;         ///< Whether any AngularScattering::backscatter is not 0.
  uint rough_mirrors;  ///< As in PlanNumbers.
  uint has_facets;     ///< FlatPlan::has_facets()
  uint max_surfaces, two_way, sends_apart;
  uint selective;  ///< Whether `secondary` is SecondaryEchoes::kSelective.
  float thin_per_metre, wavelength, tan_low, tan_high;
  float transmitter_length;                                  ///< FanPattern::length()
  float sent_low, sent_steps, received_low, received_steps;  ///< PatternAxis
  uint sent_count, received_count;                           ///< Values of the tables across elevations.
  address sent_across, received_across;                      ///< float[count]
  address lambert, lobe, steepness;                          ///< float[material], see Scatterer.
  address facets;                                            ///< float[material], 1 / (8 pi s^2).
  address roughness;                                         ///< float[material], Scattering::roughness.
  address facet_roughness;                                   ///< float[material], ScatterTable::roughness().
  address mirrored;                                          ///< float[material], ScatterTable::mirrored().
  address by_angle;                                          ///< float[material][kAngleStride]; 0: none.
  address passed;       ///< float[material][kAngleNodes], see ScatterTable::fill_passed(); 0: all surfaces are opaque.
  address transmitted;  ///< float[column]
  address row_pattern, reciprocal;  ///< float[set][row]
  address full_share;               ///< float[set], see share_out_energy().
  // Both models:
  address bin_scale;                                                        ///< float[bin], see bin_scales().
  address cos_azimuth, sin_azimuth, azimuth, column_width, column_measure;  ///< float[column]
  address row_set, touching;                                                ///< uint[column]
  address elevation, cos_t, sin_t, share;                                   ///< float[set][row]
  address interval;                                                         ///< float[set][row + 1]
  address edges;                                                            ///< float[set][4]
  address port_edges, starboard_edges;                                      ///< float[beam]
};

#undef SHARED

#ifdef __cplusplus
}  // namespace insonify::shader
#endif
