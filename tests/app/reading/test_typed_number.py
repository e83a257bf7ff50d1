"""Numbers as people type them: one reading is taken, two readings are refused."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.reading.numbers import read_number

READ = [
    ("0.3", 0.3),
    ("0,3", 0.3),
    (",3", 0.3),
    ("0,300", 0.3),  # no thousands begin with 0
    ("12,5", 12.5),
    ("1,4012", 1.4012),
    ("-1,25", -1.25),
    ("−1,25", -1.25),
    ("1,5e-3", 1.5e-3),
    ("1,200.5", 1200.5),
    ("1.200,5", 1200.5),
    ("1,200,000", 1.2e6),
    ("1.200.000", 1.2e6),
    ("1 200", 1200),
    ("1\u202f200,5", 1200.5),
    ("1\u00a0200", 1200),
    ("1'200", 1200),
    ("1’200.25", 1200.25),
    ("1_200", 1200),
    ("1.200", 1.2),  # a point is a decimal sign, as in every file and program
    ("7850", 7850),
    ("+2", 2),
    ("2.", 2),
    ("1E3", 1000),
    (" 5 ", 5),
]
NOT_READ = ["", " ", "nan", "inf", "1e", "0x10", "1,2,3", "12,34,567", "1 20", "1..2", "1,2.3,4"]
NOT_READ += ["--1", "1 2", "1_2", "٣", "5 mm", "true", "1,,2", ",", ".", "1.2.3"]
TWO_READINGS = [
    ("1,200", "1.2 or 1200"),
    ("-1,200", "-1.2 or -1200"),
    ("12,345", "12.345 or 12345"),
    ("999,000", "999 or 999000"),
    ("1,401e3", "1401 or 1401000"),
]


@pytest.mark.parametrize(("text", "value"), READ)
def test_one_reading_is_taken(text, value):
    assert read_number(text) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(("text", "readings"), TWO_READINGS)
def test_two_readings_are_refused_and_both_are_named(text, readings):
    with pytest.raises(ValueError, match=f"can mean {readings}: write one"):
        read_number(text)


@pytest.mark.parametrize("text", NOT_READ)
def test_what_is_no_number_is_refused(text):
    with pytest.raises(ValueError, match="is not a number"):
        read_number(text)


def test_a_number_beyond_a_float_is_refused():
    with pytest.raises(ValueError, match="'1e999' is too large"):
        read_number("1e999")


@given(st.floats(-1e300, 1e300))
def test_what_python_writes_reads_back(value):
    assert read_number(repr(value)) == value
    assert read_number(f"{value:.10g}") == float(f"{value:.10g}")


@given(st.text(max_size=30) | st.text("0123456789,.'_ +-−eE", max_size=20))
def test_any_text_is_a_finite_number_or_refused_in_a_short_line(text):
    words = ""
    try:
        assert math.isfinite(read_number(text))
    except ValueError as error:
        words = str(error)
    assert len(words) < 120
    assert words.isprintable()


@pytest.mark.browser
def test_the_boxes_of_the_page_read_by_the_same_rules(page):
    def typed(texts):
        return page.evaluate("(texts) => texts.map((text) => rotorstab.typed(text))", texts)

    assert [one["value"] for one in typed([text for text, _ in READ])] == pytest.approx(
        [value for _, value in READ], rel=1e-15
    )
    assert not [one for one in typed(NOT_READ) if "doubt" in one or one["value"] == one["value"]]
    for (_, readings), one in zip(
        TWO_READINGS, typed([text for text, _ in TWO_READINGS]), strict=True
    ):
        assert f"can mean {readings}: write one of them" in one["doubt"]


@pytest.mark.browser
def test_a_box_refuses_a_comma_with_two_readings(page):
    page.locator("details.group summary").last.evaluate(
        "(one) => one.getRootNode().querySelectorAll('details').forEach((d) => { d.open = true })"
    )
    box = page.locator("#rs-si_disk_mass")
    error = page.locator("#rs-si_disk_mass-error")
    before = page.evaluate("rotorstab.last.values.si_disk_mass")
    for typed, readings in (("1,200", "1.2 or 1200"), ("12,500", "12.5 or 12500")):
        box.fill(typed)
        box.press("Enter")
        error.filter(has_text=f"typed as {typed}, which can mean {readings}").wait_for()
    assert page.evaluate("rotorstab.last.values.si_disk_mass") == before
    box.fill("1,25")
    box.press("Enter")
    page.wait_for_function("rotorstab.last.values.si_disk_mass === 1.25")
    assert error.text_content() == ""
