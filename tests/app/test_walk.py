"""One walk through the page: click, look inside, pin, share, reopen, export."""

import pytest

pytestmark = pytest.mark.browser


def test_click_inspect_pin_share_reopen_export(page, open_page):
    chart = page.locator("[id='page-explore'], [data-page='explore']").locator(".plot.tall").first
    box = chart.bounding_box()
    page.mouse.click(box["x"] + 0.35 * box["width"], box["y"] + 0.5 * box["height"])
    page.wait_for_function("rotorstab.last.values.marker_follows === false")
    page.get_by_role("heading", name="The shaft in motion").wait_for(state="visible")

    page.locator(".pins summary").click()
    page.get_by_role("button", name="Pin curves").click()
    page.get_by_role("button", name="Compare the settings").click()
    page.get_by_role("heading", name="Pinned curves").wait_for(state="visible")
    page.keyboard.press("Escape")

    page.evaluate("rotorstab.change('spin_speed', 1.25)")
    page.wait_for_function(
        "rotorstab.last.values.spin_speed === 1.25 && location.search.includes('spin=1.25')"
    )
    wanted = page.evaluate("rotorstab.last.values")
    link = page.evaluate("location.pathname + location.search")
    page.evaluate("rotorstab.send({ type: 'unpin', number: 1 })")

    again = open_page(1280, 900, link)
    assert again.evaluate("rotorstab.last.values") == pytest.approx(wanted)
    again.locator(".marker-handle").wait_for(state="visible")

    with again.expect_download(timeout=60_000) as download:
        again.locator("select.export[data-chart='instability']").select_option("csv")
    text = download.value.path().read_text(encoding="utf-8")
    assert "spin_speed = 1.25" in text
    assert "growth rate" in text
