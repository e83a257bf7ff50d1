// Layout: help texts and tables open beside the buttons that belong to them.
(() => {
  const MARGIN = 8; // px between a text and the edge of the window

  // the event does not bubble, so it is caught on its way down
  document.addEventListener("beforetoggle", (event) => {
    const { target: pop, newState } = event;
    const button = document.querySelector(`[popovertarget="${pop.id}"]`);
    if (newState !== "open" || !button) return;
    const { left, right, top, bottom } = button.getBoundingClientRect();
    const place = { inset: "auto" };
    if ((left + right) / 2 < innerWidth / 2) place.left = `${Math.max(MARGIN, left)}px`;
    else place.right = `${Math.max(MARGIN, document.documentElement.clientWidth - right)}px`;
    const below = innerHeight - bottom;
    if (below >= top) Object.assign(place, { top: `${bottom + 4}px`, maxHeight: `${below - 4 - MARGIN}px` });
    else Object.assign(place, { bottom: `${innerHeight - top + 4}px`, maxHeight: `${top - 4 - MARGIN}px` });
    Object.assign(pop.style, place);
  }, true);

  // -- on a narrow screen the charts stand side by side, and are swiped or chosen by their names ----
  document.addEventListener("DOMContentLoaded", () => {
    const row = document.querySelector(".explore");
    const buttons = [...document.querySelectorAll("[data-show]")];
    const view = (name) => row.querySelector(`[data-view="${name}"]`);
    const mark = () => {
      const middle = row.getBoundingClientRect().left + row.clientWidth / 2;
      for (const button of buttons) {
        const { left, right } = view(button.dataset.show).getBoundingClientRect();
        button.setAttribute("aria-pressed", String(left <= middle && middle < right));
      }
    };
    for (const button of buttons) {
      button.addEventListener("click", () => {
        row.scrollTo({ left: view(button.dataset.show).offsetLeft - row.firstElementChild.offsetLeft });
      });
    }
    row.addEventListener("scroll", mark);
    mark();
  }, { once: true });
})();
