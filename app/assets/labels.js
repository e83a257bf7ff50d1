// Labels on the Bokeh charts: where one would lie over another, or be cut by the frame, it is painted beside, or not
// at all. Only the browser knows how wide its letters are, and what is seen while a chart is zoomed.
window.rotorstab.labelPlaces = (() => {
  const GAP = 1; // px between two labels
  const LINES = 4; // lines by which a label may be moved up or down
  const paintings = new WeakMap(); // by the view of a figure: what its present painting has painted so far

  // the boxes of the labels that were painted before, in the same painting of the figure
  function boxesOf(figure, glyph) {
    const { currentTime } = document.timeline; // the same within a frame
    let now = paintings.get(figure);
    if (!now || now.frame !== currentTime || now.boxes.has(glyph)) paintings.set(figure, now = { frame: currentTime, boxes: new Map() });
    now.boxes.set(glyph, []);
    return now.boxes;
  }

  // the box of a label as Bokeh would paint it, and what is needed to move it
  function measured(view, at, { sx, sy, x_offset, y_offset, angle }) {
    const { x: across, y: down } = view.anchor_.get(at);
    const [width, height, turn] = [view.swidth[at], view.sheight[at], angle.get(at)];
    const corners = [[0, 0], [width, 0], [0, height], [width, height]].map(([x, y]) => [x - across * width, y - down * height])
      .map(([x, y]) => [x * Math.cos(turn) - y * Math.sin(turn), x * Math.sin(turn) + y * Math.cos(turn)]);
    const [xs, ys] = [0, 1].map((axis) => corners.map((corner) => corner[axis]));
    const [dx, dy] = [x_offset.get(at), y_offset.get(at)];
    return {
      left: sx[at] + dx + Math.min(...xs), top: sy[at] + dy + Math.min(...ys),
      width: Math.max(...xs) - Math.min(...xs), height: Math.max(...ys) - Math.min(...ys), anchor: sx[at], dx, dy,
    };
  }

  const apart = (one, other) => one.left + one.width + GAP <= other.left || other.left + other.width + GAP <= one.left
    || one.top + one.height + GAP <= other.top || other.top + other.height + GAP <= one.top;

  // the part that two boxes have in common; its size is negative where they have none
  function shared(one, other) {
    const left = Math.max(one.left, other.left), top = Math.max(one.top, other.top);
    const right = Math.min(one.left + one.width, other.left + other.width), bottom = Math.min(one.top + one.height, other.top + other.height);
    return { left, top, width: right - left, height: bottom - top };
  }

  // a box moved into a frame
  function moved(box, left, top, frame) {
    const inside = (place, size, start, room) => Math.min(Math.max(place, start), start + room - size);
    return { ...box, left: inside(left, box.width, frame.left, frame.width), top: inside(top, box.height, frame.top, frame.height) };
  }

  // the first place of a label that is free: its own, then lines above and below it, on both sides of what it names
  function placed(box, frame, taken) {
    if (box.width > frame.width || box.height > frame.height) return undefined;
    const mirrored = 2 * box.anchor - box.left - box.width;
    for (let line = 0; line <= LINES; line++) {
      for (const left of [box.left, mirrored]) {
        for (const way of line ? [-1, 1] : [1]) {
          const found = moved(box, left, box.top + way * line * (box.height + GAP), frame);
          if (taken.every((other) => apart(found, other))) return found;
        }
      }
    }
    return undefined;
  }

  // the part of a chart that is not computed, whose reason stands in it or nowhere
  function blank(view, at) {
    const plot = view.renderer.parent;
    const { data } = plot.model.renderers.find((one) => one.name === "not computed").data_source;
    const ends = (values, scale) => {
      const all = [...values[at][0][0]].map((value) => scale.compute(value));
      return [Math.min(...all), Math.max(...all)];
    };
    const [left, right] = ends(data.xs, plot.frame.x_scale), [top, bottom] = ends(data.ys, plot.frame.y_scale);
    return { left, top, width: right - left, height: bottom - top };
  }

  function paint(original, view, ctx, indices, data) {
    const shown = { ...view, ...data };
    const { x, y, width, height } = view.renderer.parent.frame.bbox;
    const frame = { left: x, top: y, width, height };
    const boxes = boxesOf(view.renderer.parent, view);
    const kept = [], shifts = new Map();
    for (const at of indices) {
      const box = measured(view, at, shown);
      if (!Number.isFinite(box.left + box.top)) continue;
      const room = view.renderer.model.name === "reason" ? shared(frame, blank(view, at)) : frame;
      const found = placed(box, room, [...boxes.values()].flat());
      if (!found) continue;
      boxes.get(view).push(found);
      kept.push(at);
      shifts.set(at, [box.dx + found.left - box.left, box.dy + found.top - box.top]);
    }
    const offset = (axis) => ({ get: (at) => shifts.get(at)[axis] });
    original.call(view, ctx, kept, { ...data, x_offset: offset(0), y_offset: offset(1) });
  }

  const ready = new WeakSet();
  return {
    // let every label of the page be painted so; `glyph` is one of their models
    place(glyph) {
      const { prototype } = glyph.default_view;
      if (ready.has(prototype)) return;
      ready.add(prototype);
      const original = prototype._paint;
      prototype._paint = function (ctx, indices, data) { paint(original, this, ctx, indices, data); };
    },
  };
})();
