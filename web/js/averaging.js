// averaging.js -- levels over several pings, as a sonar's own display shows them: their mean, or echoes that fade.

const kFade = 150;  // by which an echo that is gone gets weaker a ping [0.01 dB]

/** What `over` may be: the number of pings of a mean, or how the last ones persist. */
export const kOver = [["none", "Each ping"], ["2", "Mean of 2 pings"], ["4", "Mean of 4 pings"], ["8", "Mean of 8 pings"], ["16", "Mean of 16 pings"], ["persist", "Persistence"]];

let intensities = null;  // of the values of the table `level`

function intensityOf(value) {
  intensities ??= Float64Array.from({ length: 65536 }, (_, i) => (i === 0 ? 0 : 10 ** (i / 1000 - 40)));
  return intensities[value];
}

const valueOf = (intensity) => (intensity > 0 ? Math.max(1, Math.round(1000 * (Math.log10(intensity) + 40))) : 0);

/** Levels of a sonar that gathers them ping by ping. */
export class Averager {
  #key = "";
  #last = null;  // { number, levels }
  #mean = null;  // intensities
  #count = 0;

  /** A ping with the levels over the pings so far; one that comes again, with other tables, counts once. */
  take(ping, over) {
    const key = [over, ping.sonar, ping.change, ping.beams, ping.bins].join();
    if (over === "none" || key !== this.#key || ping.number < this.#last?.number) this.#count = 0;
    this.#key = key;
    if (over === "none") return ping;
    if (this.#count === 0 || ping.number !== this.#last.number) {
      const { level } = ping.tables;
      const before = this.#count === 0 ? null : this.#last.levels;
      ++this.#count;
      this.#last = { number: ping.number, levels: over === "persist" ? faded(level, before) : this.#averaged(level, Number(over)) };
    }
    return { ...ping, tables: { ...ping.tables, level: this.#last.levels } };
  }

  #averaged(level, most) {
    if (this.#count === 1) this.#mean = new Float64Array(level.length);
    const part = 1 / Math.min(this.#count, most);
    const mean = this.#mean;
    const levels = new Uint16Array(level.length);
    for (let i = 0; i < level.length; ++i) {
      mean[i] += part * (intensityOf(level[i]) - mean[i]);
      levels[i] = valueOf(mean[i]);
    }
    return levels;
  }
}

function faded(level, before) {
  const levels = Uint16Array.from(level);
  if (before) for (let i = 0; i < levels.length; ++i) if (before[i] > levels[i] + kFade) levels[i] = before[i] - kFade;
  return levels;
}
