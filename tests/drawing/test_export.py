"""Files: exactly the plotted arrays, whole or not at all, the same every time."""

import csv
import json
import os
import re
from dataclasses import replace
from io import StringIO
from itertools import groupby

import numpy as np
import pytest

from rotorstab.drawing import tables
from rotorstab.drawing.files import write_file
from rotorstab.paper import FIGURES, table_1


@pytest.mark.parametrize("number", FIGURES)
def test_csv_and_json_hold_exactly_the_plotted_arrays(number):
    figure = FIGURES[number]()
    text = tables.figure_csv(figure)
    comments = [line for line in text.splitlines() if line.startswith("#")]
    assert comments[0].startswith(f"# Figure {number}. ")
    for name, value in figure.parameters.items():
        assert f"#   {name} = {json.dumps(value, ensure_ascii=False)}" in comments
    for panel in figure.panels:
        assert any(
            line.startswith(f"# panel {panel.letter}: ") and f"[{panel.x.unit}]" in line
            for line in comments
        )
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    written = {
        key: np.array([[float(row[axis] or "nan") for axis in "xy"] for row in group]).T
        for key, group in groupby(rows, lambda row: (row["panel"], row["kind"], row["name"]))
    }
    drawn = {
        (panel.letter, kind, one.name): one
        for panel in figure.panels
        for kind, ones in (("line", panel.series), ("region", panel.regions))
        for one in ones
    }
    assert list(written) == list(drawn)
    loaded = json.loads(tables.figure_json(figure), parse_constant=pytest.fail)
    panels = {panel["letter"]: panel for panel in loaded["panels"]}
    for (letter, kind, name), one in drawn.items():
        np.testing.assert_array_equal(written[letter, kind, name], [one.x, one.y])
        curves = panels[letter]["lines" if kind == "line" else "regions"]
        curve = next(curve for curve in curves if curve["name"] == name)
        np.testing.assert_array_equal(np.array(curve["y"], float), one.y)
    assert loaded["parameters"] == dict(figure.parameters)
    assert len(loaded["reading"]) == len(figure.reading)


def test_table_is_written_with_empty_cells_for_what_the_paper_lacks():
    table = table_1()
    rows = list(csv.DictReader(tables.table_csv(table).splitlines()[1:]))
    assert [float(row["rotorstab"]) for row in rows] == [row.ours for row in table.rows]
    assert [row["paper"] == "" for row in rows] == [row.text is None for row in table.rows]
    loaded = json.loads(tables.table_json(table))
    assert [row["paper"] for row in loaded["rows"]] == [row.text for row in table.rows]


def test_columns_write_nan_as_nothing():
    columns = {"a": [1.0, float("nan")], "b": ["x", "y"]}
    text = tables.columns_csv("Title", ["detail"], {"k": 1}, columns)
    assert text.splitlines()[-3:] == ["a,b", "1.0,x", ",y"]
    assert json.loads(tables.columns_json("Title", [], {}, columns))["columns"]["a"] == [1.0, None]


def test_a_file_is_not_overwritten_unless_told(tmp_path):
    path = tmp_path / "a.csv"
    assert write_file(path, "one") == path
    with pytest.raises(FileExistsError, match=r"a\.csv exists and is not overwritten"):
        write_file(path, "two")
    assert path.read_text() == "one"
    write_file(path, b"two", overwrite=True)
    assert path.read_text() == "two"
    assert os.listdir(tmp_path) == ["a.csv"]


def test_a_failed_write_leaves_nothing_and_the_old_file_whole(tmp_path, monkeypatch):
    path = tmp_path / "a.csv"
    write_file(path, "old")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        write_file(path, "new", overwrite=True)
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["a.csv"]


def test_a_missing_directory_is_named(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"missing/a\.csv"):
        write_file(tmp_path / "missing" / "a.csv", "x")


def test_files_follow_the_umask(tmp_path):
    before = os.umask(0o027)
    try:
        path = write_file(tmp_path / "a.csv", "x")
    finally:
        os.umask(before)
    assert path.stat().st_mode & 0o777 == 0o640


FORMULAS = ["=1+1", "+1+1", "-1+1", "@SUM(1)", "=cmd|' /C calc'!A0", "  =1+1", "\t=1", "\r=1"]
FORMULAS += ["＝1", "\n=1", "-", "%A"]


@pytest.mark.parametrize("text", FORMULAS)
def test_no_text_of_a_user_is_computed_by_a_spreadsheet(text):
    figure = FIGURES[2]()
    panel = figure.panels[0]
    (layer,) = panel.layers
    names = [f"{text}: {name}" for name in layer.columns["name"]]
    renamed = replace(layer, columns={**layer.columns, "name": names})
    figure = replace(figure, panels=(replace(panel, layers=(renamed,)),))
    written = tables.figure_csv(figure)
    rows = list(csv.DictReader(StringIO(written[written.index("panel,kind") :], newline="")))
    safe = "'" + re.sub(r"[\t\r\n]", " ", text)
    found = {row["name"] for row in rows if row["kind"] == "line"}
    assert found == {f"{safe}: {one.name}" for one in panel.series}
    columns = {"a": [text], "b": [-1.5], "c": ["-1.5"], "d": ["1B+1F"]}
    *_, last = csv.reader(StringIO(tables.columns_csv("t", (), {}, columns), newline=""))
    assert last == [safe, "-1.5", "-1.5", "1B+1F"]
