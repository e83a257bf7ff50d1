"""The examples run as they are, and say what the theory says."""

import runpy
from pathlib import Path

import pytest

pytest.importorskip("holoviews")
pytest.importorskip("matplotlib")

EXAMPLES = Path(__file__).parents[1] / "examples"


# a fine map with eight coordinates takes a quarter of a minute
@pytest.mark.long
@pytest.mark.filterwarnings("ignore::rotorstab.NotCarriedOver")
def test_a_ross_file_becomes_a_map_and_a_figure(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(EXAMPLES / "any_rotor.py"), run_name="__main__")
    out = capsys.readouterr().out
    assert "buckling load 205.2 kN, first natural frequency 87.3 rad/s" in out
    assert "30.8% of the map is unstable" in out
    assert (tmp_path / "any_rotor.pdf").read_bytes().startswith(b"%PDF-")


def test_figure_6_in_ten_lines(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(EXAMPLES / "figure_6.py"), run_name="__main__")
    out = capsys.readouterr().out
    assert "agree: With a higher α_s the regions shift left" in out
    # between the rows of the chart: a little off 1.73774 and 2.23094
    assert "1B: θ/ω_n = 1.7377" in out
    assert "1F: θ/ω_n = 2.2309" in out
    assert (tmp_path / "figure_6.pdf").read_bytes().startswith(b"%PDF-")
