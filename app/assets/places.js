// Places on the Bokeh charts: where a value lies in the element that holds a chart, and which value lies at a pixel.
window.rotorstab.places = (() => {
  const known = new Map();

  // a view that Bokeh is still building cannot list its parts
  function parts(view) {
    try { return [...view.children()].filter(Boolean); } catch { return []; }
  }

  function search(key) {
    const walk = (view) => (view.model.type === "Figure" && view.model.name === key ? view : parts(view).map(walk).find(Boolean));
    return [...Bokeh.index].filter(Boolean).map(walk).find(Boolean);
  }

  // the view of a chart, or undefined while there is none that has been laid out
  function view(key) {
    if (!known.get(key)?.el.isConnected) known.set(key, window.Bokeh && search(key));
    const found = known.get(key);
    return found?.frame?.bbox.width > 0 ? found : undefined;
  }

  // the element of the page, outside every shadow root, that holds a chart
  function holder(key) {
    let node = view(key)?.el;
    while (node && node.getRootNode() !== document) node = node.getRootNode().host;
    return node?.closest(".plot");
  }

  function offset(found, where) {
    const [inner, outer] = [found.el, where].map((one) => one.getBoundingClientRect());
    return [inner.left - outer.left, inner.top - outer.top];
  }

  return {
    view, holder,
    // the pixel of a value, from the upper left corner of the holder; undefined while there is no chart
    pixel(key, x, y) {
      const found = view(key);
      if (!found) return undefined;
      const [left, top] = offset(found, holder(key));
      return [left + found.frame.x_scale.compute(x), top + found.frame.y_scale.compute(y)];
    },
    // the value at a point of the window, such as that of a pointer
    value(key, clientX, clientY) {
      const found = view(key);
      const { left, top } = found.el.getBoundingClientRect();
      return [found.frame.x_scale.invert(clientX - left), found.frame.y_scale.invert(clientY - top)];
    },
    // lowest and highest values that are shown
    window(key) {
      const found = view(key);
      return found && [found.model.x_range, found.model.y_range].map(({ start, end }) => [start, end]);
    },
    // call back when what is shown of a chart changes: by a zoom, a pan or another size
    watch(key, moved) {
      const found = view(key);
      for (const range of [found.model.x_range, found.model.y_range]) range.change.connect(moved);
      new ResizeObserver(() => requestAnimationFrame(moved)).observe(holder(key));
    },
  };
})();
