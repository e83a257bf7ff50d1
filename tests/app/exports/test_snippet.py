""" "As Python": every program is run, and its arrays compared with what the page shows."""

import builtins
import json
from contextlib import chdir, redirect_stdout
from io import StringIO

import holoviews
import numpy as np
import pytest

from app.exports.program import notebook_text, program_text
from app.exports.snippet import python_cells
from app.pages.explore import Explore
from app.pages.marked_point import INSPECTOR_CHARTS, inspect
from app.results.analysis import CHARTS, solve
from app.state import PRESETS, State
from app.words.si import displayed
from rotorstab.charts.agreement import Agreement
from rotorstab.model.stiffness_law import STIFFNESS_LAWS

MARKED = {"marker": True, "marker_frequency": 1.7, "marker_factor": 0.4, "periods": 5.0}
TABLE_1 = PRESETS["Table 1, 1000 rpm"]
STATES = {
    "default": {},
    "no marked point": {"marker": False},
    "partly, both laws": {"load_type": "partly", "tangency": 0.3, "stiffness": "both", **MARKED},
    "exact follower, from flutter": {
        "load_type": "follower",
        "law": "exact",
        "reference": "flutter",
        "static_load_factor": 0.3,
    },
    "exact, past the pole": {
        "law": "exact",
        "reference": "flutter",
        "shear": 0.05,
        "largest_factor": 2.0,
        "highest_frequency": 4.0,
    },
    "damped": {"external_damping": 0.02, "internal_damping": 0.01},
    "finite elements": {"model": "finite elements", "largest_factor": 0.3},
    "SI": {"units": "SI", **TABLE_1},
    "SI, marked, noise": {"units": "SI", **TABLE_1, **MARKED, "initial": "noise", "seed": 7.0},
    "SI, finite elements": {"units": "SI", **TABLE_1, "model": "finite elements"},
    "SI, a shaft not in use": {"units": "SI", "shaft_length": 0.8, **MARKED},
}


# HoloViews takes five seconds to write a page. The first of these has every layer of every chart
# (`test_every_layer_is_drawn_into_a_file`), and the other one is in SI.
WRITTEN = ("default", "SI")
# SI in a picture of its own file, and with a model that another state has
LONG = ("SI", "SI, finite elements")
FILE = "rotorstab-view.html"


@pytest.fixture(
    scope="module",
    params=[pytest.param(name, marks=pytest.mark.long if name in LONG else ()) for name in STATES],
    ids=list(STATES),
)
def ran(request, tmp_path_factory):
    """A state, what its program defines, its text, and what it prints."""
    state = State()
    assert state.change(STATES[request.param]) == {}
    text = program_text(python_cells(state))
    names, saved = {}, []
    folder = tmp_path_factory.mktemp("program")
    with (
        pytest.MonkeyPatch.context() as patch,
        redirect_stdout(StringIO()) as printed,
        chdir(folder),
    ):
        if request.param not in WRITTEN:
            patch.setattr(holoviews, "save", lambda *given, **_: saved.append(given))
        exec(compile(text, "program", "exec"), names)
    # HoloViews is installed here, so the charts are drawn into a file of their own
    if request.param in WRITTEN:
        assert "<script" in (folder / FILE).read_text(encoding="utf-8")
    else:
        assert saved == [(names["view"], FILE)]
    return state, names, text, printed.getvalue()


def layers_of(names):
    """Return the layers that a program draws, by chart; the name of a layer is its kind."""
    return {
        (chart.key, layer.label)
        for chart in names["charts"]
        for layer in chart.layers
        if any(len(column) for column in layer.columns.values())
    }


@pytest.fixture(scope="module")
def layers_written():
    """The layers of the state whose charts are written into a file."""
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(StringIO()):
        patch.setattr(holoviews, "save", lambda *_, **__: None)
        names = {}
        exec(compile(program_text(python_cells(State())), "program", "exec"), names)
    return layers_of(names)


def test_every_layer_is_drawn_into_a_file(ran, layers_written):
    _, names, *_ = ran
    assert layers_of(names) <= layers_written


def lines(chart, label, column="ys"):
    return list(chart.layer(label).columns[column])


def same(drawn, computed):
    """Compare curves; HoloViews gets NaN where a pair is complex."""
    drawn = np.asarray(drawn)
    seen = np.isfinite(drawn)
    assert seen.any()
    np.testing.assert_allclose(drawn[seen], np.asarray(computed)[seen], rtol=1e-6, atol=1e-9)


def test_a_program_computes_the_arrays_of_the_charts(ran):
    state, names, *_ = ran
    result = solve(state)
    charts = displayed(result.charts, state, result.numbers)
    si = state.units == "SI"
    scales = state.scales() if si else None
    hertz = scales.frequency / (2 * np.pi) if si else 1.0
    newton = scales.load if si else 1.0
    rate = scales.frequency if si else 1.0

    chart = charts["instability"]
    bolotin = names["bolotin"]
    ratio = hertz if si else 1 / names["frequency"]
    factor = newton if si else 1 / names["reference_load"]
    for x, y, name in zip(
        *(lines(chart, "boundary", c) for c in ("xs", "ys", "name")), strict=True
    ):
        column = bolotin.names.index(name.removesuffix(" boundary"))
        same(x, bolotin.frequency[:, column] * ratio)
        same(y, bolotin.pulsating_load * factor)
    (image,) = chart.layer("growth").columns["image"]
    stability = names["stability"]
    # the chart's grid is finer: it leaves out slower loads, and pixels in doubt may be others;
    # with finite elements it follows the slowest whirls, and the program all of them
    shown = chart.layer("growth").columns["verdict"][0] != Agreement.NOT_COMPUTED
    both = np.isfinite(image) & stability.unstable
    sure = shown & (stability.error <= 1e-5)
    assert (np.isfinite(image) != stability.unstable)[sure].mean() < (
        0.005 if state.model == "lumped" else 0.01
    )
    # next to an edge growth changes fast, and the two reductions have it a little apart
    near = {"rtol": 1e-3, "atol": 1e-5 if state.model == "lumped" else 0.01 * np.nanmax(image)}
    both &= sure
    assert both.sum() > 100
    np.testing.assert_allclose(image[both], stability.growth[both] * rate, **near)
    labels = chart.layer("tongue").columns
    centres = [one.centre * ratio for one in names["tongues"]]
    for name, x in zip(labels["name"], labels["x"], strict=True):
        assert np.isclose(centres, x).any(), name

    campbell = names["campbell"]
    speeds = campbell.parameter * (60 * hertz if si else 1.0)
    drawn = dict(
        zip(
            lines(charts["campbell"], "whirl", "name"),
            lines(charts["campbell"], "whirl"),
            strict=True,
        )
    )
    for name, column in zip(campbell.names, campbell.frequencies.real.T, strict=True):
        if np.isfinite(drawn[name]).any():
            same(drawn[name], column * hertz)
    same(lines(charts["campbell"], "whirl", "xs")[0], speeds)

    chart = charts["load-frequency"]
    drawn = dict(zip(lines(chart, "whirl", "name"), lines(chart, "whirl"), strict=True))
    for kind, curves in names["load_curves"].items():
        for name, column in zip(curves.names, curves.frequencies.real.T, strict=True):
            if np.isfinite(drawn[f"{name}, {kind}"]).any():
                same(drawn[f"{name}, {kind}"], column * hertz)
    same(lines(chart, "whirl", "xs")[0], names["load_axis"] * newton)

    if state.marker:
        found = inspect(state, result)
        time, v = (found.charts["response"].layer("motion").columns[c][3] for c in ("xs", "ys"))
        same(v, names["response"].displacement.real)
        period = names["response"].period
        same(time, names["response"].time / (scales.frequency if si else period))
        shown = [
            found.charts["multipliers"].layer(f"{k}multipliers").columns for k in ("", "growing ")
        ]
        points = np.concatenate([one["x"] + 1j * one["y"] for one in shown])
        assert sorted(points, key=abs) == pytest.approx(sorted(names["multipliers"], key=abs))


def test_the_drawn_charts_are_those_of_the_page(ran):
    state, names, *_ = ran
    page = Explore().compute(state)
    drawn = {chart.key: chart for chart in names["charts"]}
    assert list(drawn) == [*CHARTS, *(INSPECTOR_CHARTS if state.marker else ())]
    assert len(names["view"]) == len(drawn)
    if state.units == "SI" and not state.shaft_in_use():
        return  # the program stays non-dimensional, and says so
    for key, chart in drawn.items():
        assert (chart.x_label, chart.y_label) == (page[key].x_label, page[key].y_label)
        assert chart.x_range == pytest.approx(page[key].x_range)
        assert chart.y_range == pytest.approx(page[key].y_range, rel=1e-6)
        # where the line of a thin tongue begins depends on the grid, and the page's is finer
        pairs = zip(
            *(
                [curve for curve in one.curves("lines") if not curve.name.startswith("thin tongue")]
                for one in (chart, page[key])
            ),
            strict=False,
        )
        for ours, theirs in pairs:
            assert ours.name == theirs.name
            np.testing.assert_allclose(ours.x, theirs.x, rtol=1e-6, atol=1e-9)
            np.testing.assert_allclose(ours.y, theirs.y, rtol=1e-6, atol=1e-9)


def run_notebook(text, folder):
    """Check a notebook against the format nbformat 4.5 and run its cells in order."""
    notebook = json.loads(text)
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    assert notebook["metadata"]["kernelspec"].keys() >= {"name", "display_name"}
    ids = [cell["id"] for cell in notebook["cells"]]
    assert len(set(ids)) == len(ids)
    names = {}
    with redirect_stdout(StringIO()) as printed, chdir(folder):
        for cell in notebook["cells"]:
            assert isinstance(cell["source"], list)
            assert cell["metadata"] == {}
            if cell["cell_type"] == "code":
                assert (cell["outputs"], cell["execution_count"]) == ([], None)
                exec(compile("".join(cell["source"]), cell["id"], "exec"), names)
            else:
                assert cell["cell_type"] == "markdown"
    return names, printed.getvalue()


def test_the_cells_of_the_notebook_run_in_order(tmp_path, monkeypatch):
    monkeypatch.setattr(holoviews, "save", lambda *_, **__: None)
    state = State(**MARKED, highest_frequency=3.0)
    cells = python_cells(state)
    text = notebook_text(cells)
    names, printed = run_notebook(text, tmp_path)
    assert "whirl frequencies:" in printed
    assert len(names["view"]) == 6
    program = program_text(cells)
    for cell in json.loads(text)["cells"]:
        if cell["cell_type"] == "code":
            assert f"# %%\n{''.join(cell['source'])}\n" in program


def test_without_holoviews_the_numbers_are_printed(tmp_path, monkeypatch):
    load = builtins.__import__

    def missing(name, *arguments, **options):
        if name == "holoviews":
            raise ImportError(name)
        return load(name, *arguments, **options)

    monkeypatch.setattr(builtins, "__import__", missing)
    text = notebook_text(python_cells(State(highest_frequency=3.0)))
    names, printed = run_notebook(text, tmp_path)
    assert names["view"] is None
    assert "whirl frequencies:" in printed
    assert "pip install 'rotorstab[app]'" in printed
    assert list(tmp_path.iterdir()) == []


def test_it_starts_from_si_data_exactly_where_the_charts_show_that_shaft(ran):
    state, names, text, printed = ran
    in_si = state.units == "SI" and state.shaft_in_use()
    assert ("ShaftDisk.from_si" in text) == in_si
    assert ("scales" in names) == in_si
    assert ("one unit of load is" in text) == (state.units == "SI" and not in_si)
    assert max(map(len, text.splitlines())) < 200
    assert ("Hz" in printed) == in_si
    for tongue in names["tongues"]:
        assert tongue.name in printed
    if in_si:
        numbers = solve(state).numbers
        assert f"{numbers['static_load'] * names['scales'].load:.6g}"[:5] in printed


def test_a_program_names_a_stiffness_law_that_is_added_and_refuses_one_that_is_not(monkeypatch):
    state = State()
    state.param.law.objects = ["linear", "exact", "another"]
    state.law = "another"
    with pytest.raises(ValueError, match="must be one of 'linear', 'exact', got 'another'"):
        python_cells(state)
    monkeypatch.setitem(STIFFNESS_LAWS, "another", STIFFNESS_LAWS["exact"])
    assert "system = lumped(rotor, 2.0, stiffness='another')" in program_text(python_cells(state))
