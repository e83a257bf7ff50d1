// The sidebar: sliders with number boxes, choices, presets.

export function render({ model, el }) {
  const spec = model.spec;
  const state = { values: {} };
  const rows = {};
  const page = window.rotorstab;

  // -- answers of the server ---------------------------------------------
  function show(data) {
    if (data.values) for (const [name, row] of Object.entries(rows)) {
      const error = data.errors?.[name] || "";
      // an error message stays until the value is typed again or changes
      if (error || data.replaced || data.values[name] !== state.values[name]) row.say(error);
      row.show(data.values[name]);
    }
    if (data.values) {
      state.values = data.values;
      form.dataset.page = data.page;
      for (const [row, name, value] of conditional) row.hidden = data.values[name] !== value;
    }
    if (data.own) for (const [name, row] of Object.entries(rows)) if (name in data.own.inputs) row.units(data.own.inputs[name]);
    if (data.si !== undefined) for (const [name, row] of Object.entries(rows)) row.units?.(data.si?.inputs[name]);
  }
  model.on("msg:custom", (answer) => page.messages.take(answer.data ?? answer));
  const { change } = page.messages;

  // -- pieces --------------------------------------------------------------
  function node(tag, attributes, ...children) {
    const made = document.createElement(tag);
    for (const [key, value] of Object.entries(attributes || {})) made.setAttribute(key, value);
    made.append(...children);
    return made;
  }

  function symbol(text) {
    // "α_s max": a letter, its subscript, the rest
    const [, letter, sub, rest] = text.match(/^([^_]+?)(?:_(\S+))?( .*)?$/);
    return node("b", {}, letter, ...(sub ? [node("sub", {}, sub)] : []), rest || "");
  }

  // the symbol, or the name where there is none, is a button that explains the quantity
  function heading(field, id) {
    const help = node("span", { class: "help", id: `${id}-help`, role: "tooltip" }, node("b", {}, field.label), " ", ...page.rich(field.doc));
    const mark = node("button", { class: "why", type: "button", "aria-label": `What is ${field.label}?`, "aria-describedby": `${id}-help` },
      field.symbol ? symbol(field.symbol) : "?");
    const label = node("label", { for: id, id: `${id}-label`, ...(field.symbol ? { class: "hidden" } : {}) }, field.label);
    return [label, mark, help];
  }

  function text(value, step) {
    const digits = Math.min(6, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
    // a value between two steps (from a preset) is shown with all digits that it needs
    const short = value.toFixed(digits);
    return Math.abs(short - value) < 1e-9 ? short : String(Number(value.toPrecision(6)));
  }

  // the nearest of 1, 2, 5, 10, 20 …
  function round(value) {
    const power = 10 ** Math.floor(Math.log10(value));
    return power * [1, 2, 5, 10].reduce((best, one) => (Math.abs(one - value / power) < Math.abs(best - value / power) ? one : best));
  }

  function number(field) {
    const id = `rs-${field.name}`;
    const slider = node("input", { type: "range", id, min: field.low, max: field.high, step: "any", "aria-describedby": `${id}-help` });
    const box = node("input", { type: "text", inputmode: "decimal", class: "box", autocomplete: "off", "aria-label": `${field.label}, number`, "aria-describedby": `${id}-error` });
    const error = node("p", { class: "error", id: `${id}-error`, role: "alert" });
    const unit = node("span", { class: "unit" });
    let si = null; // the factor and the unit while the page shows SI units; the slider itself has none
    const step = () => (si ? round(field.step * si.factor) / si.factor : field.step);
    const words = (value) => (si ? String(Number((value * si.factor).toPrecision(4))) : text(value, field.step));
    const say = (problem) => {
      error.textContent = problem ? `${field.label} ${problem}` : "";
      page.flag(box, problem);
    };
    const fill = (value) => {
      slider.style.setProperty("--fill", `${100 * (value - field.low) / (field.high - field.low)}%`);
      slider.setAttribute("aria-valuetext", `${words(value)} ${si?.unit ?? ""}`.trim());
    };
    const show = (value) => {
      if (document.activeElement !== slider && el.getRootNode().activeElement !== slider) slider.value = value;
      if (!error.textContent && el.getRootNode().activeElement !== box) box.value = words(value);
      fill(value);
    };
    const snap = (value) => Math.min(field.high, Math.max(field.low, Number((Math.round(value / step()) * step()).toPrecision(12))));
    slider.addEventListener("input", () => {
      const value = snap(slider.valueAsNumber);
      box.value = words(value);
      fill(value);
      say("");
      change(field.name, value);
    });
    // a finger that scrolls the page may begin on a slider and move it: restore the value
    let touched = null;
    slider.addEventListener("pointerdown", (event) => { touched = event.pointerType === "touch" ? slider.value : null; });
    slider.addEventListener("pointercancel", () => {
      if (touched === null) return;
      slider.value = touched;
      slider.dispatchEvent(new Event("input"));
    });
    slider.addEventListener("keydown", (event) => {
      const page = { PageUp: 10, PageDown: -10, ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }[event.key];
      if (!page) return;
      event.preventDefault();
      slider.value = snap(slider.valueAsNumber + page * step());
      slider.dispatchEvent(new Event("input"));
    });
    const commit = () => {
      const typed = page.typed(box.value);
      let value = typed.value / (si?.factor ?? 1);
      // a bound or a value that is typed as it is shown, rounded, means itself
      for (const exact of [field.low, field.high, state.values[field.name]]) if (si && words(value) === words(exact)) value = exact;
      if (!(value >= field.low && value <= field.high)) {
        const [low, high] = [field.low, field.high].map((end) => (si ? words(end) : end));
        say(typed.doubt || `must be a number from ${low} to ${high} ${si?.unit ?? ""}`.trim());
        return;
      }
      say("");
      if (value === state.values[field.name]) { box.value = words(value); return; }
      slider.value = value;
      fill(value);
      change(field.name, value);
    };
    box.addEventListener("change", commit);
    box.addEventListener("keydown", (event) => {
      if (event.key === "Enter") commit();
      if (event.key === "Escape") { box.value = words(state.values[field.name]); say(""); }
    });
    const parts = heading(field, id);
    const row = node("div", { class: "row line" }, ...parts, slider, box, unit, error);
    const units = (found) => {
      if (JSON.stringify(found ?? null) === JSON.stringify(si)) return;
      si = found ?? null;
      unit.textContent = si?.unit ?? "";
      row.classList.toggle("si", Boolean(si));
      parts[1].replaceChildren(symbol(si?.symbol ?? field.symbol));
      if (field.name in state.values) show(state.values[field.name]);
    };
    rows[field.name] = { show, say, units };
    return row;
  }

  function choice(field) {
    const id = `rs-${field.name}`;
    const error = node("p", { class: "error", role: "alert" });
    const group = node("div", { class: "choice", role: "radiogroup", "aria-labelledby": `${id}-label`, "aria-describedby": `${id}-help` });
    const inputs = field.options.map(([value, words], index) => {
      const input = node("input", { type: "radio", name: id, value, ...(index ? {} : { id }) });
      input.addEventListener("change", () => { rows[field.name].say(""); change(field.name, value); });
      group.append(node("label", {}, input, node("span", {}, words)));
      return input;
    });
    rows[field.name] = {
      show: (value) => inputs.forEach((input) => { input.checked = input.value === value; }),
      say: (words) => { error.textContent = words ? `${field.label} ${words}` : ""; },
    };
    return node("div", { class: "row choices" }, ...heading(field, id), group, error);
  }

  function toggle(field) {
    const id = `rs-${field.name}`;
    const input = node("input", { type: "checkbox", id, "aria-describedby": `${id}-help` });
    input.addEventListener("change", () => change(field.name, input.checked));
    rows[field.name] = { show: (value) => { input.checked = value; }, say: () => {} };
    return node("div", { class: "row switch" }, input, ...heading(field, id));
  }

  // a quantity in SI has a box without a slider, because its range spans orders of magnitude
  function quantity(field) {
    const id = `rs-${field.name}`;
    const box = node("input", { type: "text", inputmode: "decimal", class: "box", id, autocomplete: "off", "aria-describedby": `${id}-help ${id}-error` });
    const error = node("p", { class: "error", id: `${id}-error`, role: "alert" });
    const say = (words) => {
      error.textContent = words ? `${field.label} ${words}` : "";
      page.flag(box, words);
    };
    const show = (value) => { if (!error.textContent && el.getRootNode().activeElement !== box) box.value = String(Number(value.toPrecision(9))); };
    const commit = () => {
      const { value, doubt } = page.typed(box.value);
      if (!(value >= field.low && value <= field.high)) {
        say(doubt || `must be a number from ${field.low} to ${field.high} ${field.unit}`.trim());
        return;
      }
      say("");
      // the box shows a rounded value
      if (value !== Number(state.values[field.name].toPrecision(9))) change(field.name, value);
    };
    box.addEventListener("change", commit);
    box.addEventListener("keydown", (event) => {
      if (event.key === "Enter") commit();
      if (event.key === "Escape") { box.value = String(Number(state.values[field.name].toPrecision(9))); say(""); }
    });
    rows[field.name] = { show, say };
    return node("div", { class: "row line quantity" }, ...heading(field, id), node("span", { class: "name" }, field.label), box, node("span", { class: "unit" }, field.unit), error);
  }

  // -- assembly ------------------------------------------------------------
  const form = node("form", { class: "controls", "aria-label": "Parameters" });
  form.addEventListener("submit", (event) => event.preventDefault());
  const presets = node("select", { id: "rs-preset", class: "preset" }, node("option", { value: "" }, "Presets …"),
    ...model.presets.map((name) => node("option", { value: name }, name)));
  presets.addEventListener("change", () => {
    if (presets.value) page.send({ type: "preset", name: presets.value });
    presets.value = "";
  });
  const reset = node("button", { type: "button", class: "plain" }, "Reset all");
  reset.addEventListener("click", () => page.send({ type: "reset" }));
  form.append(node("div", { class: "row presets" }, node("label", { for: "rs-preset", class: "hidden" }, "Presets"), presets, reset));
  // on a narrow screen the sheet shows the sliders that the user has chosen
  const CHOSEN = "rotorstab-sliders";
  const chosen = new Set(["static_load_factor", "spin_speed"]);
  try {
    const found = JSON.parse(localStorage.getItem(CHOSEN));
    if (Array.isArray(found)) { chosen.clear(); for (const name of found) chosen.add(name); }
  } catch { /* private window, or nothing stored */ }
  function chooser(fields, row) {
    const buttons = fields.map((field) => {
      const button = node("button", { type: "button", "aria-label": field.label, title: field.label }, symbol(field.symbol));
      const show = () => {
        button.setAttribute("aria-pressed", String(chosen.has(field.name)));
        row(field.name).classList.toggle("unchosen", !chosen.has(field.name));
      };
      button.addEventListener("click", () => {
        if (!chosen.delete(field.name)) chosen.add(field.name);
        try { localStorage.setItem(CHOSEN, JSON.stringify([...chosen])); } catch { /* private window */ }
        show();
      });
      show();
      return button;
    });
    return node("div", { class: "chooser", role: "group", "aria-label": "Sliders in view" }, ...buttons);
  }

  const conditional = []; // rows that are shown only while another input has a value
  const main = new Map(); // rows of the group that is always in view
  for (const group of spec) {
    const set = group.page
      ? node("div", { class: "of-page", "data-of": group.page })
      : group.title
      ? node("details", { class: "group", ...(group.open ? { open: "" } : {}) }, node("summary", {}, group.title))
      : node("div", { class: "main" });
    for (const field of group.fields) {
      const row = field.name === "own_rotor" ? page.rotor.panel(node, field, rows) : field.switch ? toggle(field) : field.options ? choice(field) : field.unit !== undefined ? quantity(field) : number(field);
      row.dataset.input = field.name;
      if (field.only_with) conditional.push([row, ...field.only_with]);
      if (!group.title) main.set(field.name, row);
      set.append(row);
    }
    if (!group.title) {
      const sliders = group.fields.filter((field) => !field.options && !field.only_with);
      main.get(sliders[0].name).before(chooser(sliders, (name) => main.get(name)));
    }
    if (group.title === "Units") set.append(page.units.panel(node));
    form.append(set);
  }

  page.messages.attach((message) => model.send_msg(message), show);
  return form;
}
