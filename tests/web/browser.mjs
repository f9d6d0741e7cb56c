// browser.mjs -- headless Chromium for the tests, or the reason why there is none.

import { existsSync } from "node:fs";

import { kPatience } from "./checks.mjs";

const kPlaces = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
// On a machine that is busy for long, Chromium is not to hold the drawing process for dead, which would lose all WebGL contexts.
const kFlags = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-watchdog", "--disable-domain-blocking-for-3d-apis", "--hide-scrollbars", "--mute-audio"];

/** Ends this program with 77, which says "skipped", unless Chromium is there. */
export function needBrowser() {
  const found = kPlaces.find((place) => place && existsSync(place));
  if (found) return found;
  console.log("skipped: no Chromium (apt-get install chromium, or name it in CHROMIUM)");
  process.exit(77);
}

/** A browser and a page of that size in CSS pixels, of `scale` pixels of the screen each; what the page reports as an error is
 * collected in `page.faults`. `resize(width, height)` keeps the rest. */
export async function openPage(puppeteer, { width = 1280, height = 720, scale = 1, theme = "dark", touch = false } = {}) {
  const browser = await puppeteer.launch({ executablePath: needBrowser(), headless: true, args: kFlags });
  const page = await browser.newPage();
  page.setDefaultTimeout(1000 * kPatience);
  const resize = (w, h) => page.setViewport({ width: w, height: h, deviceScaleFactor: scale, hasTouch: touch, isMobile: false });
  await resize(width, height);
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: theme }]);
  page.faults = [];
  page.on("pageerror", (error) => page.faults.push(String(error.stack ?? error)));
  page.on("console", (message) => message.type() === "error" && page.faults.push(message.text()));
  return { browser, page, resize };
}
