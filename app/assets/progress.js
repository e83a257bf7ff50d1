// The progress in lessons, which is kept in this browser only, and shown in the list of lessons.
window.rotorstab.progress = (() => {
  const STORE = "rotorstab-lessons";

  function stored() {
    try {
      const found = JSON.parse(localStorage.getItem(STORE));
      return found && typeof found === "object" && !Array.isArray(found) ? found : {};
    } catch { return {}; }
  }
  // {at: step, steps: {0: "right" | "shown" | "tried"}}; any other content is ignored
  function progress(key) {
    const found = stored()[key];
    const steps = found && typeof found.steps === "object" && found.steps ? found.steps : {};
    const all = Number(document.querySelector(`[data-lesson-card="${CSS.escape(key)}"]`)?.dataset.steps || 0);
    return { at: Number.isInteger(found?.at) && found.at < all ? found.at : 0, steps };
  }
  function keep(key, change) {
    const all = stored();
    all[key] = change(progress(key));
    try { localStorage.setItem(STORE, JSON.stringify(all)); } catch { /* private window */ }
    list();
  }
  const passed = (word) => word === "right" || word === "shown";

  function list() {
    for (const card of document.querySelectorAll("[data-lesson-card]")) {
      const { steps } = progress(card.dataset.lessonCard);
      const all = Number(card.dataset.steps);
      const done = Object.values(steps).filter(passed).length;
      const words = card.querySelector("[data-lesson-progress]");
      card.classList.toggle("done", done >= all);
      words.textContent = !Object.keys(steps).length ? "" : done >= all ? "✓ Done" : `${done} of ${all} steps done`;
    }
  }

  document.addEventListener("DOMContentLoaded", list, { once: true });

  return {
    progress, keep, passed,
    forget() {
      try { localStorage.removeItem(STORE); } catch { /* private window */ }
      list();
    },
  };
})();
