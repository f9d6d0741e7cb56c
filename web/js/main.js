// main.js -- puts the page together.

import { byId } from "./dom.js";
import { Frames } from "./frames.js";
import { setUpBeside } from "./panels/beside.js";
import { setUpDisplay, nextMap, nextOverlay, nextPicture, fitContrast, followContrast } from "./panels/display.js";
import { Flight } from "./panels/flight.js";
import { setUpKeyboard } from "./panels/keyboard.js";
import { kViews, setUpLayout, setUpSonars } from "./panels/layout.js";
import { setUpMarks } from "./panels/marks.js";
import { Notes } from "./panels/notes.js";
import { setUpObjects } from "./panels/objects.js";
import { lookUp, setUpReadout } from "./panels/readout.js";
import { changeRange, setUpPresets, setUpSettings } from "./panels/settings.js";
import { setUpSnapshot } from "./panels/snapshot.js";
import { setUpGamepad, setUpSticks } from "./panels/sticks.js";
import { isRecording, setUpTimeline } from "./panels/timeline.js";
import { setUpTabs } from "./panels/tabs.js";
import { setUpToken } from "./panels/token.js";
import { changeSpeed, keepSaved, setUpTransport } from "./panels/transport.js";
import { setUpVideo } from "./panels/video.js";
import { Session } from "./session.js";
import { makeStore } from "./store.js";
import { AscanView } from "./views/ascan.js";
import { PictureView } from "./views/picture.js";
import { SceneView } from "./views/scene.js";
import { WaterfallView } from "./views/waterfall.js";

const store = makeStore();
const frames = new Frames();
const notes = new Notes();
window.addEventListener("error", (event) => notes.error(event.message));
window.addEventListener("unhandledrejection", (event) => notes.error(String(event.reason)));

setUpLayout(store);
const roundPings = () => picture.round.pings;
const chooseObject = (object) => store.set({ object });
// Labels come with the ping after the first cursor: a click before then waits for them.
let clicked = null;
const useTool = setUpMarks(store, (markers) => request({ op: "mark", markers }));
const chooseUnder = (cursor) => {
  const { instance, labelled, ping, world } = lookUp(store, cursor, roundPings());
  if (world && useTool({ point: world, sonar: ping.sonar, number: ping.number, time: ping.time, range: cursor.range, beam: cursor.beam })) return;
  if (instance >= 0) chooseObject(instance);
  clicked = labelled || !store.get("truth") ? null : cursor;
};
const picture = new PictureView(store, frames, chooseUnder);
store.on(["shown"], () => clicked && !store.get("tool") && chooseUnder(clicked));
let scene = null;
let waterfall = null;
// The sonar picture comes first: the shaders of the others take time.
picture.firstDrawn = () => setTimeout(() => {
  waterfall = new WaterfallView(store, frames, useTool);
  setTimeout(() => (scene = new SceneView(store, frames, chooseObject)), 50);
});
new AscanView(store, frames, roundPings);
setUpReadout(store, frames, roundPings);
setUpDisplay(store, frames, roundPings);

const session = new Session(store, notes, {
  taken: (ping, frozen) => {
    if (!frozen) picture.add(ping);
    waterfall?.add(ping);
  },
  saved: (message) => keepSaved(message, store, notes),
  changed: () => followContrast(store),
  refused: setUpToken((token) => session.tell(token)),
});
const request = (message) => session.request(message);

setUpTabs();
setUpSonars(store, (name) => session.choose(name));
setUpTransport(store, request, notes);
setUpTimeline(store, request);
setUpObjects(store, request, notes);
const apply = (settings, line, failed) => {
  notes.expect("set", line, failed);
  request({ op: "set", settings });
};
setUpSettings(store, apply);
setUpPresets(store, apply);
setUpBeside(store, frames, notes);
const redrawAll = () => {
  picture.draw();
  scene?.draw();
  waterfall?.draw();
};
setUpSnapshot(store, picture, redrawAll, notes);
setUpVideo(store, () => (store.get("main") === "waterfall" && waterfall) || picture, notes);
const flight = new Flight(store, (message) => isRecording(store) || request(message), notes);
setUpSticks(flight);
setUpGamepad(flight);

const clickAtCursor = () => {
  const cursor = store.get("cursor");
  if (cursor) (cursor.row ? waterfall : picture).click(cursor);
};
const press = (id) => () => byId(id).click();
setUpKeyboard(flight, [
  [" ", "Pause, resume", press("pause")],
  ["n", "One ping", press("step")],
  ["b", "One ping back, of a recording", press("back")],
  ["+", "Faster", () => changeSpeed(store, request, 1)],
  ["-", "Slower", () => changeSpeed(store, request, -1)],
  [",", "Shorter range", () => changeRange(store, apply, -1)],
  [".", "Longer range", () => changeRange(store, apply, 1)],
  ["t", "Follow the trajectory", press("follow")],
  ["h", "Hold (freeze) the picture", press("freeze")],
  ["f", "Full screen", press("full")],
  ["i", "Small views", press("side")],
  ["c", "Controls", press("drawer")],
  ["r", "Record", press("record")],
  ["y", "Save the scenario", press("save")],
  ["p", "Snapshot", press("shot")],
  ["k", "Ruler", press("tool-ruler")],
  ["x", "Marker", press("tool-marker")],
  ["u", "Waterfall: ground or slant range", press("tool-ground")],
  ["z", "Waterfall: altitude", press("tool-bottom")],
  ["j", "Video", press("video")],
  ["Enter", "Click at the cursor", clickAtCursor],
  ["PageDown", "Waterfall: back in time", () => waterfall?.page(1)],
  ["PageUp", "Waterfall: forth", () => waterfall?.page(-1)],
  ["Home", "Waterfall: the oldest", () => waterfall?.setTop(0)],
  ["End", "Waterfall: live", () => waterfall?.setTop(null)],
  ["g", "Fit the contrast", () => fitContrast(store)],
  ["m", "Next colours", () => nextMap(store)],
  ["o", "Next overlay", () => nextOverlay(store)],
  ["v", "Fan or polar", () => nextPicture(store)],
  ...kViews.map((name, i) => [String(i + 1), `Enlarge the ${["picture", "scene", "A-scan", "waterfall"][i]}`, () => store.set({ main: name })]),
  ["l", "Light or dark", press("theme")],
  ["?", "This help", () => byId("help").showModal()],
]);
byId("help-open").addEventListener("click", () => byId("help").showModal());
byId("help-close").addEventListener("click", () => byId("help").close());
// The closed dialog keeps no focus: the space bar is not to press its button.
byId("help").addEventListener("close", () => byId("help").contains(document.activeElement) && document.activeElement.blur());

// For tests and for the browser's console.
globalThis.insonify = { store, session, frames, picture, get waterfall() { return waterfall; }, get scene() { return scene; } };
