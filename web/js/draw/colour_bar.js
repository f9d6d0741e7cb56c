// colour_bar.js -- the colour bar: levels of the colours in dB, and what the decibels refer to.

import { context2d, themeColour } from "../dom.js";
import { niceStep, number, ticks } from "../format.js";
import { colourTable } from "./colour_maps.js";

/** Draws the bar over the whole canvas. */
export function drawColourBar(canvas, store) {
  const { context, width, height } = context2d(canvas);
  if (width < 20 || height < 60) return;
  const low = store.get("low");
  const high = Math.max(store.get("high"), low + 0.1);
  const top = 32;
  const bottom = height - 26;
  const left = 2;
  const wide = 14;
  const table = colourTable(store.get("map"));
  for (let y = top; y < bottom; ++y) {
    const i = 4 * Math.round((255 * (bottom - y)) / (bottom - top));
    context.fillStyle = `rgb(${table[i]} ${table[i + 1]} ${table[i + 2]})`;
    context.fillRect(left, y, wide, 1.5);
  }
  context.strokeStyle = themeColour("--line");
  context.strokeRect(left - 0.5, top - 0.5, wide + 1, bottom - top + 1);
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "middle";
  context.fillStyle = themeColour("--text");
  for (const level of ticks(low, high, niceStep((high - low) / Math.max(2, (bottom - top) / 44)))) {
    const y = bottom - ((level - low) / (high - low)) * (bottom - top);
    context.fillRect(left + wide, y - 0.5, 4, 1);
    context.fillText(number(level), left + wide + 7, y);
  }
  context.save();
  context.translate(width - 9, (top + bottom) / 2);
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  context.fillStyle = themeColour("--soft");
  context.fillText(referenceText(store), 0, 0);
  context.restore();
}

/** What the shown decibels refer to: the sonar's reference and the gain of the display. */
export function referenceText(store) {
  const parts = [store.get("sonar")?.reference ?? "dB"];
  if (store.get("gain") !== 0) parts.push(`${number(store.get("gain"))} dB`);
  if (store.get("tvg") !== 0) parts.push(`${number(store.get("tvg"))} lg(r / m)`);
  return parts.join(" + ").replace("+ \u2212", "\u2212 ");
}
