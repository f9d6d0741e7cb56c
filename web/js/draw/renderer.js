// renderer.js -- draws the levels of a ping as fan, polar or round picture by WebGL2.

import { kRoundSlots } from "../product.js";
import { beamTable } from "../sonar.js";
import { colourTable, labelTable } from "./colour_maps.js";
import { makeProgram, openGl, poolBins, Table } from "./gl.js";
import { setLevelUniforms } from "./level_shader.js";
import { kPictureFragment, kPictureVertex } from "./picture_shader.js";
import { columnsOf, RoundPicture } from "./round.js";

const kModes = { fan: 0, polar: 1, round: 2 };
const kOverlays = { none: 0, instance: 1, material: 1, elevation: 2, shadow: 3, multipath: 4 };
const kBeamTable = 2048;
const kNothing = -10;  // overlay value of a cell without one

/** An overlay's values of a ping as the shader reads them; undefined where the ping has none. */
const overlayValues = (ping, name) =>
  ping?.tables[name] && Float32Array.from(ping.tables[name], (value) => (Number.isNaN(value) ? kNothing : value));

export class PictureRenderer {
  constructor(canvas, redraw) {
    this.canvas = canvas;
    this.round = new RoundPicture();
    this.gl = openGl(canvas, () => {
      this.#build();
      redraw();
    });
    this.#build();
  }

  #build() {
    const { gl } = this;
    this.program = makeProgram(gl, kPictureVertex, kPictureFragment);
    this.tables = {
      levels: new Table(gl, "uint16"),
      colour_map: new Table(gl, "rgba8"),
      beam_table: new Table(gl, "float32"),
      ages: new Table(gl, "float32"),
      overlay_values: new Table(gl, "float32"),
      palette: new Table(gl, "rgba8"),
    };
    this.tables.palette.fill(256, 1, labelTable());
    this.tables.overlay_values.fill(1, 1, new Float32Array([kNothing]));
    this.tables.ages.fill(1, 1, new Float32Array([0]));
    this.limit = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    this.map = null;
    this.uploaded = null;
    this.overlayOf = null;
    this.setSonar(this.sonar ?? null);
  }

  setSonar(sonar) {
    this.sonar = sonar;
    this.uploaded = null;
    this.overlayOf = null;
    this.round.clear(sonar);
    if (!sonar) return;
    this.tables.beam_table.fill(kBeamTable, 1, beamTable(sonar, kBeamTable));
    if (sonar.product.gathers) {
      this.group = Math.ceil(sonar.bins / this.limit);
      this.rows = Math.ceil(sonar.bins / this.group);
      this.tables.levels.fill(kRoundSlots, this.rows, new Uint16Array(kRoundSlots * this.rows));
    }
  }

  /** Takes in a ping of a scanning head; every ping counts, also those that are not drawn by themselves. */
  addRound(ping) {
    const { levels, bins } = poolBins(ping.tables.level, 1, ping.bins, this.limit);
    const values = this.overlayOf && (overlayValues(ping, this.overlayOf) ?? new Float32Array(bins).fill(kNothing));
    for (const { first, count } of this.round.add(ping)) {
      this.tables.levels.write(first, 0, count, bins, columnsOf(levels, bins, count));
      if (values) this.tables.overlay_values.write(first, 0, count, bins, columnsOf(values, bins, count));
    }
    this.tables.ages.fill(kRoundSlots, 1, this.round.ages());
  }

  #upload(ping) {
    if (this.uploaded === ping) return;
    this.uploaded = ping;
    const { levels, bins, group } = poolBins(ping.tables.level, ping.beams, ping.bins, this.limit);
    this.group = group;
    this.rows = bins;
    this.tables.levels.fill(ping.beams, bins, levels);
  }

  /** Returns the kind of overlay that could be drawn: 0 where the ping has no such table. */
  #uploadOverlay(ping, name) {
    const kind = kOverlays[name];
    const table = ping?.tables[name];
    if (!kind || this.group > 1) return 0;
    if (this.sonar.product.gathers) {
      if (this.overlayOf !== name) this.#fillRoundOverlay(name);
      return kind;
    }
    if (!table) return 0;
    if (this.overlayOf !== table) {
      this.overlayOf = table;
      this.tables.overlay_values.fill(ping.beams, ping.bins, overlayValues(ping, name));
    }
    return kind;
  }

  // Pings that came before the table was asked for have none.
  #fillRoundOverlay(name) {
    this.overlayOf = name;
    this.tables.overlay_values.fill(kRoundSlots, this.rows, new Float32Array(kRoundSlots * this.rows).fill(kNothing));
    this.round.pings.forEach((ping, slot) => {
      const values = overlayValues(ping, name);
      if (values) this.tables.overlay_values.write(slot, 0, 1, this.rows, values);
    });
  }

  /** Draws what `plan` shows. */
  draw(plan, store) {
    const { gl } = this;
    const { program, at } = this.program;
    const { sonar } = this;
    const ping = store.get("shown");
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (!ping || !plan || ping.beams !== sonar.beams || ping.bins !== sonar.bins) return;
    if (!sonar.product.gathers) this.#upload(ping);
    if (this.map !== store.get("map")) {
      this.map = store.get("map");
      this.tables.colour_map.fill(256, 1, colourTable(this.map));
    }
    const overlay = this.#uploadOverlay(ping, store.get("overlay"));
    gl.useProgram(program);
    Object.entries(this.tables).forEach(([name, table], unit) => {
      table.bind(unit);
      gl.uniform1i(at[name], unit);
    });
    setLevelUniforms(gl, at, store, sonar.min_range, sonar.binLength * this.group);
    gl.uniform1i(at.mode, kModes[plan.mode]);
    gl.uniform1i(at.smooth_cells, store.get("smooth") ? 1 : 0);
    gl.uniform2f(at.azimuths, sonar.ports[0], sonar.starboards.at(-1));
    gl.uniform1f(at.up, sonar.up);
    gl.uniform1f(at.sign_ahead, sonar.sign);
    gl.uniform2i(at.size, sonar.product.columns(sonar), this.rows);
    gl.uniform1i(at.overlay, overlay);
    gl.uniform1f(at.elevation_half, sonar.elevationAperture / 2);
    gl.uniform4f(at.view, ...plan.view);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}
