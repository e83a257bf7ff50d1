// Lessons: the running lesson, its question and its controls, beside the live charts.
window.rotorstab.lessons = (() => {
  const page = window.rotorstab;
  const { progress, keep, passed } = page.progress;
  const GLIDE = 1200; // ms in which a right answer moves the settings to those that its text speaks of
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  const LIMITS = { marker_frequency: ["lowest_frequency", "highest_frequency"], marker_factor: ["", "largest_factor"] };
  const place = (name) => document.querySelector(`[data-lesson="${name}"]`);
  const panel = () => document.querySelector(".lesson");
  let running = null; // the step as the server described it
  let start = "", moved = false; // first values of the inputs in the step, and whether they have changed
  let asked = ""; // key of the lesson that was asked for
  let values = {};
  let focusTo = "";

  // -- pieces -------------------------------------------------------------------
  function node(tag, attributes, ...children) {
    const made = document.createElement(tag);
    for (const [key, value] of Object.entries(attributes || {})) made.setAttribute(key, value);
    made.append(...children);
    return made;
  }
  // the server has made the HTML of a lesson harmless
  function html(where, text) { where.innerHTML = text; }
  function button(words, action, kind = "") {
    const made = node("button", { type: "button", class: kind }, words);
    made.addEventListener("click", action);
    return made;
  }

  function numbers(where, pairs) {
    where.replaceChildren(...pairs.map(([name, label]) => {
      const term = node("dt");
      html(term, label);
      return node("div", {}, term, node("dd", { "data-quantity": name }, "…"));
    }));
    where.hidden = !pairs.length;
  }

  // -- the controls of the step: the only settings that it offers ------------------------
  function control(field) {
    const id = `lesson-${field.name}`;
    const title = [...page.rich(`${field.symbol} ${field.label}`.trim())];
    if (field.switch) {
      const input = node("input", { type: "checkbox", id });
      input.addEventListener("change", () => page.change(field.name, input.checked));
      return { row: node("div", { class: "lesson-switch" }, input, node("label", { for: id }, ...title)), show: (value) => { input.checked = value; } };
    }
    if (field.options) {
      const select = node("select", { id }, ...field.options.map(([value, words]) => node("option", { value }, words)));
      select.addEventListener("change", () => page.change(field.name, select.value));
      return { row: node("div", {}, node("label", { for: id }, ...title), select), show: (value) => { select.value = value; } };
    }
    const slider = node("input", { type: "range", id, min: field.low, max: field.high, step: field.step });
    const output = node("output", { for: id });
    const write = (value) => { output.textContent = String(Number(value.toPrecision(4))).replace("-", "−"); };
    slider.addEventListener("input", () => { write(slider.valueAsNumber); page.change(field.name, slider.valueAsNumber); });
    return {
      row: node("div", { class: "lesson-slider" }, node("label", { for: id }, ...title), output, slider),
      show: (value) => {
        // the marker stays within the chart
        const [low, high] = LIMITS[field.name] || [];
        if (low) slider.min = Math.max(field.low, values[low]);
        if (high) slider.max = Math.min(field.high, values[high]);
        if (slider.matches(":active")) return;
        slider.value = value;
        write(value);
      },
    };
  }

  let controls = {};
  function move(step) {
    controls = {};
    const rows = step.move.map((field) => {
      controls[field.name] = control(field);
      return controls[field.name].row;
    });
    if (step.has_set) rows.push(button("Set it for me", () => page.send({ type: "lesson-set" })));
    place("move").replaceChildren(...rows);
  }

  // -- the question ---------------------------------------------------------------
  function form(step) {
    const where = place("form");
    const ask = node("p", { id: "lesson-ask", class: "lesson-ask" });
    html(ask, step.ask);
    const check = node("button", { type: "submit", class: "strong" }, "Check");
    if (step.kind === "choice") {
      const group = node("div", { role: "radiogroup", "aria-labelledby": "lesson-ask" }, ...step.choices.map((text, index) => {
        const label = node("span");
        html(label, text);
        return node("label", { class: "lesson-choice" }, node("input", { type: "radio", name: "lesson-choice", value: index }), label);
      }));
      where.replaceChildren(ask, group, check);
    } else if (step.kind === "number") {
      const box = node("input", { type: "text", inputmode: "decimal", autocomplete: "off", "aria-labelledby": "lesson-ask", class: "lesson-box" });
      const unit = node("span", { class: "sub" });
      html(unit, step.unit || (step.range ? `a number from ${step.range[0]} to ${step.range[1]}`.replaceAll("-", "−") : "a number"));
      where.replaceChildren(ask, node("div", { class: "lesson-pair" }, box, check, unit));
    } else {
      where.replaceChildren(ask, check);
    }
  }

  function submit(event) {
    event.preventDefault();
    const chosen = place("form").querySelector("input:checked");
    const box = place("form").querySelector(".lesson-box");
    const value = box ? box.value : chosen ? Number(chosen.value) : "";
    page.send({ type: "lesson-answer", value });
  }

  function answered({ right, counted, words, shown, recalled, show: settings }) {
    if (recalled) { // a step that was done before: show its answer, do not scroll
      say(words, "right");
      return;
    }
    // an earlier right answer still counts
    if (counted && !right && !shown && passed(progress(running.key).steps[running.step])) {
      say("This answer is not right. Your earlier right answer still counts.", "note");
      return;
    }
    // an answer that is not counted is not an answer yet, for example a number with its unit
    const tell = () => { say(words, right ? "right" : shown ? "shown" : counted ? "hint" : "note"); scroll(); };
    if (!counted) { tell(); return; }
    const { key, step } = running;
    keep(key, (old) => {
      const before = old.steps[step];
      const now = right ? "right" : shown && before !== "right" ? "shown" : before || "tried";
      return { ...old, at: step, steps: { ...old.steps, [step]: now } };
    });
    if (!settings) { reveal(); stand(); tell(); return; }
    say("", "");
    glide(settings, () => { reveal(); tell(); });
    reveal();
    stand();
  }

  // the new text may lie below the edge of the panel, or of a small screen
  function scroll() {
    requestAnimationFrame(() => place(place("see-part").hidden ? "words" : "see-part").scrollIntoView({ block: "nearest" }));
  }

  // -- a right answer first shows what its text speaks of: the settings move, then the words appear ------
  let arrival = null; // what happens once the charts show the settings of Try
  let frame = 0;
  function glide(settings, then) {
    const from = values, moved = Object.keys(settings).filter((name) => settings[name] !== from[name]);
    if (!moved.length) { then(); return; }
    const numbers = moved.filter((name) => typeof settings[name] === "number");
    for (const name of moved) if (!numbers.includes(name)) page.change(name, settings[name]);
    arrival = then;
    const start = performance.now();
    const tick = (now) => {
      const share = still.matches || !numbers.length ? 1 : Math.min(1, Math.max(0, now - start) / GLIDE);
      if (share === 1) { page.send({ type: "lesson-set" }); return; }
      for (const name of numbers) page.change(name, from[name] + share * (settings[name] - from[name]));
      frame = requestAnimationFrame(tick);
    };
    frame = requestAnimationFrame(tick);
  }

  function arrived() {
    const then = arrival;
    arrival = null;
    then?.();
  }

  function say(words, kind) {
    const where = place("words");
    where.className = `lesson-words ${kind}`;
    html(where, words);
  }

  // -- the visible parts of the step -----------------------------------------------------
  function reveal() {
    const { key, step, kind, titles, next } = running;
    const { steps } = progress(key);
    const state = steps[step];
    const waits = !state && kind !== "goal";
    panel().classList.toggle("waits", waits);
    place("try-part").inert = waits;
    place("see-part").hidden = !passed(state) || arrival !== null;
    place("form").inert = arrival !== null;
    place("show").hidden = passed(state) || !state;
    veil(waits);
    // after a wrong answer the numbers appear when the student moves an input
    const tried = passed(state) || kind === "goal" || !running.move.length || moved;
    panel().classList.toggle("tried", tried);
    document.querySelector("main").classList.toggle("untried", !tried);
    place("back").disabled = step === 0;
    const last = step === titles.length - 1;
    const forward = place("next");
    forward.textContent = !last ? "Next" : next ? "Next lesson" : "Finish";
    forward.classList.toggle("strong", passed(state));
    place("steps").replaceChildren(...titles.map((title, index) => {
      const dot = button(String(index + 1), () => choose(index), passed(steps[index]) ? "done" : "");
      dot.setAttribute("aria-label", `Step ${index + 1}: ${title}${passed(steps[index]) ? ", done" : ""}`);
      dot.title = title;
      if (index === step) dot.setAttribute("aria-current", "step");
      return node("li", {}, dot);
    }));
  }

  // whatever would show the answer is hidden until the prediction
  const PLACES = {
    instability: '[data-view="instability"] .plot', "load-frequency": '[data-view="load-frequency"] .plot', campbell: '[data-view="campbell"] .plot',
    shaft: ".shaft-views", response: ".tip-chart .plot", multipliers: ".multipliers .plot", orbit: ".orbit .plot",
  };
  let predicting = false, laid = "";
  function veil(on) {
    predicting = on;
    document.querySelector("main").classList.toggle("predicting", on);
    const covered = on && running ? running.cover : [];
    for (const [name, selector] of Object.entries(PLACES)) document.querySelector(selector).classList.toggle("covered", covered.includes(name));
    const asked = new Set(on && running ? running.asked : []);
    for (const number of document.querySelectorAll("[data-number], [data-whirl]")) {
      const name = number.dataset.number || `whirl.${number.dataset.whirl}`;
      number.parentElement.classList.toggle("asked", asked.has(name));
    }
  }

  function stand() {
    const here = Boolean(running) && document.querySelector('[data-page="explore"]')?.hidden === false;
    const main = document.querySelector("main");
    panel().hidden = !here;
    page.mark();
    main.classList.toggle("teaching", here);
    main.classList.toggle("unmarked", here && !running.marked);
    document.querySelector(".layers").inert = here; // the controls of the step switch the layers
    const looked = here ? running.look.join(" ") : "";
    if (looked !== laid) {
      laid = looked;
      main.dataset.look = looked;
      main.classList.toggle("pointed", here && running.look.length > running.charts);
      main.dataset.charts = here ? String(running.charts) : "";
      setTimeout(page.relayout, 400);
      // on a narrow screen the first chart of the step, and its button
      const row = document.querySelector(".explore");
      row.scrollLeft = 0;
      row.dispatchEvent(new Event("scroll"));
    }
    const veiled = here && predicting;
    if (page.veiled !== veiled) { page.veiled = veiled; page.paintCharts(); }
    return here;
  }

  function show(step) {
    if (step.key !== asked) return; // the student has left this lesson
    running = step;
    cancelAnimationFrame(frame);
    arrival = null;
    // the table of tongues of the step before would tell an answer
    for (const pop of document.querySelectorAll("[popover]:popover-open")) pop.hidePopover();
    start = "";
    moved = false;
    busy(false);
    place("where").textContent = step.number ? `Lesson ${step.number} · step ${step.step + 1} of ${step.titles.length}` : `Step ${step.step + 1} of ${step.titles.length}`;
    for (const name of ["title", "intro", "heading", "predict", "try", "see"]) html(place(name), step[name]);
    if (step.number) place("title").dataset.lessonNumber = step.number;
    else delete place("title").dataset.lessonNumber;
    numbers(place("given"), step.given);
    numbers(place("watch"), step.watch);
    form(step);
    say("", "");
    move(step);
    for (const [name, one] of Object.entries(controls)) if (name in values) one.show(values[name]);
    keep(step.key, (old) => ({ ...old, at: step.step }));
    name();
    reveal();
    stand();
    document.querySelector(".lesson-body").scrollTop = 0;
    if (passed(progress(step.key).steps[step.step]) && step.kind !== "goal") page.send({ type: "lesson-show", recall: true });
    if (focusTo) {
      place(focusTo).focus({ preventScroll: true });
      // scroll past the header if it does not stay in view
      const phone = getComputedStyle(document.querySelector(".top")).position === "static";
      scrollTo({ top: phone ? document.querySelector("main").offsetTop : 0 });
      focusTo = "";
    }
  }

  // -- entering and leaving a lesson ---------------------------------------------------------------
  function go(step, held = false) {
    focusTo = held ? "" : "heading";
    busy(true);
    page.send({ type: "lesson", lesson: asked, step, keep: held, done: passed(progress(asked).steps[step]) });
  }

  // a step that is chosen with a button gets an entry in the history; a moved slider does not
  let chosen = false;
  function choose(step) { chosen = true; go(step); }

  // while the new step loads, the old one is inactive, except for the button that leaves the lesson
  function busy(waiting) {
    panel().setAttribute("aria-busy", String(waiting));
    for (const part of panel().querySelectorAll(".lesson-steps, .lesson-body, .lesson-foot, .lesson-try")) part.inert = waiting;
  }

  // #lesson/name/step opens that step beside the charts, with the state of the address if it has one.
  // #lesson/name opens the lesson at the step where the student left it, with the state of the lesson.
  function visit() {
    const found = location.hash.match(/^#lesson\/([a-z0-9-]{1,61})(?:\/(\d{1,4}))?$/);
    if (!page.send) return;
    const [wanted, step] = found ? [found[1], found[2] && Math.max(0, Number(found[2]) - 1)] : [];
    if (wanted && wanted !== running?.key) {
      asked = wanted;
      const held = !visited && step !== undefined && sent;
      go(step ?? progress(wanted).at, held);
      if (!held) focusTo = "title";
    } else if (wanted && step !== undefined && step !== running.step) go(step);
    else if (wanted) name();
    else if (running && ["", "#explore"].includes(location.hash)) end(); // Explore is the whole dashboard again
    visited = true;
    if (running) stand();
  }
  let visited = false;
  const sent = location.search.length > 1; // read before the page writes its state into the address

  // the address names the step, so that a link opens it
  function name() {
    if (!location.hash.startsWith("#lesson/")) return;
    const hash = `#lesson/${running.key}/${running.step + 1}`;
    if (hash !== location.hash) history[chosen ? "pushState" : "replaceState"](null, "", `${location.pathname}${location.search}${hash}`);
    chosen = false;
  }

  function end() {
    running = null;
    asked = "";
    cancelAnimationFrame(frame);
    arrival = null;
    page.send({ type: "lesson-end" });
    veil(false);
    stand();
  }

  function leave() {
    end();
    location.hash = "lessons";
    document.querySelector("#main").focus();
  }

  function forward() {
    const { step, titles, next } = running;
    if (step < titles.length - 1) choose(step + 1);
    else if (next) location.hash = `lesson/${next}`;
    else leave();
  }

  document.addEventListener("DOMContentLoaded", () => {
    place("form").addEventListener("submit", submit);
    place("close").addEventListener("click", leave);
    place("back").addEventListener("click", () => choose(running.step - 1));
    place("next").addEventListener("click", forward);
    place("show").addEventListener("click", () => page.send({ type: "lesson-show" }));
    document.querySelector(".lesson-forget").addEventListener("click", () => {
      page.progress.forget();
      if (running) { reveal(); stand(); }
    });
    // the link of the running lesson is chosen again in the list
    for (const link of document.querySelectorAll('a[href^="#lesson/"]')) {
      link.addEventListener("click", () => { if (running && link.hash === `#lesson/${running.key}`) setTimeout(visit); });
    }
    window.addEventListener("popstate", visit); // fires for a change of the hash and for Back to another query
  }, { once: true });

  return {
    get running() { return Boolean(running); },
    // whether an input may be changed on the charts: in a step only by a student who has made a prediction
    free: (name) => !running || (!predicting && arrival === null && running.free.includes(name)),
    // the range of an input in the step
    range: (name) => running?.move.find((field) => field.name === name),
    answer(data) {
      if (data.lesson) show(data.lesson);
      if (data.lesson_set) arrived();
      if (data.lesson === null) { asked = ""; running = null; busy(false); stand(); }
      if (data.values) {
        values = data.values;
        for (const [name, one] of Object.entries(controls)) one.show(values[name]);
        const now = JSON.stringify(Object.keys(controls).map((name) => values[name]));
        if (running && !moved) {
          moved = start !== "" && now !== start;
          start = start || now;
          if (moved) reveal();
        }
      }
      for (const [name, text] of Object.entries(data.lesson_numbers || {})) {
        for (const where of document.querySelectorAll(`[data-quantity="${CSS.escape(name)}"]`)) where.replaceChildren(...page.rich(text));
      }
      if (data.lesson_answer && running) answered(data.lesson_answer);
      if (data.page && !visited) visit();
    },
  };
})();
