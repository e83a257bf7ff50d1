// The marker on the instability chart: a handle above the chart that is dragged or moved with the arrow keys, and its number boxes.
window.rotorstab.marker = (() => {
  const page = window.rotorstab;
  const CHART = "instability";
  const BOUNDS = { marker_frequency: [0.05, 40], marker_factor: [0, 2] };
  const NAMES = { marker_frequency: "θ/ωₙ", marker_factor: "β_d" };
  const STEPS = 100; // arrow keys that cross the window; a tenth of them with Shift
  const one = (selector) => document.querySelector(selector);
  const every = (selector) => [...document.querySelectorAll(selector)];
  const values = { marker: false, marker_frequency: 0, marker_factor: 0, marker_follows: true };
  let handle = null, grabbed = null;

  const clamp = (value, [low, high]) => Math.min(high, Math.max(low, value));
  const written = (value) => String(Number(value.toFixed(4)));
  const say = (words) => { one(".marker-error").textContent = words; };

  // a step of a lesson may hold the marker, or let it move along one axis, in the range of its slider
  function limits(name) {
    if (!page.lessons.free(name)) return [values[name], values[name]];
    const { low, high } = page.lessons.range(name) ?? { low: -Infinity, high: Infinity };
    return [Math.max(low, BOUNDS[name][0]), Math.min(high, BOUNDS[name][1])];
  }

  function place(frequency, factor) {
    if (!values.marker && !page.lessons.free("marker")) return;
    values.marker_frequency = Number(clamp(frequency, limits("marker_frequency")).toFixed(4));
    values.marker_factor = Number(clamp(factor, limits("marker_factor")).toFixed(4));
    values.marker = true;
    values.marker_follows = false;
    say("");
    for (const name of ["marker", "marker_frequency", "marker_factor", "marker_follows"]) page.change(name, values[name]);
    show();
  }

  function remove() {
    if (!page.lessons.free("marker")) return;
    page.change("marker", false);
    one(".marker-keys").focus();
  }

  // back to where the page places it by rule
  function follow() {
    for (const name of ["marker", "marker_follows"]) page.change(name, true);
  }

  function commit(box) {
    const name = box.dataset.marker;
    const { value, doubt } = page.typed(box.value);
    const [low, high] = BOUNDS[name];
    const good = value >= low && value <= high;
    page.flag(box, !good);
    if (!good) { say(`${NAMES[name]} ${doubt || `must be a number from ${low} to ${high}`}`); return; }
    const moved = { ...values, [name]: value };
    place(moved.marker_frequency, moved.marker_factor);
  }

  // -- the part of the chart that is shown, in the numbers of the marker ------------------
  function shownWindow() {
    const found = page.places.window(CHART);
    if (!found) return null;
    const [low, high] = [0, 1].map((end) => page.units.plain(CHART, found[0][end], found[1][end]));
    return [[low[0], high[0]], [low[1], high[1]]];
  }

  function step(range) {
    const size = Math.abs(range[1] - range[0]) / STEPS;
    const power = 10 ** Math.floor(Math.log10(size));
    return power * [5, 2, 1].find((digit) => digit * power <= size * (1 + 1e-9));
  }

  function key(event) {
    const shown = shownWindow();
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (event.key === "Delete") { event.preventDefault(); remove(); }
    if (!way || !shown) return;
    event.preventDefault();
    const times = event.shiftKey ? 10 : 1;
    place(...[values.marker_frequency, values.marker_factor].map((value, axis) => {
      const size = step(shown[axis]);
      if (!way[axis]) return value;
      // to the next multiple of the step
      return clamp((Math.round(value / size) + times * way[axis]) * size, shown[axis]);
    }));
  }

  // -- dragging ------------------------------------------------------------------------------
  function grab(event) {
    if (event.button) return;
    const [x, y] = page.places.pixel(CHART, ...page.units.shown(CHART, values.marker_frequency, values.marker_factor));
    const { left, top } = page.places.holder(CHART).getBoundingClientRect();
    grabbed = { offset: [event.clientX - left - x, event.clientY - top - y], start: [event.clientX, event.clientY], moved: false };
    handle.setPointerCapture(event.pointerId);
    handle.classList.add("grabbed");
    handle.focus({ preventScroll: true });
    event.preventDefault();
  }

  function drag(event) {
    if (!grabbed) return;
    const { offset, start } = grabbed;
    // a press that does not move the pointer does not move the marker
    grabbed.moved ||= Math.hypot(event.clientX - start[0], event.clientY - start[1]) > 2;
    if (!grabbed.moved) return;
    const found = page.places.value(CHART, event.clientX - offset[0], event.clientY - offset[1]);
    const shown = shownWindow();
    place(...page.units.plain(CHART, ...found).map((value, axis) => clamp(value, shown[axis])));
  }

  function release() {
    grabbed = null;
    handle.classList.remove("grabbed");
  }

  function make() {
    const where = page.places.holder(CHART);
    if (!where) return;
    handle = document.createElement("div");
    handle.className = "marker-handle";
    handle.tabIndex = 0;
    handle.setAttribute("role", "slider");
    handle.setAttribute("aria-label", "Marked point");
    handle.setAttribute("aria-describedby", "marker-keys-help");
    for (const [type, act] of Object.entries({ pointerdown: grab, pointermove: drag, pointerup: release, pointercancel: release, keydown: key })) handle.addEventListener(type, act);
    // the wheel zooms the chart under the handle, or scrolls the page
    handle.addEventListener("wheel", (event) => {
      const below = page.places.view(CHART).canvas_view.events_el;
      if (!below.dispatchEvent(new WheelEvent(event.type, event))) event.preventDefault();
    }, { passive: false });
    where.append(handle);
    page.places.watch(CHART, show);
  }

  // -- what is shown -----------------------------------------------------------------------------
  function show() {
    for (const box of every("[data-marker]")) if (document.activeElement !== box) box.value = written(values[box.dataset.marker]);
    one(".marker-remove").hidden = !values.marker;
    one(".marker-keys").hidden = values.marker;
    one(".marker-follow").disabled = values.marker && values.marker_follows;
    if (!handle) make();
    if (!handle) return;
    handle.hidden = !values.marker;
    const shown = shownWindow();
    if (!values.marker || !shown) return;
    const place = [values.marker_frequency, values.marker_factor];
    // beyond a zoomed window the handle waits at its edge
    const kept = place.map((value, axis) => clamp(value, shown[axis]));
    const [x, y] = page.places.pixel(CHART, ...page.units.shown(CHART, ...kept));
    handle.style.transform = `translate(${x}px, ${y}px)`;
    handle.classList.toggle("outside", kept.some((value, axis) => value !== place[axis]));
    const [low, high] = shown[0];
    Object.entries({ valuemin: low, valuemax: high, valuenow: kept[0] }).forEach(([name, value]) => handle.setAttribute(`aria-${name}`, written(value)));
  }

  function describe(sentence) {
    if (!handle) return;
    const words = `θ/ωₙ = ${written(values.marker_frequency)}, β_d = ${written(values.marker_factor)}. ${sentence}`;
    if (handle.getAttribute("aria-valuetext") !== words) handle.setAttribute("aria-valuetext", words);
  }

  document.addEventListener("DOMContentLoaded", () => {
    for (const box of every("[data-marker]")) {
      box.addEventListener("change", () => commit(box));
      box.addEventListener("keydown", (event) => { if (event.key === "Escape") { box.value = written(values[box.dataset.marker]); page.flag(box, false); say(""); } });
    }
    one(".marker-keys").addEventListener("click", () => { place(values.marker_frequency, values.marker_factor); handle?.focus(); });
    one(".marker-remove").addEventListener("click", remove);
    one(".marker-follow").addEventListener("click", follow);
  }, { once: true });

  // the value in SI beside each box, as in the sidebar
  function si({ hints }) {
    for (const name of Object.keys(BOUNDS)) one(`[data-marker-si="${name}"]`).textContent = `= ${hints[name]}`;
  }

  return {
    tap: (x, y) => place(...page.units.plain(CHART, x, y)),
    get focused() { return Boolean(handle) && document.activeElement === handle; },
    answer(data) {
      if (data.si) si(data.si);
      if (data.values && !grabbed) for (const name of Object.keys(values)) values[name] = data.values[name];
      if (data.values) show();
      if (data.inspector && data.settled) describe(data.inspector.sentence);
    },
  };
})();
