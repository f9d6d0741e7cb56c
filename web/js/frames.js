// frames.js -- draws what has changed, once a frame of the screen at most; where that is slow, the large picture comes first.

const kSlow = 45;      // milliseconds a frame above which the smaller views wait
const kShare = 5;      // of these slow frames, one in so many draws them too
const kMemory = 0.8;   // part that the mean duration of a frame keeps of what it was

export class Frames {
  #waiting = new Set();
  #asked = false;
  #begun = 0;
  #mean = 16;  // duration of a frame [ms]
  #drawn = new Map();  // when each was drawn last
  #clock;

  /** `clock` = { now(), next(callback) } returns milliseconds and calls back at the next frame of the screen. */
  constructor(clock = { now: () => performance.now(), next: (callback) => requestAnimationFrame(callback) }) {
    this.#clock = clock;
  }

  /** Registers a drawing; returns the function that asks for it. While frames are slow it may wait until `patience()`
   * milliseconds after the one before, as far as frames come; but not after it returned false, which says that it had nothing to
   * show. */
  add(draw, patience = () => 0) {
    const entry = { draw, patience };
    return () => {
      this.#waiting.add(entry);
      this.#ask();
    };
  }

  #ask() {
    if (this.#asked) return;
    this.#asked = true;
    this.#begun = this.#clock.now();
    this.#clock.next(() => this.#frame());
  }

  // A frame is asked for right after a drawing as long as pings come: what passes until it comes is how long frames take.
  #frame() {
    const now = this.#clock.now();
    const took = now - this.#begun;
    this.#mean = kMemory * this.#mean + (1 - kMemory) * Math.min(took, 2000);
    this.#asked = false;
    const share = this.#mean > kSlow ? kShare * this.#mean : 0;
    const later = new Set();
    for (const entry of this.#waiting) {
      const wait = Math.min(share, entry.patience() - Math.max(this.#mean, took));
      if (now - (this.#drawn.get(entry) ?? -Infinity) < wait) {
        later.add(entry);
        continue;
      }
      const drawn = entry.draw() !== false;
      this.#drawn.set(entry, drawn ? now : -Infinity);
    }
    this.#waiting = later;
    if (later.size > 0) this.#ask();
  }
}
