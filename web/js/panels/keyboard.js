// keyboard.js -- keys that fly and keys that command, and the help that lists them.

import { byId, element, isTyping } from "../dom.js";

// Keys that are held: [code, axis, sign, text of the help].
const kHeld = [
  [["KeyW", "KeyS"], "surge", ["W", "S"], "Ahead, back"],
  [["KeyA", "KeyD"], "sway", ["A", "D"], "To port, to starboard"],
  [["KeyE", "KeyQ"], "heave", ["E", "Q"], "Up, down"],
  [["ArrowLeft", "ArrowRight"], "yaw", ["←", "→"], "Turn to port, to starboard"],
  [["ArrowDown", "ArrowUp"], "pitch", ["↓", "↑"], "Bow down, bow up"],
];
const kFast = 3;

/** `commands` = [[key, text, action]...]: single keys; `flight` takes the held ones. */
export function setUpKeyboard(flight, commands) {
  const held = new Set();
  const fly = (event) => {
    const wishes = {};
    const factor = event.shiftKey ? 1 : 1 / kFast;  // With Shift three times as fast.
    for (const [[positive, negative], axis] of kHeld) {
      wishes[axis] = factor * ((held.has(positive) ? 1 : 0) - (held.has(negative) ? 1 : 0));
    }
    flight.wish("keyboard", wishes);
  };
  const isHeld = (code) => kHeld.some(([codes]) => codes.includes(code));

  window.addEventListener("keydown", (event) => {
    if (event.altKey && event.code.startsWith("Arrow") && !isTyping(event) && !byId("help").open) passToView(event);
    if (isTyping(event) || event.ctrlKey || event.metaKey || event.altKey || byId("help").open) return;
    if (event.code.startsWith("Arrow") && event.target.closest?.("[role=tab], input[type=range]")) return;
    if (/^(Page|Home$|End$)/.test(event.code) && event.target.closest?.(".page, .log, [role=tab], input[type=range]")) return;  // It scrolls that.
    if (isHeld(event.code)) {
      held.add(event.code);
      event.preventDefault();
      fly(event);
      return;
    }
    if (event.key === "Shift") fly(event);
    if (event.repeat && !event.code.startsWith("Page")) return;
    if ([" ", "Enter"].includes(event.key) && event.target.closest?.("button, summary, input")) return;  // It presses that button.
    const command = commands.find(([key]) => key === (event.key.length === 1 ? event.key.toLowerCase() : event.key));
    if (!command) return;
    event.preventDefault();
    command[2]();
  });
  window.addEventListener("keyup", (event) => {
    if (held.delete(event.code) || event.key === "Shift") fly(event);
  });
  window.addEventListener("blur", () => held.clear());
  giveBackKeys();
  fillHelp(commands);
}

// Alt and an arrow act on picture or scene, whichever is large, also where neither has the focus. The browser would go back.
function passToView(event) {
  if (event.target.closest?.(".stage")) return;
  event.preventDefault();
  const large = document.querySelector('.view[data-place="main"] .stage[tabindex]') ?? byId("picture-stage");
  large.focus({ preventScroll: true });
  const { key, code, altKey, shiftKey } = event;
  large.dispatchEvent(new KeyboardEvent("keydown", { key, code, altKey, shiftKey, cancelable: true }));
}

// A list that was chosen from with the mouse lets go of the keys, so that W A S D fly at once. With the keyboard one may
// go on choosing.
function giveBackKeys() {
  let pointed = false;
  window.addEventListener("pointerdown", () => { pointed = true; }, true);
  window.addEventListener("keydown", () => { pointed = false; }, true);
  window.addEventListener("change", ({ target }) => {
    if (pointed && target instanceof HTMLSelectElement) target.blur();
  });
}

function fillHelp(commands) {
  const row = (keys, text) => element("div", {}, element("span", {}, text), element("span", {}, ...keys.map((key) => element("kbd", {}, key))));
  const rows = kHeld.map(([, , keys, text]) => row(keys, text));
  rows.push(row(["Shift"], "Three times as fast"));
  for (const [key, text] of commands) rows.push(row([key === " " ? "Space" : key.toUpperCase()], text));
  rows.push(row(["Alt", "arrow"], "Move the cursor, turn the scene"), row(["wheel"], "Closer, where the mouse is; back in the waterfall"));
  byId("help-keys").replaceChildren(...rows);
}
