// screenshot.js -- keeps the large view as a PNG, with a line that says what it shows.

import { byId, download, themeColour } from "../dom.js";
import { referenceText } from "../draw/colour_bar.js";
import { clock, number } from "../format.js";

const kBand = 30;  // height of the line of text [px]

/** The large view as a canvas; `redraw` draws all views, since a browser keeps no drawn WebGL picture. */
export function composeScreenshot(store, redraw) {
  redraw();
  const view = document.querySelector(".view[data-place=main]");
  const box = view.getBoundingClientRect();
  const scale = Math.min(window.devicePixelRatio || 1, 2);
  const made = document.createElement("canvas");
  made.width = Math.round(box.width * scale);
  made.height = Math.round((box.height + kBand) * scale);
  const context = made.getContext("2d");
  context.scale(scale, scale);
  context.fillStyle = themeColour("--panel");
  context.fillRect(0, 0, box.width, box.height + kBand);
  for (const canvas of view.querySelectorAll("canvas")) {
    const part = canvas.getBoundingClientRect();
    context.drawImage(canvas, part.left - box.left, part.top - box.top, part.width, part.height);
  }
  context.font = "12px system-ui, sans-serif";
  context.textBaseline = "middle";
  context.fillStyle = themeColour("--text");
  context.fillText(captionOf(store), 11, box.height + kBand / 2, box.width - 22);
  return made;
}

function captionOf(store) {
  const ping = store.get("shown");
  const sonar = store.get("sonar");
  const parts = ["insonify", store.get("hello")?.scenario_name ?? "", sonar?.name ?? ""];
  if (ping) parts.push(`ping ${ping.number}, ${clock(ping.time)} s`);
  if (sonar) parts.push(`${number(sonar.min_range, 1)} to ${number(sonar.max_range, 1)} m`);
  parts.push(`${number(store.get("low"))} to ${number(store.get("high"))} ${referenceText(store)}`);
  return parts.filter(Boolean).join("   ");
}

export function takeScreenshot(store, redraw, notes) {
  const sonar = (store.get("sonar")?.name ?? "sonar").replace(/[^\w-]+/g, "_");
  const name = `insonify_${sonar}_${store.get("shown")?.number ?? 0}.png`;
  composeScreenshot(store, redraw).toBlob((blob) => {
    download(name, blob);
    notes.note(`Screenshot ${name}`);
  }, "image/png");
}

export function setUpScreenshot(store, redraw, notes) {
  byId("shot").addEventListener("click", () => takeScreenshot(store, redraw, notes));
}
