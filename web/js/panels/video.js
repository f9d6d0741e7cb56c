// video.js -- records the sonar picture as it is drawn, as WebM, and offers it for download.

import { byId, download, themeColour, write } from "../dom.js";
import { levelBar, paintColourBar } from "../draw/colour_bar.js";
import { clock } from "../format.js";

const kTypes = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];
const kPerSecond = 25;
const kBar = 286;

export function setUpVideo(store, picture, notes) {
  let recorder = null;
  byId("video").addEventListener("click", () => {
    if (recorder) {
      recorder.stop();
      return;
    }
    const type = kTypes.find((each) => globalThis.MediaRecorder?.isTypeSupported(each));
    if (!type) {
      notes.error("This browser records no video (it has no MediaRecorder for WebM).");
      return;
    }
    recorder = record(store, picture, type, (blob, seconds) => {
      recorder = null;
      byId("video").setAttribute("aria-pressed", "false");
      write(byId("video-text"), "Video");
      const name = `insonify_${(store.get("sonar")?.name ?? "sonar").replace(/[^\w-]+/g, "_")}.webm`;
      download(name, blob);
      notes.note(`Video ${name}, ${clock(seconds)}`);
    });
    byId("video").setAttribute("aria-pressed", "true");
  });
}

// Copies each drawn picture onto a canvas of even size, which the browser records; done(blob, seconds) at its end.
function record(store, picture, type, done) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [picture.canvas.width, picture.canvas.height].map((size) => Math.max(2, size - (size % 2)));
  const scale = canvas.width / picture.canvas.clientWidth;
  const context = canvas.getContext("2d");
  picture.afterDraw = () => {
    context.fillStyle = themeColour("--panel");
    context.fillRect(0, 0, canvas.width, canvas.height);
    for (const part of [picture.canvas, picture.lines]) context.drawImage(part, 0, 0, canvas.width, canvas.height);
    context.save();
    context.scale(scale, scale);
    context.font = "12px system-ui, sans-serif";
    context.textBaseline = "top";
    context.fillStyle = themeColour("--text");
    byId("picture-caption").textContent.split("\n").forEach((line, i) => context.fillText(line, 12, 9 + 16 * i));
    context.translate(canvas.width / scale - kBar - 8, canvas.height / scale - 52);
    paintColourBar(context, levelBar(store), kBar);
    context.restore();
  };
  picture.draw();
  const parts = [];
  const start = performance.now();
  const recorder = new MediaRecorder(canvas.captureStream(kPerSecond), { mimeType: type, videoBitsPerSecond: 6e6 });
  const clockText = setInterval(() => write(byId("video-text"), clock((performance.now() - start) / 1000)), 250);
  recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
  recorder.addEventListener("stop", () => {
    clearInterval(clockText);
    picture.afterDraw = null;
    done(new Blob(parts, { type }), (performance.now() - start) / 1000);
  });
  recorder.start();
  return recorder;
}
