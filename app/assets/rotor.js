// Your rotor: the panel above its sliders, the words of the page, and the drawing with one scale on both axes.
window.rotorstab.rotor = (() => {
  const page = window.rotorstab;
  const LARGEST = 150000, LARGEST_MESSAGE = 240000; // bytes of a file, and characters of the message that holds it
  const KEY = "rotor-drawing";
  const place = (name) => document.querySelector(`[data-own="${name}"]`);
  let problem = null, opening = null, watching = false;

  function say(words) { if (problem) problem.textContent = words; }

  async function open(file) {
    if (!file) return;
    if (file.size > LARGEST) { say(`${file.name} is larger than ${LARGEST / 1000} kB: nothing was changed.`); return; }
    let text;
    try { text = await file.text(); } catch { say(`${file.name} could not be read: nothing was changed.`); return; }
    if (JSON.stringify(text).length > LARGEST_MESSAGE) { say(`${file.name} is too large: nothing was changed.`); return; }
    page.send({ type: "own_file", name: file.name, text });
  }

  function panel(node, field, rows) {
    const select = node("select", { id: "rs-own_rotor", class: "preset" }, ...field.options.map(([value, words]) => node("option", { value }, words)));
    const fromFile = select.lastElementChild;
    fromFile.disabled = true; // a file is chosen by its button
    const load = node("button", { type: "button", class: "plain" }, "Open file …");
    const save = node("button", { type: "button", class: "plain" }, "Save file");
    const file = node("input", { type: "file", accept: ".toml,.json,application/toml,application/json,text/plain", hidden: "", "aria-label": "Rotor file" });
    opening = node("p", { class: "shaft-words", role: "status" });
    problem = node("p", { class: "error", role: "alert" });
    select.addEventListener("change", () => { say(""); page.change(field.name, select.value); });
    load.addEventListener("click", () => file.click());
    load.title = "A rotor file of ROSS (TOML or JSON) or of this page (TOML)";
    file.addEventListener("change", () => { open(file.files[0]); file.value = ""; });
    save.addEventListener("click", () => page.send({ type: "own_save" }));
    rows[field.name] = { show: (value) => { select.value = value; }, say: () => {} };
    return node("div", { class: "row own-panel" }, node("label", { for: "rs-own_rotor", class: "hidden" }, field.label), select,
      node("div", { class: "two" }, load, save), file, opening, problem);
  }

  // one metre is as long on both axes: the ranges grow until the whole rotor is in the frame
  function fit() {
    const view = page.places.view(KEY);
    if (!view) return;
    const { x_range: x, y_range: y } = view.model;
    const { width, height } = view.frame.bbox;
    const across = x.reset_end - x.reset_start, up = y.reset_end - y.reset_start;
    const metre = Math.max(across / width, up / height); // metres of a pixel
    for (const [range, size] of [[x, metre * width], [y, metre * height]]) {
      const middle = (range.reset_start + range.reset_end) / 2;
      const ends = { start: middle - size / 2, end: middle + size / 2 };
      if (Math.abs(range.start - ends.start) + Math.abs(range.end - ends.end) > 1e-9 * size) range.setv(ends, { sync: false });
    }
  }

  function watch() {
    if (!page.places.view(KEY)) { setTimeout(watch, 100); return; }
    page.places.watch(KEY, fit);
    fit();
  }

  // a click on the stability chart places the marked point
  function tap(x, y) {
    const inputs = page.last?.own?.inputs;
    if (!inputs) return;
    const [frequency, factor] = [x / inputs.own_frequency.factor, y / inputs.own_factor.factor];
    if (!(frequency > 0 && frequency <= 7 && factor >= 0 && factor <= 0.5)) return;
    page.change("own_frequency", Number(frequency.toFixed(4)));
    page.change("own_factor", Number(factor.toFixed(4)));
  }

  // -- tables: a cell is sent when it is left or confirmed; the answer fills all of them again ----
  let shown = "";
  const node = (tag, attributes = {}, ...children) => {
    const made = document.createElement(tag);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  };

  function cell(part, row, key, head, value, materials) {
    const attributes = { "aria-label": `${head}, row ${row + 1}`, "data-cell": `${part} ${row} ${key}` };
    const send = (found) => page.send({ type: "own_edit", part, row, key, value: found });
    if (key === "material") {
      const names = materials.includes(value) ? materials : [...materials, value];
      const select = node("select", attributes, ...names.map((name) => node("option", name === value ? { selected: "" } : {}, name)));
      select.addEventListener("change", () => send(select.value));
      return select;
    }
    const box = node("input", { ...attributes, type: "text", inputmode: "decimal", autocomplete: "off", value: String(value) });
    box.addEventListener("change", () => {
      const typed = page.typed(box.value);
      page.flag(box, !Number.isFinite(typed.value));
      if (Number.isFinite(typed.value)) send(typed.value);
      else place("edited").textContent = `${head} ${typed.doubt || "must be a number"}.`;
    });
    return box;
  }

  function rowButton(words, label, part, row, what) {
    const button = node("button", { type: "button", class: "small", "aria-label": label }, words);
    button.addEventListener("click", () => page.send({ type: "own_edit", part, row, do: what }));
    return button;
  }

  function fill(found) {
    const key = JSON.stringify(found);
    if (key === shown) return;
    shown = key;
    const focused = document.activeElement?.dataset?.cell;
    for (const table of document.querySelectorAll("[data-own-table]")) {
      const part = table.dataset.ownTable;
      const { keys, heads, rows, more } = found[part];
      const head = node("tr", {}, ...heads.map((words) => node("th", { scope: "col" }, ...page.rich(words))), node("td", {}, rowButton("+", `Add to ${part}`, part, rows.length - 1, "add")));
      const body = rows.map((values, row) => node("tr", {}, ...values.map((value, at) => node("td", {}, cell(part, row, keys[at], heads[at], value, found.material))),
        node("td", {}, rowButton("−", `Remove row ${row + 1} of ${part}`, part, row, "remove"))));
      const rest = more ? [node("tr", {}, node("td", { colspan: String(keys.length) }, `and ${more} more, which are edited in the file`))] : [];
      table.replaceChildren(node("thead", {}, head), node("tbody", {}, ...body, ...rest));
    }
    if (focused) document.querySelector(`[data-cell="${focused}"]`)?.focus();
  }

  function answer(data) {
    if (data.own_edited !== undefined) {
      place("edited").textContent = data.own_edited && `${data.own_edited}. Nothing was changed.`;
      if (data.own_edited) shown = ""; // the refused value gives way to the present one
    }
    if (data.own_opening) { say(""); opening.textContent = `Reading ${data.own_opening} …`; }
    if (data.own_opened) {
      opening.textContent = "";
      say(data.own_opened.problem && `${data.own_opened.problem}. Nothing was changed.`);
      // the charts of a large rotor come with the answer to this message
      if (!data.own_opened.problem && !data.own) page.send({ type: "own_shown" });
    }
    if (data.replaced) say("");
    if (!data.own) return;
    const { sentence, source, notes, facts, point, tables, linked, waits } = data.own;
    place("sentence").replaceChildren(...page.rich(sentence));
    place("sentence").setAttribute("aria-busy", String(waits));
    place("source").textContent = source;
    place("notes").hidden = !notes.length;
    place("notes").textContent = notes.length > 1 ? `Not as in the file: ${notes.join("; ")}.` : notes.join("");
    place("facts").replaceChildren(...page.facts(facts));
    place("point").replaceChildren(...page.facts(point));
    fill(tables);
    place("linked").textContent = linked ? "The link of this page holds the rotor." : "This rotor is too large for a link: save its file.";
    if (!watching) { watching = true; watch(); }
    requestAnimationFrame(fit);
  }

  return { panel, answer, tap };
})();
