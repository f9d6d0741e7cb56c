// settings.js -- controls of the scenario's settings, made from the keys that the server offers.

import { byId, element, write } from "../dom.js";

// Labels of known keys, by the end of their path, in the order in which they are shown; others get their own name.
const kSonarKeys = [["max_range", "Range"], ["min_range", "Nearest range"], ["bin_count", "Bins"], ["gain", "Gain"], ["time_varied_gain", "TVG"], ["ping_period", "Ping period"], ["step_deg", "Step of the head"]];
const kModelKeys = [["model", "Model"], ["noise", "Noise"], ["speckle", "Speckle"], ["ambient_noise_db", "Ambient noise"], ["surface", "Sea surface"], ["surface.wind_speed", "Wind"], ["surface.level", "Level of the surface"], ["ground_truth", "Ground truth"], ["secondary", "Secondary echoes"], ["max_surfaces", "Surfaces of a path"], ["seed", "Seed"]];
const kRanges = [1, 2, 3, 5, 7.5, 10, 15, 20, 25, 30, 40, 50, 60, 75, 100, 120, 150, 200, 300, 500];
const kBins = [64, 125, 250, 500, 750, 1000, 1500, 2000, 4000];

/** Builds and updates the controls; `apply(settings, line, failed)` sends them. */
export function setUpSettings(store, apply) {
  const places = { sonar: byId("settings-sonar"), model: byId("settings-model"), more: byId("settings-more") };
  let built = "";
  const controls = new Map();
  store.on(["hello", "sonar"], () => {
    const keys = keysOfSonar(store);
    const shape = JSON.stringify(keys.map(([path, entry]) => [path, typeof entry.value, entry.choices ?? null]));
    if (shape !== built) {
      built = shape;
      controls.clear();
      Object.values(places).forEach((place) => place.replaceChildren());
      for (const [path, entry] of keys) {
        const control = makeControl(path, entry, apply);
        controls.set(path, control);
        places[placeOf(path)].append(...control.nodes);
      }
    }
    for (const [path, entry] of keys) controls.get(path).show(entry);
  });
}

/** Keys of the scenario and of the watched sonar, in order. */
function keysOfSonar(store) {
  const hello = store.get("hello");
  const index = hello?.sonars.findIndex((sonar) => sonar.name === store.get("sonar")?.name) ?? -1;
  const all = Object.entries(hello?.keys ?? {});
  const others = /^sonars[[.]/;
  const mine = new RegExp(`^sonars\\[${index}\\]`);
  const name = store.get("sonar")?.name;
  return all.filter(([path]) => !others.test(path) || mine.test(path) || path.startsWith(`sonars.${name}.`))
    .sort(([a], [b]) => orderOf(a) - orderOf(b));
}

const endsWith = (path, end) => path === end || path.endsWith(`.${end}`);
const indexIn = (list, path) => list.findIndex(([end]) => (end.includes(".") || end === "surface" ? path === end : endsWith(path, end)));
const orderOf = (path) => (indexIn(kSonarKeys, path) + 1 || indexIn(kModelKeys, path) + 101 || 0) || 1000;
const placeOf = (path) => (indexIn(kSonarKeys, path) >= 0 ? "sonar" : indexIn(kModelKeys, path) >= 0 ? "model" : "more");

function labelOf(path) {
  const known = kSonarKeys[indexIn(kSonarKeys, path)] ?? kModelKeys[indexIn(kModelKeys, path)];
  return known?.[1] ?? path.replace(/^sonars(\[\d+\]|\.[^.]+)\./, "").replace(/^receiver\./, "").replaceAll("_", " ");
}

function makeControl(path, entry, apply) {
  const id = `key-${path}`;
  const line = element("p", { class: "error", id: `error-${path}`, hidden: true, role: "alert" });
  const unit = entry.unit ? ` [${entry.unit}]` : "";
  const title = entry.help ? `${entry.help} (${path})` : path;
  const input = makeInput(id, path, entry);
  let known = entry;
  const show = (value) => {
    known = value;
    if (input.type === "checkbox") input.checked = value.value === true;
    else if (document.activeElement !== input) input.value = value.value ?? "";
  };
  const restore = () => {
    input.blur();
    show(known);
  };
  const send = (text) => (text === "" ? restore() : apply([`${path}=${text}`], line, restore));
  input.addEventListener("change", () => send(input.type === "checkbox" ? String(input.checked) : input.value.trim()));
  if (input.type === "checkbox") {
    return { nodes: [element("label", { class: "switch", title }, input, element("span", {}, labelOf(path))), line], show };
  }
  const label = element("label", { for: id, title }, labelOf(path) + unit);
  const steps = input.type === "number" ? withSteps(input, path, labelOf(path), send) : input;
  return { nodes: [element("div", { class: "field line" }, label, steps), line], show };
}

function makeInput(id, path, entry) {
  if (Array.isArray(entry.choices) && entry.choices.length > 0) {
    return element("select", { id }, ...entry.choices.map((choice) => element("option", { value: String(choice) }, String(choice))));
  }
  if (typeof entry.value === "boolean") return element("input", { id, type: "checkbox" });
  const isNumber = typeof entry.value === "number" || (entry.value === null && (entry.least !== undefined || entry.most !== undefined));
  return element("input", { id, type: isNumber ? "number" : "text", step: "any", placeholder: entry.value === null ? "none" : "" });
}

/** A number between two buttons, which go to the next usual value. */
function withSteps(input, path, label, send) {
  const go = (direction) => {
    const value = nextValue(path, Number(input.value), direction);
    input.value = value;
    send(String(value));
  };
  return element("span", { class: "stepper" },
    element("button", { type: "button", "aria-label": `${label}: less`, onclick: () => go(-1) }, "−"), input,
    element("button", { type: "button", "aria-label": `${label}: more`, onclick: () => go(1) }, "+"));
}

export function nextValue(path, value, direction) {
  const usual = endsWith(path, "max_range") ? kRanges : endsWith(path, "bin_count") ? kBins : null;
  if (usual) {
    const next = direction > 0 ? usual.find((each) => each > value) : usual.findLast((each) => each < value);
    if (next !== undefined) return next;
    return direction > 0 ? value * 2 : value / 2;
  }
  if (endsWith(path, "gain")) return Number((direction > 0 ? value * 1.25 : value / 1.25).toPrecision(3));
  if (Number.isInteger(value)) return value + direction;
  return Number((value + direction * 10 ** Math.floor(Math.log10(Math.abs(value) || 1))).toPrecision(6));
}
