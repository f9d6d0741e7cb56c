// rates.js -- how many pings a second arrive, and how fast the scenario's time passes against the clock.

const kWindow = 3000;     // time that rates are taken over [ms]
const kLeast = 500;       // time before which there is no rate yet [ms]
const kLongest = 12_000;  // pings further apart give no rate: time stands still, or nearly [ms]

/** What to say where the machine, not `--rate`, holds a simulation back: null where it keeps up. `pace` is the measured
 * seconds of the scenario in a second of the clock. */
export function slowText({ paused, speed, ms_per_ping: cost }, sonars, pace) {
  if (paused || pace === null || !(pace < 0.9 * speed)) return null;
  const due = sonars.reduce((sum, { period }) => sum + speed / period, 0);
  if (!(cost * due > 1000)) return null;
  return `This machine makes ${(1000 / cost).toFixed(1)} of the ${due.toFixed(1)} pings due a second, so time runs at ${pace.toFixed(2)} of real time. A longer ping period, fewer bins or a shorter range help.`;
}

export class Rates {
  #pings = [];  // { arrival [ms], made [ms], time [s], change }, oldest first
  #first = null;  // arrival of the first ping since reset() [ms]

  /** Forgets all: another sonar, or another connection. */
  reset() {
    this.#pings = [];
    this.#first = null;
  }

  /** Takes in a ping at `now` [ms]; `made` is when the server had made it [ms], by any clock. */
  add(now, { time, change, made_at: made }) {
    this.#first ??= now;
    this.#pings.push({ arrival: now, made: made === undefined ? now : 1000 * made, time, change });
    // The last two stay, however slow the sonar is.
    while (this.#pings.length > 2 && now - this.#pings[0].arrival > kLongest) this.#pings.shift();
  }

  /** Pings a second at `now`, over the time that there is; null before there is half a second of it. */
  pingsPerSecond(now) {
    if (this.#first === null || now - this.#first < kLeast) return null;
    const since = Math.max(now - kWindow, this.#first);
    // The first ping began the time; what came with it had been waiting.
    const count = this.#pings.filter(({ arrival }) => arrival > since).length;
    if (count > 1) return (1000 * count) / (now - since);
    if (now - this.#first < kWindow) return null;
    return this.#slowRate(now);
  }

  // For pings further apart than the window.
  #slowRate(now) {
    const [before, last] = this.#pings.slice(-2);
    if (!last) return 0;
    const between = Math.max(last.arrival - before.arrival, now - last.arrival);
    return between > kLongest ? 0 : 1000 / between;
  }

  /** Seconds of the scenario in a second of the clock, since the last change; null where that is not known. */
  timeFactor(now) {
    const last = this.#pings.at(-1);
    if (!last) return null;
    const run = this.#pings.filter(({ change, arrival }) => change === last.change && now - arrival <= kWindow);
    const [first, end] = run.length > 1 ? [run[0], last] : this.#pings.slice(-2);
    if (!end || first.change !== end.change || now - end.arrival > kLongest) return null;
    const clock = end.made - first.made;
    return clock >= kLeast && end.time > first.time ? (1000 * (end.time - first.time)) / clock : null;
  }
}
