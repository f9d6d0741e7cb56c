// settings.js -- controls of the scenario's settings, made from the keys that the server offers.

import { byId, element } from "../dom.js";
import { productIn } from "../product.js";
import { isRecording } from "./timeline.js";
import { generalKey, groupOf, labelOf, rankOf } from "./setting_names.js";

const kRanges = [1, 2, 3, 5, 7.5, 10, 15, 20, 25, 30, 40, 50, 60, 75, 100, 120, 150, 200, 300, 500];
const kOfHead = new Set(["S.step_deg", "S.sector_center_deg", "S.sector_width_deg", "S.mounting"]);  // scanning heads only
const kBins = [64, 125, 250, 500, 750, 1000, 1500, 2000, 4000];

/** Builds and updates the controls; `apply(settings, line, failed)` sends them. */
export function setUpSettings(store, apply) {
  const places = { sonar: byId("settings-sonar"), model: byId("settings-model"), more: byId("settings-more") };
  let built = "";
  const controls = new Map();
  store.on(["hello", "sonar"], () => {
    const keys = keysOfSonar(store);
    const shape = JSON.stringify(keys.map(([path, entry]) => [path, kindOf(entry), entry.choices ?? null]));
    if (shape !== built) {
      built = shape;
      controls.clear();
      Object.values(places).forEach((place) => place.replaceChildren());
      for (const [path, entry, key] of keys) {
        const control = makeControl(store, path, key, entry, apply);
        controls.set(path, control);
        places[groupOf(key)].append(control.node);
      }
    }
    for (const [path, entry] of keys) controls.get(path).show(entry);
    const surface = hasSurface(store);
    for (const path of ["surface.level", "surface.wind_speed"]) controls.get(path)?.node.toggleAttribute("hidden", !surface);
  });
  byId("settings-search").addEventListener("input", () => search(places.more, byId("settings-search").value));
}

const hasSurface = (store) => store.get("hello")?.keys.surface?.value !== false;

/** [path, entry, general key] of the scenario and of the watched sonar, in order. */
function keysOfSonar(store) {
  const hello = store.get("hello");
  const name = store.get("sonar")?.name;
  const index = hello?.sonars.findIndex((sonar) => sonar.name === name) ?? -1;
  return Object.entries(hello?.keys ?? {})
    .map(([path, entry]) => [path, entry, generalKey(path, index, name)])
    .filter(([path, , key]) => key !== null && (productIn(store).gathers || !kOfHead.has(key)) && !isOwn(hello, index, path))
    .sort(([, , a], [, , b]) => rankOf(a) - rankOf(b));
}

// Whether the sonar has a key of its own that acts instead of the scenario's.
const isOwn = (hello, index, path) => path.startsWith("receiver.") && `sonars[${index}].${path}` in hello.keys;

/** Fills the choice of presets: another instrument in the place of the watched sonar. */
export function setUpPresets(store, apply) {
  const select = byId("preset");
  store.on(["hello", "sonar"], () => {
    const presets = store.get("hello")?.presets ?? [];
    byId("preset-field").hidden = presets.length === 0;
    const options = ["", ...presets];
    if (select.options.length !== options.length) select.replaceChildren(...options.map((value) => element("option", { value }, value || "as the scenario says")));
  });
  select.addEventListener("change", () => {
    const index = store.get("hello").sonars.findIndex(({ name }) => name === store.get("sonar").name);
    if (select.value) apply([`sonars[${index}].preset=${select.value}`], byId("error-preset"), () => (select.value = ""));
  });
}

/** Asks for the next usual range of the watched sonar. */
export function changeRange(store, apply, direction) {
  const [path, entry, key] = keysOfSonar(store).find(([, , each]) => each === "S.max_range") ?? [];
  if (path && !isRecording(store)) apply([`${path}=${nextValue(key, entry.value, direction)}`], byId(`error-${path}`));
}

function search(place, words) {
  const wanted = words.trim().toLowerCase().split(/\s+/);
  for (const node of place.children) node.hidden = !wanted.every((word) => node.dataset.words.includes(word));
}

/** choice, switch, part, number or text. */
function kindOf(entry) {
  if (entry.kind === "part") return "part";
  if (Array.isArray(entry.choices) && entry.choices.length > 0) return "choice";
  if (typeof entry.value === "boolean" || entry.kind === "switch") return "switch";
  const isNumber = typeof entry.value === "number" || entry.least !== undefined || entry.most !== undefined || /number/.test(entry.kind ?? "");
  return isNumber ? "number" : "text";
}

// A surface that is switched on lies above the vehicle: as high as the water is said to be deep there.
function surfaceText(store, on) {
  if (!on) return "null";
  const depth = store.get("hello").keys["water.depth"]?.value;
  const height = store.get("ping")?.vehicle?.position[2] ?? 0;
  return `{level: ${Math.ceil(height + (depth > 0 ? depth : 5))}}`;
}

function makeControl(store, path, key, entry, apply) {
  const id = `key-${path}`;
  const kind = kindOf(entry);
  const line = element("p", { class: "error", id: `error-${path}`, hidden: true, role: "alert" });
  const title = entry.help ? `${entry.help} (${path})` : path;
  const input = makeInput(id, kind, entry);
  const isSwitch = input.type === "checkbox";
  let known = entry;
  const show = (value) => {
    known = value;
    if (isSwitch) input.checked = value.value === true;
    else if (document.activeElement !== input || kind === "choice") input.value = shown(value.value);
  };
  const restore = () => {
    input.blur();
    show(known);
  };
  const send = (text) => {
    if (text === "" && !entry.optional) restore();
    else apply([`${path}=${text === "" ? "none" : text}`], line, restore);
  };
  const textOf = () => (kind === "part" ? surfaceText(store, input.checked) : isSwitch ? String(input.checked) : input.value.trim());
  input.addEventListener("change", () => send(textOf()));
  const name = labelOf(key);
  const unit = entry.unit ? ` [${entry.unit}]` : "";
  const field = isSwitch
    ? element("label", { class: "switch", title }, input, element("span", {}, name))
    : element("div", { class: "field line" }, element("label", { for: id, title }, name + unit), kind === "number" ? withSteps(input, key, name, send) : input);
  return { node: element("div", { "data-words": `${path} ${name} ${entry.help ?? ""}`.toLowerCase() }, field, line), show };
}

// Six figures: a radian that was degrees in the file reads as those degrees.
const shown = (value) => (typeof value === "number" ? String(Number(value.toPrecision(7))) : (value ?? ""));

function makeInput(id, kind, entry) {
  if (kind === "choice") {
    return element("select", { id }, ...entry.choices.map((choice) => element("option", { value: String(choice) }, String(choice))));
  }
  if (kind === "switch" || kind === "part") return element("input", { id, type: "checkbox" });
  return element("input", { id, type: kind, step: "any", placeholder: entry.optional || entry.value === null ? "–" : "" });
}

/** A number between two buttons, which go to the next usual value. */
function withSteps(input, key, label, send) {
  const go = (direction) => {
    const value = nextValue(key, Number(input.value), direction);
    input.value = value;
    send(String(value));
  };
  return element("span", { class: "stepper" },
    element("button", { type: "button", "aria-label": `${label}: less`, onclick: () => go(-1) }, "−"), input,
    element("button", { type: "button", "aria-label": `${label}: more`, onclick: () => go(1) }, "+"));
}

function nextValue(key, value, direction) {
  const usual = { "S.max_range": kRanges, "S.bin_count": kBins }[key];
  if (usual) {
    const next = direction > 0 ? usual.find((each) => each > value) : usual.findLast((each) => each < value);
    return next ?? (direction > 0 ? value * 2 : value / 2);
  }
  if (key === "S.gain") return Number((direction > 0 ? value * 1.25 : value / 1.25).toPrecision(3));
  if (Number.isInteger(value)) return value + direction;
  return Number((value + direction * 10 ** Math.floor(Math.log10(Math.abs(value) || 1))).toPrecision(6));
}
