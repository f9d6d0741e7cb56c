// bottom.js -- the first return of the bottom in the pings of a side-scan sonar, as they come, each side by itself: the scores of
// docs/concepts/side-scan-products.md, where each ping is decided by itself and those before it.

import { rotate } from "../geometry.js";
import { levelDb } from "../link/decode.js";

const kMostCells = 512;
const kMedianReach = 3;      // cells to either side of a running median
const kLeastColumn = 4;      // shortest water column [cells]
const kDeepest = 60;         // level of silence below the median level [dB]
const kSteps = 64;           // classes of the histogram
const kCostlyChange = 0.02;  // change of range, as a share of all cells, that costs as much as the best score gains
const kForgets = 0.9;        // part of the gains that is left at the next ping: a jump is believed after some pings
const kAgree = 0.05;         // share of the range by which sides may differ that see the same bed
const kPings = 5;            // pings of the running median

/** Quality below which a first return is a guess. */
export const kNoBottom = 0.3;

/** Cosine of the pitch of a pose: altitude by range of the first return. */
export const pitchCosine = ({ orientation }) => Math.sqrt(Math.max(0, 1 - rotate(orientation, [1, 0, 0])[2] ** 2));

/** Follows the first return from ping to ping. */
export class BottomTracker {
  constructor(sonar) {
    this.sonar = sonar;
    this.group = Math.ceil(sonar.bins / kMostCells);
    this.count = Math.ceil(sonar.bins / this.group);
    this.length = this.group * sonar.binLength;
    this.window = Math.max(8, Math.round(0.03 * this.count));
    this.lead = Math.max(0, Math.ceil(((sonar.dead_range ?? 0) - sonar.min_range) / this.length));
    this.gains = Array.from({ length: sonar.beams }, () => new Float64Array(this.count));
    this.last = [];  // ranges of the last pings, newest last [m]
  }

  /** { range [m], quality 0 to 1 } of a ping by its levels [bin][beam]. */
  add(level) {
    const [port, starboard] = this.gains.map((gain, beam) => this.#side(gain, level, beam));
    const before = this.last.at(-1) ?? Infinity;  // At first the farther one: what is nearer may be on the bed.
    const farther = Math.max(port.range, starboard.range);
    const agree = farther - Math.min(port.range, starboard.range) <= kAgree * farther;
    const isNearer = (a, b) => Math.abs(a.range - before) <= Math.abs(b.range - before);
    const one = before === Infinity ? port.range >= starboard.range : isNearer(port, starboard);
    const { range, quality } = agree ? meanOf(port, starboard) : one ? port : starboard;
    this.last = [...this.last, range].slice(-kPings);
    const sorted = [...this.last].sort((a, b) => a - b);
    return { range: sorted[sorted.length >> 1], quality };
  }

  // The first return of one side.
  #side(gain, level, beam) {
    const levels = this.#levels(level, beam);
    const scores = this.#scores(levels);
    this.#spread(gain);
    let best = 0;
    for (let cell = 0; cell < this.count; ++cell) {
      gain[cell] += scores[cell];
      if (gain[cell] > gain[best]) best = cell;
    }
    return { range: this.sonar.min_range + footOf(levels, this.lead, best, this.window) * this.length, quality: scores[best] };
  }

  // Levels of the cells of a beam [dB], by a running median.
  #levels(level, beam) {
    const { beams, bins } = this.sonar;
    const raw = new Float64Array(this.count).fill(-Infinity);
    for (let bin = 0; bin < bins; ++bin) {
      const cell = Math.floor(bin / this.group);
      raw[cell] = Math.max(raw[cell], levelDb(level[bin * beams + beam]) ?? -Infinity);
    }
    const heard = [...raw].filter(Number.isFinite).sort((a, b) => a - b);
    const least = heard.length > 0 ? Math.max(heard[0], heard[heard.length >> 1] - kDeepest) : 0;
    for (let cell = 0; cell < this.count; ++cell) raw[cell] = Math.max(raw[cell], least);
    return Float64Array.from(raw, (_, cell) => {
      const near = raw.slice(Math.max(0, cell - kMedianReach), cell + kMedianReach + 1).sort();
      return near[near.length >> 1];
    });
  }

  // How likely each cell is the first of the bed: (1 - e^-d) e^3.
  #scores(levels) {
    const within = momentsOf(levels);
    const before = new Histogram(levels);
    const scores = new Float64Array(this.count);
    const middle = (from, to) => this.sonar.min_range + ((from + to) / 2) * this.length;
    for (let cell = this.lead; cell + kLeastColumn < this.count; ++cell) {
      if (cell - this.lead >= kLeastColumn) {
        const [begin, end] = [Math.max(this.lead, cell - this.window), Math.min(this.count, cell + this.window)];
        const [dark, bright] = [within(begin, cell), within(cell, end)];
        const ramp = 30 * Math.log10(middle(cell, end) / middle(begin, cell));
        const step = (bright.mean - dark.mean - ramp) / (bright.deviation + dark.deviation + 1);
        if (step > 0) scores[cell] = (1 - Math.exp(-step)) * before.below((bright.mean + dark.mean) / 2) ** 3;
      }
      before.add(levels[cell]);
    }
    return scores;
  }

  // What each cell has gained by the best way to it.
  #spread(gain) {
    const { count } = this;
    const cost = 1 / (kCostlyChange * count);
    for (let cell = 0; cell < count; ++cell) gain[cell] *= kForgets;
    for (let cell = 1; cell < count; ++cell) gain[cell] = Math.max(gain[cell], gain[cell - 1] - cost);
    for (let cell = count - 1; cell > 0; --cell) gain[cell - 1] = Math.max(gain[cell - 1], gain[cell] - cost);
  }
}

const meanOf = (a, b) => ({ range: (a.range + b.range) / 2, quality: (a.quality + b.quality) / 2 });

// Mean and standard deviation of levels [from, to), by running sums.
function momentsOf(levels) {
  const sums = new Float64Array(levels.length + 1);
  const squares = new Float64Array(levels.length + 1);
  levels.forEach((value, i) => {
    sums[i + 1] = sums[i] + value;
    squares[i + 1] = squares[i] + value * value;
  });
  return (from, to) => {
    const mean = (sums[to] - sums[from]) / (to - from);
    return { mean, deviation: Math.sqrt(Math.max(0, (squares[to] - squares[from]) / (to - from) - mean * mean)) };
  };
}

// Shares of the levels added so far that lie below others.
class Histogram {
  #counts = new Uint32Array(kSteps);
  #all = 0;

  constructor(levels) {
    this.low = levels.reduce((a, b) => Math.min(a, b));
    this.step = Math.max(1e-9, (levels.reduce((a, b) => Math.max(a, b)) - this.low) / kSteps);
  }

  #class(level) {
    return Math.max(0, Math.min(kSteps - 1, Math.floor((level - this.low) / this.step)));
  }

  add(level) {
    ++this.#counts[this.#class(level)];
    ++this.#all;
  }

  below(level) {
    let below = 0;
    for (let i = this.#class(level); i >= 0; --i) below += this.#counts[i];
    return this.#all > 0 ? below / this.#all : 0;
  }
}

// The first cell of an edge whose level is above all of the water column before it.
function footOf(levels, lead, edge, window) {
  const end = Math.max(edge - window, Math.min(edge, lead + kLeastColumn));
  const begin = Math.max(lead, edge - 3 * window);
  if (end <= begin) return edge;
  const column = momentsOf(levels)(begin, end);
  const bottom = column.mean + Math.max(4 * column.deviation, 2);
  const isFlank = (cell) => levels[cell] < levels.slice(cell, cell + 5).reduce((a, b) => Math.max(a, b)) - 20;
  let foot = Math.min(levels.length - 1, edge + (window >> 1));
  while (foot > edge && levels[foot] <= bottom) --foot;
  while (foot > lead && levels[foot - 1] > bottom) --foot;
  while (foot < edge && isFlank(foot)) ++foot;
  return foot;
}
