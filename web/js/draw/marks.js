// marks.js -- markers and the ruler over a picture: where the shown ping, or the camera, sees their points of the world.

import { rulerFigures, rulerText, seenAt } from "../measure.js";
import { beamAt } from "../sonar.js";
import { writeInside } from "./graticule.js";

const kMarker = "#8dffb4";
const kRuler = "#7de3ff";

// Place on the screen of a point of the world; null where the picture does not reach.
function placeOf(plan, pose, point) {
  const { sonar, mode } = plan;
  const { range, azimuth } = seenAt(pose, point);
  if (range < sonar.min_range || range > sonar.max_range) return null;
  return mode === "round" || beamAt(sonar, azimuth) >= 0 ? plan.place(range, azimuth) : null;
}

/** Draws `markers` and `ruler` = { from, to: points or null } as a ping at `pose` sees them, `altitude` [m] above the ground. */
export function drawMarks(context, plan, pose, { markers, ruler, altitude }) {
  for (const { name, position } of markers) {
    const at = placeOf(plan, pose, position);
    if (at) drawMarker(context, at, name);
  }
  if (ruler) drawRuler(context, plan, pose, ruler, altitude);
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

function drawRuler(context, plan, pose, { from, to }, altitude) {
  const [a, b] = [from, to ?? from].map((point) => placeOf(plan, pose, point));
  if (!a || !b) return;
  for (const [width, colour] of [[4, "rgb(0 10 16 / 75%)"], [1.6, kRuler]]) {
    context.lineWidth = width;
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
  const text = rulerText(rulerFigures(pose, from, to, altitude));
  const x = Math.max(4, Math.min((a[0] + b[0]) / 2 + 10, plan.width - context.measureText(text).width - 6));
  writeInside(context, text, x, (a[1] + b[1]) / 2 - 6);
}
