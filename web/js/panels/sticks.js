// sticks.js -- two sticks on the screen, for fingers, and the sticks and buttons of a gamepad.

import { byId, write } from "../dom.js";

const kReach = 44;        // pixels from the middle to full speed
const kDead = 0.12;       // of a gamepad's stick
const kButtons = { 0: "pause", 1: "freeze", 3: "follow" };

export function setUpSticks(flight) {
  const shown = byId("pads");
  const show = () => (byId("sticks").hidden = !shown.checked);
  shown.checked = matchMedia("(pointer: coarse)").matches;
  shown.addEventListener("change", show);
  show();
  stick("pad-left", (x, y) => flight.wish("left stick", { surge: -y, sway: -x }));
  stick("pad-right", (x, y) => flight.wish("right stick", { heave: -y, yaw: -x }));
}

// Reports x to the right and y down within -1 and 1; both are 0 when the finger leaves.
function stick(id, report) {
  const pad = byId(id);
  const knob = pad.querySelector("i");
  let finger = null;
  const move = (x, y) => {
    knob.style.transform = `translate(${x * kReach}px, ${y * kReach}px)`;
    report(x, y);
  };
  const follow = (event) => {
    const box = pad.getBoundingClientRect();
    const x = (event.clientX - box.left - box.width / 2) / kReach;
    const y = (event.clientY - box.top - box.height / 2) / kReach;
    const far = Math.max(1, Math.hypot(x, y));
    move(x / far, y / far);
  };
  pad.addEventListener("pointerdown", (event) => {
    finger = event.pointerId;
    pad.setPointerCapture(finger);
    follow(event);
  });
  pad.addEventListener("pointermove", (event) => event.pointerId === finger && follow(event));
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
    pad.addEventListener(end, () => {
      if (finger === null) return;
      finger = null;
      move(0, 0);
    });
  }
}

/** Polls the first gamepad while there is one. */
export function setUpGamepad(flight) {
  let pressed = new Set();
  let polling = false;
  const axis = (value = 0) => (Math.abs(value) < kDead ? 0 : (value - Math.sign(value) * kDead) / (1 - kDead));
  const poll = () => {
    const pad = navigator.getGamepads().find((each) => each?.connected);
    if (!pad) {
      polling = false;
      flight.wish("gamepad", {});
      write(byId("gamepad-text"), "No gamepad. Press one of its buttons to connect it.");
      return;
    }
    const [leftX, leftY, rightX, rightY] = pad.axes;
    flight.wish("gamepad", { surge: -axis(leftY), sway: -axis(leftX), heave: -axis(rightY), yaw: -axis(rightX) });
    const now = new Set(Object.keys(kButtons).filter((i) => pad.buttons[i]?.pressed));
    for (const i of now) if (!pressed.has(i)) byId(kButtons[i]).click();
    pressed = now;
    requestAnimationFrame(poll);
  };
  const begin = () => {
    const pad = navigator.getGamepads().find((each) => each?.connected);
    if (!pad || polling) return;
    polling = true;
    write(byId("gamepad-text"), `Gamepad: ${pad.id}`);
    poll();
  };
  window.addEventListener("gamepadconnected", begin);
}
