// connection.js -- the WebSocket to the server: connects, and connects again when it is lost.

const kProtocol = "insonify.viewer.v1";
const kWaits = [0.5, 1, 2, 4, 5];  // seconds before each further try; the last one repeats

/** Calls back with what the server sends. Handlers: opened(), link({state, text}), text(object), binary(buffer). */
export class Connection {
  #handlers;
  #socket = null;
  #tries = 0;
  #reason = "";
  #timer = 0;

  constructor(handlers) {
    this.#handlers = handlers;
    this.#connect();
    window.addEventListener("online", () => this.#again());
  }

  get open() {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  /** Sends a request. Returns false where there is no connection. */
  send(request) {
    if (!this.open) return false;
    this.#socket.send(JSON.stringify(request));
    return true;
  }

  #connect() {
    // The page's own address names the server and, as `?token=`, the right to talk to it.
    const url = new URL(location.href);
    url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
    url.pathname = "/";
    url.hash = "";
    const socket = new WebSocket(url, [kProtocol]);
    this.#socket = socket;
    socket.binaryType = "arraybuffer";
    socket.addEventListener("open", () => this.#opened());
    socket.addEventListener("message", ({ data }) => this.#receive(data));
    socket.addEventListener("close", (event) => this.#closed(event));
  }

  #opened() {
    this.#tries = 0;
    this.#reason = "";
    this.#handlers.link({ state: "open", text: "Connected" });
    this.#handlers.opened();
  }

  #receive(data) {
    if (typeof data !== "string") {
      this.#handlers.binary(data);
      return;
    }
    const message = JSON.parse(data);
    if (message.op === "closing") this.#reason = message.reason;
    this.#handlers.text(message);
  }

  #closed(event) {
    const wait = kWaits[Math.min(this.#tries++, kWaits.length - 1)];
    const reason = this.#reason || event.reason;
    this.#handlers.link({ state: "lost", text: `No connection, next try in ${wait} s`, reason });
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#again(), 1000 * wait);
  }

  #again() {
    if (this.#socket.readyState !== WebSocket.CLOSED) return;
    clearTimeout(this.#timer);
    this.#handlers.link({ state: "connecting", text: "Connecting" });
    this.#connect();
  }
}
