// gestures.js -- mouse, wheel and fingers on a picture: hover, click, drag, zoom and double click.

const kClickReach = 5;  // pixels that a click may wander

/** Calls hover(x, y), leave(), click(x, y), drag(dx, dy, second), zoom(factor, x, y) and home(), in CSS pixels of `node`. Where there
 * is a handler wheel(pixels, zooms), the wheel calls that instead of zoom. */
export function watchGestures(node, handlers) {
  const pointers = new Map();
  let wandered = 0;
  let spread = 0;

  const placeOf = (event) => {
    const box = node.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const isButton = (event) => event.target.closest("button, ul");

  node.addEventListener("pointerdown", (event) => {
    if (isButton(event)) return;
    pointers.set(event.pointerId, event);
    wandered = 0;
    spread = 0;
    node.setPointerCapture(event.pointerId);
  });

  node.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (before) {
      const [dx, dy] = [event.clientX - before.clientX, event.clientY - before.clientY];
      wandered += Math.hypot(dx, dy);
      pointers.set(event.pointerId, event);
      if (pointers.size === 2) pinch();
      const second = pointers.size === 2 || event.shiftKey || (event.buttons & 6) !== 0;
      if (wandered > kClickReach) handlers.drag?.(dx / pointers.size, dy / pointers.size, second);
    }
    if (pointers.size < 2) handlers.hover?.(...placeOf(event));
  });

  const pinch = () => {
    const [a, b] = [...pointers.values()];
    const distance = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
    const box = node.getBoundingClientRect();
    const middle = [(a.clientX + b.clientX) / 2 - box.left, (a.clientY + b.clientY) / 2 - box.top];
    if (spread > 0 && distance > 0) handlers.zoom?.(distance / spread, ...middle);
    spread = distance;
  };

  const lift = (event) => {
    const known = pointers.delete(event.pointerId);
    spread = 0;
    if (known && event.type === "pointerup" && event.button === 0 && wandered <= kClickReach && pointers.size === 0) {
      handlers.click?.(...placeOf(event));
    }
  };
  node.addEventListener("pointerup", lift);
  node.addEventListener("pointercancel", lift);
  node.addEventListener("pointerleave", (event) => {
    if (event.pointerType === "mouse") handlers.leave?.();
  });
  node.addEventListener("dblclick", (event) => {
    if (!isButton(event)) handlers.home?.();
  });
  node.addEventListener("contextmenu", (event) => event.preventDefault());
  node.addEventListener("wheel", (event) => {
    event.preventDefault();
    if (handlers.wheel) {
      const zooms = event.ctrlKey || event.shiftKey;  // With Shift some browsers turn the wheel sideways.
      handlers.wheel((event.deltaY || event.deltaX) * (event.deltaMode === 1 ? 33 : 1), zooms);
      return;
    }
    handlers.zoom?.(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), ...placeOf(event));
  }, { passive: false });
}
