"""The report: one page of A4, the marked point, the pins, and an address that can be followed."""

import re
from base64 import b64decode
from queue import Queue

import pytest

from app.exports.report import page_address
from app.session import Session


@pytest.mark.parametrize(
    "given",
    ["https://rotor.example/app", "http://127.0.0.1:5006/app", "http://[::1]:5006/lab/app"],
)
def test_a_pages_own_address_is_taken(given):
    assert page_address(given) == given


@pytest.mark.parametrize(
    "given",
    [
        None,
        3,
        "",
        "javascript:alert(1)",
        "https://a/app?x",
        "https://a/<b>",
        'https://a/"',
        "https://a/" + "b" * 400,
        "https://user@a/app",
        "https://a/app\n",
    ],
)
def test_anything_else_is_no_address(given):
    assert page_address(given) == ""


def made(*messages, **report):
    session = Session()
    for message in messages:
        session.respond(message)
    told = Queue()
    session.controls.send = told.put
    assert "making" in session.respond({"type": "report", **report})["toast"]
    return b64decode(told.get(timeout=120)["file"]["base64"]).decode()


@pytest.fixture(scope="module")
def full():
    """In SI, with two kinds of damping, a marker and every pin: the longest there is."""
    values = {"units": "SI", "spin_speed": 1.0, "external_damping": 0.02, "internal_damping": 0.01}
    values |= {"marker": True, "marker_frequency": 2.0, "marker_factor": 0.3}
    values |= {"lowest_frequency": 1.0}  # maps of slow loads take seconds with damping
    pins = []
    for number in range(3):
        # without damping, where a map takes a tenth of the time
        pins += [{"type": "change", "values": {"spin_speed": 0.2 * number}}]
        pins += [{"type": "pin", "label": f"a rather long name {number}"}]
    return made(*pins, {"type": "change", "values": values}, at="https://rotor.example/app")


def test_it_holds_the_marker_the_pins_and_the_address(full):
    assert re.search(r"The marked point: (Unstable|Stable): .* At θ/2π", full)
    assert "a rather long name 0, a rather long name 1, a rather long name 2." in full
    assert re.search(r'<a href="https://rotor\.example/app\?v=1&amp;[^"<>]*">', full)


@pytest.mark.browser
def test_it_is_one_page_of_a4(browser, full):
    page = browser.new_page()
    page.set_content(full)
    printed = page.pdf(prefer_css_page_size=True)
    page.close()
    assert len(re.findall(rb"/Type\s*/Page\b", printed)) == 1
