// frames.js -- draws what has changed, once a frame of the screen at most; where that is slow, the large picture comes first.

const kSlow = 45;      // milliseconds a frame above which the smaller views wait
const kShare = 5;      // of these slow frames, one in so many draws them too
const kMemory = 0.8;   // part that the mean duration of a frame keeps of what it was

export class Frames {
  #waiting = new Set();
  #asked = false;
  #begun = 0;
  #mean = 16;  // duration of a frame [ms]
  #drawn = new Map();  // when the patient ones were drawn last

  /** Registers a drawing; returns the function that asks for it. A `patient` one may wait while frames are slow. */
  add(draw, patient = () => false) {
    const entry = { draw, patient };
    return () => {
      this.#waiting.add(entry);
      this.#ask();
    };
  }

  #ask() {
    if (this.#asked) return;
    this.#asked = true;
    this.#begun = performance.now();
    requestAnimationFrame(() => this.#frame());
  }

  // A frame is asked for right after a drawing as long as pings come: what passes until it comes is how long frames take.
  #frame() {
    const now = performance.now();
    this.#mean = kMemory * this.#mean + (1 - kMemory) * Math.min(now - this.#begun, 2000);
    this.#asked = false;
    const later = new Set();
    for (const entry of this.#waiting) {
      const wait = this.#mean > kSlow && entry.patient() ? Math.min(kShare * this.#mean, 2000) : 0;
      if (now - (this.#drawn.get(entry) ?? 0) < wait) {
        later.add(entry);
        continue;
      }
      this.#drawn.set(entry, now);
      entry.draw();
    }
    this.#waiting = later;
    if (later.size > 0) this.#ask();
  }
}
