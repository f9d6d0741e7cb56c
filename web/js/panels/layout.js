// layout.js -- which view is the large one, theme, and choice of sonar.

import { byId, element } from "../dom.js";

export const kViews = ["picture", "scene", "ascan", "waterfall"];
const kTitles = { picture: "sonar picture", scene: "scene", ascan: "A-scan", waterfall: "waterfall" };

export function setUpLayout(store) {
  for (const name of kViews) {
    const button = element("button", { type: "button", class: "enlarge", id: `enlarge-${name}`, "aria-label": `Enlarge the ${kTitles[name]}`, title: `Enlarge (${kViews.indexOf(name) + 1})`, onclick: () => store.set({ main: name }) });
    button.append(enlargeIcon());
    byId(`view-${name}`).append(button);
  }
  store.on(["main"], () => place(store.get("main")));
  setUpFolds(store);
  setUpTheme(store);
}

// The large view changes places with the picture, so that the others stay where they are.
function place(main) {
  const order = ["scene", "ascan", "waterfall"].map((name) => (name === main ? "picture" : name));
  byId(`view-${main}`).dataset.place = "main";
  order.forEach((name, i) => (byId(`view-${name}`).dataset.place = ["one", "two", "three"][i]));
}

// Small views and controls fold; full screen hides all but the large view.
function setUpFolds(store) {
  byId("side").addEventListener("click", () => store.set({ side: !store.get("side") }));
  byId("drawer").addEventListener("click", () => store.set({ controls: !store.get("controls") }));
  for (const id of ["full", "leave"]) byId(id).addEventListener("click", () => store.set({ full: !store.get("full") }));
  store.on(["side"], () => {
    document.body.dataset.side = store.get("side") ? "on" : "off";
    byId("side").setAttribute("aria-pressed", String(store.get("side")));
  });
  store.on(["controls"], () => {
    byId("controls").toggleAttribute("data-open", store.get("controls"));
    byId("drawer").setAttribute("aria-expanded", String(store.get("controls")));
  });
  store.on(["full"], () => {
    const full = store.get("full");
    document.body.toggleAttribute("data-full", full);
    // Where the browser refuses its whole screen, the large view has the whole window.
    if (full) document.documentElement.requestFullscreen?.().catch(() => {});
    else if (document.fullscreenElement) document.exitFullscreen();
  });
  document.addEventListener("fullscreenchange", () => document.fullscreenElement || store.set({ full: false }));
}

function enlargeIcon() {
  const icon = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  icon.setAttribute("viewBox", "0 0 24 24");
  icon.setAttribute("aria-hidden", "true");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", "M14 4h6v6M20 4l-7 7M10 20H4v-6M4 20l7-7");
  icon.append(path);
  return icon;
}

function setUpTheme(store) {
  const system = matchMedia("(prefers-color-scheme: light)");
  const now = () => store.get("theme") ?? (system.matches ? "light" : "dark");
  const apply = () => (document.documentElement.dataset.theme = now());
  system.addEventListener("change", () => {
    apply();
    if (store.get("theme") === null) store.set({ theme: undefined });  // Pictures are drawn with the new colours.
  });
  byId("theme").addEventListener("click", () => {
    const theme = now() === "dark" ? "light" : "dark";
    document.documentElement.dataset.theme = theme;
    store.set({ theme });
  });
  store.on(["theme"], apply);
}

/** Fills the choice of sonar, and calls `choose(name)`. */
export function setUpSonars(store, choose) {
  const select = byId("sonar");
  let names = "";
  store.on(["hello"], () => {
    const hello = store.get("hello");
    const list = (hello?.sonars ?? []).map((sonar) => sonar.name);
    byId("scenario").textContent = hello?.scenario_name ?? "";
    byId("scenario").title = hello?.scenario_name ?? "";
    if (hello) document.title = `${hello.scenario_name} – insonify`;
    if (names === list.join("\n")) return;
    names = list.join("\n");
    select.replaceChildren(...list.map((name) => element("option", { value: name }, name)));
  });
  store.on(["sonar"], () => (select.value = store.get("sonar")?.name ?? ""));
  select.addEventListener("change", () => choose(select.value));
}
