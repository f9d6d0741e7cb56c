// colour_bar.js -- the colour bar: levels of the colours in dB, and what the decibels refer to.

import { context2d, themeColour } from "../dom.js";
import { niceStep, number, ticks } from "../format.js";
import { colourTable } from "./colour_maps.js";

/** Draws the bar over the whole canvas. */
export function drawColourBar(canvas, store, bar = levelBar(store)) {
  const { context, width, height } = context2d(canvas);
  if (width >= 60 && height >= 40) paintColourBar(context, bar, width);
}

/** What the colour bar of levels shows: { low, high, map, text }. */
export const levelBar = (store, high = store.get("high")) => ({ low: store.get("low"), high: Math.max(high, store.get("low") + 0.1), map: store.get("map"), text: referenceText(store) });

/** Draws a bar of `width` pixels and 46 of height: colours, values, and what they are. */
export function paintColourBar(context, { low, high, map, text }, width) {
  const [left, right, deep] = [12, width - 12, 10];
  const table = colourTable(map);
  for (let x = left; x < right; ++x) {
    const i = 4 * Math.round((255 * (x - left)) / (right - left));
    context.fillStyle = `rgb(${table[i]} ${table[i + 1]} ${table[i + 2]})`;
    context.fillRect(x, 1, 1.5, deep);
  }
  context.strokeStyle = themeColour("--line");
  context.strokeRect(left - 0.5, 0.5, right - left + 1, deep + 1);
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "top";
  context.textAlign = "center";
  context.fillStyle = themeColour("--text");
  const step = niceStep((high - low) / Math.max(2, (right - left) / 44));
  for (const level of ticks(low, high, step)) {
    const x = left + ((level - low) / (high - low)) * (right - left);
    context.fillRect(x - 0.5, deep + 1, 1, 4);
    context.fillText(number(level, step < 0.1 ? 2 : step < 1 ? 1 : 0), x, deep + 6);
  }
  context.fillStyle = themeColour("--soft");
  context.fillText(text, (left + right) / 2, deep + 21, width);
}

/** What the shown decibels refer to: the sonar's reference and the gain of the display, as on the pictures of `draw`. */
export function referenceText(store) {
  const parts = [store.get("sonar")?.reference ?? "dB"];
  if (store.get("gain") !== 0) parts.push(`${number(store.get("gain"))} dB`);
  if (store.get("tvg") !== 0) parts.push(`${number(store.get("tvg"))} log r`);
  return parts.join(", + ").replace("+ \u2212", "\u2212 ");
}
