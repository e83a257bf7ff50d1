// The page outside the charts: theme, drawer, key numbers, notices.
(() => {
  const root = document.documentElement;
  const page = window.rotorstab;
  const seen = new Set();

  // -- theme: the stored choice or that of the system; the charts follow it ----------------
  const stored = (() => { try { return localStorage.getItem("rotorstab-theme"); } catch { return null; } })();
  const system = window.matchMedia("(prefers-color-scheme: dark)");
  root.dataset.theme = stored || (system.matches ? "dark" : "light");

  function token(name) { return getComputedStyle(root).getPropertyValue(name).trim(); }

  const coarse = window.matchMedia("(pointer: coarse)");
  const freed = new WeakSet();

  // while a lesson asks for a prediction, the hover texts and the names of tongues and of critical loads are hidden
  const VEILED = ["tongue", "limit"];
  function veilNames(figure, quiet) {
    for (const names of figure.renderers.filter((one) => VEILED.includes(one.name))) {
      names.glyph.setv({ text_alpha: { value: page.veiled ? 0 : 1 }, background_fill_alpha: { value: page.veiled ? 0 : 0.7 } }, quiet);
    }
    for (const tool of figure.toolbar.tools) if (tool.type === "HoverTool") tool.setv({ active: !page.veiled }, quiet);
  }

  function paintCharts() {
    if (!window.Bokeh) return;
    const ink = token("--ink"), soft = token("--soft"), grid = token("--chart-grid"), card = token("--card");
    const quiet = { sync: false };
    for (const view_document of Bokeh.documents) {
      for (const top of view_document.roots()) {
        for (const model of top.references()) {
          switch (model.type.split(".").pop()) {
            case "LinearAxis":
              model.setv({ axis_line_color: soft, major_tick_line_color: soft, major_label_text_color: soft,
                axis_label_text_color: ink }, quiet); break;
            case "ColorBar":
              model.setv({ major_label_text_color: soft, title_text_color: ink, bar_line_color: null, background_fill_color: null }, quiet); break;
            case "BoxZoomTool":
              // on a touch screen one finger scrolls the page; the zoom tool can be switched on above the chart
              if (coarse.matches && !freed.has(model)) { freed.add(model); model.setv({ active: false }, quiet); }
              break;
            case "Figure":
              if (ZOOMED.includes(model.name)) { veilNames(model, quiet); watchWindow(model); }
              // the chart of a pin shares its ranges with the present one
              if ([...ZOOMED, "comparison"].includes(model.name)) letWheelZoom(model, quiet);
              break;
            case "Grid":
              model.setv({ grid_line_color: grid }, quiet); break;
            case "Text":
              page.labelPlaces.place(model);
              // the name of a pin has the colour of its curves
              model.setv({ ...(model.text_color?.field ? {} : { text_color: { value: ink } }), background_fill_color: { value: card } }, quiet); break;
          }
        }
      }
    }
  }

  page.paintCharts = paintCharts;

  // -- zoom: the server computes the part of a chart that is seen, once the last part has been sent ----
  const ZOOMED = ["instability", "load-frequency", "campbell"];
  const WAIT = 120; // ms between two messages while a chart is zoomed or moved
  const watched = new WeakSet();
  let settling = 0;

  // pixels of the screen between the axes of the instability chart, for which the server computes it
  let told = "";
  function pixels() {
    const { width, height } = page.places.view(ZOOMED[0])?.frame.bbox ?? {};
    return width ? { width: Math.round(width * devicePixelRatio), height: Math.round(height * devicePixelRatio) } : {};
  }
  page.restMessage = () => {
    const size = pixels();
    told = JSON.stringify(size);
    return { type: "settle", ...size };
  };

  function tellWindow(figure) {
    const factors = page.last?.si?.factors?.[figure.name] ?? [1, 1];
    const [left, right] = [figure.x_range.start, figure.x_range.end].map((end) => end / factors[0]);
    const [low, high] = [figure.y_range.start, figure.y_range.end].map((end) => end / factors[1]);
    page.send({ type: "window", chart: figure.name, left, right, low, high });
    clearTimeout(settling);
    settling = setTimeout(() => page.send(page.restMessage()), 2 * WAIT);
  }

  function watchWindow(figure) {
    if (watched.has(figure)) return;
    watched.add(figure);
    let sent = 0, waiting = 0;
    const tell = () => { sent = Date.now(); tellWindow(figure); };
    const moved = () => {
      clearTimeout(waiting);
      waiting = setTimeout(tell, Math.max(0, sent + WAIT - Date.now()));
    };
    for (const range of [figure.x_range, figure.y_range]) range.change.connect(moved);
    if (figure.name !== ZOOMED[0]) return;
    let resized = 0;
    addEventListener("resize", () => {
      clearTimeout(resized);
      resized = setTimeout(() => { if (![told, "{}"].includes(JSON.stringify(pixels()))) page.send(page.restMessage()); }, 2 * WAIT);
    });
  }

  // the wheel and two fingers zoom; where the page scrolls, the wheel needs Ctrl, which a touch pad's pinch sends, too
  const oneScreen = window.matchMedia("(min-width: 76em) and (min-height: 40em)"); // as in page.css
  function letWheelZoom(figure, quiet) {
    const still = oneScreen.matches && !document.querySelector("main").classList.contains("teaching");
    const tool = figure.toolbar.tools.find((one) => one.type === "WheelZoomTool");
    tool?.setv({ active: true, modifiers: still ? {} : { ctrl: true } }, quiet);
  }
  oneScreen.addEventListener("change", () => paintCharts());

  // a chart that was created while its place changed its width hides its tools until it is laid out again
  page.relayout = () => {
    const walk = (view) => {
      if (view.model.type === "Figure") view.invalidate_layout();
      for (const child of view.children()) walk(child);
    };
    for (const view of Bokeh.index) walk(view);
  };

  page.setTheme = setTheme;
  function setTheme(name, keep) {
    root.dataset.theme = name;
    // the button names the theme that a click chooses
    document.querySelector("button.theme").textContent = name === "dark" ? "Light" : "Dark";
    if (keep) try { localStorage.setItem("rotorstab-theme", name); } catch { /* private window */ }
    paintCharts();
  }

  // show symbols such as "β_d" with a subscript; names such as spin_speed stay as they are
  function rich(text) {
    return text.split(/(?<![\p{L}\d_])(\p{L}\p{M}?_(?:\p{Ll},\p{Lu}+|[\p{L}\d]+))/u).map((part) => {
      const found = part.match(/^(\p{L}\p{M}?)_([\p{L}\d,]+)$/u);
      if (!found) return part;
      const symbol = document.createElement("span");
      symbol.className = "symbol";
      const sub = document.createElement("sub");
      sub.textContent = found[2];
      symbol.append(found[1], sub);
      return symbol;
    });
  }
  page.rich = rich;

  // -- numbers ---------------------------------------------------------------
  function number(value, digits = 5) {
    if (value === null || value === undefined) return "none";
    return grouped(value.toPrecision(digits));
  }
  // beside a chart there is room for fewer digits than in the table
  const digits = (place) => (place.tagName === "B" ? 3 : 5);

  // the same format as `written` of the server: no exponent below 1e9
  function grouped(text) {
    const [mantissa, power] = (Math.abs(Number(text)) < 1e9 && text.includes("e+") ? String(Number(text)) : text).split("e");
    const [whole, part] = mantissa.split(".");
    const spaced = Math.abs(Number(mantissa)) < 1e4 ? whole : whole.replace(/\B(?=(\d{3})+$)/g, "\u202f");
    const raised = power === undefined ? "" : ` × 10${[...String(Number(power))].map((one) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(one)]).join("")}`;
    return `${spaced}${part ? `.${part}` : ""}${raised}`.replace("-", "−");
  }
  page.written = (value, digits = 4) => grouped(String(Number(value.toPrecision(digits))));

  // ARIA treats an empty value as false, so the attribute is removed
  page.flag = (box, wrong) => (wrong ? box.setAttribute("aria-invalid", "true") : box.removeAttribute("aria-invalid"));

  // read a typed number by the rules of app/reading/numbers.py; return { value }, or { doubt } with a message
  const TYPED = new RegExp(`^[+-]?(?:${[
    "\\d{1,3}(?:[ \u00a0\u2009\u202f'’_]\\d{3})+(?:[.,]\\d*)?", "\\d{1,3}(?:,\\d{3})+\\.\\d*", "\\d{1,3}(?:\\.\\d{3})+,\\d*",
    "\\d{1,3}(?:,\\d{3}){2,}", "\\d{1,3}(?:\\.\\d{3}){2,}", "\\d+(?:[.,]\\d*)?", "[.,]\\d+",
  ].join("|")})(?:[eE][+-]?\\d{1,3})?$`);
  page.typed = (text) => {
    let plain = text.trim().replaceAll("−", "-");
    if (!TYPED.test(plain)) return { value: NaN };
    if (/^[+-]?[1-9]\d{0,2},\d{3}(?:[eE][+-]?\d+)?$/.test(plain)) {
      const [one, other] = [".", ""].map((sign) => Number(plain.replace(",", sign)));
      return { doubt: `was typed as ${plain}, which can mean ${one} or ${other}: write one of them` };
    }
    plain = plain.replace(/[ \u00a0\u2009\u202f'’_]/g, "");
    const count = (sign) => plain.split(sign).length - 1;
    const last = plain[Math.max(plain.lastIndexOf("."), plain.lastIndexOf(","))];
    // a sign that occurs more than once, or not last, separates thousands
    const group = count(".") > 1 ? "." : count(",") > 1 ? "," : count(".") && count(",") ? (last === "." ? "," : ".") : "";
    if (group) plain = plain.replaceAll(group, "");
    return { value: Number(plain.replace(",", ".")) };
  };

  function small(words, kind = "") {
    const made = document.createElement("small");
    made.className = kind;
    made.textContent = words;
    return made;
  }

  // the imaginary part of a whirl that neither grows nor decays is 0
  const word = (imaginary) => (imaginary < 0 ? "grows" : "decays");

  // in SI, loads are in N or kN, frequencies in Hz, and growth or decay is per second
  function showNumbersInSI({ numbers, load_unit }) {
    for (const place of document.querySelectorAll("[data-number]")) {
      const value = numbers[place.dataset.number];
      place.textContent = number(value, digits(place));
      if (value !== null) place.append(small(place.dataset.number === "fundamental" ? "\u00a0Hz" : `\u00a0${load_unit}`));
    }
    for (const place of document.querySelectorAll("[data-whirl]")) {
      const [real, imaginary] = numbers.whirl[place.dataset.whirl];
      place.replaceChildren(number(real, digits(place)), ...(place.tagName === "B" ? [] : [small("\u00a0Hz")]));
      if (imaginary !== 0) place.append(small(` ${word(imaginary)} ${page.written(Math.abs(imaginary), 3)}/s`, "complex"));
    }
  }

  function showNumbers(numbers) {
    for (const place of document.querySelectorAll("[data-number]")) place.textContent = number(numbers[place.dataset.number], digits(place));
    for (const place of document.querySelectorAll("[data-whirl]")) {
      const [real, imaginary] = numbers.whirl[place.dataset.whirl];
      place.textContent = number(real, digits(place));
      if (imaginary !== 0) place.append(small(` ${word(imaginary)} ${number(Math.abs(imaginary))}`, "complex"));
    }
    page.rigid = numbers.rigid;
  }

  // -- a place with changing text keeps its largest height, so that the charts do not move ----------
  function steady(place) {
    const { width } = place.getBoundingClientRect();
    if (!width) return;
    if (place.dataset.width !== String(width)) {
      place.style.minHeight = "";
      place.dataset.width = String(width);
    }
    place.style.minHeight = `${Math.max(parseFloat(place.style.minHeight) || 0, place.getBoundingClientRect().height)}px`;
  }
  page.steady = steady;

  // -- layers of the instability chart, which the legend switches ----
  const LAYERS = ["show_growth", "show_bolotin", "show_disagreement"];
  function showLayers(values) {
    for (const name of LAYERS) root.dataset[name] = String(values[name]);
    for (const entry of document.querySelectorAll("[data-layer]")) {
      const on = values[entry.dataset.layer];
      entry.classList.toggle("off", !on);
      entry.querySelector("button")?.setAttribute("aria-pressed", String(on));
    }
  }

  // the legend shows only the load–frequency curves that are drawn
  function showCurves(drawn) {
    for (const entry of document.querySelectorAll("[data-curve]")) entry.hidden = !drawn.includes(entry.dataset.curve);
  }

  // -- the range of the instability chart, and the scale of its colours ----
  const USUAL = [0, 6], WHOLE = [0, 16]; // θ/ω_n
  function showRange({ lowest_frequency, highest_frequency }) {
    const whole = lowest_frequency === WHOLE[0] && highest_frequency === WHOLE[1];
    document.querySelector("button.whole-range").textContent = whole ? `θ/ωₙ to ${USUAL[1]}` : "Whole range";
  }

  function showGrowthUnit({ growth_unit, units }) {
    const unit = document.querySelector("[data-growth-unit]");
    if (units === "SI") unit.textContent = growth_unit === "per period" ? "σT" : "σ [1/s]";
    else unit.textContent = growth_unit === "per period" ? "σ̄T" : "σ̄";
  }

  // a row of the answer holds the loads of one coefficient; in the table it is a column
  function showErrors(coefficients) {
    coefficients.forEach((loads, column) => loads.forEach((value, row) => {
      const cells = document.querySelectorAll(`[data-error="${row}"]`);
      cells[column].textContent = value === null ? "—" : number(value, 4);
    }));
  }

  // -- pages: the hash of the address names the visible page -------------------------
  function visit() {
    const sections = [...document.querySelectorAll("[data-page]")];
    const [wanted] = location.hash.slice(1).split("/"); // behind it follows a choice of the page
    const chosen = sections.find((section) => section.dataset.page === wanted) || sections[0];
    for (const section of sections) section.hidden = section !== chosen;
    mark();
    if (!page.send) return;
    page.send({ type: "page", name: chosen.dataset.page });
    if (chosen.dataset.page === "paper") page.paper.visit();
  }

  // the current entry of the menu: a running lesson counts as Lessons, although it shows the charts of Explore
  function mark() {
    const shown = document.querySelector("[data-page]:not([hidden])").dataset.page;
    const lesson = location.hash.startsWith("#lesson/") || (shown === "explore" && page.lessons?.running);
    for (const link of document.querySelectorAll("nav a")) {
      if (link.hash.slice(1) === (lesson ? "lessons" : shown)) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    }
  }
  page.mark = mark;

  // -- short messages that disappear after some seconds -----------------------------------
  let telling = 0;
  function tell(words) {
    // an open dialog covers the page, so it has its own place for messages
    const place = document.querySelector(dialog().open ? "dialog .dialog-toast" : ".toast");
    hush();
    place.textContent = words;
    place.hidden = !words;
    if (place.closest("dialog") === null) telling = setTimeout(hush, 6000);
  }
  function hush() {
    clearTimeout(telling);
    for (const place of document.querySelectorAll(".toast, .dialog-toast")) place.hidden = true;
  }

  // -- copying: where the browser does not allow it, the text is selected in a dialog ----
  const dialog = () => document.querySelector("dialog.code");
  let files = {}; // of the text in the dialog, by their ending
  const MIMES = { py: "text/x-python", ipynb: "application/x-ipynb+json" };
  function offer(title, text, found = {}) {
    files = found;
    for (const button of dialog().querySelectorAll("[data-get]")) button.hidden = !(button.dataset.get in files);
    dialog().querySelector("h2").textContent = title;
    dialog().querySelector("code").textContent = text;
    dialog().classList.toggle("link", title.startsWith("Link"));
    hush();
    if (!dialog().open) dialog().showModal();
  }

  async function copy(text, what) {
    try {
      await navigator.clipboard.writeText(text); // there is no clipboard without https
      tell(`${what} has been copied.`);
      return true;
    } catch { return false; }
  }

  function copySelected(what) {
    getSelection().selectAllChildren(dialog().querySelector("code"));
    const done = document.execCommand("copy");
    tell(done ? `${what} has been copied.` : `${what} is selected: copy it with Ctrl+C (⌘C on a Mac; on a touch screen, press and hold it).`);
  }

  // -- saving: the browser's own download -----------------------------------------------
  page.save = (name, blob) => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  };

  // -- the address: the state of the last answer, and the page in view --------------
  page.address = () => page.history.address();
  // the page's own address, which files give with the query of the view
  page.here = () => location.origin + location.pathname;

  function fill(selector, words) {
    const place = document.querySelector(selector);
    if (place.dataset.text === words) return;
    place.dataset.text = words;
    place.replaceChildren(...rich(words));
  }

  // -- the table of tongues and the shares of the window, behind "Details" -------------
  function cells(tag, texts) {
    const row = document.createElement("tr");
    row.append(...texts.map((text) => {
      const cell = document.createElement(tag);
      cell.append(...rich(text));
      return cell;
    }));
    return row;
  }

  let detailed = "";
  function showDetails(details) {
    const key = JSON.stringify(details);
    if (key === detailed) return;
    detailed = key;
    document.querySelector('[data-tongues="heads"]').replaceChildren(cells("th", details.columns));
    const rows = details.rows.length ? details.rows : [["none"]];
    document.querySelector('[data-tongues="rows"]').replaceChildren(...rows.map((texts) => cells("td", texts)));
    fill('[data-details="words"]', details.words);
    const shares = details.shares.length ? details.shares : [["They follow once the sliders rest.", ""]];
    document.querySelector('[data-details="shares"]').replaceChildren(...page.facts(shares));
  }

  page.answer = (data) => {
    if (data.numbers) showNumbers(data.numbers);
    if (data.si) showNumbersInSI(data.si);
    if (data.details) showDetails(data.details);
    if (data.errors_table) showErrors(data.errors_table);
    page.paper.answer(data);
    page.lessons.answer(data);
    page.inspector.answer(data);
    page.units.answer(data);
    page.rotor.answer(data);
    if (data.python) offer("This view as Python", data.python.py, data.python);
    if (data.toast !== undefined) tell(data.toast);
    page.history.answer(data);
    if (!data.values) return;
    const notes = [data.notice, data.address_notice, page.rigid !== false ? "" : "No rigid body has Ī_P > 2 Ī_D: such a disk cannot exist."].filter(Boolean);
    const notice = document.querySelector(".notice");
    notice.hidden = !notes.length;
    notice.replaceChildren(...rich(notes.join(" ")));
    showLayers(data.values);
    showGrowthUnit(data.values);
    showRange(data.values);
    if (data.colours_fitted !== undefined) document.querySelector("button.fit-colours").setAttribute("aria-pressed", String(data.colours_fitted));
    if (data.curves) showCurves(data.curves);
    page.last = data;
    if (!seen.has(data.page)) {
      // the charts have just been created; the address may name another page than the first
      seen.add(data.page);
      document.querySelector(`[data-page="${data.page}"]`).setAttribute("aria-busy", "false");
      for (const delay of [0, 60, 400]) setTimeout(paintCharts, delay);
      if (!page.painted) { page.painted = true; if (location.hash.length > 1) visit(); }
    }
  };

  document.addEventListener("DOMContentLoaded", () => {
    document.querySelector("button.share").addEventListener("click", async () => {
      page.address();
      if (await copy(location.href, "The link")) return;
      offer("Link to this view", location.href);
      copySelected("The link");
    });
    for (const entry of document.querySelectorAll("[data-layer]")) {
      const name = entry.dataset.layer;
      entry.querySelector("button")?.addEventListener("click", () => page.change(name, root.dataset[name] !== "true"));
    }
    showLayers(Object.fromEntries(LAYERS.map((name) => [name, root.dataset[name] !== "false"])));
    showGrowthUnit(root.dataset);
    document.querySelector("button.python").addEventListener("click", () => page.send({ type: "python" }));
    document.querySelector("button.report").addEventListener("click", () => page.send({ type: "report", at: page.here() }));
    for (const button of document.querySelectorAll("[data-picture]")) {
      button.addEventListener("click", () => page.send({ type: "picture", format: button.dataset.picture, at: page.here() }));
    }
    for (const button of dialog().querySelectorAll("[data-get]")) {
      const kind = button.dataset.get;
      button.addEventListener("click", () => page.save(`rotorstab-view.${kind}`, new Blob([files[kind]], { type: MIMES[kind] })));
    }
    dialog().querySelector(".shut").addEventListener("click", () => dialog().close());
    dialog().querySelector(".copy").addEventListener("click", async () => {
      if (!await copy(dialog().querySelector("code").textContent, "The text")) copySelected("The text");
    });
    for (const more of document.querySelectorAll("details.more")) {
      more.addEventListener("click", (event) => { if (event.target.tagName === "BUTTON") more.open = false; });
      document.addEventListener("click", (event) => { if (!more.contains(event.target)) more.open = false; });
    }
    document.querySelector("button.view").addEventListener("click", () => page.send({ type: "view" }));
    document.querySelector("button.whole-range").addEventListener("click", () => {
      const [low, high] = page.last?.values.highest_frequency === WHOLE[1] ? USUAL : WHOLE;
      page.change("lowest_frequency", low);
      page.change("highest_frequency", high);
      page.send({ type: "view" });
    });
    document.querySelector("button.fit-colours").addEventListener("click", (event) =>
      page.send({ type: "colours", fit: event.currentTarget.getAttribute("aria-pressed") !== "true" }));
    document.querySelector("button.theme").addEventListener("click", () => setTheme(root.dataset.theme === "dark" ? "light" : "dark", true));
    window.addEventListener("popstate", visit); // fires for a change of the hash and for Back to another query
    visit();
    setTheme(root.dataset.theme, false);
    // es-module-shims fires the event a second time
  }, { once: true });
})();
