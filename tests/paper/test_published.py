"""Every published value is met, and the validation document says what the code says."""

import re
from pathlib import Path

import pytest

from rotorstab.paper import validation
from rotorstab.paper.published import PUBLISHED

DOCUMENT = Path(__file__).parents[2] / "docs" / "validation.md"
NUMBER = re.compile(r"[-−]?\d+\.?\d*(?:e-?\d+)?")


@pytest.fixture(scope="module")
def document(shared_paper):
    """The document as the code makes it now."""
    return validation.validation_markdown()


@pytest.mark.parametrize("one", PUBLISHED, ids=lambda one: one.quantity)
def test_published_value_is_met(one):
    assert one.ours() == pytest.approx(one.value, rel=0, abs=one.allowed)


def test_every_value_has_a_source_and_a_tolerance():
    for one in PUBLISHED:
        assert one.source
        assert one.quantity
        assert 0 < one.allowed <= 0.1 * abs(one.value)


def test_the_validation_document_is_not_stale(document):
    """Equal words, and numbers equal to two units of their last printed digit."""
    written = DOCUMENT.read_text(encoding="utf-8")
    advice = "stale: python -m rotorstab validation --output docs/validation.md --force"
    assert NUMBER.split(written) == NUMBER.split(document), advice
    for old, new in zip(NUMBER.findall(written), NUMBER.findall(document), strict=True):
        digits = len(old.partition("e")[0].partition(".")[2])
        step = 10.0**-digits if digits else 0.0
        first, second = (float(number.replace("−", "-")) for number in (old, new))
        assert abs(first - second) <= 2.0001 * step, advice


def test_nothing_published_is_missed(document):
    assert "**no**" not in document
