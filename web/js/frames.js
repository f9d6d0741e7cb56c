// frames.js -- draws what has changed, once a frame of the screen at most.

export class Frames {
  #waiting = new Set();
  #asked = false;

  /** Registers a drawing; returns the function that asks for it. */
  add(draw) {
    return () => {
      this.#waiting.add(draw);
      if (this.#asked) return;
      this.#asked = true;
      requestAnimationFrame(() => this.flush());
    };
  }

  /** Draws now what was asked for. */
  flush() {
    this.#asked = false;
    const drawings = [...this.#waiting];
    this.#waiting.clear();
    for (const draw of drawings) draw();
  }
}
