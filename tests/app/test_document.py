"""The HTML of the whole page."""

import pytest

from app.document import with_subscripts


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("at β_d = 0.1", 'at <span class="symbol">β<sub>d</sub></span> = 0.1'),
        ("p̄_cr", '<span class="symbol">p̄<sub>cr</sub></span>'),
        ("<b> x", "&lt;b&gt; x"),
        ("", ""),
    ],
)
def test_a_text_of_the_first_paint_has_its_subscripts(text, html):
    assert str(with_subscripts(text)) == html
