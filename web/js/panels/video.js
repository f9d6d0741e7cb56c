// video.js -- records the sonar picture, or the waterfall where that is large, as it is drawn, as WebM, and offers it for download.

import { byId, download, themeColour, write } from "../dom.js";
import { paintColourBar } from "../draw/colour_bar.js";
import { clock } from "../format.js";

const kTypes = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];
const kPerSecond = 25;
const kBar = 286;

/** `largest()` is the view to record. */
export function setUpVideo(store, largest, notes) {
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
    recorder = record(largest(), type, (blob, seconds) => {
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
function record(view, type, done) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [view.lines.width, view.lines.height].map((size) => Math.max(2, size - (size % 2)));
  const scale = canvas.width / view.lines.clientWidth;
  const context = canvas.getContext("2d");
  view.afterDraw = () => {
    context.fillStyle = themeColour("--panel");
    context.fillRect(0, 0, canvas.width, canvas.height);
    const { offsetLeft, offsetTop, clientWidth, clientHeight } = view.canvas;
    context.drawImage(view.canvas, ...[offsetLeft, offsetTop, clientWidth, clientHeight].map((size) => size * scale));
    context.drawImage(view.lines, 0, 0, canvas.width, canvas.height);
    context.save();
    context.scale(scale, scale);
    context.font = "12px system-ui, sans-serif";
    context.textBaseline = "top";
    context.fillStyle = themeColour("--text");
    view.captionText.split("\n").forEach((line, i) => context.fillText(line, 12, 9 + 16 * i));
    context.translate(canvas.width / scale - kBar - 8, canvas.height / scale - 52);
    paintColourBar(context, view.bar, kBar);
    context.restore();
  };
  view.draw();
  const parts = [];
  const start = performance.now();
  const recorder = new MediaRecorder(canvas.captureStream(kPerSecond), { mimeType: type, videoBitsPerSecond: 6e6 });
  const clockText = setInterval(() => write(byId("video-text"), clock((performance.now() - start) / 1000)), 250);
  recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
  recorder.addEventListener("stop", () => {
    clearInterval(clockText);
    view.afterDraw = null;
    done(new Blob(parts, { type }), (performance.now() - start) / 1000);
  });
  recorder.start();
  return recorder;
}
