// make_film.mjs -- makes the site's film of the viewer, 90 s: build/film/film.mp4. Each chapter has a line of text on the picture.
//
// Usage: ./dev pictures film [SECONDS]. A shorter film has all chapters, each as much shorter.

import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { sourceRoot } from "./checks.mjs";
import { flight, pointAt, visitWith } from "./paused_page.mjs";

const kRoot = sourceRoot();
const kScenes = path.join(kRoot, "scenes");
const kFerry = path.join(kScenes, "ferry_calibrated.yaml");
const kRate = 6;  // pictures a second
const kLength = 90;  // of the whole film [s]

const program = path.resolve(process.argv[2] ?? path.join(kRoot, "build/release/insonify"));
const share = Number(process.argv[4] ?? kLength) / kLength;
const scratch = mkdtempSync(path.join(tmpdir(), "insonify-film-"));
let frames = 0;

/** Writes a line over the page. */
const caption = (view, text) => view.page.evaluate((words) => {
  const line = document.getElementById("film-caption") ?? document.body.appendChild(document.createElement("div"));
  line.id = "film-caption";
  line.textContent = words;
  line.style = "position:fixed;z-index:99;left:50%;top:8%;transform:translateX(-50%);padding:.4em 1em;border-radius:6px;"
    + "background:#000c;color:#fff;font:600 22px system-ui,sans-serif;white-space:nowrap";
}, text);

/** So many seconds of the page, a ping for each picture unless it stands; `each` acts before picture i of n. */
async function shoot(view, seconds, text, each = async () => {}, stands = false) {
  await caption(view, text);
  const count = Math.max(2, Math.round(seconds * kRate * share));
  for (let i = 0; i < count; ++i) {
    await each(i, count);
    await (stands ? view.drawn() : view.next());
    writeFileSync(path.join(scratch, `frame_${String(frames++).padStart(4, "0")}.png`), await view.page.screenshot());
  }
}

/** Pings as fast as they can be kept are of no interest, nor is that the server pauses between them. */
const hideRates = (view) => view.page.evaluate(() => {
  document.querySelector(".rates").style.visibility = "hidden";
  insonify.store.on(["status"], (store) => store.get("status")?.paused && store.set({ status: { ...store.get("status"), paused: false } }));
});

/** Along the ferry: the picture, its values, its objects, the scene. 48 s. */
async function ferry() {
  const view = await visitWith(program, kFerry, ["--set", `trajectory=[${flight.join(", ")}]`, "--set", `ping_period=${22 / (48 * kRate * share)}`, "--set", "ground_truth=full"], {});
  await hideRates(view);
  await shoot(view, 8, "insonify: a simulator of imaging sonars");
  await shoot(view, 12, "Levels in decibels, speckle, shadows: a Gemini 720i at a wreck", (i, n) => pointAt(view, 36 - (14 * i) / n, 0.12));
  await view.set({ overlay: "instance" });
  await shoot(view, 10, "Ground truth: the object of every bin");
  await view.set({ overlay: "none", main: "scene" });
  await shoot(view, 10, "Where the echoes come from");
  await view.set({ main: "picture", mode: "polar", map: "copper" });
  await shoot(view, 8, "As recorded: beams by ranges");
  await view.end();
}

/** A scanning head in a tank. 16 s. */
async function tank() {
  const view = await visitWith(program, path.join(kScenes, "tank_calibrated.yaml"), [], {});
  await hideRates(view);
  const steps = Math.round(400 / (16 * kRate * share));  // Pings of a turn for each picture.
  await shoot(view, 16, "A scanning head in a tank, ping by ping", async () => {
    for (let i = 1; i < steps; ++i) await view.next();
  });
  await view.end();
}

/** Other instruments in the same page. 26 s. */
async function others() {
  for (const [name, seconds, text] of [["ssiv", 10, "An Oculus M1200d at a valve"], ["cooler", 10, "An Oculus M750d at a subsea cooler"]]) {
    const view = await visitWith(program, path.join(kScenes, `${name}_calibrated.yaml`), [], {});
    await hideRates(view);
    await shoot(view, seconds, text);
    await view.end();
  }
  const view = await visitWith(program, kFerry, [], { theme: "light" });
  await view.next();
  await shoot(view, 6, "insonify serve scenes/ferry_calibrated.yaml", async () => {}, true);
  await view.end();
}

await ferry();
await tank();
await others();
const file = path.join(kRoot, "build/film/film.mp4");
mkdirSync(path.dirname(file), { recursive: true });
execFileSync("ffmpeg", ["-y", "-loglevel", "error", "-framerate", String(kRate), "-i", path.join(scratch, "frame_%04d.png"), "-c:v", "libx264", "-crf", "27",
  "-preset", "slow", "-pix_fmt", "yuv420p", "-r", "24", "-movflags", "+faststart", file]);
console.log(`${file}: ${(frames / kRate).toFixed(0)} s, ${(statSync(file).size / 1e6).toFixed(2)} MB`);
rmSync(scratch, { recursive: true });
