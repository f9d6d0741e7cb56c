// site.js -- formulas of the pages; tables of keys that become lists where the page is narrow.
document.addEventListener("DOMContentLoaded", () => {
  for (const formula of document.querySelectorAll(".arithmatex")) {
    const text = formula.textContent.trim();
    katex.render(text.slice(2, -2), formula, { displayMode: text.startsWith("\\["), throwOnError: false });
  }
  for (const table of document.querySelectorAll(".md-typeset table")) {
    if ([...table.querySelectorAll("th")].every((head) => !head.textContent)) {
      table.tHead.hidden = true;
    }
    if (table.querySelector("td > a[id]")) {
      table.dataset.keys = "";
      const heads = [...table.querySelectorAll("th")].map((head) => head.textContent);
      for (const row of table.tBodies[0].rows) {
        [...row.cells].forEach((cell, column) => { cell.dataset.head = heads[column]; });
      }
    }
  }
});
