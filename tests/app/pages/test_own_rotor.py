"""The page Your rotor without a browser: examples, files, sliders, and what the library says."""

import base64
import math
import zlib
from urllib.parse import parse_qsl

import numpy as np
import pytest

from app.results import growth_maps
from app.results.own_charts import OWN_CHARTS
from app.session import Session
from app.state import State
from app.state.own_file import LARGEST_OWN_FILE, MOST_ELEMENTS, open_rotor
from app.state.own_link import packed
from app.state.own_presets import OWN_PRESETS
from rotorstab import (
    MATERIALS,
    Bearing,
    Disk,
    Rotor,
    ShaftSection,
    critical_speeds,
    growth_rate,
    resonances,
    whirl_frequencies,
)
from rotorstab.rotors.rotor_file import rotor_from_toml, rotor_to_toml
from tests.rotors.test_ross import as_json, as_toml, ross
from tests.testing.rotors import FRISWELL_597, FRISWELL_599, OIL_FILM, STEEL, UNEQUAL


@pytest.fixture(scope="module")
def shared():
    return Session()


@pytest.fixture
def session(shared):
    shared.respond({"type": "reset"})
    shared.respond({"type": "page", "name": "rotor"})
    return shared


def change(session, **values):
    return session.respond({"type": "change", "values": values})


def open_text(session, text, name="rotor.toml"):
    answer = session.respond({"type": "own_file", "text": text, "name": name})
    return answer["own_opened"]["problem"], answer


def columns(session, key, label):
    return session.pages["rotor"].charts[key].sources[label].data


def hertz(frequency):
    return frequency / math.tau


def test_the_examples_are_the_rotors_of_the_book():
    for name, rotor in (("two-disks", FRISWELL_597), ("overhung", FRISWELL_599)):
        ours = OWN_PRESETS[name].rotor
        assert ours.critical_load() == pytest.approx(rotor.critical_load(), rel=1e-12)
        found, wanted = (whirl_frequencies(one.system(400.0), 1e5) for one in (ours, rotor))
        np.testing.assert_allclose(found, wanted, rtol=1e-9)
    assert OWN_PRESETS["paper"].rotor.critical_load() == pytest.approx(16.034e3, rel=1e-4)


@pytest.mark.parametrize("name", OWN_PRESETS)
def test_every_example_has_all_charts(session, name):
    answer = change(session, own_rotor=name, own_spin=0.7)
    assert (answer["notice"], answer["errors"]) == ("", {})
    assert set(session.pages["rotor"].charts) == set(OWN_CHARTS)
    assert answer["own"]["source"] == OWN_PRESETS[name].source
    assert len(columns(session, "rotor-drawing", "parts")["xs"]) >= 3
    for key in ("rotor-campbell", "rotor-load-frequency"):
        assert len(columns(session, key, "whirl")["xs"]) >= 2
    # until the growth is there the chart shows the tongues of first order
    assert answer["own"]["waits"]
    assert len(columns(session, "rotor-instability", "first-order tongues")["xs"]) >= 1


def test_the_growth_is_that_of_the_whole_rotor(session):
    change(session, own_rotor="overhung", own_spin=0.8, own_load=0.3)
    answer = session.respond({"type": "settle"})
    assert not answer["own"]["waits"]
    assert columns(session, "rotor-instability", "first-order tongues")["xs"] == []
    page, rotor = session.pages["rotor"], FRISWELL_599
    model = page.operation(session.state).model
    spin = 0.8 * model.scales.frequency
    load = rotor.critical_load()
    system = rotor.system(spin)
    tongue = resonances(system, 0.3 * load, 0.25 * load)["1B+1F"]
    wanted = growth_rate(system, 0.3 * load, 0.25 * load, tongue.centre)
    window = page.compute(session.state)["rotor-instability"].layer("growth").columns
    image = window["image"][0]
    rows, count = image.shape
    column = int(hertz(tongue.centre) / window["dw"][0] * count)
    row = int(0.25 * load / 1e3 / window["dh"][0] * rows)
    assert image[row, column] == pytest.approx(wanted, rel=0.1)
    # the marked point stands in this tongue
    facts = dict(answer["own"]["point"])
    place, growth = (
        float(facts[name].split("\N{NO-BREAK SPACE}")[0])
        for name in ("Excitation frequency", "Growth rate σ")
    )
    assert place == pytest.approx(hertz(tongue.centre), rel=1e-3)
    assert growth == pytest.approx(wanted, rel=0.02)
    assert answer["own"]["sentence"].endswith("Tongue 1B+1F.")


def test_the_curves_are_those_of_the_whole_rotor(session):
    change(session, own_rotor="two-disks", own_load=0.0)
    points = columns(session, "rotor-campbell", "critical speeds")
    speeds = critical_speeds(FRISWELL_597.system(0.0))
    wanted = np.sort([*speeds.forward, *speeds.backward])[:4]
    np.testing.assert_allclose(points["x"], wanted * 60 / math.tau, rtol=5e-3)
    np.testing.assert_allclose(points["y"], np.asarray(points["x"]) / 60)


def test_the_marked_point_is_where_it_is_put(session):
    answer = change(session, own_frequency=1.0, own_factor=0.1)
    scales = session.pages["rotor"].operation(session.state).model.scales
    assert answer["own"]["sentence"].startswith("Stable: the whirl neither grows nor decays.")
    assert "Growth rate σ" not in dict(answer["own"]["point"])
    marker = columns(session, "rotor-instability", "marker")
    assert marker["x"][0] == pytest.approx(hertz(scales.frequency))
    assert marker["y"][0] == pytest.approx(0.1 * scales.load / 1e3)


def test_a_rotor_of_two_planes_has_the_tongues_of_the_library(session):
    problem, _ = open_text(session, rotor_to_toml(UNEQUAL))
    assert problem == ""
    answer = change(session, own_spin=0.5)
    scales = session.pages["rotor"].operation(session.state).model.scales
    load = UNEQUAL.critical_load()
    table = resonances(UNEQUAL.system(0.5 * scales.frequency), 0.3 * load, 0.5 * load)
    drawn = columns(session, "rotor-instability", "tongue")
    assert {"1B+1B", "1F+1F"} <= set(drawn["name"])
    for name, place in zip(drawn["name"], drawn["x"], strict=True):
        assert place == pytest.approx(hertz(table[name].centre), rel=5e-3), name
    assert len(columns(session, "rotor-campbell", "whirl")["xs"]) >= 4
    assert any(name.startswith("Whirl 1") for name, _ in answer["own"]["facts"])


def test_oil_whirl_is_said_to_need_no_pulsation(session):
    problem, _ = open_text(session, rotor_to_toml(OIL_FILM))
    assert problem == ""
    answer = change(session, own_spin=0.5, own_factor=0.0)
    assert "Unstable, even without pulsation" in answer["own"]["sentence"]
    assert len(columns(session, "rotor-campbell", "whirl")["xs"]) >= 4


@pytest.mark.parametrize("write", [as_toml, as_json])
def test_a_ross_file_opens(session, write):
    given = {**ross(), "SealElement_Seal 0": {"n": 3, "color": "red"}}
    problem, answer = open_text(session, write(given), "compressor")
    assert problem == ""
    assert answer["values"]["own_rotor"] == "file"
    assert answer["own"]["source"] == "From the file compressor."
    assert any("SealElement" in note for note in answer["own"]["notes"])
    change(session, own_load=0.2)
    drawn = columns(session, "rotor-drawing", "parts")["name"]
    assert sum(name.startswith("section") for name in drawn) == 6
    assert sum(name.startswith("disk") for name in drawn) == 2


BAD = {
    "": "lacks [[sections]]",
    "nonsense": "line 1",
    "{": "JSON",
    "[[sections]]\nlength = 1": "line 2: sections[0].length: must be a length in quotes",
    '[[sections]]\nlength = "1 m"\nouter_diameter = "0 m"\nmaterial = "steel"': "outer_diameter",
    '[[sections]]\nlength = "1 m"\nouter_diameter = "1 m"\nmaterial = "cheese"': "line 4",
    "a" + ".a" * 32_000 + " = 1": "nested deeper",
    "[" * 70_000: "nested deeper",
    '{"ShaftElement_0": {"n": 0, "L": "x"}}': "ShaftElement_0",
    '{"ShaftElement_0": []}': "no ROSS rotor",
    "x" * (LARGEST_OWN_FILE + 1): "larger than 150 kB",
}


@pytest.mark.parametrize("text", BAD, ids=range(len(BAD)))
def test_a_bad_file_is_refused_with_its_place_and_loses_nothing(session, text):
    change(session, own_stiffness=1.5)
    before = session.state.inputs(), columns(session, "rotor-drawing", "parts")["name"]
    answer = session.respond({"type": "own_file", "text": text, "name": "a\nb"})
    problem = answer["own_opened"]["problem"]
    assert BAD[text] in problem
    assert "\n" not in problem
    assert len(problem) < 300
    assert (session.state.inputs(), columns(session, "rotor-drawing", "parts")["name"]) == before


def test_a_rotor_of_too_many_elements_is_refused():
    sections = (ShaftSection(0.01, 0.05, STEEL),) * (MOST_ELEMENTS + 1)
    opened = open_rotor(rotor_to_toml(Rotor(sections, bearings=(Bearing(0.0, 1e6),))))
    assert opened.rotor is None
    assert "more than 160 elements" in opened.problem


@pytest.mark.parametrize("message", [{}, {"text": 7}, {"text": None, "name": []}])
def test_a_forged_message_is_refused(session, message):
    answer = session.respond({"type": "own_file", **message})
    assert "larger than" in answer["own_opened"]["problem"]


def test_the_sliders_multiply_the_parts(session):
    change(session, own_disk_mass=2.0, own_inertia=3.0, own_stiffness=0.5, own_damping=4.0)
    answer = session.respond({"type": "own_save"})
    text = base64.b64decode(answer["file"]["base64"]).decode()
    saved = rotor_from_toml(text)
    for ours, given in zip(saved.disks, FRISWELL_597.disks, strict=True):
        assert ours.mass == pytest.approx(2 * given.mass)
        assert ours.polar_inertia == pytest.approx(3 * given.polar_inertia)
    assert saved.bearings[0].kxx == pytest.approx(0.5e6)
    # the saved file opens as the same rotor, with factors of 1
    problem, answer = open_text(session, text)
    assert problem == ""
    assert answer["values"]["own_disk_mass"] == 1.0
    again = base64.b64decode(session.respond({"type": "own_save"})["file"]["base64"]).decode()
    assert again == text


def test_a_free_rotor_is_said_to_have_no_buckling_load(session):
    free = Rotor((ShaftSection(1.5, 0.05, STEEL),), (Disk(0.7, 20.0, 0.1, 0.2),))
    problem, answer = open_text(session, rotor_to_toml(free))
    assert problem == ""
    assert "no buckling load" in " ".join(answer["own"]["notes"])
    assert answer["notice"] == ""


def test_a_link_holds_the_rotor_and_the_sliders(session):
    open_text(session, rotor_to_toml(UNEQUAL))
    query = change(session, own_spin=1.5, own_stiffness=2.0)["query"]
    assert len(query) < 1500
    session = Session({key: [value] for key, value in parse_qsl(query)})
    assert session.respond({"type": "hello"})["address_notice"] == ""
    answer = session.respond({"type": "page", "name": "rotor"})
    assert (session.state.own_spin, session.state.own_stiffness) == (1.5, 2.0)
    assert answer["own"]["source"] == "From this link."
    assert session.pages["rotor"].rotor(session.state) == UNEQUAL
    assert answer["query"] == query
    # an example needs no rotor in the link
    assert "own=" not in change(session, own_rotor="paper")["query"]


BOMB = base64.urlsafe_b64encode(zlib.compress(b"#" * 2_000_000, 9)).decode().rstrip("=")


@pytest.mark.parametrize(
    "given", [["x" * 5000], ["AAAA"], ["ä"], [b"\xff\xfe"], ["a", "b"], [], [BOMB], ["eJwDAAAAAAE"]]
)
def test_a_bad_link_shows_an_example_and_says_so(given):
    session = Session({"rotor": ["file"], "own": given})
    answer = session.respond({"type": "page", "name": "rotor"})
    assert "Shown is an example." in answer["own"]["source"]
    assert answer["notice"] == ""
    assert State().own_rotor in OWN_PRESETS


def test_a_large_rotor_is_a_file():
    sizes = np.random.default_rng(1).uniform(0.01, 0.05, (120, 2))
    sections = tuple(ShaftSection(length, diameter, STEEL) for length, diameter in sizes)
    assert packed(Rotor(sections, bearings=(Bearing(0.0, 1e6),))) == ""


def test_the_map_is_kept_for_all_sessions(session):
    change(session, own_rotor="paper", own_spin=0.3)
    session.respond({"type": "settle"})
    other = Session()
    other.respond({"type": "page", "name": "rotor"})
    change(other, own_rotor="paper", own_spin=0.3)
    window = other.pages["rotor"].awaited(other.state)
    assert window is None
    growth_maps.clear()
    assert other.pages["rotor"].awaited(other.state) is not None


def test_a_long_file_is_read_elsewhere(session):
    text = rotor_to_toml(FRISWELL_599) + "# a comment\n" * 2000
    problem, answer = open_text(session, text, "long")
    assert problem == ""
    assert (answer["own_opening"], answer["own"]["source"]) == ("long", "From the file long.")


def edit(session, part, row, **what):
    return session.respond({"type": "own_edit", "part": part, "row": row, **what})


def test_the_tables_edit_the_rotor(session):
    change(session, own_rotor="two-disks")
    answer = edit(session, "disks", 1, key="mass", value=40)
    assert answer["own_edited"] == ""
    assert answer["own"]["source"] == "Two disks, two bearings, edited."
    assert answer["own"]["tables"]["disks"]["rows"][1][:2] == [1000.0, 40.0]
    edit(session, "bearings", 0, key="kyy", value=0.5)
    edit(session, "disks", 0, do="remove")
    edit(session, "sections", 0, key="material", value="steel")
    answer = edit(session, "sections", 0, key="inner_diameter", value=20)
    assert answer["own"]["tables"]["sections"]["rows"] == [[1500.0, 50.0, 20.0, "steel"]]
    saved = rotor_from_toml(
        base64.b64decode(session.respond({"type": "own_save"})["file"]["base64"]).decode()
    )
    assert len(saved.disks) == 1
    assert saved.bearings[0].kyy == 0.5e6
    # the shear coefficient follows the section
    hollow = ShaftSection(1.5, 0.05, MATERIALS["steel"], inner_diameter=0.02)
    assert saved.sections == (hollow,)
    answer = edit(session, "disks", 0, do="add")
    assert len(answer["own"]["tables"]["disks"]["rows"]) == 2
    assert answer["own"]["source"] == "Two disks, two bearings, edited."


@pytest.mark.parametrize(
    ("part", "row", "what", "words"),
    [
        ("disks", 0, {"key": "position", "value": 1600}, "must be"),
        ("disks", 0, {"key": "mass", "value": -1}, "mass must be"),
        ("disks", 0, {"key": "mass", "value": True}, "must be a number"),
        ("disks", 0, {"key": "mass", "value": 10**400}, "must be a number"),
        ("disks", 0, {"key": "colour", "value": 1}, "no such column"),
        ("disks", 7, {"key": "mass", "value": 1}, "no such row"),
        ("clamps", 0, {"do": "remove"}, "no such table"),
        ("sections", 0, {"key": "inner_diameter", "value": 50}, "must be smaller"),
        ("sections", 0, {"key": "material", "value": "cheese"}, "must be one of"),
        ("sections", 0, {"do": "remove"}, "one ShaftSection or more"),
    ],
)
def test_a_bad_edit_changes_nothing(session, part, row, what, words):
    change(session, own_rotor="two-disks")
    before = session.state.inputs(), session.respond({"type": "own_shown"})["own"]["tables"]
    answer = edit(session, part, row, **what)
    assert words in answer["own_edited"]
    assert (session.state.inputs(), answer["own"]["tables"]) == before
