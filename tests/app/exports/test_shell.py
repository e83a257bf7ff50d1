"""`rotorstab picture`: a link, a query or a rotor file as a picture, or one line of error."""

import os
from importlib.metadata import entry_points

import pytest

from app.exports.shell import described_sheet
from app.session import Session
from rotorstab.__main__ import main
from tests.testing.pictures import metadata

AT = "https://rotor.example/lab/app"
ROTOR = """[nondimensional]
shear = 0.01
disk_mass = 5.0
diametral_inertia = 0.8
polar_inertia = 1.6
"""


@pytest.fixture(autouse=True)
def _installed():
    if not entry_points(group="rotorstab.commands"):
        pytest.fail("rotorstab is not installed as pyproject.toml says", pytrace=False)


@pytest.fixture(scope="module")
def link():
    """A link as the page gives it, with a marked point and a pin."""
    session = Session()
    session.respond({"type": "change", "values": {"spin_speed": 1.0}})
    session.respond({"type": "pin", "label": "slow"})
    values = {"spin_speed": 1.5, "marker": True, "marker_frequency": 1.7, "marker_factor": 0.4}
    session.respond({"type": "change", "values": values})
    return f"{AT}?{session.query()}"


def test_a_link_is_drawn_over_a_file_by_force(link, tmp_path, capsys):
    """In the format of the file; `test_picture.py` has every format."""
    path = tmp_path / "lab.PNG"
    path.write_text("mine")
    assert main(["picture", link, "--output", str(path), "--force"]) == 0
    assert capsys.readouterr() == ("", "")
    found = metadata(path.read_bytes(), "png")
    assert found["link"] == link
    assert "spin_speed = 1.5; " in found["parameters"]


def test_what_a_link_shows_is_what_the_page_shows(link):
    sheet = described_sheet(link + "#explore")
    assert sheet.link == link
    assert sheet.sentence
    assert "slow (Ω̄ = 1)" in sheet.paragraphs[-1]
    labels = [("pinned boundary", "pinned edge"), ("pins",)]
    for chart, pinned in zip(sheet.charts, labels, strict=False):
        for label in pinned:
            assert chart.layer(label).columns["name"][0].startswith("slow: ")


@pytest.mark.parametrize(
    "text", ["as=0.3&spin=1", "?as=0.3&spin=1", f"{AT}?spin=1&as=0.3&utm_id=4"]
)
def test_a_query_is_read_with_defaults_for_the_rest(text):
    parameters = described_sheet(text).parameters
    assert (parameters["static_load_factor"], parameters["spin_speed"]) == (0.3, 1.0)
    assert parameters["load_type"] == "axial"


def test_a_link_without_a_query_is_the_first_view():
    assert described_sheet(AT).parameters["spin_speed"] == 2.0


def test_a_rotor_file_is_drawn(tmp_path):
    file = tmp_path / "rotor.toml"
    file.write_text(ROTOR + "[operation]\nspin_speed = 1.5\n")
    parameters = described_sheet(str(file)).parameters
    assert (parameters["shear"], parameters["spin_speed"]) == (0.01, 1.5)


def failure(capsys, *arguments):
    """Run the command with arguments that are wrong; return its one line."""
    assert main(["picture", *map(str, arguments)]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    (line,) = err.splitlines()
    return line


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("nonsense", "'nonsense' is neither a link, nor a query such as as=0.5&spin=2, nor a"),
        ("as=0.5&colour=red", "the link is not understood: colour"),
        (f"{AT}?spin=99", "the link is not understood: spin (must be a number from 0 to 4)"),
        ("as=1,200", "the link is not understood: as ("),
        ("v=9&as=0.5", "the link is not understood: v"),
        ("p1=spin_99~~slow", "the link is not understood: p1 (spin must be a number from 0 to 4)"),
        ("ftp://host/app?as=0.5", "'ftp://host/app?as=0.5' is not a link to the dashboard"),
        ("http://[1/app?as=0.5", "'http://[1/app?as=0.5' is not a link to the dashboard"),
        ("ref=flutter&spin=0&phi=0.1&md=9&id=0.02", "This rotor has no flutter load below"),
        ("missing.toml", "No such file or directory: missing.toml"),
        ("a=" + "b" * 10_000, "the link is not understood: a"),
    ],
)
def test_what_is_not_understood_is_said_in_one_line(text, words, tmp_path, capsys):
    line = failure(capsys, text, "--output", tmp_path / "lab.pdf")
    assert line.startswith(f"rotorstab: {words}")
    assert os.listdir(tmp_path) == []


def test_a_rotor_file_with_an_error_is_named(tmp_path, capsys):
    file = tmp_path / "rotor.toml"
    for text, words in (
        ("[shaft]\nlength = 1\n", "the file lacks [disk]"),
        (ROTOR + "[operation]\nspin_speed = 99.0\n", "operation.spin_speed"),
        (b"\xff\xfe", "is not a text in UTF-8"),
    ):
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        line = failure(capsys, file, "--output", tmp_path / "lab.pdf")
        assert str(file) in line
        assert words in line


def test_an_output_that_cannot_be_written_is_said_in_one_line(tmp_path, capsys):
    path = tmp_path / "lab.pdf"
    line = failure(capsys, "as=0.5", "--output", tmp_path / "lab.jpg")
    assert line.startswith("rotorstab: `--output` must end in .pdf, .svg, .png, got ")
    path.write_text("mine")
    assert "exists; --force overwrites it" in failure(capsys, "as=0.5", "--output", path)
    assert path.read_text() == "mine"
    missing = tmp_path / "missing" / "lab.pdf"
    line = failure(capsys, "as=0.5", "--output", missing)
    assert line == f"rotorstab: No such file or directory: {missing}"
    assert "--output" in failure(capsys, "as=0.5")
