"use strict";
(() => {
  document.documentElement.classList.add("script");
  const collator = new Intl.Collator("en", { numeric: true, sensitivity: "base" });

  function sortable(table) {
    const body = table.tBodies[0];
    const given = Array.from(body.rows);
    const heads = Array.from(table.tHead.rows[0].cells);
    const valueOf = (row, column, isNumber) => {
      const cell = row.cells[column];
      if (!isNumber) return cell.textContent.trim();
      return cell.dataset.value === undefined ? null : Number(cell.dataset.value);
    };
    heads.forEach((head, column) => {
      const isNumber = head.classList.contains("number");
      const button = document.createElement("button");
      const printed = document.createElement("span");
      button.type = "button";
      printed.className = "printed";
      button.textContent = printed.textContent = head.textContent;
      head.replaceChildren(button, printed);
      button.addEventListener("click", () => {
        const next = { ascending: "descending", descending: null }[head.getAttribute("aria-sort")];
        const order = next === undefined ? "ascending" : next;
        heads.forEach((other) => other.removeAttribute("aria-sort"));
        if (order === null) { body.append(...given); return; }
        head.setAttribute("aria-sort", order);
        const sign = order === "ascending" ? 1 : -1;
        const keyed = given.map((row) => [valueOf(row, column, isNumber), row]);
        keyed.sort(([a], [b]) => {
          if (a === null || b === null) return (a === null) - (b === null);
          return sign * (isNumber ? a - b : collator.compare(a, b));
        });
        body.append(...keyed.map(([, row]) => row));
      });
    });
  }

  function filterable(holder) {
    const input = holder.querySelector(".filter input");
    if (input === null) return;
    const output = holder.querySelector(".filter output");
    const rows = Array.from(holder.querySelector("table").tBodies[0].rows);
    const texts = rows.map((row) => Array.from(row.cells, (cell) => cell.textContent).join(" ").toLowerCase());
    input.addEventListener("input", () => {
      const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
      let shown = 0;
      rows.forEach((row, i) => {
        row.hidden = !words.every((word) => texts[i].includes(word));
        shown += row.hidden ? 0 : 1;
      });
      output.textContent = words.length ? `${shown} of ${rows.length} rows` : "";
    });
  }

  for (const holder of document.querySelectorAll(".long-table")) {
    sortable(holder.querySelector("table"));
    filterable(holder);
  }

  // On a phone the parts of a long page are folded. Their headings open them, and so do links, a search and printing.
  function folded(section) {
    const heading = section.querySelector("h2");
    const part = document.createElement("div");
    const button = document.createElement("button");
    part.append(...Array.from(section.childNodes).filter((node) => node !== heading));
    section.append(part);
    button.type = "button";
    button.className = "fold";
    button.textContent = heading.textContent;
    heading.replaceChildren(button);
    const fold = (closed) => {
      if (closed) part.setAttribute("hidden", "until-found");
      else part.removeAttribute("hidden");
      button.setAttribute("aria-expanded", String(!closed));
    };
    button.addEventListener("click", () => fold(!part.hidden));
    part.addEventListener("beforematch", () => fold(false));
    window.addEventListener("beforeprint", () => fold(false));
    fold(true);
    return { section, fold };
  }

  const sections = Array.from(document.querySelectorAll(".sections > section"));
  if (sections.length > 6 && window.matchMedia("(max-width: 40rem)").matches) {
    const folds = sections.map(folded);
    const reach = () => {
      const target = document.getElementById(location.hash.slice(1));
      folds.filter(({ section }) => section.contains(target)).forEach(({ fold }) => fold(false));
      if (target !== null) target.scrollIntoView();
    };
    window.addEventListener("hashchange", reach);
    reach();
  }

  // What does not scroll is no stop of the Tab key.
  const holders = document.querySelectorAll(".scroll");
  function stops() {
    for (const holder of holders) {
      if (holder.scrollWidth > holder.clientWidth) holder.tabIndex = 0;
      else holder.removeAttribute("tabindex");
    }
  }
  stops();
  window.addEventListener("resize", stops);
})();
