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
struct vec3 {
  float x, y, z;
};
struct mat3x4 {
  float values[12];  ///< Column after column.
};

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

/// Beams of a block of gains: GainMatrix::kBlockBeams.
SHARED uint kGainBeams = 8U;

/// Bins of a block of noise: kTileBins.
SHARED uint kNoiseBlock = 64U;

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

/// Values of every sample of a ping, [column][row].
struct Samples {
  address surface;       ///< uint, SurfaceLabel
  address triangle;      ///< uint, in the mesh.
  address range;         ///< float
  address normal;        ///< vec3, unit length, without relief.
  address gradient;      ///< vec3, see ReliefPoint; 0: no surface of the scene has a relief.
  address reflectivity;  ///< float: `paper` of the material times that of the relief; `calibrated` of the relief alone.
  address facing;        ///< float, see HitColumn.
  address power;         ///< float, see HitColumn.
  address joined;        ///< uint, see FootprintSegments: with the sample above.
  address turn_up;       ///< `calibrated`: vec3, see HitColumn::turn_up_x.
  address reached;       ///< float, see HitColumn; 0: all surfaces are opaque.
  address passed;        ///< The same.
};

/// The sums of a ping, in fixed point: see cells.glsl.
struct Cells {
  address energy, weight;  ///< int64[order][beam][bin]
  address first_surface;   ///< uint[beam][bin]: index + 1 of a SurfaceSum; 0 for none. One surface may have several.
  address surfaces;        ///< SurfaceSum[]
  address counter;         ///< Counter
  address met_before;      ///< int64[beam]
  uint most_surfaces;
  uint labelled;  ///< 0: no labels; 1: with; 2: with squares of elevations.
};
struct SurfaceSum {
  uint key;   ///< SurfaceLabel + 1; 0 until it is taken.
  uint next;  ///< Index + 1 of the next in the list of the cell; 0: none.
  int64 energy, moment, square;
};
struct Counters {
  uint surfaces;             ///< SurfaceSums taken; those from Cells::most_surfaces on found no room.
  uint reflected;            ///< Hits that reflect a ray.
  uint returns;              ///< Return legs traced.
  uint groups[3];            ///< Groups of the kernel that reflects them.
  uint further;              ///< FurtherSums that the host is given.
  uint behind[kMostPassed];  ///< Rays that are continued behind their first, second ... surface.
};

/// What the host reads of a ping: the Cells as an EchoGrid has them. `square` is there where labelled is 2.
struct GridLayers {
  address energy, weight;                           ///< float[order][beam][bin]
  address surface, surface_energy, moment, square;  ///< uint or float[beam][bin]: the strongest surface of a cell.
  address further;                                  ///< FurtherSum[]
  address used;        ///< uint[beam][2]: bins after the first that is used, and the last of these + 1; 0: none.
  address met_before;  ///< float[beam]
  uint orders;
};

/// A surface of a cell that is not its strongest. Those of a cell follow each other.
struct FurtherSum {
  uint cell;     ///< beam x bins + bin
  uint surface;  ///< SurfaceLabel
  float energy, moment, square;
};

/// A hit that reflects a ray.
struct Reflecting {
  uint column, row;
  float selected;  ///< How many hits it stands for.
};

/// A GainTable of the host: gains of kGainBeams beams for each row, in blocks of beams.
struct Gains {
  address gains;  ///< float[block][row][kGainBeams]; 0: none.
  address bands;  ///< uint[block][2] First row, and last + 1.
};
struct GainsOfZone {
  uint end;  ///< Bin.
  Gains in_phase, quadrature;
};

/// What FlatReceiver holds, see there.
struct ReceiverTables {
  uint cells, bins, beams, cells_per_beam;
  float first_range, bin_length;                              ///< RangeBins
  float window_share, layers_per_step, jump, jump_angle;      ///< LatticeShape
  int smoothed_bins;                                          ///< The same.
  uint first_turns, turns_per_bin;                            ///< SpeckleShape
  float turns_per_window, bins_per_window, shared_intensity;  ///< The same.
  float spread_share, turns_per_chance, spread_half;          ///< ScattererPhases
  uint has_pulse;
  float look_share, look_pairs;
  int first_tap;
  uint tap_count, zone_count, noise_rows, noise_tap_count;
  uint seed[2];
  address first_cells;  ///< uint[beam]
  address volume;       ///< float[bin]; 0: none.
  address cell_angle;   ///< float[cell]
  address taps, noise_taps;
  address zones;  ///< GainsOfZone[]; 0: beams are cells.
  Gains noise_gains;
};

/// LatticeAxes of the host.
struct BearingLattice {
  double ahead, up;
  uint key[4];
  float across_turns;
  float ahead_level, ahead_normal, up_level, up_normal;
  uint ahead_whole;
  float ahead_rest, ahead_in_layers;
  int ahead_layer;
  uint up_whole;
  float up_rest, up_in_layers;
  int up_layer;
};

/// An Echo of the host, see echo.h.
struct SpreadEcho {
  float azimuth, elevation, path_length, half_length, power, weight;
  uint order, surface;
};

/// Where a ping is received. What is [cell] has the rows of cells that the array forms beams from.
struct ReceptionAt {
  address tables;     ///< ReceiverTables; 0: the host receives.
  address axes;       ///< BearingLattice[frame][cell]: frame 0 is the world, the others are moved objects.
  address instances;  ///< uint[frame - 1]
  address deviation;  ///< float[beam] Of the noise.
  address echoes;     ///< SpreadEcho[] of sources.
  uint echo_count, frames;
  uint number[2];  ///< Of the ping.
  // Between the steps:
  address energy;               ///< float[cell][bin]
  address elevation, smoothed;  ///< float[cell][bin] Of the surface; smoothed once.
  address segment;              ///< uint[cell][bin] The bins of one surface: first | end << 16.
  address field;                ///< vec2[cell][bin]
  address before, after;        ///< vec2[cell][bin] What scatterers share with other bins; 0: nothing.
  address pulsed;               ///< vec2[cell][bin] The field after the pulse.
  address white, noise;         ///< float[row][part][...]: the noise before and after its filter, see draw_noise.
  // What the host reads:
  address beams;            ///< vec2[beam][bin]
  address surface;          ///< uint[beam][bin]
  address label_elevation;  ///< float[beam][bin]
};

/// A ping of a batch.
struct PingAt {
  address plan;            ///< PlanTables
  address scene;           ///< PlacedScene
  address reflectivity;    ///< float[material]
  vec3 sonar;              ///< Position [m].
  vec3 forward, port, up;  ///< Its axes.
  uint sampling;           ///< SecondarySampling
  Samples samples;
  Cells cells;
  GridLayers layers;
  address reflecting;  ///< Reflecting[columns * rows]
  ReceptionAt reception;
};

/// How many groups compute what lies behind one more surface, of the kernels that work through tiles of samples,
/// samples, and intervals between them. The first numbers are 0 until a ray is continued there.
struct LayerGroups {
  uint tiles[3], samples[3], intervals[3];
  uint wanted[3];  ///< What the first numbers become then.
};

/// What the kernels of a ping are passed.
struct PingJob {
  address pings;  ///< PingAt[]; a row of groups for each, from the first on.
  uint first;
  uint most_groups;    ///< In one row of groups.
  address next_layer;  ///< LayerGroups; 0: no ray is continued behind what it hits.
  uint layer;          ///< How many surfaces sound has passed.
  uint smoothed;       ///< How often elevations have been smoothed.
};

#undef SHARED

#ifdef __cplusplus
}  // namespace insonify::shader
#endif
