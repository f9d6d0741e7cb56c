// renderer.js -- draws the rows of a waterfall by WebGL2: levels in the colours of all pictures, or heights of a swath.

import { colourTable } from "../draw/colour_maps.js";
import { makeProgram, openGl, Table } from "../draw/gl.js";
import { kLevelGlsl, setLevelUniforms } from "../draw/level_shader.js";

/** Rows that a waterfall keeps. */
export const kRows = 2048;
/** Colours of heights, the deepest first. */
export const kHeightMap = "turbo";

const kVertex = `#version 300 es
out vec2 place;  // 0 to 1: left to right, bottom to top
void main() {
  vec2 clip = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  place = clip * 0.5 + 0.5;
  gl_Position = vec4(clip, 0, 1);
}`;

const kRowGlsl = `
uniform int top, rows;    // place of the row at the top in the tables, rows that are there from it on
uniform float visible;    // rows from top to bottom
in vec2 place;
out vec4 colour;

// The row at this height; -1 below the last.
int row_here(int size) {
  int back = int((1.0 - place.y) * visible);
  return back < rows ? (top - back + size) % size : -1;
}`;

const kLevelFragment = `#version 300 es
precision highp float;
precision highp int;
${kLevelGlsl}
${kRowGlsl}
uniform bool sides, corrected;
uniform float max_range;
uniform float pixel;          // width of a pixel [m]
uniform sampler2D bottoms;    // first return of the bed by row [m]

void main() {
  ivec2 size = textureSize(levels, 0);
  int row = row_here(size.y);
  if (row < 0) discard;
  int count = sides ? size.x / 2 : size.x;
  float across = sides ? abs(place.x - 0.5) * 2.0 * max_range : min_range + place.x * (max_range - min_range);
  float bottom = corrected ? texelFetch(bottoms, ivec2(0, row), 0).r : 0.0;
  float range = length(vec2(across, bottom));
  float bin = (range - min_range) / bin_length;
  uint strongest = 0u;
  if (bin >= 0.0 && bin < float(count)) {
    // Where a pixel covers several bins, the strongest counts: no echo is lost between pixels.
    int covered = clamp(int(ceil(pixel * across / max(range, 1e-6) / bin_length - 0.2)), 1, 24);
    for (int i = 0; i < covered; ++i) {
      int at = min(int(bin) + i, count - 1);
      int column = !sides ? at : place.x < 0.5 ? count - 1 - at : count + at;
      strongest = max(strongest, texelFetch(levels, ivec2(column, row), 0).r);
    }
  }
  colour = vec4(colour_of(brightness(strongest, gain_at(range))), 1);
}`;

const kHeightFragment = `#version 300 es
precision highp float;
precision highp int;
uniform sampler2D heights;     // NaN: no sounding
uniform sampler2D colour_map;
uniform vec2 span;             // heights of the first and the last colour [m]
${kRowGlsl}

void main() {
  ivec2 size = textureSize(heights, 0);
  int row = row_here(size.y);
  if (row < 0) discard;
  float height = texelFetch(heights, ivec2(min(int(place.x * float(size.x)), size.x - 1), row), 0).r;
  float part = clamp((height - span.x) / max(span.y - span.x, 1e-6), 0.0, 1.0);
  colour = isnan(height) || height > 1e8 ? vec4(0.06, 0.09, 0.11, 1) : vec4(texelFetch(colour_map, ivec2(int(part * 255.0), 0), 0).rgb, 1);
}`;

const kNothing = 1e9;  // height of a beam without a sounding: a driver may not keep NaN

export class StripRenderer {
  /** `restored` is called when a context that was lost has come back, without its rows. */
  constructor(canvas, restored) {
    this.canvas = canvas;
    this.gl = openGl(canvas, () => {
      this.#build();
      restored();
    });
    this.#build();
  }

  #build() {
    const { gl } = this;
    this.programs = { levels: makeProgram(gl, kVertex, kLevelFragment), heights: makeProgram(gl, kVertex, kHeightFragment) };
    this.tables = { levels: new Table(gl, "uint16"), heights: new Table(gl, "float32"), bottoms: new Table(gl, "float32"), map: new Table(gl, "rgba8") };
    this.limit = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    this.map = null;
  }

  /** Makes room for rows of so many columns. */
  prepare(heights, columns) {
    this.kind = heights ? "heights" : "levels";
    const none = heights ? new Float32Array(columns * kRows).fill(kNothing) : new Uint16Array(columns * kRows);
    this.tables[this.kind].fill(columns, kRows, none);
    this.tables.bottoms.fill(1, kRows, new Float32Array(kRows));
  }

  write(slot, { values, bottom }) {
    const data = this.kind === "heights" ? values.map((value) => (Number.isNaN(value) ? kNothing : value)) : values;
    this.tables[this.kind].write(0, slot, values.length, 1, data);
    this.tables.bottoms.write(0, slot, 1, 1, new Float32Array([bottom ?? 0]));
  }

  clear() {
    const { gl, canvas } = this;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
  }

  /** Draws `rows` from the slot `top` on. `shown` = { sonar, group, high [dB], span [m, m], corrected }. */
  draw(store, { top, rows, visible }, { sonar, group, high, span, corrected }) {
    const { gl } = this;
    this.clear();
    const { program, at } = this.programs[this.kind];
    gl.useProgram(program);
    const map = this.kind === "heights" ? kHeightMap : store.get("map");
    if (this.map !== map) this.tables.map.fill(256, 1, colourTable((this.map = map)));
    const bind = (name, unit, table = name) => {
      this.tables[table].bind(unit);
      gl.uniform1i(at[name], unit);
    };
    bind(this.kind, 0);
    bind("colour_map", 1, "map");
    gl.uniform1i(at.top, top);
    gl.uniform1i(at.rows, rows);
    gl.uniform1f(at.visible, visible);
    if (this.kind === "heights") gl.uniform2f(at.span, ...span);
    else {
      bind("bottoms", 2);
      setLevelUniforms(gl, at, store, sonar.min_range, sonar.binLength * group);
      const { sides } = sonar.product;
      gl.uniform1f(at.high, Math.max(high, store.get("low") + 0.1));
      gl.uniform1i(at.sides, sides ? 1 : 0);
      gl.uniform1i(at.corrected, corrected ? 1 : 0);
      gl.uniform1f(at.max_range, sonar.max_range);
      gl.uniform1f(at.pixel, (sides ? 2 * sonar.max_range : sonar.max_range - sonar.min_range) / this.canvas.width);
    }
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}
