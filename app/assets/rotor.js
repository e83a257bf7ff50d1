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

  function answer(data) {
    if (data.own_opening) { say(""); opening.textContent = `Reading ${data.own_opening} …`; }
    if (data.own_opened) {
      opening.textContent = "";
      say(data.own_opened.problem && `${data.own_opened.problem}. Nothing was changed.`);
      // the charts of a large rotor come with the answer to this message
      if (!data.own_opened.problem && !data.own) page.send({ type: "own_shown" });
    }
    if (data.replaced) say("");
    if (!data.own) return;
    const { sentence, source, notes, facts, point, waits } = data.own;
    place("sentence").replaceChildren(...page.rich(sentence));
    place("sentence").setAttribute("aria-busy", String(waits));
    place("source").textContent = source;
    place("notes").hidden = !notes.length;
    place("notes").textContent = notes.length > 1 ? `Not as in the file: ${notes.join("; ")}.` : notes.join("");
    place("facts").replaceChildren(...page.facts(facts));
    place("point").replaceChildren(...page.facts(point));
    if (!watching) { watching = true; watch(); }
    requestAnimationFrame(fit);
  }

  return { panel, answer, tap };
})();
