// ping_layout.h -- what the kernels of a ping read and write, as layout.h has what scenes and plans are.

#ifdef __cplusplus
#pragma once

#include "echo/gpu/shaders/layout.h"

namespace insonify::shader {
#endif

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
  address deviation;  ///< float[beam] Standard deviation of the noise in each part.
  address echoes;     ///< SpreadEcho[] of sources.
  uint echo_count, frames;
  uint number[2];  ///< The ping's number: its lower and upper 32 bits.
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

#ifdef __cplusplus
}  // namespace insonify::shader
#endif
