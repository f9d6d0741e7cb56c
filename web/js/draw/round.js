// round.js -- the round picture of a scanning head: the last ping in each direction.

import { kRoundSlots } from "../product.js";
import { slotAt } from "../sonar.js";

/** Echoes by direction. Columns are azimuths (see slotAt), rows are bins. */
export class RoundPicture {
  constructor() {
    this.clear(null);
  }

  clear(sonar) {
    this.sonar = sonar;
    this.pings = new Array(kRoundSlots).fill(null);  // the ping that each column shows
    this.order = new Float32Array(kRoundSlots).fill(-1);
    this.count = 0;
    this.headAngle = 0;
  }

  /** Takes in a ping; returns the columns that it changed: [{ first, count }]. */
  add(ping) {
    const { sonar } = this;
    // A step of at most three beam widths is drawn as wide as the step, a larger one as wide as the beam.
    const beam = sonar.ports[0] - sonar.starboards[0];
    const step = Math.abs((sonar.step ?? 0) * Math.PI) / 180;
    const width = step > 0 && step <= 3 * beam ? Math.max(step, beam * 0.5) : beam;
    const half = Math.max(width / 2, Math.PI / kRoundSlots);
    const first = slotAt(ping.headAngle + half);
    // Up to the column where the next beam begins: rounded widths would leave a seam of a column between them.
    const last = slotAt(ping.headAngle - half);
    const count = half >= Math.PI ? kRoundSlots : Math.max(1, (last - first + kRoundSlots) % kRoundSlots);
    this.headAngle = ping.headAngle;
    ++this.count;
    for (let i = 0; i < count; ++i) {
      const slot = (first + i) % kRoundSlots;
      this.pings[slot] = ping;
      this.order[slot] = this.count;
    }
    const ahead = Math.min(count, kRoundSlots - first);
    const parts = [{ first, count: ahead }];
    if (ahead < count) parts.push({ first: 0, count: count - ahead });
    return parts;
  }

  /** Age of each column, 0 new to 1 a turn old; below 0 where it was never heard. */
  ages() {
    const step = Math.max(Math.abs(this.sonar?.step ?? 1), 0.05);
    const turn = 360 / step;
    return this.order.map((order) => (order < 0 ? -1 : Math.min(1, (this.count - order) / turn)));
  }
}

/** A block of equal columns from the values of a ping's single beam, of the same type as these. */
export function columnsOf(values, bins, count) {
  const block = new values.constructor(bins * count);
  for (let bin = 0; bin < bins; ++bin) block.fill(values[bin], bin * count, (bin + 1) * count);
  return block;
}
