// logic_test.mjs -- what the viewer's page computes without a browser: rates, plans of pictures, labels, measurements, and the
// contrast of its colours. install.py copies the page beside this test.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { runChecks, sourceRoot } from "./checks.mjs";
import { Camera, screenPlace } from "../page/js/draw/camera.js";
import { drawGraticule } from "../page/js/draw/graticule.js";
import { makePlan } from "../page/js/draw/plan.js";
import { RoundPicture } from "../page/js/draw/round.js";
import { crossLines, fanShape, sectorShape } from "../page/js/draw/shapes.js";
import { clearPoint, heightAbove } from "../page/js/draw/sight.js";
import { bearing } from "../page/js/format.js";
import { Frames } from "../page/js/frames.js";
import { quaternionOf, radians } from "../page/js/geometry.js";
import { csvOf, freeName, geoJsonOf, rulerFigures, rulerText, seenAt, worldPoint } from "../page/js/measure.js";
import { plainError } from "../page/js/panels/setting_names.js";
import { poseFigures, poseTexts } from "../page/js/pose.js";
import { Averager } from "../page/js/averaging.js";
import { Rates, slowText } from "../page/js/rates.js";
import { describeSonar } from "../page/js/sonar.js";
import { BottomTracker, kNoBottom } from "../page/js/strip/bottom.js";
import { StripHistory } from "../page/js/strip/history.js";
import { stripKind } from "../page/js/strip/kinds.js";
import { bedPoint, groundRange, heightByShadow, offsetsOf, passesOf } from "../page/js/strip/place.js";
import { sideFigures, spansShadow } from "../page/js/strip/ruler.js";
import { underPoint } from "../page/js/draw/plan.js";

Object.assign(globalThis, { document: { documentElement: {} }, getComputedStyle: () => ({ getPropertyValue: () => "#808080" }) });

const kHome = { factor: 1, x: 0, y: 0 };

/** A sonar with even beams; `more` as in `hello`. */
function sonarOf(beams, aperture, more = {}) {
  const azimuths = Array.from({ length: beams }, (_, i) => aperture / 2 - ((i + 0.5) * aperture) / beams);
  return describeSonar({ type: "fls", product: "image", beams, bins: 100, min_range: 0.2, max_range: 15, azimuths, azimuth_aperture: aperture, ...more });
}

/** Labels that a graticule writes: { text, left, right, y }. Digits are taken for 6 pixels wide. */
function labelsOf(sonar, mode, width = 900, height = 600) {
  const labels = [];
  const context = new Proxy({
    measureText: (text) => ({ width: 6 * text.length }),
    fillText(text, x, y) {
      const wide = 6 * text.length;
      const left = x - { left: 0, center: wide / 2, right: wide }[this.textAlign];
      labels.push({ text, left, right: left + wide, y });
    },
  }, { get: (real, name) => real[name] ?? (() => {}) });
  drawGraticule(context, makePlan(sonar, mode, width, height, kHome), { grid: true, headAngle: 0 });
  return labels;
}

const failed = await runChecks({
  async "rates count over the time there is, and not before half a second of it"() {
    const seen = (() => {
      // Four pings that had waited at once, then 37 a second; time passes at 0.8 of the clock, which the server's stamps say.
      const fast = new Rates();
      const found = { fast: [], slow: [] };
      const pings = [0, 0, 0, 0];
      for (let i = 1; i < 37 * 6; ++i) pings.push((1000 * i) / 37);
      let next = 0;
      for (const now of [400, 499, 1000, 3000, 5000]) {
        for (; next < pings.length && pings[next] <= now; ++next) fast.add(pings[next], { time: (0.8 * (next - 3)) / 37, change: 1, made_at: 1.7e9 + (next - 3) / 37 });
        found.fast.push([fast.pingsPerSecond(now), fast.timeFactor(now)]);
      }
      fast.add(5001, { time: 0, change: 2, made_at: 1.7e9 + 5.1 });
      found.restarted = fast.timeFactor(5002);
      const slow = new Rates();
      for (const now of [0, 5000, 10_000]) {
        slow.add(now, { time: now / 500, change: 1 });
        found.slow.push([slow.pingsPerSecond(now), slow.timeFactor(now)]);
      }
      found.stopped = [slow.pingsPerSecond(40_000), slow.timeFactor(40_000)];
      return found;
    })();
    const rounded = seen.fast.map(([rate, pace]) => [rate && Math.round(rate), pace && Math.round(pace * 100) / 100]);
    assert.deepEqual(rounded, [[null, null], [null, 0.8], [37, 0.8], [37, 0.8], [37, 0.8]]);
    assert.equal(seen.restarted, null);
    assert.deepEqual(seen.slow, [[null, null], [0.2, 2], [0.2, 2]]);
    assert.deepEqual(seen.stopped, [0, null]);
  },

  async "a smaller view is drawn once a second at least, and at once when it has something to show"() {
    const seen = (() => {
      // Frames of a clock that is moved by hand, `length` milliseconds each; every frame asks for both drawings again.
      const drawings = (length, empty = 0) => {
        let now = 5000;
        let pending = null;
        const times = [];
        const frames = new Frames({ now: () => now, next: (callback) => (pending = callback) });
        const large = frames.add(() => {});
        const small = frames.add(() => {
          times.push(now);
          return times.length > empty;
        }, () => 1000);
        for (let i = 0; i < 60; ++i) {
          large();
          small();
          now += length;
          pending();
        }
        return times;
      };
      const longest = (times) => Math.max(...times.slice(1).map((time, i) => time - times[i]));
      return { quick: longest(drawings(16)), slow: [60, 150, 300, 700, 990, 1500].map((length) => longest(drawings(length))), empty: drawings(300, 3).slice(0, 4) };
    })();
    assert.equal(seen.quick, 16);
    seen.slow.slice(0, 5).forEach((gap) => assert.ok(gap <= 1000, `${gap} ms between drawings`));
    assert.ok(seen.slow[2] > 500, "frames of 0.3 s leave most drawings out");
    assert.equal(seen.slow[5], 1500, "every frame");
    assert.deepEqual(seen.empty, [5300, 5600, 5900, 6200]);
  },

  async "labels of the picture do not lie on each other"() {
    for (const [beams, aperture, mode] of [[1, 1, "fan"], [32, 3, "fan"], [32, 7.5, "fan"], [64, 16, "polar"], [128, 120, "fan"], [128, 150, "fan"]]) {
      const labels = labelsOf(sonarOf(beams, aperture), mode);
      for (const [i, one] of labels.entries()) {
        const other = labels.slice(i + 1).find((each) => Math.abs(each.y - one.y) < 11 && each.left < one.right && one.left < each.right);
        assert.equal(other, undefined, `${aperture} deg, ${mode}: ${one.text} on ${other?.text}`);
      }
    }
    const degrees = (sonar) => labelsOf(sonar, "fan").map(({ text }) => text).filter((text) => text.includes("°")).sort();
    assert.deepEqual(degrees(sonarOf(1, 1)), ["0°"]);
    assert.deepEqual(degrees(sonarOf(128, 120)), ["0°", ..."10 30 50 60".split(" ").flatMap((each) => [`${each}° P`, `${each}° S`])].sort());
  },

  async "every label of a fan is within its picture"() {
    for (const aperture of [10, 60, 90, 120, 130, 150, 180, 210]) {
      for (const [width, height] of [[1048, 626], [1580, 986], [810, 777], [500, 700]]) {
        for (const { text, left, right, y } of labelsOf(sonarOf(64, aperture), "fan", width, height)) {
          assert.ok(left >= 0 && right <= width && y > 5 && y < height, `${aperture} deg at ${width} x ${height}: ${text} from ${left} to ${right} at ${y}`);
        }
      }
    }
  },

  // Of 1048 x 626 pixels in a window of 1280 x 720: 24 are left above and 6 below, 596 for the range; 1032 across.
  async "a fan of 120 degrees takes two thirds of 1280 x 720, and no picture reaches under the figures in its corners"() {
    const sonar = sonarOf(128, 120);
    const plan = makePlan(sonar, "fan", 1048, 626, kHome);
    const width = plan.place(15, sonar.starboards.at(-1))[0] - plan.place(15, sonar.ports[0])[0];
    const height = plan.toScreen(0, 0)[1] - plan.place(15, 0)[1];
    assert.ok((width * height) / (1280 * 720) > 0.665, `${width} x ${height}`);
    for (const [each, mode] of [[sonar, "fan"], [sonar, "polar"], [sonarOf(64, 30), "fan"], [sonarOf(128, 180), "fan"], [sonarOf(128, 300), "fan"]]) {
      for (const size of [[1048, 626], [700, 900], [810, 777]]) {
        const made = makePlan(each, mode, ...size, kHome);
        for (const [x, y] of [[20, 620], [320, 528], [760, 580], [1040, 620]]) {
          const at = [x > 524 ? size[0] - 1048 + x : x, size[1] - 626 + y];
          assert.equal(made.holds(...at), false, `${mode} of ${each.beams} beams, ${size}: ${at}`);
        }
      }
    }
  },

  async "bearings of a vertical head are slopes"() {
    const said = [0, 0.001, 90, -90, -45.04, 134.96, 180, -179.99, 270, 30].map((angle) => bearing((angle * Math.PI) / 180, true));
    assert.deepEqual(said, ["front", "front", "up", "down", "45.0° down", "45.0° up, back", "back", "back", "down", "30.0° up"]);
  },

  async "beams of a scanning head leave no column between them, whatever the step"() {
    for (const step of [0.45, 0.9, 1.8, 3.7, -2.3]) {
      const round = new RoundPicture();
      round.clear({ step, ports: [0.02], starboards: [-0.02] });
      for (let i = 0; i < 370 / Math.abs(step); ++i) round.add({ headAngle: ((0.3 + i * step) * Math.PI) / 180 });
      assert.equal(round.order.filter((order) => order < 0).length, 0, `steps of ${step} degrees`);
    }
  },

  async "a fan has its sides and right ahead written on it"() {
    const head = { ...sonarOf(1, 3, { type: "msis", product: "line" }) };
    for (const mode of ["fan", "polar"]) {
      const at = new Map(labelsOf(sonarOf(128, 120), mode).map(({ text, left }) => [text, left]));
      const [port, ahead, starboard] = ["60° P", "0°", "60° S"].map((text) => at.get(text));
      assert.ok(port < ahead && ahead < starboard, `${mode}: ${port}, ${ahead}, ${starboard}`);
    }
    const round = labelsOf(head, "round").map(({ text }) => text);
    for (const text of ["90° P", "90° S", "0°", "180°"]) assert.ok(round.includes(text), text);
  },

  async "a side-scan sonar has two sectors abeam, and both sides in its picture"() {
    const sides = sonarOf(2, 0.5, { type: "sss", product: "waterfall", azimuths: [90, -90], elevation_center: -30, elevation_aperture: 50 });
    assert.deepEqual([sides.ports[0], sides.starboards[0], sides.starboards[1]], [Math.PI / 2, 0, -Math.PI / 2]);
    const { lines } = sectorShape(sides);
    assert.equal(lines.length, 2 * sectorShape(sonarOf(1, 0.5)).lines.length);
    // Its corners are 5 and 55 degrees below horizontal, within a quarter of a degree of abeam.
    const points = Array.from({ length: lines.length / 3 }, (_, i) => lines.slice(3 * i, 3 * i + 3)).filter(([, y]) => y !== 0);
    for (const [x, y, z] of points) {
      assert.ok(Math.abs(x) <= 15 * Math.sin(radians(0.26)), `${x}`);
      const below = (Math.atan2(-z, Math.abs(y)) * 180) / Math.PI;
      assert.ok(Math.abs(below - 5) < 0.01 || Math.abs(below - 55) < 0.01, `${below}`);
    }
    assert.ok(points.some(([, y]) => y > 5) && points.some(([, y]) => y < -5));
    assert.equal(fanShape(sides).length, 0);
  },

  async "walls are not between camera and vehicle, and the way down ends at the ground"() {
    const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
    const square = (corners) => ({ matrix: identity, vertices: new Float32Array(corners), triangles: new Uint32Array([0, 1, 2, 0, 2, 3]) });
    const objects = [square([18, -20, -3, 18, 20, -3, 18, 20, 3, 18, -20, 3]), square([-30, -30, -3, 30, -30, -3, 30, 30, -3, -30, 30, -3])];
    const through = clearPoint(objects, [10, 0, 0], [30, 0, 0], 1);
    assert.ok(Math.abs(through[0] - (10 + 0.9 * 8)) < 1e-4 && through[1] === 0, String(through));
    assert.deepEqual([clearPoint(objects, [10, 25, 0], [30, 25, 0], 1), clearPoint(objects, [10, 0, 0], [30, 0, 20], 1)], [[30, 25, 0], [30, 0, 20]]);
    assert.ok(Math.abs(clearPoint(objects, [17.3, 0, 0], [27.3, 0, 0], 1)[0] - 18.3) < 1e-6, "not nearer to the vehicle than that");
    assert.deepEqual(clearPoint(objects, [17.5, 0, 0], [27.5, 0, 0], 1), [27.5, 0, 0], "what touches the vehicle is looked over");
    assert.ok(Math.abs(heightAbove(objects, [5, 2, 1.25]) - 4.25) < 1e-6);
    assert.deepEqual([heightAbove(objects, [5, 2, -4]), heightAbove(objects, [50, 2, 1])], [null, null]);
    assert.deepEqual([...crossLines([[12, -3, 0]], 0.5)].slice(0, 12), [11.5, -3, 0, 12.5, -3, 0, 12, -3.5, 0, 12, -2.5, 0]);
  },

  // North is the world's y: a yaw of 90 degrees heads north, one of 0 east, one of -100 degrees 190.
  async "heading, depth and altitude are those of a compass, of the sea's surface and of the ground"() {
    const of = (yaw, z, surface, ground) => poseTexts(poseFigures({ position: [0, 0, z], orientation: quaternionOf([0, radians(5), radians(yaw)]) }, { keys: { surface: { value: surface }, "surface.level": { value: 2.5 } } }, ground));
    assert.deepEqual(of(90, -7.5, true, -12), ["heading 000°   pitch 5°   roll 0°", "depth 10.0 m   altitude 4.5 m"]);
    assert.deepEqual(of(-100, -7.5, false, -Infinity), ["heading 190°   pitch 5°   roll 0°", "z \u22127.5 m"]);
    assert.equal(of(0.4, 0, false)[0].slice(0, 12), "heading 090°");
  },

  // A sonar 10 m above flat ground that looks along y: north, 000. What is 20 m away on the ground is sqrt(300) = 17.32 m ahead. A
  // pole's top at 15 m whose shadow ends at 20 m is 10 (1 - 15 / 20) = 2.5 m high.
  async "a point of the picture lies on the ground, is seen where it was, and a shadow gives a height"() {
    const sonar = sonarOf(64, 120, { elevation_aperture: 90 });
    const pose = { position: [2, 3, 10], orientation: quaternionOf([0, 0, radians(90)]) };
    const close = (found, expected) => found.forEach((each, i) => assert.ok(Math.abs(each - expected[i]) < 1e-6, `${found} is not ${expected}`));
    const end = worldPoint(sonar, pose, { range: 20, azimuth: 0 }, NaN, 0);
    close(end, [2, 3 + Math.sqrt(300), 0]);
    close(worldPoint(sonar, pose, { range: 20, azimuth: 0 }, 0, 0), [2, 23, 10]);
    close(worldPoint(sonar, pose, { range: 5, azimuth: 0 }, undefined, 0), [2, 8, 10]);  // Too near for the ground.
    const seen = seenAt(pose, worldPoint(sonar, pose, { range: 17, azimuth: 0.4 }, undefined, 0));
    close([seen.range], [17]);
    const top = worldPoint(sonar, pose, { range: 15, azimuth: 0 }, undefined, 0);
    const figures = rulerFigures(pose, top, end, 10);
    close([figures.rise, figures.heading], [2.5, 0]);
    close([figures.length], [Math.sqrt(300) - Math.sqrt(125)]);
    assert.equal(rulerText(figures), "6.14 m   heading 000°   height by shadow 2.50 m");
    assert.equal(rulerFigures(pose, top, worldPoint(sonar, pose, { range: 20, azimuth: 0.2 }, undefined, 0), 10).rise, null);
    assert.equal(rulerFigures(pose, top, end, NaN).rise, null);
  },

  async "the fan of a multibeam looks down, with port to the left"() {
    const sonar = sonarOf(61, 120, { type: "mbes", max_range: 40 });
    for (const [width, height] of [[900, 600], [700, 640], [400, 300]]) {
      const plan = makePlan(sonar, "fan", width, height, kHome);
      const [apex, below, port] = [plan.toScreen(0, 0), plan.place(30, 0), plan.place(30, radians(50))];
      assert.ok(below[1] > apex[1] && Math.abs(below[0] - apex[0]) < 1e-9, "straight below");
      assert.ok(port[0] < apex[0] && port[1] > apex[1] && port[1] < below[1], "to port, less deep");
      const { range, azimuth, beam } = underPoint(plan, ...port);
      assert.ok(Math.abs(range - 30) < 1e-9 && Math.abs(azimuth - radians(50)) < 1e-9 && beam === 5, `${range}, ${azimuth}, ${beam}`);
      for (const { text, left, right, y } of labelsOf(sonar, "fan", width, height)) assert.ok(left >= 0 && right <= width && y >= 0 && y <= height, `${text} at ${left}, ${y} of ${width} x ${height}`);
    }
  },

  // A ruler over a level distance and one over a drop of 2 m: housing and beams look along -z.
  async "a ruler in a fan that looks down says how much deeper its end is, and no height by shadow"() {
    const pose = { position: [0, 0, 20], orientation: quaternionOf([0, radians(90), 0]) };
    const figures = rulerFigures(pose, [0, 5, 0], [0, -7, -2], 20, true);
    assert.equal(rulerText(figures), "12.17 m   heading 180°   2.00 m lower");
    assert.deepEqual([figures.rise, rulerFigures(pose, [0, 5, -2], [0, 5, 0], 20, true).drop], [null, -2]);
  },

  async "a waterfall keeps so many rows, finds them by ping, and begins another line after a pause"() {
    const history = new StripHistory(4);
    const row = (number, time, x = number) => ({ number, time, pose: { position: [x, 0, 0] } });
    for (let i = 0; i < 6; ++i) history.add(row(i, 0.5 * i), 0.5);
    assert.deepEqual([history.first, history.count, history.row(1), history.row(2).number, history.row(5).age, history.row(5).way], [2, 6, null, 2, 2.5, 5]);
    assert.deepEqual([history.find(1, 0.5), history.find(3, 1.5), history.find(3, 1)], [-1, 3, -1]);
    history.add(row(20, 10), 0.5);  // 7.5 s after a period of half a second
    history.add(row(0, 0), 0.5);    // a restart: the last interval goes on
    assert.deepEqual([4, 5, 6, 7].map((i) => history.row(i).seam), [false, false, true, true]);
    assert.equal(history.newest.age - history.row(6).age, 7.5);
    history.cut(6);
    assert.deepEqual([history.count, history.newest.number, history.find(20, 10)], [6, 5, -1]);
  },

  // Noise of 3 dB at -100 dB up to the bed, of -60 dB from 8 m on, with a fish at 3 m in every tenth ping.
  async "the first return of the bed is followed through noise and fish, and none is claimed without a bed"() {
    const sonar = sonarOf(2, 0.5, { type: "sss", product: "waterfall", azimuths: [90, -90], bins: 400, min_range: 0, max_range: 20 });
    let seed = 7;
    const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
    const ping = (bed, fish) => Uint16Array.from({ length: 800 }, (_, i) => {
      const range = (Math.floor(i / 2) + 0.5) * 0.05;
      const level = range > bed ? -60 - 10 * Math.log10(range / 8) : fish && Math.abs(range - 3) < 0.2 ? -50 : -100;
      return 100 * (level + 400 + 3 * (random() - 0.5));
    });
    const tracker = new BottomTracker(sonar);
    for (let i = 0; i < 60; ++i) {
      const bed = 8 + 0.5 * Math.sin(i / 10);
      const { range, quality } = tracker.add(ping(bed, i % 10 === 5));
      assert.ok(Math.abs(range - bed) < 0.2 && quality > kNoBottom, `ping ${i}: ${range} m for ${bed}, quality ${quality}`);
    }
    assert.ok(new BottomTracker(sonar).add(ping(30, false)).quality < kNoBottom);
  },

  // The wall of docs/how-to/side-scan.md, 14 m to starboard of a sonar 8 m above the bed, 2 m high: its shadow ends at 14 * 8 / (8 - 2) m.
  async "a row has places of the bed, a shadow gives a height, and a ruler needs one between its ends"() {
    const sonar = sonarOf(2, 0.5, { type: "sss", product: "waterfall", azimuths: [90, -90], bins: 350, min_range: 0, max_range: 35 });
    const [foot, end] = [Math.hypot(14, 8), Math.hypot((14 * 8) / 6, 8)];
    assert.ok(Math.abs(heightByShadow(8, 8, foot, end) - 2) < 1e-9);
    assert.deepEqual([heightByShadow(8, 8, 7, end), heightByShadow(0, 0, foot, end)], [null, null]);
    const level = Uint16Array.from({ length: 700 }, (_, i) => {
      const range = (Math.floor(i / 2) + 0.5) * 0.1;
      return range < 8 || (i % 2 === 1 && range > foot && range < end) ? 0 : 34000;
    });
    const history = new StripHistory(10);
    // Along y, which is ahead: starboard is x.
    for (let i = 0; i < 5; ++i) history.add({ sonar: "s", number: i, time: i, pose: { position: [0, i, 8], orientation: quaternionOf([0, 0, radians(90)]) }, bottom: 8, altitude: 8, beams: 2, bins: 350, tables: { level } }, 1);
    const mark = (number, beam, range) => ({ point: bedPoint(history.row(number), beam, range), sonar: "s", number, time: number, range, beam });
    const close = (found, expected) => found.forEach((each, i) => assert.ok(Math.abs(each - expected[i]) < 1e-6, `${found} is not ${expected}`));
    close(mark(3, 1, foot).point, [14, 3, 0]);
    close(mark(3, 0, foot).point, [-14, 3, 0]);
    close(mark(3, 0, 5).point, [0, 3, 3]);  // In the water below the sonar.
    close([groundRange(10, 8), groundRange(5, 8)], [6, 0]);
    assert.ok(spansShadow(sonar, [history.row(0)], 1, foot, end) && !spansShadow(sonar, [history.row(0)], 0, foot, end));
    const shown = { sonar, corrected: true };
    const shadow = sideFigures(shown, history, mark(2, 1, foot), mark(2, 1, end));
    close([shadow.rise, shadow.across, shadow.along, shadow.length], [2, (14 * 8) / 6 - 14, 0, (14 * 8) / 6 - 14]);
    const both = sideFigures(shown, history, mark(0, 0, foot), mark(4, 1, foot));
    close([both.across, both.along, both.length], [28, 4, Math.hypot(28, 4)]);
    assert.equal(both.rise, null);
    close([sideFigures({ sonar, corrected: false }, history, mark(0, 0, foot), mark(4, 1, foot)).across], [2 * foot]);
    assert.match(rulerText(shadow), /^4\.67 m   heading 090°   across 4\.67 m \(ground\)   along 0\.00 m   height by shadow 2\.00 m$/);
    // A point of the world is in the row that passed nearest to it.
    assert.deepEqual(passesOf(history, 0, 4, [5, 2.2, 0]), [2]);
    assert.deepEqual(passesOf(history, 0, 4, [5, 9, 0]), []);
    close([offsetsOf(history.row(2), [5, 2.2, 0]).ahead], [0.2]);
  },

  async "a side-scan waterfall has port to the left of the track, and ranges that are those under the cursor again"() {
    const sonar = sonarOf(2, 0.5, { type: "sss", product: "waterfall", azimuths: [90, -90], bins: 400, min_range: 0.5, max_range: 20 });
    const kind = stripKind(sonar, "strongest");
    const row = { bottom: 6 };
    for (const corrected of [false, true]) {
      for (const [beam, range] of [[0, 9], [1, 15]]) {
        const share = kind.share(sonar, row, { beam, range }, { corrected });
        const across = corrected ? Math.sqrt(range * range - 36) : range;
        assert.ok(Math.abs(share - (0.5 + ((beam ? 0.5 : -0.5) * across) / 20)) < 1e-9);
        const place = kind.at(sonar, row, share, { corrected });
        assert.deepEqual([place.beam, place.bin], [beam, Math.floor((range - 0.5) / (19.5 / 400))]);
        assert.ok(Math.abs(place.range - range) < 1e-9);
      }
    }
    assert.equal(kind.at(sonar, row, 0.5001, { corrected: false }), null, "nearer than the first bin");
    assert.deepEqual([[0, 10, 1], [0, 0, 1], [1, 0, -1], [1, 5, 1]].map(([beam, bin, to]) => kind.step(sonar, { beam, bin }, to)),
      [{ beam: 0, bin: 9 }, { beam: 1, bin: 0 }, { beam: 0, bin: 0 }, { beam: 1, bin: 6 }]);
  },

  async "the 3-D view has points of the world where its camera sees them"() {
    const camera = new Camera();
    camera.pitch = 0;  // Level, from -x: y is to the left.
    camera.place(null, 2);
    const close = (found, expected) => found.forEach((each, i) => assert.ok(Math.abs(each - expected[i]) < 1e-2, `${found} is not ${expected}`));
    const perMetre = 50 / (camera.distance * Math.tan(radians(24)));  // The field of view is 48 degrees high.
    close(screenPlace(camera, [0, 0, 0], 200, 100), [100, 50]);
    close(screenPlace(camera, [0, 1, 0], 200, 100), [100 - perMetre, 50]);
    close(screenPlace(camera, [0, 0, 1], 200, 100), [100, 50 - perMetre]);
    assert.equal(screenPlace(camera, [-2 * camera.distance, 0, 0], 200, 100), null, "behind it");
    assert.equal(screenPlace(camera, [0, 4 * camera.distance, 0], 200, 100), null, "beside the picture");
  },

  async "markers have names of their own, and are written as CSV and GeoJSON"() {
    const marker = { name: 'wreck, "stern"', position: [1, -2.5, 3.25], time: 4.5, sonar: "fls", ping: 9 };
    assert.equal(freeName([{ name: "M1" }, { name: "M3" }]), "M2");
    assert.equal(csvOf([marker]), 'name,x,y,z,time,sonar,ping,range,side\r\n"wreck, ""stern""",1.000,-2.500,3.250,4.500,fls,9,,\r\n');
    const { features } = JSON.parse(geoJsonOf([marker]));
    assert.deepEqual(features, [{ type: "Feature", geometry: { type: "Point", coordinates: [1, -2.5, 3.25] }, properties: { name: 'wreck, "stern"', time: 4.5, sonar: "fls", ping: 9 } }]);
  },

  // Levels of -40, -40 and -30 dB: 1e-4, 1e-4, 1e-3; the means are 1e-4, 1e-4 and of the last two 5.5e-4, -32.60 dB. Without an echo in
  // the second ping a level fades by 1.5 dB.
  async "levels are averaged as intensities, and those that persist fade"() {
    const ping = (number, ...levels) => ({ sonar: "s", change: 0, beams: levels.length, bins: 1, number, tables: { level: Uint16Array.from(levels, (db) => (db === null ? 0 : Math.round(100 * (db + 400)))) } });
    const shown = (taken) => [...taken.tables.level].map((value) => (value ? value / 100 - 400 : null)).map((db) => db && Math.round(db * 100) / 100);
    const averager = new Averager();
    const means = [ping(0, -40, null), ping(1, -40, null), ping(2, -30, -50), ping(2, -30, -50)].map((each) => shown(averager.take(each, "2")));
    assert.deepEqual(means, [[-40, null], [-40, null], [-32.6, -53.01], [-32.6, -53.01]]);
    assert.deepEqual(shown(averager.take(ping(0, -70, -70), "2")), [-70, -70], "a run that begins again");
    assert.deepEqual([ping(0, -40, -60), ping(1, null, -50), ping(2, -42.5, -50)].map((each) => shown(averager.take(each, "persist"))), [[-40, -60], [-41.5, -50], [-42.5, -50]]);
    const each = ping(3, -10, -20);
    assert.equal(averager.take(each, "none"), each);
  },

  async "a machine that does not keep up is named, and one that is held back on purpose is not"() {
    const status = { paused: false, speed: 1, ms_per_ping: 175 };
    assert.equal(slowText(status, [{ period: 0.1 }], 0.57), "This machine makes 5.7 of the 10.0 pings due a second, so time runs at 0.57 of real time. A longer ping period, fewer bins or a shorter range help.");
    assert.equal(slowText({ ...status, ms_per_ping: 20 }, [{ period: 0.1 }], 0.5), null);
    for (const other of [slowText(status, [{ period: 0.2 }], 0.98), slowText({ ...status, paused: true }, [{ period: 0.1 }], 0.57), slowText(status, [{ period: 0.1 }], null)]) assert.equal(other, null);
  },

  async "errors of settings speak of the controls, not of the command line"() {
    assert.equal(plainError("--set sonars[0].max_range=0.1: sonars[0].max_range = 0.1 m must be greater than min_range = 0.5 m"), "Range = 0.1 m must be greater than nearest range = 0.5 m");
    assert.equal(plainError("--set: sonars.fls.receiver.time_varied_gain = -1 must be at least 0"), "TVG = -1 must be at least 0");
    assert.equal(plainError("--set: sonars[1].two_way_array = 3: true or false"), "two way array = 3: true or false");
  },

  // WCAG 2.1, 1.4.3: 4.5 for text; 1.4.11: 3 for what is told apart by its colour alone.
  async "texts have a contrast of 4.5 and signs of 3 in both themes"() {
    const css = readFileSync(path.join(sourceRoot(), "web/style/theme.css"), "utf8");
    const coloursOf = (block) => Object.fromEntries([...block.matchAll(/--([\w-]+): (#[0-9a-f]{6})/g)].map(([, name, colour]) => [name, colour]));
    const [dark, light] = [css.slice(0, css.indexOf("[data-theme")), css.slice(css.indexOf("[data-theme"))].map(coloursOf);
    const linear = (part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);
    const luminance = (colour) => [0.2126, 0.7152, 0.0722].reduce((sum, weight, i) => sum + weight * linear(parseInt(colour.slice(1 + 2 * i, 3 + 2 * i), 16) / 255), 0);
    const ratio = (a, b) => {
      const [high, low] = [luminance(a), luminance(b)].sort((x, y) => y - x);
      return (high + 0.05) / (low + 0.05);
    };
    assert.equal(ratio("#ffffff", "#000000"), 21);
    const texts = [..."text soft bad warn".split(" ").flatMap((name) => ["panel", "raised"].map((ground) => [name, ground])), ["text", "bed"], ["accent-ink", "accent"], ["badge-ink", "bad"], ["tag-ink", "tag"]];
    const signs = ["accent", "good", "warn", "bad"].map((name) => [name, "panel"]);
    for (const [theme, colours] of Object.entries({ dark, light: { ...dark, ...light } })) {
      for (const [pairs, least] of [[texts, 4.5], [signs, 3]]) {
        for (const [front, ground] of pairs) {
          const found = ratio(colours[front], colours[ground]);
          assert.ok(found >= least, `${theme}: --${front} on --${ground} has ${found.toFixed(2)}, less than ${least}`);
        }
      }
    }
  },
}, { only: process.argv[2] });

process.exit(failed === 0 ? 0 : 1);
