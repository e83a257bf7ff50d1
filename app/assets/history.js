// Undo and redo: one gesture that changes the settings is one entry of the browser's history, so that Back and
// Forward step through the settings, as the buttons and Ctrl+Z do.
window.rotorstab.history = (() => {
  const page = window.rotorstab;
  const PAUSE = 1000; // ms: keys that are further apart belong to two gestures
  let query = "", values = null; // of the last answer
  let gesture = 0, pressed = 0, where = null;
  let entry = { step: history.state?.step ?? 0, key: "", gesture: -1 }; // the present entry of the history
  let last = entry.step; // the newest entry to which Forward leads
  const button = (name) => document.querySelector(`button.${name}`);

  function write(how) {
    // a browser refuses entries that come too fast
    try { history[how]({ step: entry.step, values }, "", `${location.pathname}?${query}${location.hash}`); } catch { /* the next one counts */ }
  }

  function offer() {
    button("undo").disabled = page.lessons.running || entry.step <= 0;
    button("redo").disabled = page.lessons.running || entry.step >= last;
  }

  // settings at rest: a new gesture makes an entry, the same gesture changes its own one
  function rest() {
    const key = JSON.stringify(values);
    const first = !entry.key, same = key === entry.key || gesture === entry.gesture;
    if (first || same || page.lessons.running) {
      entry.key = key;
      write("replaceState");
    } else {
      entry = { step: entry.step + 1, key, gesture };
      last = entry.step;
      write("pushState");
    }
    offer();
  }

  function enter({ state }) {
    if (state?.step === undefined) { // a link to another page made this entry
      entry = { ...entry, step: entry.step + 1, gesture: -1 };
      last = entry.step;
      if (values) write("replaceState");
    } else {
      // what the server makes of these settings belongs to this entry, until the next gesture
      entry = { step: state.step, key: JSON.stringify(state.values), gesture };
      last = Math.max(last, entry.step);
      // a lesson sets its own values
      const held = location.hash.startsWith("#lesson/") || !values || !state.values ? {} : state.values;
      // a marker that follows the tongue finds its place by itself
      const placed = held.marker_follows ? ["marker_frequency", "marker_factor"] : [];
      for (const [name, value] of Object.entries(held)) if (values[name] !== value && !placed.includes(name)) page.change(name, value);
    }
    offer();
  }

  function typing(element) {
    return element.isContentEditable || ["TEXTAREA", "SELECT"].includes(element.tagName)
      || (element.tagName === "INPUT" && ["text", "number", "search"].includes(element.type));
  }

  addEventListener("popstate", enter);
  addEventListener("pointerdown", () => { gesture += 1; }, true);
  addEventListener("keydown", (event) => {
    const [target] = event.composedPath();
    if (!event.repeat && (target !== where || event.timeStamp - pressed > PAUSE)) gesture += 1;
    where = target;
    pressed = event.timeStamp;
    if (!(event.ctrlKey || event.metaKey) || event.altKey || !/^[zy]$/i.test(event.key) || typing(target)) return;
    event.preventDefault();
    button(event.shiftKey || /y/i.test(event.key) ? "redo" : "undo").click();
  }, true);
  document.addEventListener("DOMContentLoaded", () => {
    button("undo").addEventListener("click", () => history.back());
    button("redo").addEventListener("click", () => history.forward());
    offer();
  }, { once: true });

  return {
    answer(data) {
      if (data.values) ({ query, values } = data);
      // at rest only, because browsers refuse an address that changes with every frame
      if (values && (data.at_rest || data.resting) && !page.left) rest();
      else offer();
    },
    // write the state of the last answer into the address
    address() { if (query) write("replaceState"); },
  };
})();
