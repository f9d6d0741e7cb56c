// marks.js -- tools of the picture, ruler and markers, and the list of the markers.

import { byId, download, element } from "../dom.js";
import { csvOf, freeName, geoJsonOf } from "../measure.js";
import { productIn } from "../product.js";
import { stripMeasures } from "../strip/kinds.js";

const kTools = ["ruler", "marker"];
const kSwitches = { "tool-ground": "corrected", "tool-bottom": "bottomLine" };  // of the waterfall of a side-scan sonar

/** Sets up the tools; `send(markers)` tells the server. Returns use(mark): what a click does, whether it was
 * for a tool; a mark = { point [m] of the world, sonar, number, time [s] of the ping, range [m], beam }. */
export function setUpMarks(store, send) {
  for (const tool of kTools) byId(`tool-${tool}`).addEventListener("click", () => choose(store, store.get("tool") === tool ? null : tool));
  for (const [id, name] of Object.entries(kSwitches)) {
    byId(id).addEventListener("click", () => store.set({ [name]: !store.get(name) }));
    store.on([name], () => byId(id).setAttribute("aria-pressed", String(store.get(name))));
  }
  store.on(["main", "sonar", "waterfallOf"], () => showTools(store));
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
  return (mark) => {
    const tool = store.get("tool");
    if (tool === "marker") change([...store.get("markers"), markerAt(store, mark)]);
    if (tool === "ruler") measure(store, mark);
    return tool !== null;
  };
}

// Those that the large view has.
function showTools(store) {
  const main = store.get("main");
  const measures = main === "picture" || (main === "waterfall" && stripMeasures(store));
  for (const tool of kTools) byId(`tool-${tool}`).hidden = !measures;
  for (const id of Object.keys(kSwitches)) byId(id).hidden = main !== "waterfall" || !productIn(store).sides;
}

// Without the tool its line goes, too.
const choose = (store, tool) => store.set({ tool, ruler: tool === "ruler" ? store.get("ruler") : null });

function markerAt(store, { point, time, number, sonar, range, beam }) {
  const side = store.get("sonar")?.product.sides ? { side: beam === 0 ? "port" : "starboard" } : {};
  return { name: freeName(store.get("markers")), position: point, time, sonar, ping: number, range, ...side };
}

function measure(store, mark) {
  const ruler = store.get("ruler");
  store.set({ ruler: ruler && !ruler.to ? { ...ruler, to: mark } : { from: mark, to: null } });
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
