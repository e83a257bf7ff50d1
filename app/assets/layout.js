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
})();
