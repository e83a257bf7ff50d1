// Units: the panel below the data of the shaft in the sidebar, rotor files, and clicks on charts in SI.
window.rotorstab.units = (() => {
  const page = window.rotorstab;
  const LARGEST = 8000; // bytes, the same limit as on the server
  let factors = {};
  let parts = null;

  function say(words) {
    if (!parts) return;
    parts.error.textContent = words;
    if (words) parts.error.scrollIntoView({ block: "nearest" });
  }

  async function open(file) {
    if (!file) return;
    if (file.size > LARGEST) { say(`${file.name} is larger than ${LARGEST / 1000} kB: nothing was changed`); return; }
    try { page.send({ type: "rotor_file", text: await file.text() }); }
    catch { say(`${file.name} could not be read: nothing was changed`); }
  }

  function panel(node) {
    const words = node("p", { class: "shaft-words", "aria-live": "polite" });
    const use = node("button", { type: "button", class: "plain" }, "Use this shaft");
    const load = node("button", { type: "button", class: "plain" }, "Open rotor file …");
    const save = node("button", { type: "button", class: "plain" }, "Save rotor file");
    const file = node("input", { type: "file", accept: ".toml,application/toml,text/plain", hidden: "", "aria-label": "Rotor file" });
    const error = node("p", { class: "error", role: "alert" });
    use.addEventListener("click", () => page.send({ type: "use_shaft" }));
    load.addEventListener("click", () => file.click());
    file.addEventListener("change", () => { open(file.files[0]); file.value = ""; });
    save.addEventListener("click", () => page.send({ type: "save_rotor_file" }));
    parts = { words, use, error };
    return node("div", { class: "row shaft-panel" }, words, use, node("div", { class: "two" }, load, save), file, error);
  }

  function answer(data) {
    if (data.shaft && parts) {
      const { words, in_use, good } = data.shaft;
      if (parts.words.dataset.text !== words) {
        parts.words.dataset.text = words;
        parts.words.replaceChildren(...page.rich(words));
      }
      parts.use.disabled = in_use || !good;
    }
    if (data.shaft_error !== undefined) say(data.shaft_error && `${data.shaft_error}. Nothing was changed.`);
    if (data.shaft_notice) say(data.shaft_notice);
    if (data.values) document.documentElement.dataset.units = data.values.units;
    if (data.si !== undefined) factors = data.si ? data.si.factors : {};
  }

  // convert a position on a chart to the non-dimensional numbers of the marker
  function plain(key, x, y) {
    const [fx, fy] = factors[key] || [1, 1];
    return [x / fx, y / fy];
  }

  // and the numbers of the marker to a position on a chart
  function shown(key, x, y) {
    const [fx, fy] = factors[key] || [1, 1];
    return [x * fx, y * fy];
  }

  return { panel, answer, plain, shown };
})();
