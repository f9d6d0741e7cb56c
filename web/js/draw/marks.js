// marks.js -- markers and the ruler over a picture or a waterfall, wherever that has their points of the world.

import { seenAt } from "../measure.js";
import { beamAt } from "../sonar.js";
import { writeInside } from "./graticule.js";

const kMarker = "#8dffb4";
const kRuler = "#7de3ff";

const kAbeam = 0.04;  // Farther from abeam a point is not in the ping of a side-scan sonar [rad].

/** Place on the screen of a point of the world, as a ping at `pose` sees it; null where the picture does not reach. */
export function placeInPicture(plan, pose, point) {
  const { sonar, mode } = plan;
  const { range, azimuth } = seenAt(pose, point);
  if (range < sonar.min_range || range > sonar.max_range) return null;
  if (sonar.product.sides) {
    const side = azimuth > 0 ? 0 : 1;
    return Math.abs(azimuth - sonar.beamAzimuths[side]) < kAbeam ? plan.toScreen(side + 0.5, range) : null;
  }
  return mode === "round" || beamAt(sonar, azimuth) >= 0 ? plan.place(range, azimuth) : null;
}

/** Draws markers and `ruler` = { from, to: { point, ... }, or null }. `placesOf(mark)` are the places on the screen of a marker, or of
 * an end of the ruler, `text()` what the ruler reads; `width` is that of the picture. */
export function drawMarks(context, width, placesOf, { markers, ruler, text }) {
  for (const marker of markers) {
    for (const at of placesOf({ point: marker.position, ...marker })) drawMarker(context, at, marker.name);
  }
  if (ruler) drawRuler(context, width, placesOf, ruler, text);
}

/** Draws a marker and its name at a place of the screen. */
export function drawMarker(context, [x, y], name) {
  for (const [width, colour] of [[4, "rgb(0 10 16 / 75%)"], [1.6, kMarker]]) {
    context.lineWidth = width;
    context.strokeStyle = colour;
    context.beginPath();
    context.moveTo(x, y - 6);
    for (const [dx, dy] of [[6, 0], [0, 6], [-6, 0], [0, -6]]) context.lineTo(x + dx, y + dy);
    context.stroke();
  }
  writeInside(context, name, x + 9, y + 6);
}

function drawRuler(context, width, placesOf, { from, to }, text) {
  const [a, b] = [from, to ?? from].map((end) => placesOf(end)[0]);
  if (!a || !b) return;
  for (const [thick, colour] of [[4, "rgb(0 10 16 / 75%)"], [1.6, kRuler]]) {
    context.lineWidth = thick;
    context.strokeStyle = colour;
    context.beginPath();
    context.moveTo(...a);
    context.lineTo(...b);
    for (const [x, y] of [a, b]) {
      context.moveTo(x + 4, y);
      context.arc(x, y, 4, 0, 2 * Math.PI);
    }
    context.stroke();
  }
  context.lineWidth = 1;
  if (!to) return;
  const words = text();
  const x = Math.max(4, Math.min((a[0] + b[0]) / 2 + 10, width - context.measureText(words).width - 6));
  writeInside(context, words, x, (a[1] + b[1]) / 2 - 6);
}
