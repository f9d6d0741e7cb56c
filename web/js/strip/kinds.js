// kinds.js -- what the rows of a waterfall hold and where things lie across it: both sides of a side-scan sonar, depths of a swath,
// or the ranges of a beam.
//
// Across a waterfall a share runs from 0 at its left edge to 1 at the right. A place is { beam, range, azimuth, bin } of a row's ping.

import { number, ringSpacing, ticks } from "../format.js";
import { degrees, radians, sonarPoint, toWorld } from "../geometry.js";
import { levelDb } from "../link/decode.js";
import { seenAt, worldPoint } from "../measure.js";
import { productIn } from "../product.js";
import { beamAt, binAt, binRange } from "../sonar.js";
import { bedPoint, groundRange, offsetsOf, passesOf } from "./place.js";

const metresText = (range) => `${number(range, Number.isInteger(range) ? 0 : 1)} m`;
const kAngles = [5, 10, 15, 20, 30, 45];  // between labels of a swath [degrees]
const kAngleWidth = 56;                   // room for a label [pixels]
const within = (value, least, most) => Math.max(least, Math.min(most, value));

// The strongest of each group of bins of a beam, or of all beams where that is -1.
function pooled(ping, beam, group, columns) {
  const { level } = ping.tables;
  const values = new Uint16Array(columns);
  for (let bin = 0; bin < ping.bins; ++bin) {
    const column = Math.floor(bin / group);
    const start = bin * ping.beams;
    let value = beam >= 0 ? level[start + beam] : 0;
    if (beam < 0) for (let i = start; i < start + ping.beams; ++i) if (level[i] > value) value = level[i];
    if (value > values[column]) values[column] = value;
  }
  return values;
}

/** Port to the left, starboard to the right, the track in the middle, by slant range or by range on a level bed. */
const kSides = {
  heights: false,
  columns: (sonar, group) => 2 * Math.ceil(sonar.bins / group),
  values(sonar, ping, { group, columns }) {
    const reach = columns / 2;
    const values = new Uint16Array(columns);
    values.set(pooled(ping, 0, group, reach).reverse());
    values.set(pooled(ping, 1, group, reach), reach);
    return values;
  },
  // The row keeps its levels for the A-scan and the figures under the cursor.
  kept: (ping) => ({ beams: ping.beams, bins: ping.bins, tables: { level: ping.tables.level.slice() } }),
  caption: (sonar, { corrected }) => `Port   |   starboard   ${corrected ? "ground range" : "slant range"}`,
  share(sonar, row, { beam, range }, { corrected }) {
    const across = corrected ? groundRange(range, row.bottom) : range;
    return 0.5 + ((beam === 0 ? -0.5 : 0.5) * across) / sonar.max_range;
  },
  at(sonar, row, share, { corrected }) {
    const across = 2 * Math.abs(share - 0.5) * sonar.max_range;
    const range = corrected ? Math.hypot(across, row.bottom ?? 0) : across;
    const beam = share < 0.5 ? 0 : 1;
    const bin = binAt(sonar, range);
    return bin < 0 ? null : { beam, bin, range, azimuth: sonar.beamAzimuths[beam] };
  },
  point: (sonar, row, { beam, range }) => bedPoint(row, beam, range),
  seen(sonar, row, point) {
    const { port, range } = offsetsOf(row, point);
    return range < sonar.max_range ? { beam: port >= 0 ? 0 : 1, range } : null;
  },
  passes: passesOf,
  step: (sonar, { bin, beam }, bins) => {
    const next = beam === 0 ? bin - bins : bin + bins;  // To the right is towards the track on the port side.
    const [side, to] = next >= 0 ? [beam, next] : [1 - beam, -next - 1];
    return { beam: side, bin: within(to, 0, sonar.bins - 1) };
  },
  ticks(sonar) {
    const spacing = ringSpacing(sonar.max_range);
    const ranges = ticks(spacing, sonar.max_range, spacing);
    return [{ share: 0.5, text: "0" }, ...[-0.5, 0.5].flatMap((side) => ranges.map((range) => ({ share: 0.5 + (side * range) / sonar.max_range, text: metresText(range) })))];
  },
};

/** Soundings of a multibeam, a column for each beam. */
const kDepths = {
  heights: true,
  columns: (sonar) => sonar.beams,
  values(sonar, ping) {
    const ranges = ping.tables.sounding_range;
    return Float32Array.from({ length: sonar.beams }, (_, beam) => {
      const range = ranges?.[beam] ?? NaN;
      return Number.isFinite(range) ? toWorld(ping.pose, sonarPoint(range, sonar.beamAzimuths[beam]))[2] : NaN;
    });
  },
  kept: (ping) => ({ ranges: ping.tables.sounding_range?.slice() }),
  caption: () => "Swath",
  share: (sonar, row, { azimuth }) => {
    const beam = beamAt(sonar, azimuth);
    return beam < 0 ? NaN : (beam + (sonar.ports[beam] - azimuth) / (sonar.ports[beam] - sonar.starboards[beam])) / sonar.beams;
  },
  at(sonar, row, share) {
    const beam = within(Math.floor(share * sonar.beams), 0, sonar.beams - 1);
    const range = row.ranges?.[beam];
    return Number.isFinite(range) ? { beam, range, azimuth: sonar.beamAzimuths[beam], bin: Math.max(0, binAt(sonar, range)) } : null;
  },
  point: (sonar, row, { azimuth, range }) => toWorld(row.pose, sonarPoint(range, azimuth)),
  seen(sonar, row, point) {
    const { range, azimuth } = seenAt(row.pose, point);
    return beamAt(sonar, azimuth) >= 0 ? { range, azimuth } : null;
  },
  passes: passesOf,
  step: (sonar, { beam }, beams) => ({ beam: within(beam + beams, 0, sonar.beams - 1) }),
  ticks(sonar, width) {
    const [port, starboard] = [degrees(sonar.ports[0]), degrees(sonar.starboards.at(-1))];
    const step = kAngles.find((each) => ((port - starboard) / each) * kAngleWidth <= width) ?? 90;
    return ticks(starboard, port, step).map((angle) => ({
      share: this.share(sonar, null, { azimuth: radians(angle) }),
      text: angle === 0 ? "0°" : `${number(Math.abs(angle))}° ${angle > 0 ? "P" : "S"}`,
    })).filter(({ share }) => Number.isFinite(share));
  },
};

/** A beam, or the strongest of all, over range. */
const kRanges = {
  heights: false,
  columns: (sonar, group) => Math.ceil(sonar.bins / group),
  values: (sonar, ping, { group, columns, beam }) => pooled(ping, beam, group, columns),
  kept: (ping, sonar, { beam }) => ({ azimuth: beam < 0 ? null : sonar.product.azimuth(sonar, ping, beam), beam }),
  share: (sonar, row, { range }) => (range - sonar.min_range) / (sonar.max_range - sonar.min_range),
  at(sonar, row, share) {
    const range = sonar.min_range + share * (sonar.max_range - sonar.min_range);
    const bin = binAt(sonar, range);
    return bin < 0 || row.azimuth === null ? null : { beam: Math.max(0, row.beam), bin, range, azimuth: row.azimuth };
  },
  point: (sonar, row, { range, azimuth }) => worldPoint(sonar, row.pose, { range, azimuth }, undefined, row.ground),
  seen: () => null,
  passes: () => [],
  step: (sonar, { bin, beam }, bins) => ({ beam, bin: within(bin + bins, 0, sonar.bins - 1) }),
  ticks(sonar) {
    const spacing = ringSpacing(sonar.max_range);
    return ticks(Math.max(sonar.min_range, spacing), sonar.max_range, spacing)
      .map((range) => ({ share: this.share(sonar, null, { range }), text: metresText(range) }));
  },
};

/** The kind of waterfall of a sonar; `shows` is strongest, beam or depths. */
export const stripKind = (sonar, shows) => (sonar.product.sides ? kSides : sonar.down && shows === "depths" ? kDepths : kRanges);

/** Loudest level of a row with the display's gain by range [dB]. */
export function peakOf(sonar, values, group, tvg) {
  let peak = -Infinity;
  values.forEach((value, column) => {
    if (value > 0) peak = Math.max(peak, levelDb(value) + tvg * Math.log10(Math.max(binRange(sonar, (column + 0.5) * group - 0.5), 0.01)));
  });
  return peak;
}

/** Whether ruler and markers have places in the waterfall of the watched sonar. */
export const stripMeasures = (store) => productIn(store).sides || store.get("sonar")?.down || productIn(store).gathers || store.get("waterfallOf") === "beam";
