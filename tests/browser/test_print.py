"""Print: light on paper whatever the theme, no controls, whole charts, and the parameters."""

import pytest

from tests.testing.page import settle, visit

pytestmark = pytest.mark.browser

# share of the pixels of a picture that are nearly white, and of those that are neither
LIGHT = """(image) => {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
  const context = canvas.getContext("2d");
  context.fillStyle = "white";
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
  let faint = 0, dark = 0;
  for (let i = 0; i < data.length; i += 4) {
    const sum = data[i] + data[i + 1] + data[i + 2];
    if (sum < 300) dark += 1;
    if (sum > 600 && sum < 720) faint += 1;
  }
  return [dark / (data.length / 4), faint / (data.length / 4)];
}"""


def printed(page):
    page.emulate_media(media="print")
    page.wait_for_function("document.querySelectorAll('.print-chart').length > 0")
    page.wait_for_function(
        "[...document.querySelectorAll('.print-chart')].every((one) => one.complete)"
    )


def test_explore_is_printed_as_a_sheet_in_light_colours(page):
    page.get_by_role("button", name="Dark").click()
    page.evaluate("rotorstab.change('marker', true)")
    settle(page, "marker", True)
    page.evaluate("rotorstab.send({ type: 'pin', label: '' })")
    before = page.evaluate("rotorstab.last.inspector.sentence")
    page.evaluate("rotorstab.change('spin_speed', 1.5)")
    page.wait_for_function("(before) => rotorstab.last.inspector.sentence !== before", arg=before)
    values = settle(page, "spin_speed", 1.5)
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
    printed(page)
    sheet = page.locator(".print-sheet")
    assert sheet.is_visible()
    assert (
        not page.locator("header.top, #sidebar, main button, main select")
        .filter(visible=True)
        .count()
    )
    names = sheet.locator("img").evaluate_all("(all) => all.map((one) => one.alt)")
    assert names == [
        "instability",
        "load-frequency",
        "campbell",
        "response",
        "multipliers",
        "orbit",
    ]
    words = sheet.text_content()
    assert page.evaluate("rotorstab.last.inspector.sentence")[:40].split("_")[0] in words
    assert "Pin A" in words
    parameters = dict(
        zip(
            sheet.locator("dt").all_text_contents(),
            sheet.locator("dd").all_text_contents(),
            strict=True,
        )
    )
    assert float(parameters["Spin speed Ω̄"]) == values["spin_speed"]
    assert float(parameters["Static load factor αs"]) == values["static_load_factor"]
    assert page.evaluate("rotorstab.last.query") in words
    for image in sheet.locator("img").all():
        dark, _ = image.evaluate(LIGHT)
        assert dark > 0.001  # the letters of the axes are dark, as on white paper
        box = image.bounding_box()
        assert box["width"] > 100
    pdf = page.pdf(prefer_css_page_size=True, print_background=True)
    assert pdf.startswith(b"%PDF")
    page.emulate_media(media="screen")
    page.wait_for_function("!document.querySelector('.print-sheet')")
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"


def test_another_page_is_printed_without_controls(page):
    visit(page, "stiffness")
    printed(page)
    assert page.locator(".print-chart").filter(visible=True).count() == 5
    assert not page.locator("header.top, #sidebar, select").filter(visible=True).count()
    page.emulate_media(media="screen")
    page.wait_for_function("!document.querySelector('.print-sheet')")
