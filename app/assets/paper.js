// The Paper page with its figures, and the downloads of every page.
window.rotorstab.paper = (() => {
  const page = window.rotorstab;
  const FIRST = 6; // the figure that an address without a choice shows
  const place = (name) => document.querySelector(`[data-paper="${name}"]`);
  const panels = () => [...document.querySelectorAll("[data-panel]")];
  const box = () => document.querySelector("#paper-floquet");
  const SVG = "http://www.w3.org/2000/svg";
  let current = 0, shown = null; // the number that was asked for, and the figure of the last answer
  let hidden = new Set(); // places of the groups of curves that are switched off

  function row(cells, heads = 0) {
    const tr = document.createElement("tr");
    cells.forEach((cell, index) => {
      const td = document.createElement(index < heads ? "th" : "td");
      if (index < heads) td.scope = "row";
      if (typeof cell === "string") td.append(...page.rich(cell)); else td.append(cell);
      tr.append(td);
    });
    return tr;
  }

  // -- the choice, which the address names unless it is the usual one ---------------
  const ONLY = "paper-only";
  function fromAddress() {
    const [, number, only] = location.hash.split("/");
    const known = [...document.querySelectorAll("[data-figure]")].map((button) => Number(button.dataset.figure));
    if (number === undefined) return; // the last choice stays
    current = known.includes(Number(number)) ? Number(number) : FIRST;
    box().checked = only !== ONLY;
    hidden = new Set();
  }

  function toAddress() {
    const usual = current === FIRST && box().checked;
    const hash = usual ? "#paper" : `#paper/${current}${box().checked ? "" : `/${ONLY}`}`;
    if (location.hash !== hash) history.replaceState(history.state, "", hash);
  }

  function request() {
    page.send({ type: "figure", number: current, floquet: box().checked, hidden: [...hidden].join(",") });
  }

  function wait(panel, words) {
    if (words) panel.dataset.waits = words; else delete panel.dataset.waits;
  }

  // the words stay until Bokeh has laid out the chart
  function waitForChart(panel, figure) {
    if (shown !== figure) return;
    if (page.places.view(panel.dataset.panel)) wait(panel, "");
    else setTimeout(() => waitForChart(panel, figure), 50);
  }

  function ask(number) {
    if (number !== current) hidden = new Set();
    current = number;
    toAddress();
    for (const button of document.querySelectorAll("[data-figure]")) button.setAttribute("aria-pressed", String(Number(button.dataset.figure) === number));
    place("problem").hidden = true;
    if (shown?.number !== number) {
      // until the answer is here, neither words nor curves of the last figure must be shown
      place("title").textContent = `Figure ${number}`;
      for (const name of ["caption", "parameters", "reading", "legend"]) place(name).replaceChildren();
      for (const panel of panels()) wait(panel, "Drawing …");
    }
    request();
  }

  // -- the answer -------------------------------------------------------------
  function stroke({ color, dash }) {
    const svg = document.createElementNS(SVG, "svg"), line = document.createElementNS(SVG, "line");
    for (const [name, value] of Object.entries({ width: 30, height: 10, "aria-hidden": "true" })) svg.setAttribute(name, value);
    const look = { x1: 1, x2: 29, y1: 5, y2: 5, stroke: color, "stroke-width": 2, ...(dash === "solid" ? {} : { "stroke-dasharray": dash }) };
    for (const [name, value] of Object.entries(look)) line.setAttribute(name, value);
    svg.append(line);
    return svg;
  }

  function entry(...content) {
    const item = document.createElement("li");
    item.append(...content);
    return item;
  }

  function swatch(kind, words) {
    const sign = document.createElement("span");
    sign.className = `swatch ${kind}`;
    return entry(sign, words);
  }

  function showLegend(figure) {
    const entries = figure.legend.map((group, index) => {
      const words = [stroke(group), ...page.rich(group.name)];
      if (figure.legend.length < 2) return entry(...words);
      const button = document.createElement("button");
      button.type = "button";
      button.dataset.group = index;
      button.setAttribute("aria-pressed", String(!hidden.has(index)));
      button.append(...words);
      button.addEventListener("click", () => {
        if (!hidden.delete(index)) hidden.add(index);
        button.setAttribute("aria-pressed", String(!hidden.has(index)));
        request();
      });
      return entry(button);
    });
    if (figure.regions) entries.push(swatch("hatch", "Bolotin region"));
    if (figure.regions && figure.floquet) entries.push(swatch("unstable", "unstable by Floquet’s method"));
    const focused = document.activeElement?.dataset?.group;
    place("legend").replaceChildren(...entries);
    if (focused !== undefined) place("legend").querySelector(`[data-group="${focused}"]`)?.focus();
  }

  function showPanels(figure) {
    const known = new Map();
    for (const { letter, title, paper, floquet } of figure.panels) {
      known.set(`figure-${letter}`, [`(${letter}) ${title}`, figure.has_floquet ? paper : ""]);
      if (figure.floquet && figure.has_floquet) known.set(`figure-${letter}-floquet`, [`(${letter}) ${title}`, floquet]);
    }
    for (const panel of panels()) {
      const names = known.get(panel.dataset.panel);
      panel.hidden = !names;
      if (!names) continue;
      const method = document.createElement("small");
      method.textContent = names[1];
      panel.querySelector("[data-panel-title]").replaceChildren(...page.rich(names[0]), " ", method);
      panel.setAttribute("aria-label", names.filter(Boolean).join(", "));
      if (figure.waits && panel.dataset.panel.endsWith("-floquet")) wait(panel, "Computing with Floquet’s method …");
      else waitForChart(panel, figure);
    }
    const settings = Object.fromEntries(figure.settings.map((one) => [one.letter, one]));
    place("open").hidden = !("" in settings);
    for (const button of document.querySelectorAll("[data-open]")) button.hidden = !(button.dataset.open in settings);
    Object.assign(place("panels").dataset, { pairs: String(known.size > figure.panels.length), count: figure.panels.length });
  }

  function open(letter) {
    const setting = shown.settings.find((one) => one.letter === letter);
    for (const [name, value] of Object.entries(setting.values)) page.change(name, value);
    location.hash = setting.page;
  }

  function verdict(words) {
    const made = document.createElement("span");
    made.className = `verdict ${words.replaceAll(" ", "-")}`;
    made.textContent = words;
    return made;
  }

  function show(figure) {
    shown = figure;
    place("title").replaceChildren(...page.rich(`Figure ${figure.number}. ${figure.title}`));
    place("caption").replaceChildren(...page.rich(figure.caption));
    place("parameters").replaceChildren(...page.facts(figure.parameters));
    place("reading").replaceChildren(...figure.reading.map((one) => {
      const ours = document.createElement("div");
      ours.append(...page.rich(one.ours));
      if (one.note) {
        const note = document.createElement("p");
        note.className = "sub";
        note.append(...page.rich(one.note));
        ours.append(note);
      }
      return row([one.text, ours, verdict(one.verdict)]);
    }));
    box().disabled = !figure.has_floquet;
    showLegend(figure);
    showPanels(figure);
    // charts that have just been created have not been painted in the colours of the page
    for (const delay of [0, 60, 400]) setTimeout(page.paintCharts, delay);
  }

  function problem(words) {
    for (const panel of panels()) wait(panel, "");
    place("problem").textContent = words;
    place("problem").hidden = false;
    shown = null;
  }

  function save({ name, mime, base64 }) {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    page.save(name, new Blob([bytes], { type: mime }));
  }

  document.addEventListener("DOMContentLoaded", () => {
    for (const button of document.querySelectorAll("[data-figure]")) button.addEventListener("click", () => ask(Number(button.dataset.figure)));
    box().addEventListener("change", () => ask(current));
    place("open").addEventListener("click", () => open(""));
    for (const button of document.querySelectorAll("[data-open]")) button.addEventListener("click", () => open(button.dataset.open));
    place("download").addEventListener("change", ({ target }) => {
      if (target.value) page.send({ type: "export", number: current, floquet: box().checked && shown?.has_floquet === true, format: target.value, at: page.here() });
      target.value = "";
    });
    for (const select of document.querySelectorAll("select.export")) {
      select.addEventListener("change", () => {
        if (select.value) page.send({ type: "export", chart: select.dataset.chart, format: select.value, at: page.here() });
        select.value = "";
      });
    }
  }, { once: true });

  return {
    // the page has come into view
    visit() {
      fromAddress();
      ask(current || FIRST);
    },
    answer(data) {
      const { figure } = data;
      // a figure with Floquet may arrive after the user has chosen another one
      if (figure && figure.number === current && (figure.floquet === box().checked || !figure.has_floquet)) {
        if (data.figure_made) request(); else show(figure);
      }
      if (data.table_1) place("table").replaceChildren(...data.table_1.map((cells) => row(cells, 1)));
      if (data.not_drawn) problem(data.not_drawn);
      if (data.file) save(data.file);
    },
  };
})();
