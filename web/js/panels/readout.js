// readout.js -- what lies under the cursor: range, bearing, level, beam, bin, place in the world, object and material.

import { byId, write } from "../dom.js";
import { bearing, decibels, metres, number, triple } from "../format.js";
import { levelDb } from "../link/decode.js";
import { worldPoint } from "../measure.js";

const kFields = ["range", "bearing", "level", "beam", "bin", "world", "object", "material"];

/** What the shown ping holds at a cursor; `roundPings` are the pings of the round picture's columns. */
export function lookUp(store, cursor, roundPings) {
  const sonar = store.get("sonar");
  if (cursor.row) return lookUpRow(sonar, cursor);
  const ping = cursor.slot === undefined ? store.get("shown") : roundPings[cursor.slot];
  // The picture of a side-scan sonar is as wide as it likes: its beams look abeam.
  const azimuth = sonar?.product.sides ? sonar.beamAzimuths[cursor.beam] : cursor.azimuth;
  const found = { ...cursor, azimuth, sonar };
  if (!ping || !sonar || ping.bins !== sonar.bins || ping.beams !== sonar.beams) return found;
  const cell = cursor.bin * ping.beams + cursor.beam;
  const { level, instance, material, elevation } = ping.tables;
  const names = store.get("hello");
  const label = instance ? instance[cell] : -1;
  const surface = material ? material[cell] : -1;
  // The azimuth of a scanning head is that of the head in its housing, which is also how its picture is drawn.
  return {
    ...found,
    ping,
    level: levelDb(level[cell]),
    world: worldPoint(sonar, ping.pose, { range: cursor.range, azimuth }, elevation?.[cell], store.get("ground")),
    instance: label,
    object: label >= 0 ? (names?.objects[label] ?? `object ${label}`) : null,
    material: surface >= 0 ? (names?.materials[surface] ?? `material ${surface}`) : null,
    labelled: Boolean(instance),
  };
}

// The same in a row of the waterfall, which keeps no labels.
function lookUpRow(sonar, cursor) {
  const { row, beam, bin } = cursor;
  const level = row.tables?.level;
  return { ...cursor, sonar, ping: row, level: level ? levelDb(level[bin * row.beams + beam]) : undefined, instance: -1, object: null, material: null, labelled: true };
}

/** Gain of the display at a range [dB]. */
const shownGain = (store, range) => store.get("gain") + (store.get("tvg") && store.get("tvg") * Math.log10(Math.max(range, 0.01)));

function levelText({ level }, gain) {
  if (level === null) return "no echo";
  if (level === undefined) return "–";
  const shown = number(level + gain, 1);
  return shown === number(level, 1) ? decibels(level) : `${decibels(level)} (shown ${shown})`;
}

/** Keeps the line of figures up to date. */
export function setUpReadout(store, frames, roundPings) {
  const clear = () => kFields.forEach((name) => write(byId(`read-${name}`), "–"));
  const show = () => {
    const cursor = store.get("cursor");
    byId("readout").toggleAttribute("data-cursor", Boolean(cursor));
    if (!cursor) {
      clear();
      return;
    }
    const found = lookUp(store, cursor, roundPings());
    write(byId("read-range"), metres(found.range, found.sonar.binLength));
    write(byId("read-bearing"), bearing(found.azimuth, found.sonar.vertical));
    const level = levelText(found, shownGain(store, found.range));
    write(byId("read-level"), level);
    byId("read-level").title = level.includes("shown") ? `${level}: shown with the gain of the display` : "";
    write(byId("read-beam"), String(found.beam));
    write(byId("read-bin"), String(found.bin));
    write(byId("read-world"), found.world ? triple(found.world) : "–");
    write(byId("read-object"), found.object ?? "–");
    write(byId("read-material"), found.material ?? "–");
    byId("read-object").title = found.object ?? "";
  };
  store.on(["cursor", "shown", "hello", "gain", "tvg"], frames.add(show));
}
