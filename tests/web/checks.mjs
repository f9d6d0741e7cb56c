// checks.mjs -- runs named checks one after another, and says which of them fail.

import { cpus, loadavg } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";

/** The source tree: tests run as copies in the build tree, beside their packages (tests/node/run.py). */
export const sourceRoot = () => process.env.INSONIFY_ROOT ?? path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");

/** Runs { name: async function }, or those whose names hold `only`; returns how many failed. */
export async function runChecks(checks, only) {
  let failed = 0;
  for (const [name, check] of Object.entries(checks)) {
    if (only && !name.includes(only)) continue;
    const start = Date.now();
    try {
      await check();
      console.log(`ok      ${name} (${Date.now() - start} ms)`);
    } catch (error) {
      ++failed;
      console.log(`FAILED  ${name}\n${error.stack}`);
    }
  }
  return failed;
}

/** How many times longer things may take because others use the machine: programs that want to run, by half the processors. */
export const crowd = () => Math.min(15, Math.max(1, (2 * loadavg()[0]) / cpus().length));

/** Waits until `condition()` gives something true, and returns that; longer on a machine that others use. */
export async function until(condition, what, seconds = 8) {
  const end = Date.now() + 1000 * seconds * crowd();
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
