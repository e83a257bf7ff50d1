"""Every file says what made it: title, parameters and link, to readers and to programs."""

import json

import pytest

pytest.importorskip("holoviews")
pytest.importorskip("matplotlib")

from rotorstab.drawing.formats import PICTURE_FORMATS
from rotorstab.drawing.printed import figure_files
from rotorstab.drawing.tables import figure_csv, figure_json
from rotorstab.paper import FIGURES, Figure
from tests.testing.pictures import metadata

LINK = "https://rotor.example/app?as=0.5&spin=2"
PARAMETERS = {"Φ (shear)": 0.0013, "name": 'a "b" \\ ü', "speeds": [0.0, 2.0]}


@pytest.fixture(scope="module")
def figure():
    paper = FIGURES[2](points=11)
    return Figure(None, "Títle (1)", "", PARAMETERS, paper.panels, footer="Φ = 0.0013", link=LINK)


@pytest.mark.parametrize("kind", PICTURE_FORMATS)
def test_a_picture_gives_title_parameters_and_link_to_programs(figure, kind):
    found = metadata(figure_files(figure, [kind])[kind], kind)
    assert found["title"] == "Títle (1)"
    assert found["link"] == LINK
    pairs = [part.split(" = ", 1) for part in found["parameters"].split("; ")]
    assert {name: json.loads(text) for name, text in pairs} == PARAMETERS


def test_a_pdf_can_be_clicked_at_its_link(figure):
    data = figure_files(figure, ["pdf"])["pdf"]
    assert b"/URI (https://rotor.example/app?as=0.5&spin=2)" in data


def test_tables_give_the_link(figure):
    assert f"# link: {LINK}" in figure_csv(figure).splitlines()
    assert json.loads(figure_json(figure))["link"] == LINK
    plain = FIGURES[2](points=11)
    assert "# link" not in figure_csv(plain)
    assert "Subject" not in metadata(figure_files(plain, ["pdf"])["pdf"], "pdf")
