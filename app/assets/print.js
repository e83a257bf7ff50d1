// Print (Ctrl-P). A chart of Bokeh keeps its size and its colours on paper, so each one is printed as a picture of
// itself in the light theme. Explore, whose charts stand around a screen, is printed as a sheet of its own.
(() => {
  const page = window.rotorstab;
  const root = document.documentElement;
  const MAIN = ["instability", "load-frequency", "campbell"];
  const POINT = ["response", "multipliers", "orbit"];
  let sheet = null, theme = "";

  function made(tag, kind, ...content) {
    const element = document.createElement(tag);
    if (kind) element.className = kind;
    element.append(...content);
    return element;
  }

  // the views of the charts that are laid out
  function figures() {
    const found = [];
    const walk = (view) => {
      if (view.model.type === "Figure" && view.bbox.width > 0 && view.el.getClientRects().length) found.push(view);
      for (const child of view.children()) walk(child);
    };
    for (const view of Bokeh.index) walk(view);
    return found;
  }

  // the place of a view in the page, outside the shadow roots of Bokeh
  function place(view) {
    let element = view.el;
    while (element.getRootNode().host) element = element.getRootNode().host;
    return element.closest(".plot");
  }

  function picture(view) {
    for (const renderer of view.renderer_views.values()) renderer.set_visuals?.();
    view.paint(); // the colours of the light theme have not been painted yet
    const image = made("img", "print-chart");
    image.src = view.export("png").canvas.toDataURL();
    image.alt = view.model.name;
    return image;
  }

  const shown = (value) => (typeof value === "number" ? String(Number(value.toPrecision(6))) : String(value));

  function parameters() {
    const { values, si } = page.last;
    const rows = Object.entries(page.labels)
      .filter(([, label]) => !label.in_si || values.units === "SI")
      .map(([name, { words }]) => {
        const hint = si?.hints[name];
        return made("div", "", made("dt", "", ...page.rich(words)), made("dd", "", shown(values[name]), hint ? ` (${hint})` : ""));
      });
    return made("dl", "print-parameters", ...rows);
  }

  function explore() {
    const views = Object.fromEntries(figures().map((view) => [view.model.name, view]));
    const row = (names, kind) => made("div", kind, ...names.filter((name) => name in views).map((name) => picture(views[name])));
    const words = [page.last.inspector?.sentence, page.last.verdict].filter(Boolean);
    const legends = new Map(); // by their words: charts share some
    for (const entry of document.querySelectorAll('[data-page="explore"] .legend > li:not([hidden]):not(.off)')) {
      const copy = entry.cloneNode(true);
      for (const button of copy.querySelectorAll("button")) button.replaceWith(...button.childNodes);
      legends.set(copy.textContent.trim(), copy);
    }
    const pins = document.querySelector(".pin-table");
    return made("section", "print-sheet",
      made("h1", "", "Parametric instability of a shaft–disk rotor"),
      ...words.map((text) => made("p", "", ...page.rich(text))),
      row(MAIN.slice(0, 1), "print-main"), row(MAIN.slice(1), "print-pair"), row(POINT, "print-point"),
      made("ul", "legend", ...legends.values()),
      ...(page.last.pins && pins ? [made("h2", "", "Pinned curves"), pins.cloneNode(true)] : []),
      made("h2", "", "Parameters"), parameters(),
      made("p", "print-link", `${page.here()}?${page.last.query}`));
  }

  function prepare() {
    if (sheet || !page.last || !window.Bokeh) return;
    theme = root.dataset.theme;
    page.setTheme("light", false);
    if (page.last.page === "explore") {
      sheet = explore();
      document.body.append(sheet);
      root.dataset.printing = "sheet";
      return;
    }
    sheet = made("section", "print-sheet");
    for (const view of figures()) {
      const target = place(view);
      if (target) { target.append(picture(view)); target.classList.add("printed"); }
    }
  }

  function restore() {
    if (!sheet) return;
    sheet.remove();
    sheet = null;
    for (const target of document.querySelectorAll(".plot.printed")) {
      target.classList.remove("printed");
      target.querySelector(".print-chart").remove();
    }
    delete root.dataset.printing;
    page.setTheme(theme, false);
  }

  addEventListener("beforeprint", prepare);
  addEventListener("afterprint", restore);
  // a page that is shown as it would be printed has no such events
  matchMedia("print").addEventListener("change", (event) => (event.matches ? prepare() : restore()));
})();
