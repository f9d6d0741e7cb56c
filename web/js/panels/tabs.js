// tabs.js -- the groups of controls, one of them shown; arrow keys go from one to the next.

import { byId } from "../dom.js";

const kTabs = ["display", "sonar", "scene", "fly", "log"];

export function choosePage(chosen) {
  for (const name of kTabs) {
    const tab = byId(`tab-${name}`);
    tab.setAttribute("aria-selected", String(name === chosen));
    tab.tabIndex = name === chosen ? 0 : -1;
    byId(`page-${name}`).hidden = name !== chosen;
  }
}

export function setUpTabs() {
  kTabs.forEach((name) => {
    const tab = byId(`tab-${name}`);
    tab.addEventListener("click", () => choosePage(name));
    tab.addEventListener("keydown", ({ key }) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[key];
      if (!step) return;
      const shown = kTabs.filter((each) => !byId(`tab-${each}`).hidden);
      const next = shown[(shown.indexOf(name) + step + shown.length) % shown.length];
      byId(`tab-${next}`).focus();
      byId(`tab-${next}`).click();
    });
  });
}
