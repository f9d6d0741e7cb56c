// paused_page.mjs -- the viewer on a paused server, from which pictures and the film are taken.

import path from "node:path";
import puppeteer from "puppeteer-core";
import { openPage } from "./browser.mjs";
import { sourceRoot, until } from "./checks.mjs";
import { startServer } from "./live_server.mjs";

// Towards the wreck, then along it with the bow on it: [time, x, y, z, yaw in degrees].
const kFlight = [[0, -7, 5, 8, -7], [6, 1, 2, 7.4, -2], [12, 6, -4, 7, 14], [17, 12, -8.5, 6.6, 33], [22, 19, -10, 6.4, 58]];
export const flight = kFlight.map(([time, x, y, z, yaw]) => `{time: ${time}, position: [${x}, ${y}, ${z}], orientation_deg: [0, 0, ${yaw}]}`);

/** A page on a server of `program` that is paused; `next()` makes a ping and waits until it is drawn. */
export async function visitWith(program, scenario, options, look, command) {
  const server = await startServer(program, scenario, ["--paused", "--page", path.join(sourceRoot(), "web"), ...options], command);
  const { browser, page } = await openPage(puppeteer, look);
  await page.goto(server.address);
  await until(() => page.evaluate(() => globalThis.insonify?.store.get("link").state === "open"), "a connection", 30);
  const numberOf = () => page.evaluate(() => insonify.store.get("shown")?.number ?? -1);
  const drawn = () => page.evaluate(() => new Promise((done) => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done)), 80)));
  return {
    page,
    set: (values) => page.evaluate((each) => insonify.store.set(each), values),
    drawn,
    async next() {
      const before = await numberOf();
      await page.evaluate(() => insonify.session.request({ op: "step" }));
      await until(async () => (await numberOf()) > before, "the next ping", 30);
      await drawn();
    },
    async end() {
      await browser.close();
      await server.stop();
    },
  };
}

/** Where a range and an azimuth [rad, positive to port] are on the screen. */
export const pointAt = async (view, range, azimuth) => view.page.mouse.move(...(await view.page.evaluate((r, a) => {
  const box = document.getElementById("picture-stage").getBoundingClientRect();
  const [x, y] = insonify.picture.plan.place(r, a);
  return [box.left + x, box.top + y];
}, range, azimuth)));
