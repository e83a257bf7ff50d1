// The panel of the marked point, its marks that follow the motion, and the pins.
window.rotorstab.inspector = (() => {
  const page = window.rotorstab;
  const one = (selector) => document.querySelector(selector);
  const every = (selector) => [...document.querySelectorAll(selector)];
  const BOUNDS = { seed: [0, 999], periods: [0, 400] };
  const NAMES = { seed: "The seed", periods: "The number of periods" };
  const values = {};
  let asked = false, painted = false;

  function commit(box, name) {
    // an empty box lets the page choose the number of periods
    const { value, doubt } = name === "periods" && !box.value.trim() ? { value: 0 } : page.typed(box.value);
    const [low, high] = BOUNDS[name];
    const good = value >= low && value <= high;
    page.flag(box, !good);
    one(".inspector-error").textContent = good ? "" : `${NAMES[name]} ${doubt || `must be a number from ${low} to ${high}`}`;
    if (good) page.change(name, Math.round(value));
  }

  function showInputs() {
    for (const box of every("[data-input]")) {
      const value = values[box.dataset.input];
      if (document.activeElement !== box) box.value = box.dataset.input === "periods" && value === 0 ? "" : String(value);
    }
    one("[data-noise]").hidden = values.initial !== "noise";
  }

  page.facts = (rows) => rows.map(([name, value]) => {
    const [pair, term, text] = ["div", "dt", "dd"].map((tag) => document.createElement(tag));
    term.append(...page.rich(name));
    text.textContent = value;
    pair.append(term, text);
    return pair;
  });

  const swatch = (number) => one(".pin-strokes").content.children[number - 1].cloneNode(true);

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
    const beside = one(".pin-beside");
    if (beside.dataset.key !== key) {
      beside.dataset.key = key;
      beside.replaceChildren(new Option("off", "none"), ...pins.names.map(({ name, number }) => new Option(name, `pin ${number}`)));
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

  // -- the chart of a pin beside the present one ----------------------------------------------
  let paired = false;
  // colours and tools are set once the chart has been laid out
  function dress() {
    if (paired && !page.places.view("comparison")) { setTimeout(dress, 60); return; }
    page.paintCharts();
    page.relayout();
  }
  function showPair(titles) {
    const both = Boolean(titles);
    one(".pair").classList.toggle("both", both);
    for (const part of every("[data-side]")) {
      part.hidden = !both;
      if (both && part.dataset.side !== "chart") write(part, titles[part.dataset.side]);
    }
    if (both === paired) return;
    paired = both;
    dress();
  }

  document.addEventListener("DOMContentLoaded", () => {
    one(".pin-beside").addEventListener("change", ({ target }) => page.change("compared", target.value));
    for (const box of every("input[data-input]")) {
      box.addEventListener("change", () => commit(box, box.dataset.input));
      box.addEventListener("keydown", (event) => {
        if (event.key !== "Escape") return;
        box.blur();
        page.flag(box, false);
        one(".inspector-error").textContent = "";
        showInputs();
      });
    }
    one('[data-input="initial"]').addEventListener("change", (event) => page.change("initial", event.target.value));
    one(".pin-add").addEventListener("click", () => {
      const box = one(".pin-name");
      page.send({ type: "pin", label: box.value });
      box.value = "";
    });
  }, { once: true });

  // -- the cursor on the chart of the tip, and the dot on its orbit --------------------------------
  const spots = {};
  function spot(key, name, x, y) {
    const where = x !== null && page.places.holder(key);
    if (spots[key]?.parentElement !== where && where) {
      spots[key] = document.createElement("div");
      spots[key].className = name;
      where.append(spots[key]);
    }
    const shown = where && page.places.window(key);
    const inside = shown && [x, y].every((value, axis) => value === undefined || (value >= shown[axis][0] && value <= shown[axis][1]));
    if (spots[key]) spots[key].hidden = !inside;
    if (!inside) return;
    const [left, top] = page.places.pixel(key, x, y ?? shown[1][1]);
    spots[key].style.transform = `translate(${left}px, ${top}px)`;
    if (y === undefined) spots[key].style.height = `${page.places.pixel(key, x, shown[1][0])[1] - top}px`;
  }

  function cursor(now, data) {
    const at = now && now.periods * (data.seconds ?? 1);
    spot("response", "time-cursor", now ? at : null);
    const levelled = one(".shaft-level").checked; // the charts show the motion with its growth
    spot("orbit", "orbit-dot", now && !levelled ? now.v * data.edge : null, now && now.w * data.edge);
  }
  page.motion.follow(cursor);

  // what is true at the point: announced at rest, or by the handle of the marker while that has the focus
  function say({ sentence, explanation, facts }, settled) {
    for (const words of every("[data-point]")) {
      words.setAttribute("aria-live", settled && !page.marker.focused ? "polite" : "off");
      write(words, sentence);
    }
    write(one('[data-inspector="explanation"]'), explanation);
    one('[data-inspector="facts"]').replaceChildren(...page.facts(facts));
  }

  function write(where, words) {
    if (where.dataset.text === words) return;
    where.dataset.text = words;
    where.replaceChildren(...page.rich(words));
  }

  return {
    // whether the charts of the point are there, if one is marked
    get ready() { return painted || !page.last?.inspector; },
    answer(data) {
      if (data.values) {
        for (const name of ["initial", "seed", "periods"]) values[name] = data.values[name];
        showInputs();
      }
      page.marker.answer(data);
      if (data.pins !== undefined) showPins(data.pins);
      if (data.side_by_side !== undefined) {
        showPair(data.side_by_side);
        if (document.activeElement !== one(".pin-beside")) one(".pin-beside").value = data.side_by_side ? data.values.compared : "none";
      }
      if (data.inspector === undefined) return;
      const { inspector } = data;
      one(".card.inspector").classList.toggle("empty", !inspector);
      say(inspector || { sentence: "No point is marked: click the chart to mark one.", explanation: "", facts: [] }, data.settled);
      page.motion.load(inspector && inspector.motion);
      if (!inspector || painted) return;
      // the charts of the point are made after the first picture has been painted, when the page asks again
      painted = asked;
      if (asked) for (const delay of [0, 60, 400]) setTimeout(page.paintCharts, delay);
      else requestAnimationFrame(() => setTimeout(() => page.send(page.restMessage())));
      asked = true;
    },
  };
})();
