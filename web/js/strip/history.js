// history.js -- the last pings of a waterfall: a bounded number of rows, each with the ping's pose and values.

import { norm, subtract } from "../geometry.js";

const kGap = 5;  // A pause of more ping periods than that begins another line.

/** Rows by their index since the beginning: `first` to `count` - 1 are there. */
export class StripHistory {
  #rows = [];
  #places = new Map();  // "number:time" -> index

  constructor(most) {
    this.most = most;
    this.clear();
  }

  clear() {
    this.#rows = new Array(this.most);
    this.#places.clear();
    this.count = 0;
  }

  get first() {
    return Math.max(0, this.count - this.most);
  }

  /** Place of a row in tables of `most` rows. */
  slot(index) {
    return index % this.most;
  }

  row(index) {
    return index >= this.first && index < this.count ? this.#rows[this.slot(index)] : null;
  }

  get newest() {
    return this.row(this.count - 1);
  }

  /** Index of the row of a ping, or -1. */
  find(number, time) {
    const index = this.#places.get(`${number}:${time}`) ?? -1;
    return this.row(index) ? index : -1;
  }

  /** Adds a row = { number, time, ... }; completes it by `age`, time since the first row [s], where a restart of time goes on after
   * the last interval, `way`, what the sonar has flown since then [m], and `seam`, whether a line begins with it. `period` is that of the pings [s]. */
  add(row, period) {
    const before = this.newest;
    const since = before ? row.time - before.time : 0;
    row.between = since > 0 ? since : before?.between ?? 0;
    row.age = (before?.age ?? 0) + (before ? row.between : 0);
    row.way = (before?.way ?? 0) + (before ? norm(subtract(row.pose.position, before.pose.position)) : 0);
    row.seam = Boolean(before) && (since < 0 || since > kGap * period);
    const dropped = this.count >= this.most ? this.#rows[this.slot(this.count)] : null;
    if (dropped) this.#places.delete(keyOf(dropped));
    this.#rows[this.slot(this.count)] = row;
    this.#places.set(keyOf(row), this.count);
    ++this.count;
  }

  /** Forgets the rows from `index` on: a recording that was set back shows them again. */
  cut(index) {
    for (let i = Math.max(index, this.first); i < this.count; ++i) this.#places.delete(keyOf(this.row(i)));
    this.count = index;
  }
}

const keyOf = ({ number, time }) => `${number}:${time}`;
