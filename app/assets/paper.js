// The Paper page with its figures, and the downloads of every page.
window.rotorstab.paper = (() => {
  const page = window.rotorstab;
  const place = (name) => document.querySelector(`[data-paper="${name}"]`);
  let current = 0;
  const floquet = () => document.querySelector("#paper-floquet").checked;

  function row(cells, heads = 0) {
    const tr = document.createElement("tr");
    cells.forEach((cell, index) => {
      const td = document.createElement(index < heads ? "th" : "td");
      if (index < heads) td.scope = "row";
      if (typeof cell === "string") td.append(...page.rich(cell)); else td.append(cell);
      tr.append(td);
    });
    return tr;
  }

  function ask(number) {
    current = number;
    for (const button of document.querySelectorAll("[data-figure]")) button.setAttribute("aria-pressed", String(Number(button.dataset.figure) === number));
    // a figure with Floquet takes seconds: meanwhile the text of the last figure must not be shown
    place("title").textContent = `Figure ${number}`;
    for (const name of ["caption", "parameters", "reading", "settings"]) place(name).replaceChildren();
    await_picture("Drawing …");
    page.send({ type: "figure", number, floquet: floquet() });
  }

  function await_picture(words) {
    const waiting = document.createElement("p");
    waiting.className = "sub";
    waiting.textContent = words;
    place("picture").replaceChildren(waiting);
  }

  function show(figure) {
    current = figure.number;
    place("title").replaceChildren(...page.rich(`Figure ${figure.number}. ${figure.title}`));
    place("caption").replaceChildren(...page.rich(figure.caption));
    place("parameters").replaceChildren(...page.facts(figure.parameters));
    place("reading").replaceChildren(...figure.reading.map((one) => {
      const ours = document.createElement("div");
      ours.append(...page.rich(one.ours));
      if (one.note) {
        const note = document.createElement("p");
        note.className = "sub";
        note.append(...page.rich(one.note));
        ours.append(note);
      }
      const verdict = document.createElement("span");
      verdict.className = `verdict ${one.verdict.replaceAll(" ", "-")}`;
      verdict.textContent = one.verdict;
      return row([one.text, ours, verdict]);
    }));
    place("settings").replaceChildren("Open in the live charts", ...figure.settings.map((setting) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = setting.label;
      button.addEventListener("click", () => {
        for (const [name, value] of Object.entries(setting.values)) page.change(name, value);
        location.hash = setting.page;
      });
      return button;
    }));
    document.querySelector("#paper-floquet").disabled = !figure.has_floquet;
    place("downloads").hidden = false;
    await_picture("Drawing …");
  }

  function picture({ number, floquet: with_floquet, svg }) {
    if (number !== current || (with_floquet !== floquet() && !document.querySelector("#paper-floquet").disabled)) return;
    const image = document.createElement("img");
    image.alt = place("title").textContent;
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
    place("picture").replaceChildren(image);
  }

  function save({ name, mime, base64 }) {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    page.save(name, new Blob([bytes], { type: mime }));
  }

  document.addEventListener("DOMContentLoaded", () => {
    for (const button of document.querySelectorAll("[data-figure]")) button.addEventListener("click", () => ask(Number(button.dataset.figure)));
    document.querySelector("#paper-floquet").addEventListener("change", () => ask(current));
    for (const button of place("downloads").querySelectorAll("button")) {
      button.addEventListener("click", () => page.send({ type: "export", number: current, floquet: floquet(), format: button.dataset.format, at: page.here() }));
    }
    for (const select of document.querySelectorAll("select.export")) {
      select.addEventListener("change", () => {
        if (select.value) page.send({ type: "export", chart: select.dataset.chart, format: select.value, at: page.here() });
        select.value = "";
      });
    }
  }, { once: true });

  return {
    answer(data) {
      // a figure with Floquet may arrive after the user has chosen another one
      if (data.figure && data.figure.number === current && (data.figure.floquet === floquet() || !data.figure.has_floquet)) show(data.figure);
      if (data.table_1) place("table").replaceChildren(...data.table_1.map((cells) => row(cells, 1)));
      if (data.picture) picture(data.picture);
      if (data.not_drawn) await_picture(data.not_drawn);
      if (data.file) save(data.file);
      if (data.page === "paper" && !current) ask(6);
    },
  };
})();
