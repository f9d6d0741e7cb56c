// live_test.mjs -- the viewer with `insonify serve`: a point target reads what the sonar equation says, controls act, and 20
// pings a second of 256 beams and 500 bins are shown.
//
// Usage: node live_test.mjs INSONIFY

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync, existsSync, copyFileSync } from "node:fs";
import { loadavg, tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { needBrowser, openPage } from "./browser.mjs";
import { bestOfThree, crowd, need, pause, runChecks, until } from "./checks.mjs";
import { startServer } from "./live_server.mjs";

const program = process.argv[2];
needBrowser();
const { default: puppeteer } = await need("puppeteer-core");
const folder = mkdtempSync(path.join(tmpdir(), "insonify-web-"));
const scenario = path.join(folder, "point.yaml");
copyFileSync(path.join(path.dirname(fileURLToPath(import.meta.url)), "point.yaml"), scenario);
process.chdir(folder);

const server = await startServer(program, scenario);
// A quarter of the pixels: a processor draws here what a graphics card draws elsewhere.
const { browser, page } = await openPage(puppeteer, { scale: 0.5 });
const text = (id) => page.$eval(`[id="${id}"]`, (node) => node.textContent);
/** An entry of the page's store; of a ping only which tables it has: their values would take seconds on their way. */
const get = (name) => page.evaluate((each) => {
  const value = insonify.store.get(each);
  return value?.tables ? { ...value, tables: Object.fromEntries(Object.keys(value.tables).map((table) => [table, true])) } : value;
}, name);
const press = (id) => page.$eval(`#${id}`, (node) => node.click());
const choose = (id, to) => page.$eval(`[id="${id}"]`, (node, value) => {
  if (node.type === "checkbox") node.checked = value;
  else node.value = value;
  node.dispatchEvent(new Event("change", { bubbles: true }));
}, to);
const number = (shown) => Number(shown.replace("\u2212", "-").match(/-?[\d.]+/)[0]);
const status = (what, condition) => until(async () => condition(await get("status")), what);

async function pointAt(range, azimuth) {
  const [x, y] = await page.evaluate((r, a) => {
    const box = document.getElementById("picture-stage").getBoundingClientRect();
    const [px, py] = insonify.picture.plan.place(r, a);
    return [box.left + px, box.top + py];
  }, range, azimuth);
  await page.mouse.move(x, y);
}

// The point is 12 m ahead, 3 m to starboard and 1 m above the sonar.
const kRange = Math.sqrt(12 ** 2 + 3 ** 2 + 1 ** 2);
const kBearing = (Math.atan2(3, 12) * 180) / Math.PI;
// Echo level less source level: TS - 40 lg r - 2 alpha r = 3 - 43.75 - 1.24 dB (Urick, ch. 2).
const kLevel = 3 - 40 * Math.log10(kRange) - 2 * 0.05 * kRange;

const failed = await runChecks({
  async "the first picture is there within two seconds, as far as the machine is free"() {
    await bestOfThree(async () => {
      const limit = 2000 * (await crowd());
      await page.goto(server.address);
      const drawn = await until(() => page.evaluate(() => globalThis.insonify?.picture.drawn), "a picture");
      console.log(`        ${drawn.toFixed(0)} ms, limit ${limit.toFixed(0)} ms at a load of ${loadavg()[0].toFixed(1)}`);
      assert.ok(drawn < limit, `${drawn} ms`);
    });
  },

  async "a point target reads range, bearing and level as the sonar equation says"() {
    await pointAt(kRange, (-kBearing * Math.PI) / 180);
    await until(async () => /dB/.test(await text("read-level")), "a level");
    console.log(`        ${await text("read-range")}, ${await text("read-bearing")}, ${await text("read-level")}; theory ${kRange.toFixed(2)} m, ${kBearing.toFixed(1)}, ${kLevel.toFixed(2)} dB`);
    assert.ok(Math.abs(number(await text("read-range")) - kRange) < 0.06, "range: a bin is 0.06 m");
    assert.ok(Math.abs(number(await text("read-bearing")) - kBearing) < 0.47, "bearing: a beam is 0.47 degrees");
    assert.match(await text("read-bearing"), / S$/);
    assert.ok(Math.abs(number(await text("read-level")) - kLevel) < 0.15, "level: shown to 0.1 dB");
    assert.equal(number(await text("read-bin")), Math.floor((kRange - 0.5) / 0.06));
    assert.equal(number(await text("read-beam")), Math.floor((60 + kBearing) / (120 / 256)));
  },

  async "twenty pings a second are shown for five seconds"() {
    await choose("key-sonars[0].receiver.noise", true);
    await until(async () => (await get("hello")).keys["sonars[0].receiver.noise"].value === true, "noise");
    // Away from the picture: over it, labels come with each ping, and the processor that draws here has no time for them.
    await page.mouse.move(640, 5);
    await pause(2);
    await bestOfThree(async () => {
      const others = await crowd();
      const seen = await page.evaluate(() => new Promise((done) => {
        const numbers = [];
        let drawings = 0;
        let longest = 0;
        let last = performance.now();
        const start = last;
        const { renderer } = insonify.picture;
        const draw = Object.getPrototypeOf(renderer).draw;  // Not one of an earlier measurement.
        renderer.draw = (...all) => {
          ++drawings;
          draw.apply(renderer, all);
        };
        insonify.store.on(["ping"], () => {
          const ping = insonify.store.get("ping");
          if (!ping) return;
          numbers.push(ping.number);
          longest = Math.max(longest, performance.now() - last);
          last = performance.now();
          if (last - start > 5_000) done({ count: numbers.length - 1, first: numbers[1], end: numbers.at(-1), seconds: (last - start) / 1000, drawings, longest });
        });
      }));
      const rate = seen.count / seen.seconds;
      console.log(`        ${rate.toFixed(1)} pings/s, ${(seen.drawings / seen.seconds).toFixed(1)} pictures/s, longest gap ${seen.longest.toFixed(0)} ms, ${seen.end - seen.first + 1 - seen.count} left out, load ${loadavg()[0].toFixed(1)}`);
      assert.ok(rate > 19 / others, `${rate} pings/s`);
      // Headless, the processor draws what a graphics card draws elsewhere.
      assert.ok(seen.drawings / seen.seconds > 4 / others, `${seen.drawings / seen.seconds} pictures/s`);
    });
  },

  async "a changed range is the new picture's, and one out of limits is refused in the server's words"() {
    await choose("key-sonars[0].max_range", "15");
    await until(async () => (await get("sonar")).max_range === 15, "the new range");
    await until(async () => (await get("shown"))?.bins === (await get("sonar")).bins, "a ping of it");
    await choose("key-sonars[0].max_range", "0.1");
    const said = await until(() => text("error-sonars[0].max_range"), "the error");
    assert.match(said, /^Range = 0\.1 m must be greater than nearest range = 0\.5 m/);
    assert.equal((await get("sonar")).max_range, 15);
  },

  async "model, bins, speckle, surface and truth change what the server simulates"() {
    for (const [key, to, known] of [["sonars[0].bin_count", "250", 250], ["sonars[0].receiver.speckle", true, true], ["ground_truth", "labels", "labels"], ["surface", true, true], ["surface", false, false]]) {
      await choose(`key-${key}`, to);
      await until(async () => (await get("hello")).keys[key].value === known, `${key} = ${known}; the page says: ${await text("note")}`);
    }
  },

  async "pause, step, speed, steering and following act"() {
    await press("pause");
    await status("a pause", (each) => each.paused);
    const shown = async () => (await get("ping")).number;
    let before;
    do {  // A page that is slow shows pings for a while.
      before = await shown();
      await pause(1);
    } while ((await shown()) !== before);
    const { pings_since_change: made } = await get("status");
    await press("step");
    await until(async () => (await shown()) > before, "one more ping");
    assert.equal(await shown(), before + 1);
    await status("its count", (each) => each.pings_since_change === made + 1);
    await press("pause");
    await status("going on", (each) => !each.paused);
    await choose("speed", "0.5");
    await status("half the speed", (each) => each.speed === 0.5);
    await choose("speed", "1");
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.down("w");
    await status("steering", (each) => !each.follow);
    await until(async () => (await get("ping"))?.vehicle.position[0] > 0.2, "a way ahead");
    await page.keyboard.up("w");
    await press("follow");
    await status("the trajectory", (each) => each.follow);
  },

  async "a recording is written, and a saved scenario runs"() {
    await press("record");
    const { recording } = await until(async () => ((await get("status")).recording ? get("status") : null), "a recording");
    await status("recorded pings", (each) => each.recorded_pings > 3);
    await press("record");
    await status("its end", (each) => !each.recording);
    assert.ok(existsSync(recording), recording);
    const yaml = await page.evaluate(() => new Promise((done) => {
      insonify.session.saved = (message) => done(message.yaml);
      document.getElementById("save").click();
    }));
    writeFileSync("saved.yaml", yaml);
    execFileSync(program, ["run", "saved.yaml", "--pings", "1", "-o", "again"]);
    assert.ok(existsSync("again/fan.h5"));
  },

  async "the page and the server made no errors of their own"() {
    assert.deepEqual(page.faults, []);
    const { code, seconds } = await server.stop();
    assert.ok(seconds < 2, `${seconds} s to end`);
    assert.ok(code === 0 || code === 130, `exit status ${code}: ${server.output()}`);
  },
}, { only: process.argv[3], recover: () => page.evaluate(() => insonify.store.get("status").paused && document.getElementById("pause").click()) });

await browser.close();
process.chdir(tmpdir());
rmSync(folder, { recursive: true });
process.exit(failed === 0 ? 0 : 1);
