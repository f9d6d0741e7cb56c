// graticule.js -- range rings, radials, labels, sweep line and cursor over the picture.

import { themeColour } from "../dom.js";
import { number, ringSpacing, slope, ticks } from "../format.js";
import { degrees, radians, wrapped } from "../geometry.js";

const kFont = "11px system-ui, sans-serif";
const kWide = 36;    // that of an angle [pixels]
const kBeside = 58;  // room for a label beside the fan [pixels]

/** Draws all lines of `plan`; `options` = { grid, cursor, beam, headAngle }. */
export function drawGraticule(context, plan, options) {
  context.font = kFont;
  context.lineWidth = 1;
  if (options.grid) {
    if (plan.mode === "polar") drawPolarGrid(context, plan);
    else drawRings(context, plan);
  }
  if (plan.mode === "round") drawSweep(context, plan, options.headAngle);
  if (options.cursor) drawCross(context, plan.place(options.cursor.range, options.cursor.azimuth));
}

const isSmall = (plan) => plan.width < 420;

function drawRings(context, plan) {
  const { sonar, mode } = plan;
  const whole = mode === "round";
  const port = whole ? Math.PI : sonar.ports[0];
  const starboard = whole ? -Math.PI : sonar.starboards.at(-1);
  const spacing = ringSpacing(sonar.max_range);
  const rings = ticks(spacing, sonar.max_range, spacing);
  const [apexX, apexY] = plan.toScreen(0, 0);
  const radiusOf = (range) => plan.toScreen(range, 0)[0] - apexX;
  const arc = (range) => {
    context.beginPath();
    const ends = sonar.down ? [Math.PI / 2 + starboard, Math.PI / 2 + port] : [sonar.up - Math.PI / 2 - port, sonar.up - Math.PI / 2 - starboard];
    context.arc(apexX, apexY, radiusOf(range), ...ends);
    context.stroke();
  };
  context.strokeStyle = themeColour("--ring");
  rings.forEach(arc);
  arc(sonar.max_range);
  if (sonar.min_range > 0.03 * sonar.max_range) arc(sonar.min_range);
  for (const azimuth of radialsOf(plan, port, starboard)) {
    context.beginPath();
    context.moveTo(...plan.place(sonar.min_range, azimuth));
    context.lineTo(...plan.place(sonar.max_range, azimuth));
    context.stroke();
  }
  const hasAhead = !whole && port > 0 && starboard < 0;
  if (hasAhead) drawAhead(context, plan);
  const labelled = [...radialsOf(plan, port, starboard), ...(hasAhead ? [0] : [])];
  writeApart(context, plan, labelled.map((azimuth) => radialLabel(plan, azimuth, !whole && (azimuth === port || azimuth === starboard))));
  rings.forEach((range) => labelRing(context, plan, range, whole ? sonar.up - Math.PI / 4 : port));
}

// Every 20 degrees, beginning at 10 to either side, and both edges; every 30 around a full circle.
function radialsOf(plan, port, starboard) {
  if (plan.mode === "round") return ticks(-150, 180, 30).map(radians);
  const step = port - starboard < radians(50) ? 5 : 10;
  const found = [port, starboard];
  for (let at = step; radians(at) < Math.max(port, -starboard) - radians(step / 2); at += 2 * step) {
    if (radians(at) < port) found.push(radians(at));
    if (radians(-at) > starboard) found.push(radians(-at));
  }
  return found;
}

// A tick at the outer arc: a radial would hide echoes right ahead.
function drawAhead(context, plan) {
  const [x, y] = plan.place(plan.sonar.max_range, 0);
  context.strokeStyle = themeColour("--soft");
  context.beginPath();
  context.moveTo(x, y - 4 * plan.sonar.sign);
  context.lineTo(x, y + 7 * plan.sonar.sign);
  context.stroke();
  context.strokeStyle = themeColour("--ring");
}

function radialLabel(plan, azimuth, isEdge = false) {
  const [x, y] = plan.place(plan.sonar.max_range * 1.0, azimuth);
  const { sign } = plan.sonar;
  const angle = plan.sonar.up - azimuth;
  const up = sign * Math.cos(angle);
  const isBeside = x > kBeside && x < plan.width - kBeside;
  if (isEdge && !isBeside) {  // Below the corner, above that of a fan that looks down.
    return { isEdge, text: radialText(plan.sonar, azimuth), align: azimuth > 0 ? "left" : "right", baseline: sign > 0 ? "top" : "bottom", x, y: y + sign * edgeDrop(azimuth) };
  }
  return {
    isEdge,
    text: radialText(plan.sonar, azimuth),
    align: Math.sin(angle) > 0.2 ? "left" : Math.sin(angle) < -0.2 ? "right" : "center",
    baseline: up < -0.5 || (sign < 0 && up < -0.2) ? "top" : "bottom",
    x: x > 0 && x < plan.width ? Math.min(Math.max(x + 5 * Math.sin(angle), kWide), plan.width - kWide) : x,
    y: y - (azimuth === 0 && plan.mode === "fan" ? 6 : 4) * up,
  };
}

// How far below the corner of a fan a label is free of its edge.
const edgeDrop = (azimuth) => 3 + Math.max(0, kWide / Math.tan(Math.abs(azimuth)));

// Leaves out labels that would lie on others. Those of the edges come first, unless they lie on each other.
function writeApart(context, plan, labels) {
  if (isSmall(plan)) return;
  const boxOf = ({ text, align, baseline, x, y }) => {
    const width = context.measureText(text).width;
    const [height, gap] = [12, 4];  // Height of the font, and gap between labels [pixels].
    const left = x - { left: 0, center: width / 2, right: width }[align];
    const top = y - { top: 0, middle: height / 2, bottom: height }[baseline];
    return { left, right: left + width + gap, top, bottom: top + height };
  };
  const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  const edges = labels.filter(({ isEdge }) => isEdge);
  const others = labels.filter(({ isEdge }) => !isEdge);
  const crossed = edges.length === 2 && overlap(boxOf(edges[0]), boxOf(edges[1]));
  const written = [];
  context.fillStyle = themeColour("--soft");
  for (const label of crossed ? [...others.reverse(), ...edges] : [...edges, ...others]) {
    const box = boxOf(label);
    if (written.some((other) => overlap(box, other))) continue;
    written.push(box);
    context.textAlign = label.align;
    context.textBaseline = label.baseline;
    context.fillText(label.text, label.x, label.y);
  }
}

function radialText({ vertical }, azimuth) {
  if (vertical) return slope(degrees(wrapped(azimuth)), 0).replace(/, back$/, "");
  const angle = Number(Math.abs(degrees(azimuth)).toFixed(1));
  return angle === 0 || angle === 180 ? `${angle}°` : `${angle}° ${azimuth > 0 ? "P" : "S"}`;
}

// At the left edge of the fan, beside it.
function labelRing(context, plan, range, azimuth) {
  const [x, y] = plan.place(range, azimuth);
  if (x < -20 || y < 0 || x > plan.width || y > plan.height) return;
  const text = `${number(range, Number.isInteger(range) ? 0 : 1)} m`;
  const wide = context.measureText(text).width;
  if (isSmall(plan) && x < wide + 8) return;  // Small pictures have no room over the echoes.
  if (plan.mode === "round") {
    writeInside(context, text, x - wide - 3, y + 9);
    return;
  }
  const isLast = range > 0.97 * plan.sonar.max_range;  // The edge's own label is there.
  const isBeside = x > kBeside || !isLast;
  context.textAlign = isBeside ? "right" : "left";
  context.textBaseline = "middle";
  context.fillStyle = themeColour("--soft");
  context.fillText(text, isBeside ? x - 6 : x, y + plan.sonar.sign * (isLast ? (isBeside ? 14 : edgeDrop(azimuth) + 20) : 3));
}

/** Writes over the picture, with an outline; the text's lower left corner is at x, y. */
export function writeInside(context, text, x, y) {
  context.textAlign = "left";
  context.textBaseline = "bottom";
  context.lineWidth = 3;
  context.lineJoin = "round";
  context.strokeStyle = "rgb(0 10 16 / 75%)";
  context.strokeText(text, x, y);
  context.lineWidth = 1;
  context.fillStyle = "#e6eff4";
  context.fillText(text, x, y);
  context.strokeStyle = themeColour("--ring");
}

function drawPolarGrid(context, plan) {
  const { sonar } = plan;
  const spacing = ringSpacing(sonar.max_range);
  const [left] = plan.toScreen(0, 0);
  const [right] = plan.toScreen(sonar.beams, 0);
  context.strokeStyle = themeColour("--ring");
  for (const range of ticks(Math.max(spacing, sonar.min_range), sonar.max_range, spacing)) {
    const [, y] = plan.toScreen(0, range);
    context.beginPath();
    context.moveTo(left, y);
    context.lineTo(right, y);
    context.stroke();
    const text = `${number(range, Number.isInteger(range) ? 0 : 1)} m`;
    if (isSmall(plan)) {
      if (y > 40) writeInside(context, text, left + 4, y - 2);  // Above is the caption.
      continue;
    }
    context.fillStyle = themeColour("--soft");
    context.textBaseline = "middle";
    context.textAlign = "right";
    context.fillText(text, Math.max(left - 5, 32), y);
  }
  const labels = [];
  const [, bottom] = plan.toScreen(0, sonar.min_range);
  const [, top] = plan.toScreen(0, sonar.max_range);
  if (sonar.product.sides) {
    drawSides(context, plan, bottom, top);
    return;
  }
  const [port, starboard] = [sonar.ports[0], sonar.starboards.at(-1)];
  for (const azimuth of [...radialsOf(plan, port, starboard), ...(port > 0 && starboard < 0 ? [0] : [])]) {
    const [x] = plan.place(sonar.max_range, Math.min(Math.max(azimuth, starboard + 1e-9), port));
    context.beginPath();
    context.moveTo(x, bottom);
    context.lineTo(x, azimuth === 0 ? bottom - 7 : top);
    context.stroke();
    const isEdge = azimuth === port || azimuth === starboard;
    labels.push({ isEdge, text: radialText(sonar, azimuth), align: "center", baseline: "middle", x, y: bottom + 12 });
  }
  writeApart(context, plan, labels);
}

// The two beams of a side-scan sonar, side by side.
function drawSides(context, plan, bottom, top) {
  const [x] = plan.toScreen(1, 0);
  context.beginPath();
  context.moveTo(x, bottom);
  context.lineTo(x, top);
  context.stroke();
  const label = (text, beam) => ({ isEdge: false, text, align: "center", baseline: "middle", x: plan.toScreen(beam + 0.5, 0)[0], y: bottom + 12 });
  writeApart(context, plan, [label("port", 0), label("starboard", 1)]);
}

function drawSweep(context, plan, headAngle) {
  context.strokeStyle = "#7dffb0";
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(...plan.toScreen(0, 0));
  context.lineTo(...plan.place(plan.sonar.max_range, headAngle));
  context.stroke();
  context.lineWidth = 1;
}

/** Draws a cursor at a place of the screen. */
export function drawCross(context, [x, y]) {
  for (const [width, colour] of [[3, "rgb(0 10 16 / 70%)"], [1.3, "#7de3ff"]]) {
    context.lineWidth = width;
    context.strokeStyle = colour;
    context.beginPath();
    context.arc(x, y, 7, 0, 2 * Math.PI);
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.moveTo(x + 4 * dx, y + 4 * dy);
      context.lineTo(x + 13 * dx, y + 13 * dy);
    }
    context.stroke();
  }
  context.lineWidth = 1;
}
