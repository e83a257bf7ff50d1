// The marker on the instability chart, the panel of the marked point, and the pins.
window.rotorstab.inspector = (() => {
  const page = window.rotorstab;
  const one = (selector) => document.querySelector(selector);
  const every = (selector) => [...document.querySelectorAll(selector)];
  const BOUNDS = { marker_frequency: [0.05, 40], marker_factor: [0, 2], seed: [0, 999], periods: [1, 400] };
  const NAMES = { marker_frequency: "θ/ωₙ", marker_factor: "β_d", seed: "The seed", periods: "The number of periods" };
  const PIN_LOOKS = { 1: ["#7a6fd8", "3 3"], 2: ["#9a7b00", "7 3"], 3: ["#2f8f8f", "7 3 2 3"] };
  const values = {};
  let painted = false;

  const clamp = (name, value) => Math.min(BOUNDS[name][1], Math.max(BOUNDS[name][0], value));
  const shown = (name, value) => (BOUNDS[name][1] > 100 ? String(value) : String(Number(value.toFixed(4))));

  function place(frequency, factor) {
    values.marker_frequency = Number(clamp("marker_frequency", frequency).toFixed(4));
    values.marker_factor = Number(clamp("marker_factor", factor).toFixed(4));
    values.marker = true;
    say("");
    for (const name of ["marker", "marker_frequency", "marker_factor"]) page.change(name, values[name]);
    for (const box of every("[data-marker]")) box.value = shown(box.dataset.marker, values[box.dataset.marker]);
  }

  function remove() {
    values.marker = false;
    page.change("marker", false);
    one(".marker-keys").focus();
  }

  function say(words) { one(".marker-error").textContent = words; }

  function commit(box, name) {
    const { value, doubt } = page.typed(box.value);
    const [low, high] = BOUNDS[name];
    const good = value >= low && value <= high;
    page.flag(box, !good);
    if (!good) { say(`${NAMES[name]} ${doubt || `must be a number from ${low} to ${high}`}`); return; }
    say("");
    if (box.dataset.marker) place(...["marker_frequency", "marker_factor"].map((key) => (key === name ? value : values[key])));
    else page.change(name, Math.round(value));
  }

  function move(event) {
    const step = event.shiftKey ? 0.1 : 0.01;
    const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[event.key];
    if (by) {
      event.preventDefault();
      place(values.marker_frequency + by[0], values.marker_factor + by[1]);
    } else if (event.key === "Delete" && values.marker) { event.preventDefault(); remove(); }
  }

  page.facts = (rows) => rows.map(([name, value]) => {
    const [pair, term, text] = ["div", "dt", "dd"].map((tag) => document.createElement(tag));
    term.append(...page.rich(name));
    text.textContent = value;
    pair.append(term, text);
    return pair;
  });

  function swatch(number) {
    const holder = document.createElement("span");
    const [colour, dash] = PIN_LOOKS[number];
    holder.innerHTML = `<svg width="30" height="8" aria-hidden="true"><line x1="1" x2="29" y1="4" y2="4" stroke="${colour}" stroke-width="2" stroke-dasharray="${dash}"/></svg>`;
    return holder.firstChild;
  }

  function showPins(pins) {
    const card = one(".pins");
    const pinned = one("[data-pinned]");
    if (pins && pinned.hidden) card.open = true;
    pinned.hidden = !pins;
    const full = Boolean(pins && pins.full);
    const why = full ? "There are three pins already: remove one first." : "";
    Object.assign(one(".pin-add"), { disabled: full, title: why });
    one("[data-pin-full]").textContent = why;
    if (!pins) return;
    const key = JSON.stringify(pins.names);
    const list = card.querySelector("[data-pins]");
    if (list.dataset.key !== key) {
      list.dataset.key = key;
      list.replaceChildren(...pins.names.map(({ name, number }) => {
        const item = document.createElement("li");
        const button = document.createElement("button");
        button.type = "button";
        button.className = "pin-remove";
        button.textContent = "Remove";
        button.setAttribute("aria-label", `Remove ${name}`);
        button.addEventListener("click", () => { page.send({ type: "unpin", number }); one(".pin-add").focus(); });
        item.append(swatch(number), name, button);
        return item;
      }));
    }
    const line = (cells, tag) => {
      const row = document.createElement("tr");
      cells.forEach((text, index) => {
        const cell = document.createElement(index && tag === "td" ? "td" : "th");
        cell.scope = tag === "th" ? "col" : "row";
        if (cell.tagName === "TD") cell.removeAttribute("scope");
        cell.append(...page.rich(text));
        row.append(cell);
      });
      return row;
    };
    one(".pin-table thead").replaceChildren(line(["What differs", "Now", ...pins.names.map(({ name }) => name)], "th"));
    one(".pin-table tbody").replaceChildren(...(pins.rows.length ? pins.rows.map((cells) => line(cells, "td")) : [line(["Nothing differs yet: move a slider."], "td")]));
  }

  document.addEventListener("DOMContentLoaded", () => {
    for (const box of every("[data-marker], input[data-input]")) {
      const name = box.dataset.marker || box.dataset.input;
      box.addEventListener("change", () => commit(box, name));
      box.addEventListener("keydown", (event) => { if (event.key === "Escape") { box.value = shown(name, values[name]); page.flag(box, false); say(""); } });
    }
    one('[data-input="initial"]').addEventListener("change", (event) => page.change("initial", event.target.value));
    const keys = one(".marker-keys");
    keys.addEventListener("keydown", move);
    keys.addEventListener("click", () => { if (!values.marker) place(values.marker_frequency, values.marker_factor); });
    one(".marker-remove").addEventListener("click", remove);
    one(".pin-add").addEventListener("click", () => {
      const box = one(".pin-name");
      page.send({ type: "pin", label: box.value });
      box.value = "";
    });
  }, { once: true });

  // the value in SI beside each box, as in the sidebar
  function si({ hints }) {
    for (const name of ["marker_frequency", "marker_factor"]) one(`[data-marker-si="${name}"]`).textContent = `= ${hints[name]}`;
  }

  return {
    tap: (x, y) => place(...page.units.plain("instability", x, y)),
    answer(data) {
      if (data.values) {
        for (const name of ["marker", "marker_frequency", "marker_factor", "initial", "seed", "periods"]) values[name] = data.values[name];
        for (const box of every("[data-marker], [data-input]")) {
          const name = box.dataset.marker || box.dataset.input;
          if (document.activeElement !== box) box.value = box.tagName === "SELECT" ? values[name] : shown(name, values[name]);
        }
        one("[data-noise]").hidden = values.initial !== "noise";
        one(".marker-remove").hidden = !values.marker;
        const keys = one(".marker-keys");
        keys.textContent = values.marker ? "Move with arrow keys" : "Place the marker";
        keys.setAttribute("aria-pressed", String(values.marker));
      }
      if (data.si) si(data.si);
      if (data.pins !== undefined) showPins(data.pins);
      if (data.inspector === undefined) return;
      const card = one(".card.inspector");
      card.classList.toggle("empty", !data.inspector);
      const words = one("[data-point]");
      if (!data.inspector) {
        words.dataset.text = words.textContent = "Click the chart to mark a point.";
        page.shaft.stop();
        return;
      }
      words.setAttribute("aria-live", data.settled ? "polite" : "off");
      if (words.dataset.text !== data.inspector.sentence) {
        words.dataset.text = data.inspector.sentence;
        words.replaceChildren(...page.rich(data.inspector.sentence));
      }
      one('[data-inspector="facts"]').replaceChildren(...page.facts(data.inspector.facts));
      for (const place of card.querySelectorAll(".steady")) page.steady(place);
      if (data.inspector.motion) page.shaft.load(data.inspector.motion);
      if (!painted) {
        // the charts have just been created
        painted = true;
        for (const delay of [0, 60, 400]) setTimeout(page.paintCharts, delay);
      }
    },
  };
})();
