// transport.js -- pause, step, speed, follow, freeze, record, save, and the figures of the connection.

import { byId, download, element, write } from "../dom.js";
import { number } from "../format.js";
import { slowText } from "../rates.js";
import { isRecording } from "./timeline.js";

// Says once that the machine does not keep up, and marks the figure for as long.
function watchPace(store, notes) {
  let said = false;
  store.on(["pace", "status"], () => {
    const { hello, status } = { hello: store.get("hello"), status: store.get("status") };
    const text = hello && status && !isRecording(store) ? slowText(status, hello.sonars, store.get("pace")) : null;
    byId("pace").parentElement.toggleAttribute("data-slow", text !== null);
    if (text && !said) notes.note(text);
    said ||= text !== null;
  });
  store.on(["hello"], () => (said = false));
}

export function setUpTransport(store, request, notes) {
  watchPace(store, notes);
  byId("pause").addEventListener("click", () => request({ op: "pause", on: !store.get("status")?.paused }));
  byId("step").addEventListener("click", () => request({ op: "step" }));
  byId("follow").addEventListener("click", () => request({ op: "follow", on: !store.get("status")?.follow }));
  byId("freeze").addEventListener("click", () => store.set({ frozen: !store.get("frozen") }));
  byId("speed").addEventListener("change", () => request({ op: "speed", factor: Number(byId("speed").value) }));
  byId("record").addEventListener("click", () => {
    const on = !store.get("status")?.recording;
    request(on ? { op: "record", on, format: byId("record-format").value } : { op: "record", on });
  });
  byId("save").addEventListener("click", () => request({ op: "save" }));
  store.on(["hello"], () => listFormats(store.get("hello")?.record_formats ?? []));
  store.on(["status", "link", "hello"], () => show(store));
  store.on(["frozen"], () => press("freeze", store.get("frozen")));
  store.on(["link", "status"], () => {
    const { state, text } = store.get("link");
    const prepares = state === "open" && store.get("status")?.preparing;  // Meanwhile pings of the state before go on.
    byId("link").dataset.state = prepares ? "preparing" : state;
    write(byId("link-text"), prepares ? "Preparing the change" : text);
  });
  store.on(["rate", "pace", "status"], () => {
    const runs = store.get("status")?.paused === false;
    for (const [name, digits] of [["rate", 1], ["pace", 2]]) write(byId(name), runs ? number(store.get(name) ?? NaN, digits) : "–");
  });
}

const press = (id, on) => byId(id).setAttribute("aria-pressed", String(Boolean(on)));

// Formats as [name, title]; the choice of the user stays.
function listFormats(formats) {
  const select = byId("record-format");
  const chosen = select.value;
  select.replaceChildren(...formats.map(([value, title]) => element("option", { value }, title)));
  if (formats.some(([name]) => name === chosen)) select.value = chosen;
}

function show(store) {
  const status = store.get("status");
  const open = store.get("link").state === "open";
  for (const id of ["pause", "step", "speed"]) byId(id).disabled = !open;
  const fixed = !open || isRecording(store);
  for (const id of ["follow", "record", "save", "record-format"]) byId(id).disabled = fixed;
  if (!status) return;
  press("pause", status.paused);
  press("follow", status.follow);
  press("record", status.recording);
  write(byId("pause-text"), status.paused ? "Resume" : "Pause");
  write(byId("record-text"), status.recording ? `${status.recorded_pings ?? 0} pings` : "Record");
  byId("record").title = status.recording ? `Recording to ${status.recording}. Click to end (R)` : "Record (R)";
  byId("record-format").disabled = fixed || Boolean(status.recording);
  showSpeed(status.speed);
  write(byId("cost"), number(status.ms_per_ping, status.ms_per_ping < 10 ? 1 : 0));
  write(byId("dropped"), number(status.dropped));
}

// A speed that is none of the usual ones becomes one.
function showSpeed(speed) {
  const select = byId("speed");
  const value = String(speed);
  if (![...select.options].some((option) => option.value === value)) {
    select.append(element("option", { value }, `${value} ×`));
  }
  select.value = value;
}

/** The next faster or slower of the speeds. */
export function changeSpeed(store, request, direction) {
  const speeds = [...byId("speed").options].map((option) => Number(option.value)).sort((a, b) => a - b);
  const now = store.get("status")?.speed ?? 1;
  const next = direction > 0 ? speeds.find((speed) => speed > now) : speeds.findLast((speed) => speed < now);
  if (next !== undefined) request({ op: "speed", factor: next });
}

/** Downloads a saved scenario, and says what it is. */
export function keepSaved(message, store, notes) {
  const base = (store.get("hello")?.scenario_name || "scenario").replace(/^.*[/\\]/, "").replace(/\.ya?ml$/i, "");
  const name = `${base.replace(/[^\w.-]+/g, "_") || "scenario"}_live.yaml`;
  download(name, new Blob([message.yaml], { type: "application/yaml" }));
  const pings = store.get("status")?.pings_since_change;
  const path = pings > 0 ? ` with the path of ${pings} pings` : "";
  notes.note(`Saved ${name}${path}; \`insonify run ${name}\` repeats it.${message.path ? ` Also on the server: ${message.path}` : ""}`);
}
