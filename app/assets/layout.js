// Layout: help texts and tables open beside the buttons that belong to them.
(() => {
  const MARGIN = 8; // px between a text and the edge of the window
  const SWIPE = 30; // px that a finger moves to show the next chart

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
    // the browser returns to the chart that was in view unless a swipe crosses half of the screen: a short one is enough
    let touch = null, aim; // where a swipe began, and where its chart begins
    row.addEventListener("touchstart", ({ touches: [finger, other] }) => {
      aim = undefined;
      touch = other ? null : { x: finger.clientX, left: row.scrollLeft };
    }, { passive: true });
    row.addEventListener("touchend", ({ changedTouches: [finger] }) => {
      const across = touch ? touch.x - finger.clientX : 0, went = touch ? row.scrollLeft - touch.left : 0;
      touch = null;
      // a finger that moves something on a chart does not swipe
      if (Math.abs(across) < SWIPE || went * across <= 0) return;
      const left = row.getBoundingClientRect().left;
      const starts = [...row.children].filter((card) => card.checkVisibility())
        .map((card) => row.scrollLeft + card.getBoundingClientRect().left - left).sort((one, other) => one - other);
      const from = row.scrollLeft - went;
      aim = across > 0 ? starts.find((start) => start > from + 1) : starts.findLast((start) => start < from - 1);
    }, { passive: true });
    row.addEventListener("scrollend", () => {
      if (aim !== undefined) row.scrollTo({ left: aim });
      aim = undefined;
    });
    row.addEventListener("scroll", mark);
    new ResizeObserver(mark).observe(row); // a tablet that is turned has another layout
    mark();
  }, { once: true });
})();
