// page_test.mjs -- the viewer's page in a browser, against a stand-in for the server: what is drawn, what each control says to
// the server, what the page says of errors, and that it can be used with a keyboard, by touch and by a screen reader.

import assert from "node:assert/strict";
import { openPage, needBrowser } from "./browser.mjs";
import { bestOfThree, crowd, need, pause, runChecks, until } from "./checks.mjs";

needBrowser();
const { default: puppeteer } = await need("puppeteer-core");
await need("ws");
const { MockServer } = await import("./mock_server.mjs");
const { kFence, kHostile, kPoint, makeSurveyors } = await import("./mock_sonar.mjs");

const server = new MockServer({ rate: 4 });
const address = await server.start();
// A quarter of the pixels each way: a processor draws here what a graphics card draws elsewhere.
const { browser, page, resize } = await openPage(puppeteer, { scale: 0.25 });

const text = (id) => page.$eval(`#${id}`, (node) => node.textContent);
const value = (id) => page.$eval(`[id="${id}"]`, (node) => (node.type === "checkbox" ? node.checked : node.value));
const press = (id) => page.$eval(`[id="${id}"]`, (node) => node.click());
/** An entry of the page's store; of a ping only which tables it has: their values would take seconds on their way. */
const get = (name) => page.evaluate((each) => {
  const value = insonify.store.get(each);
  return value?.tables ? { ...value, tables: Object.fromEntries(Object.keys(value.tables).map((table) => [table, true])) } : value;
}, name);
const choose = (id, chosen) => page.$eval(`[id="${id}"]`, (node, to) => {
  if (node.type === "checkbox") node.checked = to;
  else node.value = to;
  node.dispatchEvent(new Event("input", { bubbles: true }));
  node.dispatchEvent(new Event("change", { bubbles: true }));
}, chosen);
/** The last ping of the sonar as it is now: for a moment after a change there is none. */
const ping = () => until(() => get("ping"), "a ping");
const told = (op, what = () => true) => until(() => server.requests.findLast((each) => each.op === op && what(each)), `a request ${op}`);

/** Pauses the server, or lets it go on, and waits until the page knows: it asks for the opposite of what it knows. */
async function serverPauses(on) {
  server.state.paused = on;
  server.say(server.state);
  await until(async () => (await get("status")).paused === on, on ? "a server that pauses" : "a server that goes on");
}

/** Where a range and an azimuth to port [rad] lie in the window. */
const placeOf = (range, azimuth) => page.evaluate((r, a) => {
  const box = document.getElementById("picture-stage").getBoundingClientRect();
  const [x, y] = insonify.picture.plan.place(r, a);
  return [box.left + x, box.top + y];
}, range, azimuth);

async function askedFor(path, control, to, expected = `${path}=${to}`) {
  server.requests.length = 0;
  await choose(control, to);
  const request = await told("set");
  assert.deepEqual(request.settings, [expected]);
}

/** After a check that failed: the server and the page as at the start, so that the others fail by their own faults only. */
async function recover() {
  if (!server.http.listening) return;
  server.reset();
  await resize(1280, 720);
  await page.goto(address);
  await page.evaluate(() => localStorage.clear());
  await page.reload();
  await ping();
  await openControls();
}

// Most checks do without the small views: drawing them takes a processor half of its time.
const openControls = () => page.evaluate(() => insonify.store.set({ controls: true, side: false }));

/** A check with the small views. */
const withSide = (check) => async () => {
  await page.evaluate(() => insonify.store.set({ side: true }));
  try {
    await check();
  } finally {
    await page.evaluate(() => insonify.store.set({ side: false }));
  }
};

/** Where a ping's slant range to a side (0 port, 1 starboard), or a share of its row, lies in the window. */
const placeInRow = (number, beam, range) => page.evaluate((ping, place) => {
  const view = insonify.waterfall;
  const index = Array.from({ length: view.count }, (_, i) => i).find((i) => view.history.row(i)?.number === ping);
  const { kind, sonar } = view.strip;
  const box = document.getElementById("waterfall-stage").getBoundingClientRect();
  const share = typeof place.range === "number" ? kind.share(sonar, view.history.row(index), place, view.shown) : (place.beam + 0.5) / sonar.beams;
  return [box.left + view.plan.xOf(share), box.top + view.plan.yOf(index)];
}, number, { beam, range });

/** A view of another sonar of a paused server, which has flown along x by 0.1 m a ping, `pings` of them. */
async function surveyed(name, pings) {
  await serverPauses(true);
  server.sonars.push(...makeSurveyors());
  server.say(server.hello());
  server.number = 0;
  await choose("sonar", name);
  await until(async () => (await get("sonar")).name === name, name);
  await until(() => page.evaluate(() => Boolean(insonify.waterfall)), "the waterfall");
  await page.evaluate(() => insonify.waterfall.clear());
  for (let i = 0; i < pings; ++i) await flown(-2 + 0.1 * i);
}

/** One ping more, at x. */
async function flown(x) {
  server.vehicle = { position: [x, 0, 0], yaw: 0 };
  const { number } = server;
  await press("step");
  await until(async () => (await get("ping"))?.number === number && (await page.evaluate(() => insonify.waterfall.history.newest?.number)) === number, `ping ${number}`);
}

async function leaveSurvey() {
  server.sonars.length = 2;
  server.vehicle = { position: [0, 0, 0], yaw: 0 };
  server.say(server.hello());
  await choose("sonar", "fls");
  await until(async () => (await get("sonar")).name === "fls", "the fan");
  await page.evaluate(() => insonify.store.set({ main: "picture", ruler: null, tool: null, corrected: false, bottomLine: false }));
  server.say({ op: "markers", markers: [] });
  await serverPauses(false);
  await ping();
}

if (process.argv[2]) await recover();  // Without the first check, which opens the page.

const failed = await runChecks({
  async "the first picture is there within two seconds, as far as the machine is free"() {
    await bestOfThree(async () => {
      const limit = 2000 * (await crowd());
      await page.goto(address);
      const drawn = await until(() => page.evaluate(() => globalThis.insonify?.picture.drawn), "a picture");
      console.log(`        first picture after ${drawn.toFixed(0)} ms, limit ${limit.toFixed(0)} ms`);
      assert.ok(drawn < limit, `${drawn} ms`);
    });
    const shades = await page.evaluate(() => {
      insonify.picture.draw();  // A browser keeps no drawn WebGL picture.
      const made = document.createElement("canvas");
      Object.assign(made, { width: 64, height: 64 });
      const context = made.getContext("2d");
      context.drawImage(document.getElementById("picture"), 0, 0, 64, 64);
      const pixels = context.getImageData(0, 0, 64, 64).data;
      const colours = new Set();
      for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 3] > 0) colours.add(pixels[i] >> 3);
      return colours.size;
    });
    assert.ok(shades > 4, `only ${shades} shades in the picture`);
  },

  async "the fan fills two thirds of the window; small views and controls fold, and full screen hides all else"() {
    const share = () => page.evaluate(() => {
      const { plan } = insonify.picture;
      const sonar = insonify.store.get("sonar");
      const [left] = plan.place(sonar.max_range, sonar.ports[0]);
      const [right, apex] = [plan.place(sonar.max_range, sonar.starboards.at(-1))[0], plan.toScreen(0, 0)[1]];
      return ((right - left) * (apex - plan.place(sonar.max_range, 0)[1])) / innerWidth / innerHeight;
    });
    const shown = (id) => page.$eval(`#${id}`, (node) => node.offsetParent !== null);
    assert.ok((await share()) > 0.66, `${await share()} of the window`);
    assert.deepEqual([await shown("controls"), await shown("view-scene")], [false, true]);
    await page.keyboard.press("i");
    assert.equal(await shown("view-scene"), false);
    await page.keyboard.press("f");
    await until(async () => (await share()) > 0.8, "a fan as large as the screen");
    assert.deepEqual([await shown("controls"), await shown("pause"), await shown("leave")], [false, false, true]);
    await press("leave");
    await page.keyboard.press("i");
    await page.keyboard.press("c");
    assert.deepEqual([await shown("controls"), await shown("pause"), await shown("view-scene")], [true, true, true]);
    await openControls();
  },

  // The point is at (12, -3, 0), the sonar at the origin looks along x: sqrt(153) = 12.369 m, atan(3 / 12) = 14.04 degrees to
  // starboard. Bins are 29.8 m / 250 = 0.1192 m: floor((12.369 - 0.2) / 0.1192) = 102. Beams are 120 / 128 = 0.9375 degrees, the
  // first at +60: floor((60 + 14.036) / 0.9375) = 78. Its level is -31.25 dB.
  async "a point reads its range, bearing, level, beam, bin, place, object and material"() {
    const [x, y] = await placeOf(Math.hypot(12, 3), -Math.atan2(3, 12));
    await page.mouse.move(x, y);
    await until(async () => (await text("read-level")).startsWith("\u221231"), "the point's level");
    assert.ok(Math.abs(parseFloat(await text("read-range")) - 12.369) < 0.06, await text("read-range"));
    assert.ok(Math.abs(parseFloat(await text("read-bearing")) - 14.036) < 0.24, await text("read-bearing"));
    assert.match(await text("read-bearing"), /S$/);
    assert.ok(Math.abs(-31.25 + Number((await text("read-level")).slice(1, -3))) < 0.051, await text("read-level"));
    assert.equal(await text("read-beam"), "78");
    assert.equal(await text("read-bin"), "102");
    await until(async () => (await text("read-object")) !== "\u2013", "a ping with labels");
    const world = (await text("read-world")).replaceAll("\u2212", "-").split(",").map(Number);
    world.forEach((each, i) => assert.ok(Math.abs(each - kPoint.position[i]) < 0.08, `world ${world}`));
    assert.equal(await text("read-object"), kHostile);
    assert.equal(await text("read-material"), "steel");
  },

  async "the level under the cursor is also said as it is shown"() {
    const [x, y] = await placeOf(Math.hypot(12, 3), -Math.atan2(3, 12));
    await page.mouse.move(x, y);
    await choose("gain", "10");
    await choose("tvg", "20");
    // -31.25 + 10 + 20 lg 12.37 = 0.6
    await until(async () => /^\u221231\.[23] dB \(shown 0\.6\)$/.test(await text("read-level")), "the shown level");
    await press("contrast-reset");
    await until(async () => /^\u221231\.[23] dB$/.test(await text("read-level")), "the level alone");
  },

  async "the polar picture reads the same point"() {
    await press("mode-polar");
    const [x, y] = await placeOf(Math.hypot(12, 3), -Math.atan2(3, 12));
    await page.mouse.move(x, y);
    await until(async () => (await text("read-beam")) === "78" && (await text("read-bin")) === "102", "beam 78, bin 102");
    await press("mode-fan");
  },

  async "labels are asked for while the cursor is over the picture, and no longer"() {
    await page.mouse.move(640, 10);
    const without = await told("watch", ({ tables }) => !tables.includes("instance"));
    assert.deepEqual(without.tables, ["level", "elevation"]);
    await until(async () => !(await ping()).tables.instance, "a ping without labels");
    await page.mouse.move(...(await placeOf(12, 0)));
    await until(async () => (await ping()).tables.instance && (await ping()).tables.material, "a ping with labels");
  },

  async "names of a hostile scene stay text"() {
    await press("tab-scene");
    assert.ok(await page.$$eval("#object option", (nodes, name) => nodes.some((node) => node.textContent === name), kHostile));
    assert.equal(await page.title(), "mock \u2013 insonify");
    assert.equal(await page.$("img"), null);
  },

  async "every setting says itself to the server"() {
    await press("tab-sonar");
    await askedFor("sonars[0].max_range", "key-sonars[0].max_range", "25");
    await until(async () => (await get("sonar")).max_range === 25, "the new range");
    await askedFor("sonars[0].bin_count", "key-sonars[0].bin_count", "400");
    await until(async () => (await get("shown"))?.bins === 400, "a ping of 400 bins");
    await askedFor("sonars[0].gain", "key-sonars[0].gain", "2.5");
    await askedFor("model", "key-model", "paper");
    await askedFor("sonars[0].receiver.noise", "key-sonars[0].receiver.noise", false);
    await askedFor("sonars[0].receiver.speckle", "key-sonars[0].receiver.speckle", false);
    await askedFor("sonars[0].receiver.time_varied_gain", "key-sonars[0].receiver.time_varied_gain", "30");
    await askedFor("surface", "key-surface", true, "surface={level: 5}");
    await askedFor("surface.wind_speed", "key-surface.wind_speed", "7");
    await askedFor("water.salinity", "key-water.salinity", "12");
  },

  async "buttons beside a number go to the next usual value"() {
    server.requests.length = 0;
    await page.click('[aria-label="Range: more"]');
    assert.deepEqual((await told("set")).settings, ["sonars[0].max_range=30"]);
  },

  async "an error is shown beside its control, at the bottom and in the log, and the control goes back"() {
    await choose("key-sonars[0].max_range", "0");
    const message = "Range = 0 must be greater than 0 and at most 100000";
    await until(async () => (await text("error-sonars[0].max_range".replace(/[[\].]/g, "\\$&"))) === message, "the error");
    assert.equal(await text("note"), message);
    assert.ok((await text("log")).includes(message));
    assert.equal(await value("key-sonars[0].max_range"), "30");
    assert.equal(await text("log-count"), "1");
  },

  async "pause, step, speed, follow, record and save say so, and show the server's answer"() {
    await ping();  // A ping with the settings that the checks before have changed.
    await press("pause");
    assert.equal((await told("pause")).on, true);
    await until(async () => (await text("pause-text")) === "Resume", "Resume");
    const before = (await ping()).number;
    await press("step");
    await until(async () => (await ping()).number === before + 1, "one more ping");
    await press("pause");
    assert.equal((await told("pause", (each) => !each.on)).on, false);
    await choose("speed", "2");
    assert.equal((await told("speed")).factor, 2);
    await press("follow");
    assert.equal((await told("follow")).on, false);
    await choose("record-format", "mcap");
    await press("record");
    assert.deepEqual(await told("record"), { op: "record", on: true, format: "mcap" });
    await until(() => page.$eval("#record", (node) => node.getAttribute("aria-pressed") === "true"), "a pressed button");
    await press("record");
    await told("record", (each) => !each.on);
    await press("save");
    await told("save");
    await until(async () => /^Saved mock_live\.yaml/.test(await text("note")), "the note of what was saved");
  },

  async "the page tells pings a second and the part of real time, and neither while it is paused"() {
    // The stand-in makes 4 pings a second, 0.05 s of its time apart: 0.2 of real time, and less where its timers are late.
    await until(async () => /^[1-4]\.\d$/.test(await text("rate")) && /^0\.(0[5-9]|1\d|2[0-2])$/.test(await text("pace")), "both");
    await press("pause");
    await until(async () => (await text("rate")) === "\u2013" && (await text("pace")) === "\u2013", "neither");
    await press("pause");
    await until(async () => (await text("rate")) !== "\u2013", "a rate again");
  },

  async "keys fly, and letting go stops"() {
    await page.evaluate(() => document.activeElement.blur());
    server.requests.length = 0;
    await page.keyboard.down("w");
    const ahead = await told("fly");
    assert.ok(ahead.linear[0] > 0 && ahead.linear[1] === 0 && ahead.angular[2] === 0, JSON.stringify(ahead));
    await page.keyboard.down("Shift");
    const faster = await told("fly", (each) => each.linear[0] > ahead.linear[0] + 0.1);
    assert.equal(faster.linear[0], 1);
    await page.keyboard.up("Shift");
    await page.keyboard.up("w");
    await told("fly", (each) => each.linear.every((part) => part === 0));
    for (const [key, part, index, sign] of [["s", "linear", 0, -1], ["a", "linear", 1, 1], ["d", "linear", 1, -1], ["e", "linear", 2, 1], ["q", "linear", 2, -1], ["ArrowLeft", "angular", 2, 1], ["ArrowRight", "angular", 2, -1], ["ArrowUp", "angular", 1, -1]]) {
      server.requests.length = 0;
      await page.keyboard.down(key);
      assert.equal(Math.sign((await told("fly"))[part][index]), sign, key);
      await page.keyboard.up(key);
      await told("fly", (each) => [...each.linear, ...each.angular].every((one) => one === 0));
    }
  },

  async "keys fly after a button was pressed and a list chosen from with the mouse"() {
    const flies = async (what) => {
      server.requests.length = 0;
      await page.keyboard.down("w");
      assert.ok((await told("fly")).linear[0] > 0, what);
      await page.keyboard.up("w");
      await told("fly", (each) => each.linear.every((part) => part === 0));
    };
    await page.focus("#record");
    await flies("from a button");
    await page.evaluate(() => {
      const list = document.querySelector("#speed");
      list.focus();
      list.dispatchEvent(new PointerEvent("pointerdown", { bubbles: true }));
      list.dispatchEvent(new Event("change", { bubbles: true }));
    });
    await flies("from a list");
  },

  async "a stick on the screen flies as far as it is pushed"() {
    await press("tab-fly");
    await choose("pads", true);
    const box = await (await page.$("#pad-left")).boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    server.requests.length = 0;
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x, y - 22);  // half of the stick's reach of 44
    const half = await told("fly", (each) => each.linear[0] !== 0);
    assert.ok(Math.abs(half.linear[0] - 0.5) < 0.03 && half.linear[1] === 0, JSON.stringify(half));
    await page.mouse.move(x + 200, y);
    await told("fly", (each) => each.linear[1] === -1);
    await page.mouse.up();
    await told("fly", (each) => each.linear.every((part) => part === 0));
    await choose("pads", false);
  },

  async "a gamepad flies, and its buttons press"() {
    server.requests.length = 0;
    await page.evaluate(() => {
      globalThis.fakePad = { connected: true, id: "Test pad", axes: [0, -1, 0.5, 0], buttons: Array.from({ length: 16 }, () => ({ pressed: false })) };
      navigator.getGamepads = () => [globalThis.fakePad];
      window.dispatchEvent(new Event("gamepadconnected"));
    });
    const { linear, angular } = await told("fly");
    assert.equal(linear[0], 1);
    assert.ok(angular[2] < 0, "the right stick to the right turns to starboard");
    assert.equal(await text("gamepad-text"), "Gamepad: Test pad");
    await page.evaluate(() => (fakePad.buttons[1].pressed = true));
    await until(() => get("frozen"), "the freeze");
    await page.evaluate(() => (fakePad.connected = false));
    await told("fly", (each) => [...each.linear, ...each.angular].every((part) => part === 0));
    await press("freeze");
  },

  async "the cursor moves by keys, a bin or a beam at a time"() {
    await page.mouse.move(640, 10);
    await page.focus("#picture-stage");
    await page.keyboard.down("Alt");
    await page.keyboard.press("ArrowUp");
    const first = await until(() => get("cursor"), "a cursor");
    await page.keyboard.press("ArrowUp");
    await until(async () => (await get("cursor")).bin === first.bin + 1, "the next bin");
    await page.keyboard.press("ArrowRight");
    await until(async () => (await get("cursor")).beam === first.beam + 1, "the next beam");
    // Without the focus too, where the browser would go back.
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("ArrowLeft");
    await until(async () => (await get("cursor"))?.beam === first.beam, "the beam before");
    await page.keyboard.press("ArrowLeft");
    await until(async () => (await get("cursor"))?.beam === first.beam - 1, "one beam for each key");
    await page.keyboard.up("Alt");
    await page.evaluate(() => document.activeElement.blur());
  },

  async "keys typed into a field do not fly"() {
    server.requests.length = 0;
    await press("tab-sonar");
    await page.focus("#settings-search");
    await page.keyboard.type("wasd water");
    await pause(0.2);
    assert.equal(server.requests.some(({ op, linear }) => op === "fly" && linear.some((part) => part !== 0)), false);
    await choose("settings-search", "");
    await page.evaluate(() => document.activeElement.blur());
  },

  async "a number puts the vehicle somewhere, and something else is refused"() {
    await press("tab-fly");
    server.requests.length = 0;
    for (const [name, to] of Object.entries({ x: "1.5", y: "-2", z: "0", roll: "0", pitch: "0", yaw: "90" })) await choose(`place-${name}`, to);
    await press("place-go");
    const { position, orientation } = await told("place");
    assert.deepEqual(position, [1.5, -2, 0]);
    orientation.forEach((part, i) => assert.ok(Math.abs(part - [Math.SQRT1_2, 0, 0, Math.SQRT1_2][i]) < 1e-9));
    server.requests.length = 0;
    await choose("place-x", "");
    await press("place-go");
    assert.equal(await text("error-place"), "x must be a number.");
    assert.equal(server.requests.some(({ op }) => op === "place"), false);
  },

  async "the chosen object gets its material"() {
    await press("tab-scene");
    await choose("object", "1");
    assert.equal(await value("material"), "concrete");
    server.requests.length = 0;
    await choose("material", "steel");
    assert.deepEqual(await told("material"), { op: "material", object: "wall", material: "steel" });
    await until(async () => (await value("material")) === "steel", "the server's answer");
  },

  async "a click in the picture chooses beam and object"() {
    await page.evaluate(() => insonify.store.set({ object: -1 }));
    const position = server.vehicle.position;
    const bearing = (40 * Math.PI) / 180;
    await until(async () => (await ping()).position[0] === position[0], "the vehicle there");
    const [x, y] = await placeOf(12, bearing);
    await page.mouse.click(x, y);
    await until(async () => (await get("object")) === 2, "the bed");
    assert.equal(await get("beam"), 21);  // (60 - 40) / 0.9375 = 21.3
  },

  async "a click in the scene chooses an object"() {
    await page.evaluate(() => insonify.store.set({ object: -1, main: "scene", camera: "chase" }));
    const box = await (await page.$("#scene-stage")).boundingBox();
    await until(async () => {
      await page.mouse.click(box.x + 40, box.y + box.height - 60);  // The view may not yet be drawn as large as it is.
      return (await get("object")) === 2;
    }, "the bed");
    await page.evaluate(() => insonify.store.set({ main: "picture" }));
  },

  async "the waterfall labels ages of rows, also when the time restarts"() {
    await until(() => page.evaluate(() => Boolean(insonify.waterfall)), "the waterfall");
    const ages = await page.evaluate(() => {
      const view = insonify.waterfall;
      view.clear();
      for (const time of [5, 5.5, 6, 0, 0.5, 0]) view.add({ ...insonify.store.get("shown"), time });
      return view.ages;
    });
    assert.deepEqual(ages, [0, 0.5, 1, 1.5, 2, 2.5]);
  },

  async "the waterfall begins with the ping that is shown"() {
    await until(() => get("shown"), "a ping");
    await until(() => page.evaluate(() => Boolean(insonify.waterfall)), "the waterfall");
    const rows = await page.evaluate(async () => {
      const { WaterfallView } = await import("./js/views/waterfall.js");
      return new WaterfallView(insonify.store, { add: () => () => {} }).count;
    });
    assert.equal(rows, 1);
    await page.goto(address);  // Without the second view.
    await ping();
    await until(() => page.evaluate(() => Boolean(insonify.scene)), "all views");
  },

  "range lines of an empty waterfall are seen in both themes": withSide(async () => {
    const before = await get("theme");
    await until(() => page.evaluate(() => Boolean(insonify.waterfall)), "the waterfall");
    for (const theme of ["dark", "light"]) {
      const contrast = await page.evaluate(async (name) => {
        const { themeColour } = await import("./js/dom.js");
        document.documentElement.dataset.theme = name;
        const view = insonify.waterfall;
        view.clear();
        view.draw();
        const canvas = document.getElementById("waterfall-scale");
        const [r, g, b] = [1, 3, 5].map((at) => parseInt(themeColour("--panel").slice(at, at + 2), 16));
        const row = canvas.getContext("2d").getImageData(0, Math.floor(canvas.height / 2), canvas.width, 1).data;
        let most = 0;  // of the line's colour over the panel
        for (let i = 0; i < row.length; i += 4) {
          const part = row[i + 3] / 255;
          most = Math.max(most, part * (Math.abs(row[i] - r) + Math.abs(row[i + 1] - g) + Math.abs(row[i + 2] - b)));
        }
        return most;
      }, theme);
      assert.ok(contrast > 8, `${theme}: ${contrast}`);  // A line covers a quarter of a pixel here.
    }
    await page.evaluate((theme) => {
      insonify.store.set({ theme: "dark" });
      insonify.store.set({ theme });
    }, before);
  }),

  async "contrast, gain, colours and overlay change the picture, and nothing on the server"() {
    await press("tab-display");
    server.requests.length = 0;
    // Picture, lines and legend as they are drawn; screenshots of the window would take a second each.
    const shown = () => page.evaluate(() => {
      insonify.picture.draw();
      const drawn = ["picture", "graticule"].map((id) => document.getElementById(id).toDataURL());
      return [...drawn, document.getElementById("legend").textContent].join();
    });
    await press("freeze");
    await page.mouse.move(2, 300);
    let before = await shown();
    for (const [id, to] of [["low", "-80"], ["high", "-20"], ["gain", "10"], ["tvg", "30"], ["map", "turbo"], ["map", "copper"], ["map", "grey"], ["map", "blue"], ["grid", false], ["smooth", false], ["overlay", "instance"], ["overlay", "material"]]) {
      await choose(id, to);
      before = await until(async () => {
        const after = await shown();
        return after !== before && after;
      }, `another picture by ${id} = ${to}`);
    }
    assert.equal(server.requests.filter(({ op }) => op !== "watch").length, 0);
    await press("freeze");
    await choose("overlay", "multipath");
    const { tables } = await told("watch", (each) => each.tables.includes("multipath"));
    assert.ok(tables.includes("level"));
    for (const [id, to] of [["overlay", "none"], ["map", "inferno"], ["grid", true], ["smooth", true]]) await choose(id, to);
    await press("contrast-reset");
    assert.equal(await get("low"), -110);
    assert.equal(await get("tvg"), 0);
    await press("auto");
    assert.ok((await get("low")) > -110 && (await get("high")) < -20);
  },

  async "of the paper's model the overlays that it cannot have need the calibrated one"() {
    server.keys.model.value = "paper";
    server.say(server.hello());
    const disabled = () => page.$$eval("#overlay option", (all) => all.filter((each) => each.disabled).map(({ value }) => value));
    await until(async () => (await disabled()).length > 0, "choices that are disabled");
    assert.deepEqual(await disabled(), ["shadow", "multipath"]);
    // As a page shows it that had the overlay before; the pings hold none.
    await page.evaluate(() => insonify.store.set({ overlay: "shadow" }));
    await until(async () => (await text("overlay-error")) === "The pings hold no shadow: it needs the calibrated model.", "what it needs");
    await page.evaluate(() => insonify.store.set({ overlay: "elevation" }));
    await page.evaluate(() => document.activeElement?.blur());
    await page.keyboard.press("o");
    assert.equal(await get("overlay"), "none");
    server.keys.model.value = "calibrated";
    server.say(server.hello());
    await until(async () => (await disabled()).length === 0, "all choices again");
  },

  async "a frozen picture stays while pings go on"() {
    await press("freeze");
    await until(async () => (await get("shown")).tables.instance, "labels of the picture that stays");
    const { number } = await get("shown");
    const first = (await ping()).number;
    await until(async () => (await ping()).number > first + 2, "more pings");
    assert.equal((await get("shown")).number, number);
    await press("freeze");
    await until(async () => (await get("shown")).number > number, "the picture to go on");
  },

  async "the scanning head has a round picture that fills"() {
    await choose("sonar", "head");
    await told("watch", (each) => each.sonar === "head");
    await until(async () => (await get("mode")) === "round" && (await get("shown"))?.sonar === "head", "the round picture");
    assert.equal(await page.$eval("#mode-fan", (node) => node.hidden), true);
    await until(() => page.evaluate(() => insonify.picture.round.count > 2), "three beams");
    const [x, y] = await placeOf(12, (await get("shown")).headAngle);
    await page.mouse.move(x, y);
    await until(async () => (await text("read-bin")) !== "\u2013", "a readout");
    await choose("sonar", "fls");
    await until(async () => (await get("mode")) === "fan", "the fan");
  },

  async "the ruler measures by keys alone"() {
    await until(async () => (await get("shown"))?.sonar === (await get("sonar")).name, "a picture to measure in");
    await page.mouse.move(2, 300);
    await page.evaluate(() => document.activeElement?.blur());
    await page.keyboard.press("k");
    await page.keyboard.down("Alt");
    for (const key of ["ArrowUp", "ArrowUp"]) {
      await page.keyboard.press(key);
      await page.keyboard.up("Alt");
      await page.keyboard.press("Enter");
      await page.keyboard.down("Alt");
    }
    await page.keyboard.up("Alt");
    assert.ok((await get("ruler"))?.to, "two points");
    await page.keyboard.press("k");
    assert.deepEqual([await get("ruler"), await get("tool")], [null, null]);
  },

  async "a second sonar is shown beside the first, and its connection ends with it"() {
    await choose("beside", "head");
    await until(() => page.$eval("#beside-empty", (node) => node.hidden && node.offsetParent === null), "its picture");
    await until(() => page.$eval("#beside-picture-caption", (node) => /^head/.test(node.textContent)), "its name");
    const [left, right] = await page.evaluate(() => ["picture-stage", "beside-picture-stage"].map((id) => document.getElementById(id).getBoundingClientRect().toJSON()));
    assert.ok(right.left >= left.right && Math.abs(right.width - left.width) < 3 && left.width > 350, `${left.width} and ${right.width}`);
    assert.equal((await get("sonar")).name, "fls");
    assert.equal(server.sockets.clients.size, 2);
    await choose("beside", "");
    await until(() => server.sockets.clients.size === 1, "one connection");
    assert.equal(await page.$eval("#view-beside", (node) => node.hidden), true);
  },

  async "a preset and a longer range are asked for by list and key"() {
    server.requests.length = 0;
    await choose("preset", "gemini");
    assert.deepEqual((await told("set")).settings, ["sonars[0].preset=gemini"]);
    server.requests.length = 0;
    await page.evaluate(() => document.activeElement?.blur());
    await page.keyboard.press(".");
    assert.deepEqual((await told("set")).settings, ["sonars[0].max_range=40"]);
    await until(async () => (await get("sonar")).max_range === 40, "the longer range");
    await page.keyboard.press(",");
    await told("set", ({ settings }) => settings[0] === "sonars[0].max_range=30");
  },

  async "a very narrow sonar begins as polar picture, and the next one as before"() {
    const narrow = { ...server.sonars[0], name: "side", beams: 1, azimuths: [0], azimuth_aperture: 1 };
    server.sonars.push(narrow);
    server.say(server.hello());
    await until(() => page.$eval("#sonar", (node) => [...node.options].some(({ value }) => value === "side")), "the narrow sonar");
    await choose("sonar", "side");
    await until(async () => (await get("mode")) === "polar" && (await get("shown"))?.sonar === "side", "its polar picture");
    await press("mode-fan");
    assert.equal(await get("mode"), "fan");
    await choose("sonar", "fls");
    await until(async () => (await get("mode")) === "fan" && (await get("shown"))?.sonar === "fls", "the fan");
    await choose("sonar", "side");
    await until(async () => (await get("mode")) === "polar", "the polar picture");
    await choose("sonar", "fls");
    await until(async () => (await get("mode")) === "fan", "the fan again");
    server.sonars.pop();
    server.say(server.hello());
  },

  async "of a scanning head the overlay colours the round picture, and no beam can be chosen"() {
    await press("tab-display");
    assert.equal(await page.$eval("#beam-field", (node) => node.offsetParent !== null), true);
    await choose("sonar", "head");
    await until(async () => (await get("mode")) === "round" && (await get("shown"))?.sonar === "head", "the round picture");
    for (const id of ["beam-field", "waterfall-of-field"]) assert.equal(await page.$eval(`#${id}`, (node) => node.offsetParent), null, id);
    assert.match(await text("beam-hint"), /^The head has one beam/);
    // Colours of the picture that are none of the colour map: hues that grey levels and inferno do not have.
    const greenish = () => page.evaluate(() => {
      insonify.picture.draw();
      const canvas = document.getElementById("picture");
      const made = document.createElement("canvas");
      Object.assign(made, { width: canvas.width, height: canvas.height });
      const context = made.getContext("2d");
      context.drawImage(canvas, 0, 0);
      const pixels = context.getImageData(0, 0, made.width, made.height).data;
      let count = 0;
      for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 1] > pixels[i] + 20 && pixels[i + 1] > pixels[i + 2] + 20 && pixels[i + 3] > 200) ++count;
      return count;
    });
    await choose("map", "inferno");
    assert.equal(await greenish(), 0);
    // Label 2, the bed, has the hue (2 * 0.618 + 0.08) mod 1 = 0.316: green.
    await choose("overlay", "instance");
    await until(async () => (await greenish()) > 3, "the bed's colour");
    await until(async () => (await text("legend")).includes("bed"), "its name");
    await choose("overlay", "none");
    await until(async () => (await greenish()) === 0, "the picture without it");
    await choose("sonar", "fls");
    await until(async () => (await get("mode")) === "fan", "the fan");
  },

  async "the A-scan says why it is empty"() {
    Object.assign(server.sonars[1], { sector_center: 0, sector_width: 90 });
    await serverPauses(true);
    server.headAngle = 0;
    server.say(server.hello());
    await choose("sonar", "head");
    await until(async () => (await get("sonar"))?.sector_width === 90, "the sector");
    assert.equal(await text("ascan-empty"), "Waiting for the first ping");
    await press("step");
    await until(() => page.$eval("#ascan-empty", (node) => node.hidden), "a curve");
    for (const [degrees, reason] of [[-44, "No ping in this direction yet"], [50, "Outside the scanned sector"]]) {
      await page.mouse.move(...(await placeOf(10, (degrees * Math.PI) / 180)));
      await until(async () => (await text("ascan-empty")) === reason && !(await page.$eval("#ascan-empty", (node) => node.hidden)), reason);
      assert.match(await text("ascan-caption"), degrees < 0 ? /^4[34]\.\d° S$/ : /^(49|50)\.\d° P$/);
    }
    delete server.sonars[1].sector_width;
    await serverPauses(false);
    server.say(server.hello());
    await choose("sonar", "fls");
    await until(async () => (await get("mode")) === "fan", "the fan");
  },

  async "a vertical scanning head is drawn upright: up is up, the housing's front to the right"() {
    await serverPauses(true);
    server.sonars[1].mounting = "vertical";
    server.say(server.hello());
    await choose("sonar", "head");
    await until(async () => (await get("sonar")).vertical && (await get("mode")) === "round", "the upright picture");
    const box = await page.$eval("#picture-stage", (node) => node.getBoundingClientRect().toJSON());
    const [middle] = await placeOf(0, 0);
    const [front] = await placeOf(10, 0);
    const [, up] = await placeOf(10, Math.PI / 2);
    const [, level] = await placeOf(10, 0);
    assert.ok(front > middle + 50 && up < level - 50 && up > box.top, `front ${front - middle}, up ${level - up}`);
    // Loud everywhere in a beam 60 degrees down and ahead; where the picture is bright, as parts of its reach from the middle.
    const [right, below] = await page.evaluate(() => {
      const { picture, store } = insonify;
      const { beams, bins, max_range: reach } = store.get("sonar");
      const pose = { position: [0, 0, 0], orientation: [1, 0, 0, 0] };
      const ping = { number: 0, time: 0, beams, bins, pose, vehicle: pose, headAngle: -Math.PI / 3, tables: { level: new Uint16Array(bins).fill(40_000) } };
      picture.renderer.round.clear(store.get("sonar"));
      picture.add(ping);
      store.set({ shown: ping, grid: false });
      picture.draw();
      const canvas = document.getElementById("picture");
      const made = document.createElement("canvas");
      Object.assign(made, { width: canvas.width, height: canvas.height });
      const context = made.getContext("2d");
      context.drawImage(canvas, 0, 0);
      const pixels = context.getImageData(0, 0, made.width, made.height).data;
      let [sumX, sumY, count] = [0, 0, 0];
      for (let i = 0; i < pixels.length; i += 4) {
        if (pixels[i] < 200 || pixels[i + 3] < 200) continue;
        const at = picture.plan.toPlane((((i / 4) % made.width) + 0.5) * canvas.clientWidth / made.width, (Math.floor(i / 4 / made.width) + 0.5) * canvas.clientHeight / made.height);
        sumX += at[0];
        sumY += at[1];
        ++count;
      }
      store.set({ grid: true });
      return [sumX / count / reach, -sumY / count / reach];
    });
    // The middle of a narrow sector lies at 2/3 of its reach: cos 60 and sin 60 of that, within a pixel or two.
    assert.ok(Math.abs(right - 0.333) < 0.05 && Math.abs(below - 0.577) < 0.05, `${right} to the right, ${below} below`);
    const bearingAt = async (azimuth) => {
      await page.mouse.move(...(await placeOf(10, (azimuth * Math.PI) / 180)));
      return until(async () => Math.abs(((await get("cursor"))?.azimuth ?? 9) * 180 / Math.PI - azimuth) < 1 && (await text("read-bearing")) !== "\u2013" && text("read-bearing"), `the bearing ${azimuth}`);
    };
    assert.match(await bearingAt(-60), /^(59\.\d|60\.\d)° down$/);
    assert.match(await bearingAt(30), /^(29\.\d|30\.\d)° up$/);
    assert.match(await bearingAt(-150), /^(29\.\d|30\.\d)° down, back$/);
    delete server.sonars[1].mounting;
    await serverPauses(false);
    server.say(server.hello());
    await choose("sonar", "fls");
    await until(async () => (await get("mode")) === "fan", "the fan");
  },

  async "help opens with ? and closes with Escape"() {
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.type("?");
    assert.equal(await page.$eval("#help", (node) => node.open), true);
    await page.keyboard.press("Escape");
    assert.equal(await page.$eval("#help", (node) => node.open), false);
  },

  async "single keys do what the help says"() {
    await until(async () => !(await page.$eval("#pause", (node) => node.disabled)), "the connection");
    await page.evaluate(() => document.activeElement?.blur());  // The space bar presses a button that has the focus.
    await page.keyboard.press("2");
    assert.equal(await get("main"), "scene");
    await page.keyboard.press("1");
    await page.keyboard.press("v");
    assert.equal(await get("mode"), "polar");
    await page.keyboard.press("v");
    await page.keyboard.press("m");
    assert.equal(await get("map"), "copper");
    await page.keyboard.press("l");
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "light");
    await page.keyboard.press("l");
    server.requests.length = 0;
    await page.keyboard.press("Space");
    await told("pause");
    await until(async () => (await get("status")).paused, "the pause");
    await page.keyboard.press("Space");
    await told("pause", (each) => !each.on);
  },

  async "what the server cannot be understood in is said, and the page goes on"() {
    server.say(Buffer.from([9, 0, 0, 0, 0, 0, 0, 0]));
    await until(async () => (await text("note")).startsWith("A message of the server cannot be read"), "a note");
    const { number } = await ping();
    await until(async () => (await ping()).number !== number, "more pings");
  },

  async "a snapshot has a pixel for each bin at least, a scale, and lines of pose and settings"() {
    const made = await page.evaluate(async () => {
      const { captionOf, composeSnapshot } = await import("./js/panels/snapshot.js");
      const { store, picture } = insonify;
      const canvas = composeSnapshot(store, picture, () => {});
      const { plan } = picture;
      const row = canvas.getContext("2d").getImageData(0, canvas.height - 40, canvas.width, 30).data;
      return { scale: canvas.width / plan.width, width: canvas.width, foot: canvas.height / (canvas.width / plan.width) - plan.height, shades: new Set(row).size, needed: picture.pixelsNeeded, lines: captionOf(store) };
    });
    assert.ok(made.scale >= Math.min(2, made.needed) && made.width <= 4096, JSON.stringify(made));
    assert.ok(made.foot >= 3 * 18 && made.shades > 8, "lines below the picture");
    assert.match(made.lines[0], /^insonify   0\.0\.0   mock   fls   ping \d+, /);
    assert.match(made.lines[1], /m   heading \d{3}°   pitch 0°   roll 0°   z /);
    assert.match(made.lines[2], /^0\.2 to 30\.0 m   \d+ bins x 128 beams   .* dB re source at 1 m.*   model calibrated/);
    await press("shot");
    await until(async () => /^Snapshot insonify_fls_\d+\.png, \d+ x \d+$/.test(await text("note")), "the note");
  },

  async "a video of the picture is recorded and kept"() {
    await press("video");
    await until(async () => /^0:00\.[2-9]|0:0[1-9]/.test(await text("video-text")), "its time");
    const { number } = await ping();
    await until(async () => (await ping()).number > number, "a picture more");
    await press("video");
    await until(async () => /^Video insonify_fls\.webm, 0:0/.test(await text("note")), "the note");
    assert.equal(await text("video-text"), "Video");
  },

  async "the ruler measures between two clicks, and markers are told to the server and listed"() {
    await press("tool-ruler");
    await until(() => get("shown"), "a picture to measure in");
    for (const range of [10, 15]) await page.mouse.click(...(await placeOf(range, 0.2)));
    const { from, to } = await until(async () => (await get("ruler"))?.to && get("ruler"), "two points");
    assert.ok(Math.abs(Math.hypot(...from.point.map((each, i) => each - to.point[i])) - 5) < 0.6, `${from.point} to ${to.point}`);
    await press("tool-marker");
    assert.equal(await get("ruler"), null);
    server.requests.length = 0;
    await page.mouse.click(...(await placeOf(12, -0.3)));
    const { markers: [marker] } = await told("mark");
    assert.deepEqual([marker.name, marker.sonar, marker.side], ["M1", "fls", undefined]);
    assert.ok(Math.abs(marker.range - 12) < 0.06, `${marker.range} m`);
    await page.evaluate(() => insonify.store.set({ main: "scene" }));
    await until(() => page.$eval("#scene-marks", (canvas) => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some((byte) => byte > 0)), "its name in the scene");
    await page.evaluate(() => insonify.store.set({ main: "picture" }));
    await press("tool-marker");
    await press("tab-scene");
    await page.$eval("#markers input", (node) => {
      node.value = "anchor";
      node.dispatchEvent(new Event("change", { bubbles: true }));
    });
    await told("mark", ({ markers }) => markers[0]?.name === "anchor");
    await page.$eval("#markers button", (node) => node.click());
    await told("mark", ({ markers }) => markers.length === 0);
    assert.equal(await page.$eval("#markers", (node) => node.children.length), 0);
    await press("tab-display");
  },

  // The sonar is 3 m above the bed, and passes a wall between its pings 10 and 30.
  "a side-scan waterfall scrolls, looks back without a jump, measures a shadow and has markers": withSide(async () => {
    await surveyed("sides", 40);
    assert.equal(await get("main"), "waterfall");
    const rows = () => page.evaluate(() => ({ top: insonify.waterfall.topRow, count: insonify.waterfall.count, live: document.getElementById("waterfall-live").hidden }));
    assert.deepEqual(await rows(), { top: 39, count: 40, live: true });
    const altitudes = await page.evaluate(() => Array.from({ length: 40 }, (_, i) => insonify.waterfall.history.row(i).altitude));
    altitudes.forEach((altitude, i) => assert.ok(Math.abs(altitude - 3) < 0.11, `ping ${i}: ${altitude} m`));

    // Higher rows, so that they do not all fit; the wheel goes back, and new pings move nothing.
    await page.evaluate(() => {
      insonify.waterfall.pixels = 24;
      insonify.waterfall.setTop(null);
    });
    const fits = await page.evaluate(() => Math.floor(insonify.waterfall.visible));
    assert.ok(fits > 12 && fits < 38, `${fits} rows`);
    await page.mouse.move(...(await placeInRow(37, 0, 15)));
    await page.mouse.wheel({ deltaY: 12 });
    const { top } = await until(async () => ((await rows()).top < 39 ? rows() : null), "rows back");
    const under = async () => (await get("cursor"))?.row.number;
    const before = await under();
    for (const x of [2, 2.1, 2.2]) await flown(x);
    assert.deepEqual([await rows(), await under()], [{ top, count: 43, live: false }, before]);
    const caption = `Port   |   starboard   slant range   ping ${top}   0:0${(0.1 * top).toFixed(1)} s   altitude 3.0 m   ${(0.1 * (42 - top)).toFixed(1)} s back`;
    await until(async () => (await text("waterfall-caption")) === caption, `the caption ${caption}`);
    await page.keyboard.press("End");
    await until(async () => (await rows()).top === 42, "the newest");
    await page.keyboard.press("Home");
    await until(async () => (await rows()).top === fits - 1, "the oldest");
    await press("waterfall-live");
    assert.deepEqual(await rows(), { top: 42, count: 43, live: true });
    await page.keyboard.press("PageDown");
    await until(async () => (await rows()).top < 42, "a page back");

    // The wall's foot is at 8.544 m, the end of its shadow at 12.369 m: 12 - 8 = 4 m on the bed.
    await page.evaluate(() => insonify.waterfall.setTop(30));
    await until(() => page.evaluate(() => insonify.waterfall.topRow === 30), "row 30");
    await press("tool-ruler");
    const [foot, end] = [kFence.across, (kFence.across * 3) / (3 - kFence.height)].map((across) => Math.hypot(across, 3));
    for (const range of [foot + 0.1, end - 0.02]) await page.mouse.click(...(await placeInRow(20, 1, range)));
    await until(async () => (await get("ruler"))?.to, "two points");
    const reads = () => page.evaluate(async () => {
      const { stripRulerText } = await import("./js/strip/ruler.js");
      const { shown, history, store } = insonify.waterfall;
      return stripRulerText(shown, history, store.get("ruler"));
    });
    const height = Number((await reads()).match(/height by shadow ([\d.]+) m$/)?.[1]);
    assert.ok(Math.abs(height - kFence.height) < 0.06, await reads());
    assert.match(await reads(), /across 3\.[67]\d m \(slant\)   along 0\.00 m/);
    await press("tool-ground");
    await until(() => page.evaluate(() => insonify.waterfall.shown.corrected), "ranges on the bed");
    assert.match(await reads(), /across 3\.[89]\d m \(ground\)   along 0\.00 m/);
    // To the other side and 8 pings on: no shadow, and along it 0.8 m.
    await page.mouse.click(...(await placeInRow(20, 0, 5)));
    await page.mouse.click(...(await placeInRow(28, 1, 5)));
    await until(async () => /across 8\.\d\d m \(ground\)   along 0\.80 m$/.test(await reads()), "a ruler over both sides");

    // A marker at 8.544 m to starboard of ping 20 is at (0, -8, -3): it has the ping, the range and the side, and lies on its row.
    await press("tool-marker");
    server.requests.length = 0;
    await page.mouse.click(...(await placeInRow(20, 1, foot)));
    const { markers: [marker] } = await told("mark");
    assert.deepEqual([marker.name, marker.sonar, marker.ping, marker.side], ["M1", "sides", 20, "starboard"]);
    assert.ok(Math.abs(marker.range - foot) < 0.03, `${marker.range} m`);
    [0, -8, -3].forEach((each, i) => assert.ok(Math.abs(marker.position[i] - each) < 0.12, String(marker.position)));
    await leaveSurvey();
  }),

  "a frozen waterfall stays, and has the pings that came meanwhile": withSide(async () => {
    await surveyed("sides", 5);
    await press("freeze");
    await flown(0);
    await flown(0.1);
    assert.deepEqual(await page.evaluate(() => [insonify.waterfall.topRow, insonify.waterfall.count]), [4, 7]);
    await press("freeze");
    assert.equal(await page.evaluate(() => insonify.waterfall.topRow), 6);
    await leaveSurvey();
  }),

  // The bed is level, 3 m below: ranges are 3 / cos of the angle.
  "a multibeam looks down with its soundings, and its waterfall has their depths": withSide(async () => {
    await surveyed("swath", 6);
    assert.deepEqual([await get("main"), await get("mode"), await get("waterfallOf")], ["picture", "fan", "depths"]);
    const [apex, below, port] = await page.evaluate(() => {
      const { plan } = insonify.picture;
      return [plan.toScreen(0, 0), plan.place(3, 0), plan.place(6, Math.PI / 3)];
    });
    assert.ok(below[1] > apex[1] && port[0] < apex[0] && Math.abs(port[1] - below[1]) < 1e-6, `${apex}, ${below}, ${port}`);
    await until(async () => /soundings: 19 by amplitude \(blue\), 41 by phase \(green\)$/.test(await text("picture-caption")), "a count of the soundings");
    const heights = await page.evaluate(() => [...insonify.waterfall.history.newest.values].map((z) => (Number.isNaN(z) ? null : z)));
    assert.equal(heights[0], null);
    heights.slice(1).forEach((z, i) => assert.ok(Math.abs(z + 3) < 1e-5, `beam ${i + 1}: ${z} m`));
    // By ruler from 45 degrees to port to 45 to starboard along the bed: 6 m, none lower.
    await press("tool-ruler");
    for (const azimuth of [Math.PI / 4, -Math.PI / 4]) await page.mouse.click(...(await placeOf(3 * Math.SQRT2, azimuth)));
    const { from, to } = await until(async () => (await get("ruler"))?.to && get("ruler"), "two points");
    assert.ok(Math.abs(from.point[1] - to.point[1] - 6) < 0.15 && Math.abs(from.point[2] - to.point[2]) < 0.1, JSON.stringify([from, to]));
    // In the waterfall a click takes the beam's sounding.
    await page.evaluate(() => insonify.store.set({ main: "waterfall" }));
    await until(() => page.evaluate(() => document.getElementById("waterfall").clientWidth > 600), "a large waterfall");
    await press("tool-marker");
    server.requests.length = 0;
    await page.mouse.click(...(await placeInRow(3, 45)));
    const { markers: [marker] } = await told("mark");
    // Beam 45 looks 30 degrees to starboard: y = -3 tan 30.
    assert.deepEqual([marker.ping, marker.side], [3, undefined]);
    [-1.7, -3 * Math.tan(Math.PI / 6), -3].forEach((each, i) => assert.ok(Math.abs(marker.position[i] - each) < 1e-4, String(marker.position)));
    await leaveSurvey();
  }),

  async "every control has a name that a screen reader finds"() {
    const nameless = await page.evaluate(() => [...document.querySelectorAll("button, select, input")].filter((node) => {
      const label = node.getAttribute("aria-label") || node.labels?.[0]?.textContent || (node.tagName === "BUTTON" ? node.textContent : "");
      return !label.trim();
    }).map((node) => node.outerHTML));
    assert.deepEqual(nameless, []);
    const tree = await page.accessibility.snapshot();
    assert.ok(JSON.stringify(tree).includes("Brightest"));
    assert.equal(await page.$eval("#note", (node) => node.getAttribute("aria-live")), "polite");
  },

  "nothing is wider than the window, on a desktop, on a tablet and on a telephone": withSide(async () => {
    for (const [width, height] of [[1280, 720], [1024, 768], [768, 1024], [390, 800]]) {
      await resize(width, height);
      await until(() => page.evaluate((w) => innerWidth === w, width), "the width");
      const wide = await page.evaluate(() => [document.documentElement.scrollWidth - innerWidth, document.documentElement.scrollHeight - innerHeight]);
      assert.ok(wide[0] <= 0 && wide[1] <= 0, `${width} x ${height}: ${wide}`);
      const cut = await page.evaluate(() => [...document.querySelectorAll("header button, header dd, footer button, footer select")]
        .filter((node) => node.offsetParent && (node.getBoundingClientRect().right > innerWidth + 0.5 || node.getBoundingClientRect().left < -0.5 || node.getBoundingClientRect().bottom > innerHeight + 0.5)).map((node) => node.id));
      assert.deepEqual(cut, [], `${width} x ${height}`);
      // Figures as long as they can be are whole, and within the line or the lines of the readout.
      const cutFigures = await page.evaluate(() => {
        const figures = { range: "1234.567 m", bearing: "120.0\u00b0 S", level: "\u2212108.1 dB (shown \u2212108.1)", beam: "1023", bin: "12345", world: "\u2212123.45, \u2212123.45, \u2212123.45" };
        const edge = document.getElementById("readout").getBoundingClientRect();
        return Object.entries(figures).filter(([name, text]) => {
          const node = document.getElementById(`read-${name}`);
          node.textContent = text;
          const box = node.parentElement.getBoundingClientRect();
          return node.scrollWidth > node.clientWidth || box.right > edge.right + 0.5 || box.bottom > edge.bottom + 0.5;
        });
      });
      assert.deepEqual(cutFigures, [], `${width} x ${height}`);
    }
    await resize(390, 800);
    await until(() => page.evaluate(() => innerWidth === 390), "the telephone");
    const boxes = await page.$$eval(".view:not([hidden]), .readout", (nodes) => nodes.map((node) => node.getBoundingClientRect().toJSON()).sort((a, b) => a.top - b.top));
    boxes.forEach(({ left, right, top }, i) => {
      assert.ok(left <= 8 && right >= 382, `from ${left} to ${right}`);
      assert.ok(i === 0 || top >= boxes[i - 1].bottom, "one below the other");
    });
    await until(() => page.$eval("#controls", (node) => {
      const { left, right, top } = node.getBoundingClientRect();
      return left >= 0 && right <= innerWidth && top >= document.getElementById("drawer").getBoundingClientRect().bottom;
    }), "controls that leave the button free which closes them");
    await press("drawer");
    await until(() => page.$eval("#controls", (node) => node.offsetParent === null), "no controls");
    assert.ok(boxes[0].height > 250 && (await page.$eval("#views", (node) => node.scrollHeight > node.clientHeight)), "the rest is scrolled to");
    await resize(1280, 720);
    await openControls();
  }),

  "the pose shows yaw, pitch and roll whole, also far from the origin": withSide(async () => {
    const before = server.vehicle;
    server.vehicle = { position: [-1234.56, -2345.67, -345.67], yaw: -3 };
    for (const [width, height] of [[1280, 720], [1024, 768]]) {
      await resize(width, height);
      await until(async () => /^\u22121234\.56.*yaw \u2212172° pitch 0° roll 0°$/s.test(await text("pose")), "the pose");
      const [needs, has] = await page.$eval("#pose", (node) => [node.scrollWidth, node.clientWidth]);
      assert.ok(needs <= has, `${width} x ${height}: ${needs} of ${has} pixels`);
    }
    server.vehicle = before;
    await resize(1280, 720);
  }),

  "neither the legend nor the frozen tag lies on anything": withSide(async () => {
    await choose("overlay", "multipath");
    await until(() => page.$eval("#legend", (node) => node.offsetParent !== null && node.textContent.includes("three surfaces")), "the legend");
    const overlap = (a, b) => page.evaluate((ids) => {
      const [one, other] = ids.map((id) => document.getElementById(id).getBoundingClientRect());
      return one.width > 0 && other.width > 0 && Math.min(one.right, other.right) > Math.max(one.left, other.left) && Math.min(one.bottom, other.bottom) > Math.max(one.top, other.top);
    }, [a, b]);
    assert.equal(await overlap("legend", "picture-stage"), false);
    assert.equal(await overlap("legend", "colour-bar"), false);
    await choose("overlay", "none");
    await press("freeze");
    await press("enlarge-scene");
    await until(() => page.$eval("#view-picture", (node) => node.dataset.place !== "main"), "the small picture");
    assert.equal(await overlap("frozen", "enlarge-picture"), false);
    assert.equal(await overlap("frozen", "picture-caption"), false);
    await press("enlarge-picture");
    await press("freeze");
  }),

  async "louder levels of a first turn are followed, unless the contrast was set by hand"() {
    await press("contrast-reset");
    server.say({ op: "levels", sonar: "fls", levels: [-95, -45] });
    await until(async () => (await get("high")) === -45 && (await get("low")) === -95, "the new levels");
    server.say({ op: "levels", sonar: "head", levels: [-75, -25] });
    await choose("high", "-33");
    server.say({ op: "levels", sonar: "fls", levels: [-85, -35] });
    await until(async () => (await get("hello")).sonars[0].levels[1] === -35, "the message");
    assert.deepEqual([await get("low"), await get("high"), (await get("hello")).sonars[1].levels[1]], [-95, -33, -25]);
    await press("contrast-reset");
    assert.deepEqual([await get("low"), await get("high")], [-85, -35]);
    server.say(server.hello());
  },

  async "point targets are crosses in the scene"() {
    await until(() => page.evaluate(() => Boolean(insonify.scene && insonify.store.get("scene"))), "the scene");
    assert.equal(await page.evaluate(() => {
      insonify.scene.draw();
      return insonify.scene.renderer.lists.points.count;
    }), 6);
  },

  async "a recording has a line of time, and nothing to steer or to change"() {
    await serverPauses(true);
    server.recording = { first_time: 2, last_time: 4002.5, pings: 16000 };
    server.say(server.hello());
    const hidden = (id) => page.$eval(`#${id}`, (node) => node.closest("[hidden]") !== null);
    await until(async () => !(await hidden("timeline")), "the line of time");
    for (const id of ["follow", "record", "record-format", "save", "tab-fly"]) assert.equal(await hidden(id), true, id);
    assert.equal(await page.$eval('[id="key-sonars[0].max_range"]', (node) => node.matches(":disabled")), true);
    assert.equal(await page.$eval("#material", (node) => node.disabled), true);
    server.requests.length = 0;
    await page.$eval("#time", (node) => {
      node.value = 1502;
      node.dispatchEvent(new Event("input", { bubbles: true }));
      node.dispatchEvent(new Event("change", { bubbles: true }));
    });
    assert.equal((await told("seek")).time, 1502);
    await until(async () => (await text("time-text")) === "25:00.0 / 1:06:40.5", "the time of that ping");
    const number = Math.round(1502 / server.sonars[0].period);
    await until(async () => (await ping()).number === number, "the ping of that time");
    await page.evaluate(() => document.activeElement?.blur());
    await page.keyboard.press("b");
    assert.equal((await told("step")).back, true);
    await until(async () => (await ping()).number === number - 1, "the ping before");
    await until(async () => Math.abs(Number(await value("time")) - 1502) < 1, "the line's end at the ping");
    // Pings of another sonar are shown, whose recording is the longer one.
    server.state.time = 3000.5;
    server.say(server.state);
    await until(async () => (await text("time-text")) === "49:58.5 / 1:06:40.5", "where the playback is");
    assert.equal(Number(await value("time")), 3000.5);
    server.requests.length = 0;
    for (const key of ["w", "t", "r", "y"]) await page.keyboard.press(key);
    await page.keyboard.press("n");
    await told("step");
    assert.deepEqual(server.requests.map(({ op }) => op), ["step"]);
    for (const width of [1280, 390]) {
      await resize(width, 720);
      await until(() => page.evaluate((w) => innerWidth === w, width), "the width");
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width, `${width}: wider than the window`);
    }
    await resize(1280, 720);
    server.recording = null;
    server.say(server.hello());
    await until(() => hidden("timeline"), "no line of time");
    assert.equal(await hidden("record"), false);
    await serverPauses(false);
  },

  async "a lost connection is said, tried again, and found"() {
    server.requests.length = 0;
    server.say({ op: "closing", reason: "the test says so" });
    for (const socket of server.sockets.clients) socket.close(1008, "the test says so");
    await until(async () => (await text("log")).includes("The server ended the connection: the test says so"), "the reason");
    await until(async () => (await text("link-text")) === "Connected", "another connection");
    assert.equal((await told("watch")).sonar, "fls");
    const { number } = await ping();
    await until(async () => (await ping()).number !== number, "pings again");
  },

  async "the token of the page's address opens the connection"() {
    await page.goto(`${address}?token=s%26cret`);
    await until(async () => (await text("link-text")) === "Connected", "a connection");
    assert.equal(new URL(server.lastUrl, address).searchParams.get("token"), "s&cret");
  },

  async "a server that wants a token is told the one that is typed, and a wrong one is said to be wrong"() {
    server.token = "s&cret";
    await page.goto(address);
    const asks = () => page.$eval("#token-ask", (node) => node.open);
    await until(asks, "the question");
    assert.equal(await text("token-reason"), "This server needs a token.");
    assert.equal(await text("link-text"), "Token needed");
    await page.type("#token", "wrong");
    await page.keyboard.press("Enter");
    await until(async () => (await asks()) && (await text("token-reason")) === "This is not the server's token.", "another question");
    assert.equal(await text("link-text"), "Wrong token");
    await page.type("#token", "s&cret");
    await page.keyboard.press("Enter");
    await until(async () => (await text("link-text")) === "Connected", "a connection");
    assert.equal(await asks(), false);
    assert.equal(new URL(page.url()).searchParams.get("token"), "s&cret");
    await page.reload();
    await until(async () => (await text("link-text")) === "Connected", "a connection after a reload");
    server.token = undefined;
  },

  async "without a server, controls say that nothing was changed"() {
    await until(() => page.$eval("#empty", (node) => node.hidden), "a picture");
    await server.stop();
    await until(async () => (await text("link-text")).startsWith("No connection"), "the loss");
    assert.equal(await page.$eval("#pause", (node) => node.disabled), true);
    await press("tab-sonar");
    await choose("key-sonars[0].max_range", "40");
    await until(async () => (await text("note")) === "No connection: nothing was changed.", "the note");
    assert.notEqual(await value("key-sonars[0].max_range"), "40");
  },

  async "the page made no errors of its own"() {
    const own = page.faults.filter((fault) => !/WebSocket|ERR_CONNECTION|status of 401/.test(fault));
    assert.deepEqual(own, []);
  },
}, { only: process.argv[2], recover });

await browser.close();
process.exit(failed === 0 ? 0 : 1);
