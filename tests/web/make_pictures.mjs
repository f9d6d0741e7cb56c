// make_pictures.mjs -- makes the documents' pictures of the viewer: docs/images/viewer_*.png, and the moving one, viewer.gif.
//
// Usage: ./dev pictures [png] [gif]. It makes both unless one is named.

import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { pause, sourceRoot } from "./checks.mjs";
import { flight, pointAt, visitWith } from "./paused_page.mjs";

const kRoot = sourceRoot();
const kFerry = path.join(kRoot, "scenes/ferry_calibrated.yaml");
const kImages = path.join(kRoot, "docs/images");
const kFrames = 44;
const kTurn = 330;  // pings of a scanning head: most of a turn
const kLine = 190;  // pings of a side-scan sonar
const kSwath = 50;  // pings of a multibeam
const kPeriod = 0.5;  // between the pings of the flight [s]

const program = path.resolve(process.argv[2] ?? path.join(kRoot, "build/release/insonify"));
const wanted = process.argv.length > 3 ? process.argv.slice(3) : ["png", "gif"];
const visit = (...where) => visitWith(program, ...where);
const scratch = mkdtempSync(path.join(tmpdir(), "insonify-pictures-"));

/** A PNG of 256 colours, which is a third of the size. */
async function keep(view, name) {
  await pause(0.6);
  await view.drawn();
  const raw = path.join(scratch, "raw.png");
  const file = path.join(kImages, `viewer_${name}.png`);
  writeFileSync(raw, await view.page.screenshot());
  execFileSync("ffmpeg", ["-y", "-loglevel", "error", "-i", raw, "-vf", "split[a][b];[a]palettegen=max_colors=255[p];[b][p]paletteuse=dither=none", file]);
  console.log(`${file}: ${Math.round(statSync(file).size / 1000)} kB`);
}

// A side-scan sonar past the container, the ruler over its shadow; a multibeam above it.
async function makeSurveyPngs() {
  const scene = path.join(kRoot, "scenes/survey.yaml");
  const flown = ["--set", "pattern=null", "--set", "trajectory=[{time: 0, position: [-22, -2, 4.5]}, {time: 40, position: [22, -2, 4.5]}]"];
  let view = await visit(scene, flown, {});
  for (let i = 0; i < kLine; ++i) await view.next();
  await view.set({ bottomLine: true });
  await view.drawn();
  await keep(view, "side_scan");
  await view.end();
  const head = ["--set", "sonars=[{name: head, preset: r2sonic-2024, mode: 400khz, max_range: 20, bin_count: 500, ping_period: 0.4}]"];
  view = await visit(scene, [...flown, ...head], {});
  for (let i = 0; i < kSwath; ++i) await view.next();
  await keep(view, "multibeam");
  await view.end();
}

async function makePngs() {
  let view = await visit(kFerry, ["--set", "ground_truth=full"], {});
  for (let i = 0; i < 12; ++i) await view.next();
  await pointAt(view, 29, 0.12);
  await keep(view, "dark");
  await view.page.evaluate(() => document.getElementById("tab-sonar").click());
  await view.set({ overlay: "instance", controls: true });
  await view.next();
  await pointAt(view, 29, 0.12);
  await keep(view, "objects");
  await view.set({ overlay: "none", mode: "polar", map: "copper", controls: false });
  await keep(view, "polar");
  await view.page.evaluate(() => document.getElementById("tab-scene").click());
  await view.set({ mode: "fan", map: "inferno", main: "scene" });
  await view.page.evaluate(() => document.getElementById("camera-orbit").click());
  await keep(view, "scene");
  await view.set({ main: "picture" });
  await view.page.evaluate(() => document.getElementById("help").showModal());
  await keep(view, "help");
  await view.end();

  view = await visit(kFerry, [], { theme: "light" });
  for (let i = 0; i < 12; ++i) await view.next();
  await pointAt(view, 29, 0.12);
  await keep(view, "light");
  await view.end();

  view = await visit(kFerry, [], { width: 1024, height: 768, touch: true });
  for (let i = 0; i < 8; ++i) await view.next();
  await keep(view, "tablet");
  await view.end();

  view = await visit(path.join(kRoot, "scenes/tank_calibrated.yaml"), [], {});
  for (let i = 0; i < kTurn; ++i) await view.next();
  await keep(view, "round");
  await view.end();

  await makeSurveyPngs();

  const along = ["--set", `trajectory=[${flight.join(", ")}]`];
  execFileSync(program, ["run", kFerry, "-o", scratch, "--no-pictures", "--duration", "12", "--set", "ground_truth=full", ...along, "--set", "ping_period=0.2"]);
  view = await visit(kFerry, [], {}, ["replay", path.join(scratch, "fls.h5"), "--view", "--folder", path.dirname(kFerry)]);
  for (let i = 0; i < 40; ++i) await view.next();
  await view.page.evaluate(() => document.getElementById("tab-sonar").click());
  await pointAt(view, 20, 0.1);
  await keep(view, "replay");
  await view.end();
}

async function makeGif() {
  const view = await visit(kFerry, ["--set", `trajectory=[${flight.join(", ")}]`, "--set", `ping_period=${kPeriod}`], {});
  // It is paused between the frames, and makes pings as fast as they can be kept: neither is of interest.
  await view.page.evaluate(() => {
    document.querySelector(".rates").style.visibility = "hidden";
    insonify.store.on(["status"], (store) => store.get("status")?.paused && store.set({ status: { ...store.get("status"), paused: false } }));
  });
  for (let i = 0; i < kFrames; ++i) {
    await view.next();
    if (i === 0) await pause(2);
    if (i < kFrames * 0.45) await pointAt(view, 31 - 0.4 * i, 0.12);
    if (i === Math.round(kFrames * 0.45)) await view.set({ main: "scene" });
    await view.drawn();
    writeFileSync(path.join(scratch, `frame_${String(i).padStart(3, "0")}.png`), await view.page.screenshot());
  }
  await view.end();
  const file = path.join(kImages, "viewer.gif");
  // Speckle does not compress: fewer pictures a second, pixels and colours keep the file below a megabyte.
  const filter = "fps=4,scale=640:-1:flags=area,split[a][b];[a]palettegen=max_colors=20:stats_mode=full[p];[b][p]paletteuse=dither=none:diff_mode=rectangle";
  execFileSync("ffmpeg", ["-y", "-loglevel", "error", "-framerate", "6", "-i", path.join(scratch, "frame_%03d.png"), "-filter_complex", filter, "-loop", "0", file]);
  console.log(`${file}: ${(statSync(file).size / 1e6).toFixed(2)} MB`);
}

if (wanted.includes("png")) await makePngs();
if (wanted.includes("gif")) await makeGif();
rmSync(scratch, { recursive: true });
