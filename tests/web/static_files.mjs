// static_files.mjs -- serves the page's files over HTTP, with a content security policy as strict as the page allows.

import { readFile } from "node:fs/promises";
import http from "node:http";
import path from "node:path";

const kTypes = { ".html": "text/html; charset=utf-8", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml" };
const kPolicy = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'";

/** An HTTP server of the files under `root`, and of `answers`: { path: (url) => [status, text] }. */
export function serveFiles(root, answers = {}) {
  return http.createServer(async (request, response) => {
    const url = new URL(request.url, "http://localhost");
    const name = url.pathname;
    if (name in answers) {
      const [status, text] = answers[name](url);
      response.writeHead(status, { "Content-Type": "text/plain; charset=utf-8" }).end(text);
      return;
    }
    const file = path.join(root, name === "/" ? "index.html" : name);
    try {
      if (!file.startsWith(root)) throw new Error("outside of the page");
      const body = await readFile(file);
      response.writeHead(200, { "Content-Type": kTypes[path.extname(file)] ?? "application/octet-stream", "Content-Security-Policy": kPolicy });
      response.end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
}
