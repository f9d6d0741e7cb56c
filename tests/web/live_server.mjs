// live_server.mjs -- runs `insonify serve`, or `replay --view`, for a test or a picture.

import { spawn } from "node:child_process";

/** Starts it with these arguments, of which the first are "serve" and the scenario unless `command` says otherwise; returns { address, stop(), output() }. Throws what it said where it does not start. */
export async function startServer(program, scenario, options = [], command = ["serve", scenario]) {
  const child = spawn(program, [...command, "--port", "0", ...options]);
  process.on("exit", () => child.kill("SIGKILL"));  // It never outlives this program.
  let said = "";
  child.stdout.on("data", (data) => (said += data));
  child.stderr.on("data", (data) => (said += data));
  const ended = new Promise((done) => child.on("exit", done));
  const address = await new Promise((done, fail) => {
    child.stdout.on("data", () => /http:\S+\n/.test(said) && done(said.match(/http:\S+/)[0]));
    ended.then((code) => fail(new Error(`insonify ${command[0]} ended with ${code}: ${said}`)));
  });
  return {
    address,
    output: () => said,
    /** Interrupts it as Ctrl-C does; returns its exit status and the seconds that it took. */
    async stop() {
      const start = Date.now();
      child.kill("SIGINT");
      return { code: await ended, seconds: (Date.now() - start) / 1000 };
    },
  };
}
