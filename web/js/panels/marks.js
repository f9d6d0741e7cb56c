// marks.js -- tools of the picture, ruler and markers, and the list of the markers.

import { byId, download, element } from "../dom.js";
import { csvOf, freeName, geoJsonOf } from "../measure.js";

const kTools = ["ruler", "marker"];

/** Sets up the tools; `send(markers)` tells the server. Returns use(point): what a click at a point of the world does, whether it
 * was for a tool. */
export function setUpMarks(store, send) {
  for (const tool of kTools) byId(`tool-${tool}`).addEventListener("click", () => choose(store, store.get("tool") === tool ? null : tool));
  store.on(["tool"], () => {
    for (const tool of kTools) byId(`tool-${tool}`).setAttribute("aria-pressed", String(store.get("tool") === tool));
  });
  const change = (markers) => {
    store.set({ markers });
    send(markers);
  };
  store.on(["markers"], () => list(store, change));
  const base = () => `${(store.get("hello")?.scenario_name || "scenario").replace(/[^\w.-]+/g, "_")}_markers`;
  byId("markers-csv").addEventListener("click", () => download(`${base()}.csv`, new Blob([csvOf(store.get("markers"))], { type: "text/csv" })));
  byId("markers-geojson").addEventListener("click", () => download(`${base()}.geojson`, new Blob([geoJsonOf(store.get("markers"))], { type: "application/geo+json" })));
  return (point) => {
    const tool = store.get("tool");
    if (tool === "marker") change([...store.get("markers"), markerAt(store, point)]);
    if (tool === "ruler") measure(store, point);
    return tool !== null;
  };
}

// Without the tool its line goes, too.
const choose = (store, tool) => store.set({ tool, ruler: tool === "ruler" ? store.get("ruler") : null });

function markerAt(store, position) {
  const { time, number, sonar } = store.get("shown");
  return { name: freeName(store.get("markers")), position, time, sonar, ping: number };
}

function measure(store, point) {
  const ruler = store.get("ruler");
  store.set({ ruler: ruler && !ruler.to ? { ...ruler, to: point } : { from: point, to: null } });
}

function list(store, change) {
  const markers = store.get("markers");
  const place = byId("markers");
  for (const id of ["markers-csv", "markers-geojson"]) byId(id).disabled = markers.length === 0;
  if (place.contains(document.activeElement) && place.children.length === markers.length) return;  // Its name is being typed.
  place.replaceChildren(...markers.map((marker, i) => element("li", { class: "row" },
    element("input", { type: "text", value: marker.name, "aria-label": `Name of marker ${i + 1}`, maxlength: "60",
      onchange: ({ target }) => change(store.get("markers").map((each, at) => (at === i ? { ...each, name: target.value } : each))) }),
    element("button", { type: "button", class: "icon", "aria-label": `Remove marker ${marker.name}`,
      onclick: () => change(store.get("markers").filter((_, at) => at !== i)) }, "×"))));
}
