// token.js -- asks for the token of a server that wants one.

import { byId, write } from "../dom.js";

/** Returns the function that asks, with a reason; `tell(token)` gets the typed token. */
export function setUpToken(tell) {
  const dialog = byId("token-ask");
  const field = byId("token");
  byId("token-form").addEventListener("submit", (event) => {
    event.preventDefault();
    if (field.value.trim() === "") return;
    dialog.close();
    tell(field.value.trim());
  });
  return (reason) => {
    write(byId("token-reason"), reason);
    write(byId("empty"), "No connection");
    field.value = "";
    if (!dialog.open) dialog.showModal();
    field.focus();
  };
}
