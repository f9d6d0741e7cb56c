// snapshot.js -- keeps the large view as a PNG with lines that say what it shows: the sonar picture at the resolution of its bins.

import { byId, download, themeColour } from "../dom.js";
import { referenceText } from "../draw/colour_bar.js";
import { clock, niceStep, number, triple } from "../format.js";
import { poseFigures, poseTexts } from "../pose.js";

const kLine = 18;    // height of a line of text [px]
const kMost = 4096;  // pixels of a side that every graphics card draws

/** The large view as a canvas; `redraw` draws all views, since a browser keeps no drawn WebGL picture. */
export function composeSnapshot(store, picture, redraw) {
  const isPicture = store.get("main") === "picture" && picture.plan;
  const view = document.querySelector(".view[data-place=main] .stage");
  const [width, height] = isPicture ? [picture.plan.width, picture.plan.height] : [view.clientWidth, view.clientHeight];
  const sharp = isPicture ? picture.pixelsNeeded : 0;
  const scale = Math.min(Math.max(sharp, 2, window.devicePixelRatio || 1), kMost / Math.max(width, height));
  const made = document.createElement("canvas");
  const context = made.getContext("2d");
  context.font = "12px system-ui, sans-serif";
  const lines = captionOf(store).flatMap((line) => wrapped(context, line, width - 22));
  made.width = Math.round(width * scale);
  made.height = Math.round((height + kLine * lines.length + 10) * scale);
  context.fillStyle = themeColour("--panel");
  context.fillRect(0, 0, made.width, made.height);
  if (isPicture) picture.paint(context, scale);
  else redraw();
  context.scale(scale, scale);
  if (isPicture) drawScale(context, picture.plan);
  else for (const canvas of view.querySelectorAll("canvas")) if (canvas.offsetParent) context.drawImage(canvas, 0, 0, width, height);
  context.font = "12px system-ui, sans-serif";
  context.textBaseline = "middle";
  context.textAlign = "left";
  context.fillStyle = themeColour("--text");
  lines.forEach((line, i) => context.fillText(line, 11, height + 5 + kLine * (i + 0.5)));
  return made;
}

// Parts of a line, three spaces between them, on as many lines as they need.
function wrapped(context, line, width) {
  const lines = [];
  for (const part of line.split("   ")) {
    const longer = lines.length > 0 ? `${lines.at(-1)}   ${part}` : part;
    if (lines.length > 0 && context.measureText(longer).width <= width) lines[lines.length - 1] = longer;
    else lines.push(part);
  }
  return lines;
}

// A bar of so many metres in the corner that figures have on the screen.
function drawScale(context, plan) {
  if (plan.mode === "polar") return;
  const perMetre = plan.toScreen(1, 0)[0] - plan.toScreen(0, 0)[0];
  const metres = niceStep(60 / perMetre);
  const [left, y] = [14, plan.height - 14];
  const right = left + metres * perMetre;
  context.strokeStyle = context.fillStyle = themeColour("--text");
  context.lineWidth = 1.5;
  context.beginPath();
  for (const [x, dy] of [[left, -5], [left, 0], [right, 0], [right, -5]]) context.lineTo(x, y + dy);
  context.stroke();
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.fillText(`${number(metres, metres < 1 ? 1 : 0)} m`, (left + right) / 2, y - 3);
}

/** What a snapshot says: what it is of, the pose, and the settings. */
export function captionOf(store) {
  const { shown: ping, sonar, hello } = Object.fromEntries(["shown", "sonar", "hello"].map((name) => [name, store.get(name)]));
  const lines = [["insonify", hello?.version, hello?.scenario_name, sonar && `${sonar.name}${sonar.model ? ` (${sonar.model})` : ""}`, ping && `ping ${ping.number}, ${clock(ping.time)} s`, new Date().toISOString().slice(0, 19) + "Z"]];
  const vehicle = ping?.vehicle ?? ping?.pose;
  if (vehicle) lines.push([`${triple(vehicle.position)} m`, ...poseTexts(poseFigures(vehicle, hello, store.get("ground")))]);
  if (sonar) {
    const key = (path) => hello?.keys?.[path]?.value;
    const index = hello?.sonars.findIndex(({ name }) => name === sonar.name);
    const on = ["noise", "speckle"].filter((name) => key(`sonars[${index}].receiver.${name}`));
    lines.push([`${number(sonar.min_range, 1)} to ${number(sonar.max_range, 1)} m`, `${sonar.bins} bins x ${sonar.beams} beams`,
      `${number(store.get("low"))} to ${number(store.get("high"))} ${referenceText(store)}`, `colours ${store.get("map")}`,
      store.get("overlay") !== "none" && `overlay ${store.get("overlay")}`, key("model") && `model ${key("model")}`, on.length > 0 && `with ${on.join(" and ")}`]);
  }
  return lines.map((parts) => parts.filter(Boolean).join("   "));
}

export function setUpSnapshot(store, picture, redraw, notes) {
  byId("shot").addEventListener("click", () => {
    const sonar = (store.get("sonar")?.name ?? "sonar").replace(/[^\w-]+/g, "_");
    const name = `insonify_${sonar}_${store.get("shown")?.number ?? 0}.png`;
    const made = composeSnapshot(store, picture, redraw);
    made.toBlob((blob) => {
      download(name, blob);
      notes.note(`Snapshot ${name}, ${made.width} x ${made.height}`);
    }, "image/png");
  });
}
