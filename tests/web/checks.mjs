// checks.mjs -- runs named checks one after another, and says which of them fail.

import { readFileSync } from "node:fs";
import { cpus, loadavg } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";

/** The source tree: tests run as copies in the build tree, beside their packages (tests/node/run.py). */
export const sourceRoot = () => process.env.INSONIFY_ROOT ?? path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");

/** Runs { name: async function }, or those whose names hold `only`; returns how many failed. After one that failed it calls
 * `recover()`. */
export async function runChecks(checks, { only, recover } = {}) {
  let failed = 0;
  for (const [name, check] of Object.entries(checks)) {
    if (only && !name.includes(only)) continue;
    const start = Date.now();
    try {
      await check();
      console.log(`ok      ${name} (${Date.now() - start} ms)`);
    } catch (error) {
      ++failed;
      console.log(`FAILED  ${name} (${Date.now() - start} ms)\n${error.stack}`);
      await recover?.();
    }
  }
  return failed;
}

const running = () => Number(readFileSync("/proc/loadavg", "utf8").match(/(\d+)\//)[1]);

/** How many times longer things may take because others use the machine: programs that want to run, now or in the last minute,
 * by half the processors. Beyond six, Chromium gets too little time to measure anything: any time may pass. To be asked before
 * what is measured, which it would count too. */
export async function crowd() {
  const now = [];
  for (let i = 0; i < 5; ++i, await pause(0.1)) now.push(running() - 1);  // Without this program.
  const times = (2 * Math.max(loadavg()[0], Math.min(...now))) / cpus().length;
  return times > 6 ? Infinity : Math.max(1, times);
}

/** Tries a measurement of speed until it passes, three times at most: others may use the machine for a moment. */
export async function bestOfThree(measure) {
  for (let i = 1; i < 3; ++i) {
    try {
      return await measure();
    } catch (error) {
      console.log(`        again, after ${error.message.split("\n")[0]}`);
    }
  }
  return measure();
}

/** A limit that only ends a check that fails [s]: how long things take on a machine that others use is not known. */
export const kPatience = 180;

/** Waits until `condition()` gives something true, and returns that. */
export async function until(condition, what, seconds = kPatience) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const value = await condition();
    if (value) return value;
    if (Date.now() > end) throw new Error(`waited ${seconds} s in vain for ${what}`);
    await new Promise((done) => setTimeout(done, 25));
  }
}

export const pause = (seconds) => new Promise((done) => setTimeout(done, 1000 * seconds));

/** A package of npm, or the end of this program with 77, which says "skipped". */
export async function need(name) {
  try {
    return await import(name);
  } catch {
    console.log(`skipped: no npm package ${name} (ctest -R node_packages installs it)`);
    process.exit(77);
  }
}
