// Times redraws inside a page: every paint of every figure is noted with the probe of the
// data it painted, and compared with what the solver's arrays give for the slider's value.
window.bench = (() => {
  const bench = { paints: [], messages: 0, bytes: 0 };
  const views = [];
  const walk = (view) => {
    if (view.model.type === "Figure") views.push(view);
    for (const child of view.children()) walk(child);
  };
  for (const view of Bokeh.index) walk(view);
  bench.sizes = Object.fromEntries(views.map((view) => [view.model.name, [view.bbox.width, view.bbox.height]]));

  // one number that tells which values a figure holds: `probe` of moves.py
  function probe(view) {
    let total = 0;
    for (const renderer of view.model.renderers) {
      const data = renderer.data_source.data;
      for (const name of ["xs", "ys", "x", "y"]) {
        let column = data[name] ?? [];
        while (column.length && typeof column[0] !== "number") column = column[0];
        if (!column.length) continue;
        for (const place of [0, Math.floor(column.length / 3), column.length - 1]) {
          if (Number.isFinite(column[place])) total += column[place];
        }
      }
    }
    return total;
  }

  for (const view of views) {
    const paint = view._actual_paint;
    view._actual_paint = function (...rest) {
      const result = paint.apply(this, rest);
      bench.paints.push({ time: performance.now(), key: view.model.name, probe: probe(view) });
      return result;
    };
  }

  const near = (a, b) => Math.abs(a - b) <= 1e-9 * (1 + Math.abs(b));
  const idle = (time) => new Promise((resolve) => { setTimeout(resolve, time); });

  // when each chart first painted what is wanted, after a time; null until all have
  function settled(wanted, since) {
    const times = Object.entries(wanted).map(([key, value]) =>
      bench.paints.find((one) => one.time >= since && one.key === key && near(one.probe, value))?.time);
    return times.includes(undefined) ? null : Math.max(...times);
  }

  async function wait(wanted, since) {
    while (settled(wanted, since) === null) {
      if (performance.now() - since > 30000) {
        throw new Error(`not painted: wanted ${JSON.stringify(wanted)}, got ${JSON.stringify(bench.paints.slice(-6))}`);
      }
      await idle(4);
    }
    return settled(wanted, since);
  }

  const custom = () => {
    for (const view of Bokeh.index) if (view.model.name === "controls" || view.model.type.includes("ESM")) return view;
  };
  function find(name) {
    // the dashboard's own slider, as a user's drag moves it; else a stock Bokeh one
    const own = custom()?.shadow_el?.querySelector(`#rs-${name}`);
    if (own) {
      return (value) => { own.value = value; own.dispatchEvent(new Event("input")); };
    }
    const stock = Bokeh.documents[0].get_model_by_name(name);
    return (value) => { stock.value = value; };
  }

  bench.move = async ({ slider, value, wanted }) => {
    const set = find(slider);
    bench.paints.length = 0;
    bench.start = performance.now();
    set(value);
    return (await wait(wanted, bench.start)) - bench.start;
  };

  // the full picture of the last move, painted after the one of the moving slider, from the input event
  bench.rest = async (wanted) => (await wait(wanted, bench.start)) - bench.start;

  bench.drag = async ({ slider, steps, rate, wanted }) => {
    const set = find(slider);
    bench.paints.length = 0;
    const start = performance.now();
    let sent = 0;
    let last = 0;
    await new Promise((resolve) => {
      const timer = setInterval(() => {
        const due = Math.min(steps.length, Math.floor((performance.now() - start) * rate / 1000));
        if (due <= sent) return;
        sent = due;
        last = performance.now();
        set(steps[due - 1]);
        if (due === steps.length) { clearInterval(timer); resolve(); }
      }, 1000 / rate);
    });
    const end = await wait(wanted, last);
    const keys = Object.keys(wanted);
    const changes = (from, to) => keys.map((key) => {
      const mine = bench.paints.filter((one) => one.key === key && one.time <= to);
      return mine.filter((one, i) => one.time > from && (i === 0 || one.probe !== mine[i - 1].probe)).length;
    });
    return {
      settle: end - last,
      redraws: Math.max(...changes(last, end)),
      rate: 1000 * Math.max(...changes(start, last)) / (last - start),
    };
  };
  return bench;
})();
