// beside.js -- a second sonar beside the first, with a connection of its own: both pictures are of the same time.

import { byId, element } from "../dom.js";
import { Session } from "../session.js";
import { makeStore } from "../store.js";
import { PictureView } from "../views/picture.js";
import { followContrast } from "./display.js";

const kShared = ["map", "grid", "smooth", "soundings", "theme", "frozen", "overlay", "over", "markers", "ground", "scene"];

export function setUpBeside(store, frames, notes) {
  const select = byId("beside");
  let second = null;  // { store, session, picture }
  store.on(["hello", "sonar"], () => {
    const others = (store.get("hello")?.sonars ?? []).map(({ name }) => name).filter((name) => name !== store.get("sonar")?.name);
    select.closest("label").hidden = others.length === 0;
    const options = ["", ...others];
    if ([...select.options].map(({ value }) => value).join("\n") !== options.join("\n")) {
      select.replaceChildren(...options.map((value) => element("option", { value }, value || "none")));
    }
    select.value = options.includes(store.get("beside")) ? store.get("beside") : "";
    if (select.value !== store.get("beside")) store.set({ beside: select.value });
  });
  select.addEventListener("change", () => store.set({ beside: select.value, main: "picture" }));
  store.on(["beside", "main"], () => {
    select.value = store.get("beside");
    const name = store.get("main") === "picture" ? store.get("beside") : "";
    document.body.toggleAttribute("data-beside", Boolean(name));
    byId("view-beside").hidden = !name;
    if (!name) return second?.session.pause();
    second ??= begin(store, frames, notes);
    second.session.resume();
    second.store.set({ wanted: name });
    second.session.choose(name);
  });
}

function begin(store, frames, notes) {
  const own = makeStore({ kept: false });
  const picture = new PictureView(own, frames, () => {}, "beside-");
  const session = new Session(own, { note() {}, error: (text, op) => op && notes.error(text, op) }, {
    taken: (ping, frozen) => frozen || picture.add(ping), saved() {}, changed: () => followContrast(own), refused() {},
  });
  store.on(kShared, () => own.set(Object.fromEntries(kShared.map((name) => [name, store.get(name)]))));
  return { store: own, session };
}
