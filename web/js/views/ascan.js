// ascan.js -- level over range of the beam under the cursor, or of the chosen beam.

import { byId, context2d, themeColour, write } from "../dom.js";
import { bearing, niceStep, number, ringSpacing, ticks } from "../format.js";
import { levelDb } from "../link/decode.js";
import { binRange, inSector } from "../sonar.js";

const kNarrow = 270;  // A narrower view has no room to say that a beam is the chosen one [CSS pixels].

export class AscanView {
  constructor(store, frames, roundPings) {
    this.store = store;
    this.canvas = byId("ascan");
    this.roundPings = roundPings;
    const redraw = frames.add(() => this.draw(), () => (store.get("main") === "ascan" ? 0 : 1000));
    new ResizeObserver(redraw).observe(this.canvas);
    store.on(["shown", "cursor", "beam", "low", "high", "gain", "tvg", "theme", "main", "sonar"], redraw);
  }

  draw() {
    const { store } = this;
    const { context, width, height } = context2d(this.canvas);
    const sonar = store.get("sonar");
    const cursor = store.get("cursor");
    const beam = cursor?.beam ?? store.get("beam");
    const slot = cursor?.slot;
    const row = cursor?.row?.tables ? cursor.row : null;  // of the waterfall
    const found = row ?? (slot === undefined ? store.get("shown") : this.roundPings()[slot]);
    const ping = found?.bins === sonar?.bins && beam < found?.beams ? found : null;
    this.#explain(sonar, ping, cursor);
    if (!sonar || !ping) return;
    const { product } = sonar;
    const azimuth = product.azimuth(sonar, ping, beam);
    write(byId("ascan-caption"), `${product.beam(beam)}${product.sides ? "" : bearing(azimuth, sonar.vertical)}${cursor || width < kNarrow ? "" : product.chosen}`);
    const low = store.get("low");
    const trace = traceOf(sonar, ping, beam, store);
    // The axis reaches to the loudest bin, also where the picture's colours end below it.
    const high = Math.max(store.get("high"), low + 1, Math.ceil(trace.loudest));
    const margin = (high - low) * 0.12;
    const frame = {
      left: 34, right: width - 8, top: store.get("main") === "ascan" ? 46 : 28, bottom: height - 18,
      low: low - margin, high: high + margin, near: sonar.min_range, far: sonar.max_range,
    };
    if (frame.bottom - frame.top < 20) return;
    drawAxes(context, frame, low, Math.max(store.get("high"), low + 1));
    drawTrace(context, frame, trace);
    if (cursor) drawLine(context, frame, cursor.range);
  }

  // Says why there is no curve.
  #explain(sonar, ping, cursor) {
    const line = byId("ascan-empty");
    line.hidden = Boolean(ping);
    if (ping) return;
    const aside = cursor?.slot !== undefined;
    if (aside) write(byId("ascan-caption"), bearing(cursor.azimuth, sonar.vertical));
    write(line, !aside ? "Waiting for the first ping" : inSector(sonar, cursor.azimuth) ? "No ping in this direction yet" : "Outside the scanned sector");
  }
}

const xOf = (frame, range) => frame.left + ((range - frame.near) / (frame.far - frame.near)) * (frame.right - frame.left);
const yOf = (frame, level) => {
  const y = frame.bottom - ((level - frame.low) / (frame.high - frame.low)) * (frame.bottom - frame.top);
  return Math.min(frame.bottom, Math.max(frame.top, y));
};

function drawAxes(context, frame, low, high) {
  context.font = "10px system-ui, sans-serif";
  context.fillStyle = themeColour("--raised");
  context.fillRect(frame.left, yOf(frame, high), frame.right - frame.left, yOf(frame, low) - yOf(frame, high));
  context.strokeStyle = themeColour("--line");
  context.fillStyle = themeColour("--soft");
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const level of ticks(low, frame.high, niceStep((frame.high - low) / Math.max(2, (frame.bottom - frame.top) / 32)))) {
    const y = yOf(frame, level);
    context.beginPath();
    context.moveTo(frame.left, y);
    context.lineTo(frame.right, y);
    context.stroke();
    context.fillText(number(level), frame.left - 4, y);
  }
  context.textBaseline = "top";
  context.fillText("dB", frame.left - 4, frame.bottom + 5);
  context.textAlign = "center";
  const spacing = ringSpacing(frame.far);
  for (const range of ticks(frame.near, frame.far, spacing)) {
    const x = xOf(frame, range);
    if (x > frame.right - 12) continue;
    context.fillRect(x, frame.bottom, 1, 3);
    context.fillText(number(range, Number.isInteger(range) ? 0 : 1), x, frame.bottom + 5);
  }
  context.textAlign = "right";
  context.fillText("m", frame.right, frame.bottom + 5);
}

// Levels of a beam as they are shown [dB], NaN without an echo, and the loudest of them.
function traceOf(sonar, ping, beam, store) {
  const [gain, tvg] = [store.get("gain"), store.get("tvg")];
  const levels = new Float32Array(ping.bins).fill(NaN);
  let loudest = -Infinity;
  for (let bin = 0; bin < ping.bins; ++bin) {
    const db = levelDb(ping.tables.level[bin * ping.beams + beam]);
    if (db === null) continue;
    levels[bin] = db + gain + tvg * Math.log10(Math.max(binRange(sonar, bin), 0.01));
    loudest = Math.max(loudest, levels[bin]);
  }
  return { levels, loudest };
}

function drawTrace(context, frame, { levels }) {
  // The strongest and the weakest bin of each pixel: no echo is lost between pixels.
  const bins = levels.length;
  const columns = Math.max(1, Math.round(frame.right - frame.left));
  const strongest = new Float32Array(columns).fill(-1e9);
  const weakest = new Float32Array(columns).fill(1e9);
  for (let bin = 0; bin < bins; ++bin) {
    const shown = Number.isNaN(levels[bin]) ? frame.low : levels[bin];
    const first = Math.floor((bin / bins) * columns);
    const last = Math.max(first + 1, Math.floor(((bin + 1) / bins) * columns));
    for (let i = first; i < last && i < columns; ++i) {
      strongest[i] = Math.max(strongest[i], shown);
      weakest[i] = Math.min(weakest[i], shown);
    }
  }
  context.strokeStyle = themeColour("--accent");
  context.lineWidth = 1.3;
  context.lineJoin = "round";
  context.beginPath();
  for (let i = 0; i < columns; ++i) {
    context.lineTo(frame.left + i, yOf(frame, weakest[i]));
    if (strongest[i] > weakest[i]) context.lineTo(frame.left + i, yOf(frame, strongest[i]));
  }
  context.stroke();
  context.lineWidth = 1;
}

function drawLine(context, frame, range) {
  const x = xOf(frame, range);
  context.strokeStyle = "#35b5e5";
  context.beginPath();
  context.moveTo(x, frame.top);
  context.lineTo(x, frame.bottom);
  context.stroke();
}
