// objects.js -- the chosen object and its material.

import { byId, element } from "../dom.js";
import { isRecording } from "./timeline.js";

export function setUpObjects(store, request, notes) {
  const objects = byId("object");
  const materials = byId("material");
  let known = null;
  store.on(["hello"], () => {
    const hello = store.get("hello");
    const names = [...new Set([...(hello?.materials ?? []), ...(hello?.library ?? [])])].sort();
    const list = JSON.stringify([hello?.objects ?? [], names]);
    if (list === known) return;
    known = list;
    const options = (hello?.objects ?? []).map((name, i) => element("option", { value: String(i) }, name));
    objects.replaceChildren(element("option", { value: "-1" }, options.length > 0 ? "None" : "The scene has no objects"), ...options);
    materials.replaceChildren(...names.map((name) => element("option", { value: name }, name)));
  });
  store.on(["hello", "object"], () => {
    const hello = store.get("hello");
    const object = store.get("object");
    const known = object >= 0 && object < (hello?.objects.length ?? 0);
    objects.value = String(known ? object : -1);
    materials.disabled = !known || isRecording(store);
    materials.value = known ? (hello.materials[hello.object_materials[object]] ?? "") : "";
  });
  objects.addEventListener("change", () => store.set({ object: Number(objects.value) }));
  materials.addEventListener("change", () => {
    const name = store.get("hello").objects[store.get("object")];
    notes.expect("material", byId("error-material"), () => store.set({ hello: { ...store.get("hello") } }));
    request({ op: "material", object: name, material: materials.value });
  });
  store.on(["scene"], () => {
    const note = store.get("scene")?.note ?? "";
    byId("scene-note").hidden = !note;
    byId("scene-note").textContent = note;
  });
}
