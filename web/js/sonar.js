// sonar.js -- beams and bins of the watched sonar: from indices to ranges and azimuths, and back.

import { radians, wrapped } from "./geometry.js";
import { kRoundSlots, productOf } from "./product.js";

/** Adds to a SONAR of `hello` what drawing needs; angles in rad. */
export function describeSonar(sonar) {
  const azimuths = sonar.azimuths.map(radians);
  const aperture = radians(sonar.azimuth_aperture ?? 0);
  const product = productOf(sonar);
  // The picture has both sides of a side-scan sonar side by side, however narrow its beams are.
  const edges = product.sides
    ? [Math.PI / 2, 0, -Math.PI / 2]
    : sonar.azimuth_edges?.map(radians) ?? edgesOf(azimuths, aperture);
  // Edges between beams; where there are gaps between beams, both edges of each in turn.
  const each = edges.length > azimuths.length + 1 ? 2 : 1;
  const down = sonar.type === "mbes";
  const vertical = product.gathers && sonar.mounting === "vertical";
  return {
    ...sonar,
    product,
    vertical,
    // A vertical head's port side points up: up is drawn upwards, and the housing's front to the right.
    up: vertical ? Math.PI / 2 : 0,  // azimuth that is drawn upwards
    down,
    sign: down ? -1 : 1,  // of what is ahead in the plane of the fan: a multibeam looks down
    beamAzimuths: azimuths,
    ports: azimuths.map((_, beam) => edges[each * beam]),
    starboards: azimuths.map((_, beam) => edges[each * beam + 1]),
    binLength: (sonar.max_range - sonar.min_range) / sonar.bins,
    azimuthAperture: aperture,
    elevationAperture: radians(sonar.elevation_aperture ?? 20),
    elevationCentre: radians(sonar.elevation_center ?? 0),
  };
}

// Halfway between the centres; the outer edges as far from theirs as the next ones.
function edgesOf(azimuths, aperture) {
  const beams = azimuths.length;
  const edges = new Array(beams + 1);
  for (let b = 1; b < beams; ++b) edges[b] = (azimuths[b - 1] + azimuths[b]) / 2;
  edges[0] = beams > 1 ? 2 * azimuths[0] - edges[1] : azimuths[0] + aperture / 2;
  edges[beams] = beams > 1 ? 2 * azimuths[beams - 1] - edges[beams - 1] : azimuths[0] - aperture / 2;
  return edges;
}

/** Whether a scanning head turns to an azimuth [rad]. */
export const inSector = (sonar, azimuth) =>
  Math.abs(wrapped(azimuth - radians(sonar.sector_center ?? 0))) <= radians(sonar.sector_width ?? 360) / 2;

export const binRange = (sonar, bin) => sonar.min_range + (bin + 0.5) * sonar.binLength;

/** Bin at a range, or -1. */
export function binAt(sonar, range) {
  const bin = Math.floor((range - sonar.min_range) / sonar.binLength);
  return bin >= 0 && bin < sonar.bins ? bin : -1;
}

/** Beam whose slice holds an azimuth [rad], or -1. Edges fall from port to starboard. */
export function beamAt({ ports, starboards }, azimuth) {
  if (azimuth < starboards.at(-1)) return -1;
  let low = 0;
  let high = ports.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (azimuth < starboards[middle]) low = middle + 1;
    else high = middle;
  }
  return azimuth <= ports[low] ? low : -1;
}

/** Beams by azimuth: table[i] is the beam, with its fraction, from the port to the starboard edge of the fan, evenly; -1 in a gap. */
export function beamTable({ ports, starboards }, size) {
  const last = ports.length - 1;
  const table = new Float32Array(size);
  let beam = 0;
  for (let i = 0; i < size; ++i) {
    const azimuth = ports[0] + ((starboards[last] - ports[0]) * i) / (size - 1);
    while (beam < last && azimuth < starboards[beam]) ++beam;
    table[i] = azimuth > ports[beam] ? -1 : beam + (ports[beam] - azimuth) / (ports[beam] - starboards[beam]);
  }
  return table;
}

/** Column of the round picture that an azimuth [rad] falls in: 0 is right behind, clockwise by starboard last. */
export function slotAt(azimuth) {
  const turn = 0.5 - azimuth / (2 * Math.PI);
  // Azimuths that differ by rounding alone are in the same column, also at its edge.
  return Math.floor((turn - Math.floor(turn)) * kRoundSlots + 1e-6) % kRoundSlots;
}
