// timeline.js -- where a recording is: shown, and gone to. A simulation has no such line.

import { byId, write } from "../dom.js";

const kBetween = 100;  // milliseconds between requests while the line is dragged

/** Whether a recording is shown. */
export const isRecording = (store) => Boolean(store.get("hello")?.recording);

export function setUpTimeline(store, request) {
  const slider = byId("time");
  let dragged = false;
  let waiting = 0;
  const seek = () => {
    clearTimeout(waiting);
    waiting = 0;
    request({ op: "seek", time: Number(slider.value) });
  };
  slider.addEventListener("input", () => {
    dragged = true;
    tell(store, Number(slider.value));
    waiting ||= setTimeout(seek, kBetween);
  });
  slider.addEventListener("change", () => {
    dragged = false;
    seek();
  });
  byId("back").addEventListener("click", () => request({ op: "step", back: true }));
  store.on(["hello"], () => show(store));
  store.on(["link", "hello"], () => {
    byId("back").disabled = slider.disabled = store.get("link").state !== "open" || !isRecording(store);
  });
  // Where the playback is, not the last ping of the sonar that is watched: its recording may be the shorter one.
  store.on(["status", "hello"], () => {
    const time = store.get("status")?.time;
    if (!isRecording(store) || dragged || time === undefined) return;
    slider.value = time;
    tell(store, time);
  });
}

function show(store) {
  const recording = store.get("hello")?.recording;
  for (const id of ["timeline", "back"]) byId(id).hidden = !recording;
  for (const id of ["follow", "record", "save", "tab-fly"]) byId(id).hidden = Boolean(recording);
  byId("record-format").closest("label").hidden = Boolean(recording);
  byId("settings-hint").hidden = !recording;
  for (const id of ["settings-sonar", "settings-model", "settings-more"]) byId(id).disabled = Boolean(recording);
  if (!recording) return;
  Object.assign(byId("time"), { min: recording.first_time, max: recording.last_time });
  byId("pace").parentElement.title = "Seconds of the recording in a second of the clock: 1.00 is real time";
  byId("cost").parentElement.title = "Time that a ping takes to be read";
}

function tell(store, time) {
  const { first_time: first, last_time: last } = store.get("hello").recording;
  const text = (seconds) => {
    const whole = Math.max(0, seconds);
    const [hours, minutes, rest] = [Math.floor(whole / 3600), Math.floor((whole % 3600) / 60), whole % 60];
    const two = (value) => String(value).padStart(2, "0");
    return (hours ? `${hours}:${two(minutes)}` : `${minutes}`) + `:${rest.toFixed(1).padStart(4, "0")}`;
  };
  write(byId("time-text"), `${text(time - first)} / ${text(last - first)}`);
}
