// display.js -- contrast, gain, colours and overlay of the pictures: nothing here changes the simulation.

import { kOver } from "../averaging.js";
import { byId, element, write } from "../dom.js";
import { labelColour } from "../draw/colour_maps.js";
import { number } from "../format.js";
import { levelDb } from "../link/decode.js";
import { kPictures, productIn } from "../product.js";
import { binRange } from "../sonar.js";

const kMaps = ["inferno", "copper", "grey", "turbo", "blue"];
const kOverlays = ["none", "instance", "material", "elevation", "shadow", "multipath"];
const kCalibrated = ["shadow", "multipath"];  // Overlays that the calibrated model alone has.
const kFixedLegends = {
  elevation: [["rgb(255 84 31)", "above"], ["rgb(242 242 242)", "level"], ["rgb(26 115 255)", "below"]],
  shadow: [["rgb(40 110 220)", "shadow"]],
  multipath: [["rgb(26 217 255)", "two surfaces"], ["rgb(255 64 217)", "three surfaces"]],
};
const kSwitches = { corrected: "corrected", "bottom-line": "bottomLine", soundings: "soundings", grid: "grid", smooth: "smooth", truth: "truth", "show-echoes": "showEchoes", "show-fan": "showFan", "show-sector": "showSector", "show-paths": "showPaths" };

export function setUpDisplay(store, frames, roundPings) {
  for (const name of ["low", "high", "gain", "tvg"]) slider(store, name);
  byId("over").replaceChildren(...kOver.map(([value, text]) => element("option", { value }, text)));
  for (const [id, name] of [["map", "map"], ["overlay", "overlay"], ["over", "over"], ["waterfall-of", "waterfallOf"]]) {
    byId(id).addEventListener("change", () => store.set({ [name]: byId(id).value }));
    store.on([name], () => (byId(id).value = store.get(name)));
  }
  for (const [id, name] of Object.entries(kSwitches)) {
    byId(id).addEventListener("change", () => store.set({ [name]: byId(id).checked }));
    store.on([name], () => (byId(id).checked = store.get(name)));
  }
  store.on(["hello"], () => {
    for (const option of byId("overlay").options) {
      option.disabled = !isThere(store, option.value);
      option.title = option.disabled ? "Needs the calibrated model" : "";
    }
  });
  byId("auto").addEventListener("click", () => fitContrast(store));
  byId("contrast-reset").addEventListener("click", () => resetContrast(store));
  for (const mode of kPictures) byId(`mode-${mode}`).addEventListener("click", () => store.set({ mode }));
  store.on(["mode", "sonar"], () => showModes(store));
  setUpBeam(store);
  const redraw = frames.add(() => drawLegend(store, roundPings));
  store.on(["shown", "overlay", "hello"], redraw);
  store.on(["overlay"], () => (pingsSince = 0));
  store.on(["shown"], () => ++pingsSince);
}

function slider(store, name) {
  const input = byId(name);
  input.addEventListener("input", () => {
    const value = Number(input.value);
    const patch = { [name]: value };
    // The darkest colour stays below the brightest: the other one gives way.
    if (name === "low" && value >= store.get("high")) patch.high = value + 1;
    if (name === "high" && value <= store.get("low")) patch.low = value - 1;
    store.set(patch);
  });
  store.on([name], () => {
    const value = store.get(name);
    if (value < Number(input.min)) input.min = value;
    if (value > Number(input.max)) input.max = value;
    input.value = value;
    const text = name === "tvg" ? (value === 0 ? "off" : `${number(value)} log r`) : `${number(value)} dB`;
    write(byId(`${name}-text`), text);
    input.setAttribute("aria-valuetext", text);
  });
}

function setUpBeam(store) {
  const input = byId("beam");
  const choose = (value) => {
    const beams = store.get("sonar")?.beams ?? 1;
    if (Number.isFinite(value)) store.set({ beam: Math.max(0, Math.min(beams - 1, Math.round(value))), waterfallOf: "beam" });
    input.value = store.get("beam");
  };
  input.addEventListener("change", () => choose(Number(input.value)));
  for (const button of input.parentElement.querySelectorAll("button")) {
    button.addEventListener("click", () => choose(store.get("beam") + Number(button.dataset.step)));
  }
  store.on(["sonar"], () => {
    // A scanning head has a single beam: there is nothing to choose.
    const { gathers, sides, hint } = productIn(store);
    byId("waterfall-of-field").hidden = byId("beam-field").hidden = gathers || sides;
    for (const id of ["corrected", "bottom-line"]) byId(id).closest("label").hidden = !sides;
    const down = Boolean(store.get("sonar")?.down);
    byId("soundings").closest("label").hidden = !down;
    byId("waterfall-of").querySelector("[value=depths]").hidden = !down;
    write(byId("beam-hint"), hint);
  });
  store.on(["beam", "sonar"], () => {
    input.max = (store.get("sonar")?.beams ?? 1) - 1;
    input.value = store.get("beam");
  });
}

function showModes(store) {
  for (const mode of kPictures) {
    byId(`mode-${mode}`).hidden = !productIn(store).pictures.includes(mode);
    byId(`mode-${mode}`).setAttribute("aria-pressed", String(store.get("mode") === mode));
  }
}

/** The levels that the server proposes for the watched sonar. */
export function resetContrast(store) {
  const { levels: [low, high] = [], shown_gain: tvg = 0, reference } = store.get("sonar") ?? {};
  if (!Number.isFinite(low) || !Number.isFinite(high)) return;
  const values = { low: Math.round(low), high: Math.round(high), gain: 0, tvg };
  proposals.set(store, { ...values, reference });
  store.set(values);
}

const proposals = new WeakMap();  // by store

/** After a change: the new proposal, unless somebody has set the contrast by hand and the decibels are still the same. */
export function followContrast(store) {
  const proposed = proposals.get(store);
  const untouched = ["low", "high", "gain", "tvg"].every((name) => proposed && store.get(name) === proposed[name]);
  if (untouched || proposed?.reference !== store.get("sonar")?.reference) resetContrast(store);
}

/** Darkest: a third of the echoes are below; brightest: one in two thousand is above. */
export function fitContrast(store) {
  const ping = store.get("shown");
  const sonar = store.get("sonar");
  if (!ping || !sonar) return;
  const levels = [];
  for (let bin = 0; bin < ping.bins; ++bin) {
    const raised = store.get("gain") + store.get("tvg") * Math.log10(Math.max(binRange(sonar, bin), 0.01));
    for (let i = bin * ping.beams; i < (bin + 1) * ping.beams; ++i) {
      const level = levelDb(ping.tables.level[i]);
      if (level !== null) levels.push(level + raised);
    }
  }
  if (levels.length === 0) return;
  levels.sort((a, b) => a - b);
  const high = Math.ceil(levels[Math.floor(levels.length * 0.9995)]);
  const low = Math.floor(levels[Math.floor(levels.length * 0.33)]);
  store.set({ high, low: Math.max(high - 90, Math.min(low, high - 12)) });
}

const after = (list, item) => list[(list.indexOf(item) + 1) % list.length];

/** The next kind of picture, colour map or overlay, for the keyboard. */
export const nextPicture = (store) => store.set({ mode: after(productIn(store).pictures, store.get("mode")) });
export const nextMap = (store) => store.set({ map: after(kMaps, store.get("map")) });
export function nextOverlay(store) {
  const from = kOverlays.indexOf(store.get("overlay"));
  const order = [...kOverlays.slice(from + 1), ...kOverlays.slice(0, from + 1)];
  store.set({ overlay: order.find((overlay) => isThere(store, overlay)) });
}

// The paper's model has no shadows and no paths in its ground truth.
const isThere = (store, overlay) => !kCalibrated.includes(overlay) || store.get("hello")?.keys?.model?.value !== "paper";

let pingsSince = 0;     // that came since the overlay was chosen
const kUnderway = 3;    // of them were on their way before the server knew

// Whether the pings hold no such table, rather than not yet.
function isMissing(store, overlay, ping) {
  if (overlay === "none" || !ping || ping.tables[overlay]) return false;
  const truth = store.get("hello")?.keys?.ground_truth?.value;
  const lacks = truth === "none" || (truth === "labels" && kCalibrated.includes(overlay)) || !isThere(store, overlay);
  return lacks || pingsSince > kUnderway;
}

function drawLegend(store, roundPings) {
  const overlay = store.get("overlay");
  const ping = store.get("shown");
  const legend = byId("legend");
  const error = byId("overlay-error");
  const missing = isMissing(store, overlay, ping);
  error.hidden = !missing;
  if (missing) {
    const needs = kCalibrated.includes(overlay) ? "full" : "labels or full";
    write(error, isThere(store, overlay) ? `The pings hold no ${overlay}: set ground_truth to ${needs}.` : `The pings hold no ${overlay}: it needs the calibrated model.`);
  }
  const entries = overlay === "none" || !ping?.tables[overlay] ? [] : (kFixedLegends[overlay] ?? labelEntries(store, tablesOf(store, ping, overlay, roundPings), overlay));
  legend.hidden = entries.length === 0;
  const key = JSON.stringify(entries);
  if (legend.dataset.key === key) return;
  legend.dataset.key = key;
  legend.replaceChildren(...entries.map(([colour, name]) => {
    const patch = element("i");
    patch.style.background = colour;
    return element("li", {}, patch, name);
  }));
}

const kMostEntries = 12;

// The tables that the picture shows: a scanning head's picture has one for each ping of a turn.
function tablesOf(store, ping, overlay, roundPings) {
  return productIn(store).pings(ping, roundPings()).map((each) => each?.tables[overlay]).filter(Boolean);
}

function labelEntries(store, tables, overlay) {
  const names = store.get("hello")?.[overlay === "instance" ? "objects" : "materials"] ?? [];
  const counts = new Map();
  for (const table of tables) {
    for (let i = 0; i < table.length; i += 7) if (table[i] >= 0) counts.set(table[i], (counts.get(table[i]) ?? 0) + 1);
  }
  const found = [...counts].sort((a, b) => b[1] - a[1]).slice(0, kMostEntries).map(([label]) => label).sort((a, b) => a - b);
  return found.map((label) => [`rgb(${labelColour(label % 256).join(" ")})`, names[label] ?? String(label)]);
}
