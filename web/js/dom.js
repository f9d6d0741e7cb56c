// dom.js -- elements of the page. Texts become text nodes, never markup: names come from files of strangers.

export const byId = (id) => document.getElementById(id);

/** Makes an element: attributes by name, listeners as `onclick`, children as elements or text. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (typeof value === "boolean") made.toggleAttribute(name, value);
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

/** Writes a text, if it is another one than is there. */
export function write(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

/** Whether a key was typed into a field, so that it is no command. */
export function isTyping(event) {
  const target = event.target;
  if (target instanceof HTMLSelectElement || target?.isContentEditable) return true;
  return target instanceof HTMLInputElement && !["checkbox", "button", "range"].includes(target.type);
}

/** A 2-D context whose unit is a CSS pixel, on a canvas as large as it is shown. */
export function context2d(canvas) {
  const { width, height, scale } = fitCanvas(canvas);
  const context = canvas.getContext("2d");
  context.setTransform(scale, 0, 0, scale, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}

/** Gives a canvas as many pixels as it covers on the screen. */
export function fitCanvas(canvas) {
  const scale = Math.min(window.devicePixelRatio || 1, 2);
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  const columns = Math.max(1, Math.round(width * scale));
  const rows = Math.max(1, Math.round(height * scale));
  if (canvas.width !== columns || canvas.height !== rows) {
    canvas.width = columns;
    canvas.height = rows;
  }
  return { width, height, scale };
}

/** Offers a file for download. */
export function download(name, blob) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** A colour of the theme, such as `--soft`. */
export const themeColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
