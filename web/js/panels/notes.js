// notes.js -- what the server says: one line at the bottom, near the control it concerns, and in the log.

import { byId, element, write } from "../dom.js";
import { plainError } from "./setting_names.js";

const kMostLines = 300;
const kShown = 9000;  // milliseconds that a note stays at the bottom

export class Notes {
  #timer = 0;
  #unread = 0;
  #waiting = new Map();  // op -> element that shows its next error

  constructor() {
    byId("log-clear").addEventListener("click", () => byId("log").replaceChildren());
    byId("tab-log").addEventListener("click", () => this.#count(0));
  }

  note(text) {
    this.#show(text, "note");
  }

  /** An error of a request `op`, or of the page itself. */
  error(message, op = "") {
    const text = op === "set" ? plainError(message) : message;
    this.#show(text, "error");
    const near = this.#waiting.get(op);
    this.#waiting.delete(op);
    if (near) {
      write(near.line, text);
      near.line.hidden = false;
      near.failed?.();
    }
    if (byId("page-log").hidden) this.#count(this.#unread + 1);
  }

  /** Says where the next error of requests `op` is to be shown; what it showed before goes. `failed` restores the control. */
  expect(op, line, failed) {
    line.hidden = true;
    this.#waiting.set(op, { line, failed });
  }

  #show(text, kind) {
    const line = byId("note");
    write(line, text);
    line.dataset.kind = kind;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => write(line, ""), kShown);
    const time = element("time", {}, new Date().toLocaleTimeString("en-GB"));
    const log = byId("log");
    log.prepend(element("li", { "data-kind": kind }, time, text));
    while (log.children.length > kMostLines) log.lastChild.remove();
  }

  #count(count) {
    this.#unread = count;
    byId("log-count").hidden = count === 0;
    write(byId("log-count"), count === 0 ? "" : String(Math.min(count, 99)));
  }
}
