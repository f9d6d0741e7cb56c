// waterfall.js -- pings over time: the chosen beam, the strongest echo at each range, or both sides of a side-scan sonar;
// the newest ping is on top.

import { byId, context2d, fitCanvas, themeColour, write } from "../dom.js";
import { colourTable } from "../draw/colour_maps.js";
import { makeProgram, openGl, Table } from "../draw/gl.js";
import { kLevelGlsl, setLevelUniforms } from "../draw/level_shader.js";
import { bearing, number, ringSpacing, ticks } from "../format.js";
import { levelDb } from "../link/decode.js";
import { binRange } from "../sonar.js";

const kRows = 512;
const kPixels = 3;  // height of a ping in CSS pixels

const kVertex = `#version 300 es
out vec2 place;  // 0 to 1: near to far (or the far end of port to that of starboard), old to new
void main() {
  vec2 clip = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  place = clip * 0.5 + 0.5;
  gl_Position = vec4(clip, 0, 1);
}`;

const kFragment = `#version 300 es
precision highp float;
precision highp int;
${kLevelGlsl}
uniform int newest, rows, sides;
uniform float visible;  // pings from top to bottom
in vec2 place;
out vec4 colour;
void main() {
  ivec2 size = textureSize(levels, 0);
  int back = int((1.0 - place.y) * visible);
  if (back >= rows) discard;
  int row = (newest - back + size.y) % size.y;
  float bin = place.x * float(size.x);
  int covered = clamp(int(ceil(dFdx(place.x) * float(size.x) - 0.2)), 1, 24);
  uint strongest = 0u;
  for (int i = 0; i < covered; ++i) {
    int at = min(int(bin) + i, size.x - 1);
    strongest = max(strongest, texelFetch(levels, ivec2(at, row), 0).r);
  }
  float from_track = sides != 0 ? abs(bin - 0.5 * float(size.x)) : bin;
  colour = vec4(colour_of(brightness(strongest, gain_at(min_range + (from_track + 0.5) * bin_length))), 1);
}`;

export class WaterfallView {
  constructor(store, frames) {
    this.store = store;
    this.canvas = byId("waterfall");
    this.redraw = frames.add(() => this.draw(), () => (store.get("main") === "waterfall" ? 0 : 1000));
    this.gl = openGl(this.canvas, () => {
      this.#build();
      this.redraw();
    });
    this.#build();
    new ResizeObserver(this.redraw).observe(this.canvas);
    store.on(["sonar", "waterfallOf", "beam"], () => this.clear());
    if (store.get("shown")) this.add(store.get("shown"));
    store.on(["low", "high", "gain", "tvg", "map", "theme", "main"], this.redraw);
  }

  #build() {
    this.program = makeProgram(this.gl, kVertex, kFragment);
    this.levels = new Table(this.gl, "uint16");
    this.map = new Table(this.gl, "rgba8");
    this.limit = this.gl.getParameter(this.gl.MAX_TEXTURE_SIZE);
    this.clear();
  }

  /** Forgets all rows. */
  clear() {
    const { store } = this;
    const sonar = store.get("sonar");
    this.count = 0;
    this.ages = [];
    this.peaks = [];  // of the rows, with the display's gain by range, newest first [dB]
    this.time = this.between = undefined;
    if (!sonar) return;
    const parts = sonar.product.sides ? 2 : 1;
    this.group = Math.ceil((parts * sonar.bins) / this.limit);
    this.reach = Math.ceil(sonar.bins / this.group);  // columns from the track outwards
    this.width = parts * this.reach;
    this.levels.fill(this.width, kRows, new Uint16Array(this.width * kRows));
    const beam = store.get("waterfallOf") === "beam";
    const azimuth = sonar.beamAzimuths[Math.min(store.get("beam"), sonar.beams - 1)];
    this.what = sonar.product.waterfall ?? (beam ? `Beam ${store.get("beam")}   ${bearing(azimuth)}` : "Strongest");
    this.redraw();
  }

  /** Takes in every ping, also while the picture is not drawn. */
  add(ping) {
    const sonar = this.store.get("sonar");
    const beam = this.store.get("waterfallOf") === "beam" ? Math.min(this.store.get("beam"), ping.beams - 1) : -1;
    const row = new Uint16Array(this.width);
    const { level } = ping.tables;
    const tvg = this.store.get("tvg");
    let peak = -Infinity;
    for (let bin = 0; bin < ping.bins; ++bin) {
      const start = bin * ping.beams;
      const column = Math.floor(bin / this.group);
      let value = 0;
      if (beam >= 0 && !sonar.product.sides) value = level[start + beam];
      else for (let i = start; i < start + ping.beams; ++i) if (level[i] > value) value = level[i];
      if (sonar.product.sides) {
        const [port, starboard] = [this.reach - 1 - column, this.reach + column];
        row[port] = Math.max(row[port], level[start]);
        row[starboard] = Math.max(row[starboard], level[start + 1]);
      } else if (value > row[column]) row[column] = value;
      if (value > 0) peak = Math.max(peak, levelDb(value) + tvg * Math.log10(Math.max(binRange(sonar, bin), 0.01)));
    }
    this.levels.write(0, this.count % kRows, this.width, 1, row);
    ++this.count;
    this.peaks = [peak, ...this.peaks].slice(0, kRows);
    this.#note(ping.time);
    this.redraw();
  }

  // Ages of the rows [s], newest first. If the time restarts, a row follows the previous one by the last interval.
  #note(time) {
    const since = time - this.time;
    this.between = since > 0 ? since : this.between ?? 0;
    this.time = time;
    this.ages = [0, ...this.ages.map((age) => age + this.between)];
    this.ages.length = Math.min(this.ages.length, kRows);
  }

  get #visible() {
    return Math.min(kRows, Math.max(1, this.canvas.clientHeight / kPixels));
  }

  /** Returns whether there was a row to show. */
  draw() {
    const { gl, store } = this;
    const sonar = store.get("sonar");
    fitCanvas(this.canvas);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (!sonar) return false;
    const { program, at } = this.program;
    gl.useProgram(program);
    this.map.fill(256, 1, colourTable(store.get("map")));
    this.levels.bind(0);
    this.map.bind(1);
    gl.uniform1i(at.levels, 0);
    gl.uniform1i(at.colour_map, 1);
    setLevelUniforms(gl, at, store, sonar.min_range, sonar.binLength * this.group);
    // The strongest of all beams would be brighter than most colours: theirs reach to the loudest that is seen.
    const most = Math.max(store.get("high"), Math.ceil(Math.max(...this.peaks.slice(0, this.#visible)) + store.get("gain")));
    gl.uniform1f(at.high, Math.max(most, store.get("low") + 0.1));
    write(byId("waterfall-caption"), most > store.get("high") ? `${this.what}, to ${number(most)} dB` : this.what);
    gl.uniform1i(at.newest, (this.count - 1 + kRows) % kRows);
    gl.uniform1i(at.rows, Math.min(this.count, kRows));
    gl.uniform1i(at.sides, sonar.product.sides ? 1 : 0);
    gl.uniform1f(at.visible, this.#visible);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    this.#drawScale(sonar);
    return this.count > 0;
  }

  #drawScale(sonar) {
    const { context, width, height } = context2d(byId("waterfall-scale"));
    context.font = "11px system-ui, sans-serif";
    context.textBaseline = "bottom";
    context.textAlign = "center";
    // On a plate: an outline would smear small figures over a picture.
    const text = (words, x, y) => {
      const wide = context.measureText(words).width + 6;
      const left = context.textAlign === "center" ? x - wide / 2 : x - 3;
      context.globalAlpha = 0.78;
      context.fillStyle = themeColour("--panel");
      context.fillRect(left, y - 13, wide, 14);
      context.globalAlpha = 1;
      context.fillStyle = themeColour("--text");
      context.fillText(words, x, y);
    };
    const spacing = ringSpacing(sonar.max_range);
    const ranges = ticks(Math.max(sonar.min_range, spacing), sonar.max_range, spacing);
    const share = (range) => (range - sonar.min_range) / (sonar.max_range - sonar.min_range);
    const places = sonar.product.sides
      ? [-1, 1].flatMap((side) => ranges.map((range) => [range, 0.5 + 0.5 * side * share(range)]))
      : ranges.map((range) => [range, share(range)]);
    for (const [range, part] of places) {
      const x = width * part;
      if (x < 14 || x > width - 14) continue;
      // Over the rows as over a picture, below them as on the page.
      const rows = Math.min(height - 15, (height * this.count) / this.#visible);
      context.fillStyle = themeColour("--ring");
      context.fillRect(x, 0, 1, rows);
      context.fillStyle = themeColour("--line");
      context.fillRect(x, rows, 1, height - 15 - rows);
      text(`${number(range, Number.isInteger(range) ? 0 : 1)} m`, x, height - 3);
    }
    context.textAlign = "left";
    for (const part of [0.25, 0.5, 0.75]) {
      const row = Math.floor(part * this.#visible);
      if (row > 0 && row < this.ages.length) text(`${number(-this.ages[row], this.ages[row] < 10 ? 1 : 0)} s`, 4, part * height + 4);
    }
  }
}
