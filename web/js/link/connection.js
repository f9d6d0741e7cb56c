// connection.js -- the WebSocket to the server: connects, and connects again when it is lost.

const kProtocol = "insonify.viewer.v1";
const kWaits = [0.5, 1, 2, 4, 5];  // seconds before each further try; the last one repeats

/** Calls back with what the server sends. Handlers: opened(), link({state, text, reason}), text(object), binary(buffer), and
 * refused(reason) if the server wants another token: then there is no further try until `tell`. */
export class Connection {
  #handlers;
  #socket = null;
  #tries = 0;
  #reason = "";
  #timer = 0;
  #opens = false;  // whether this socket was ever open
  #paused = false;

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

  /** Ends the connection without trying again. */
  pause() {
    this.#paused = true;
    clearTimeout(this.#timer);
    this.#socket.close();
  }

  resume() {
    if (!this.#paused) return;
    this.#paused = false;
    this.#connect();
  }

  /** Tells another token, as part of the page's address, where a reload finds it. */
  tell(token) {
    const url = new URL(location.href);
    url.searchParams.set("token", token);
    history.replaceState(null, "", url);
    this.#tries = 0;
    this.#again();
  }

  #connect() {
    // The page's own address names the server and, as `?token=`, the right to talk to it.
    const url = new URL(location.href);
    url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
    url.pathname = "/";
    url.hash = "";
    const socket = new WebSocket(url, [kProtocol]);
    this.#socket = socket;  // What an earlier one says no longer counts.
    this.#opens = false;
    socket.binaryType = "arraybuffer";
    socket.addEventListener("open", () => this.#opened());
    socket.addEventListener("message", ({ data }) => this.#receive(data));
    socket.addEventListener("close", (event) => !this.#paused && socket === this.#socket && this.#closed(event));
  }

  #opened() {
    this.#tries = 0;
    this.#reason = "";
    this.#opens = true;
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

  async #closed(event) {
    const refusal = this.#opens ? null : await whyRefused();
    if (refusal?.status === 401) {
      const told = new URL(location.href).searchParams.has("token");
      this.#handlers.link({ state: "lost", text: told ? "Wrong token" : "Token needed" });
      this.#handlers.refused(told ? "This is not the server's token." : "This server needs a token.");
      return;
    }
    const wait = kWaits[Math.min(this.#tries++, kWaits.length - 1)];
    const reason = this.#reason || event.reason || refusal?.reason;
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

/** Why the server opens no WebSocket, which the browser does not tell: { status, reason }, or null where it would or is not there. */
async function whyRefused() {
  try {
    const answer = await fetch(`access${location.search}`, { cache: "no-store" });
    return answer.ok ? null : { status: answer.status, reason: (await answer.text()).trim() };
  } catch {
    return null;  // Nobody is there: the connection is tried again.
  }
}
