"""Write pictures of every page and lesson, in both themes: `python -m docs.screenshots [FOLDER]`.

Serves the dashboard on a free loopback port and photographs it with headless Chromium.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from playwright.sync_api import Browser, Page, sync_playwright

from app.lessons import library
from tests.testing.browser import FLAGS, find_browser
from tests.testing.serving import Server

ROOT = Path(__file__).resolve().parent.parent
SIZES = {"wide": (1920, 1080), "desktop": (1280, 1000), "tablet": (820, 1100), "phone": (390, 844)}
PLACES = {
    "explore": "#explore",
    "stiffness": "#stiffness",
    "paper": "#paper",
    "lessons": "#lessons",
    **{f"lesson-{key}": f"#lesson/{key}/1" for key in library().lessons},
}
"""The views that one open page goes through, one after the other: it starts at the first."""
INSPECTOR = "?v=1&at=1&f=1.0844&b=0.5#explore"  # a marked point is opened anew
README = "explore-desktop-light.png"
# the answer to the last change of the address has come, and its charts are drawn
DRAWN = """([page, lesson]) => {
  const { last } = window.rotorstab ?? {};
  return last && last !== window.formerAnswer && last.page === page && last.at_rest
    && (page !== "explore" || last.settled) && Bokeh.documents[0]?.is_idle
    && (!lesson || document.querySelector("#lesson-title")?.textContent !== window.formerLesson);
}"""
MOVE = """(place) => {
  window.formerAnswer = rotorstab.last;
  window.formerLesson = document.querySelector("#lesson-title")?.textContent;
  location.hash = place;
}"""
PAINTED = 400  # ms for layout and colours of the charts
TOOLS = 1500  # ms: Bokeh puts tools in their places late


def open_tabs(browser: Browser, address: str) -> dict[str, Page]:
    """Open an address in one tab for each size, each with a storage of its own."""
    tabs = {}
    for size, (width, height) in SIZES.items():
        context = browser.new_context(
            color_scheme="light",
            device_scale_factor=1,
            viewport={"width": width, "height": height},
        )
        tabs[size] = context.new_page()
        tabs[size].goto(address, wait_until="commit")
    return tabs


def wait_until_drawn(tabs: dict[str, Page], view: str) -> None:
    """Wait until every tab shows a view."""
    lesson = view.startswith("lesson-")
    shown = "explore" if lesson or view == "inspector" else view
    for tab in tabs.values():
        tab.wait_for_function(DRAWN, arg=[shown, lesson], timeout=60_000)
        if lesson:
            tab.locator(".lesson").wait_for(state="visible")
        if view == "paper":
            tab.wait_for_function(
                "!document.querySelector('.panel:not([hidden])[data-waits]')", timeout=60_000
            )
    tab.wait_for_timeout(TOOLS)  # for every tab


def photograph(tabs: dict[str, Page], view: str) -> Iterator[tuple[str, bytes]]:
    """Picture a view in every tab, from its top to its end, in both themes.

    All tabs change together, so that they share the time that a change takes.
    """
    for size, tab in tabs.items():
        full = tab.evaluate("document.documentElement.scrollHeight")
        width, height = SIZES[size]
        tab.set_viewport_size({"width": width, "height": max(height, full)})
    for turn in range(2):
        if turn:
            for tab in tabs.values():
                tab.evaluate('document.querySelector("button.theme").click()')
        tab.wait_for_timeout(PAINTED)
        for size, tab in tabs.items():
            theme = tab.evaluate("document.documentElement.dataset.theme")
            yield f"{view}-{size}-{theme}.png", tab.screenshot()
    for size, tab in tabs.items():
        width, height = SIZES[size]
        tab.set_viewport_size({"width": width, "height": height})


def pictures(browser: Browser, origin: str) -> Iterator[tuple[str, bytes]]:
    """Picture every view in every size and theme; few pages are opened and each goes on."""
    tabs = open_tabs(browser, f"{origin}/app{next(iter(PLACES.values()))}")
    for number, (view, place) in enumerate(PLACES.items()):
        if number:
            for tab in tabs.values():
                tab.evaluate(MOVE, place)
        wait_until_drawn(tabs, view)
        yield from photograph(tabs, view)
    for tab in tabs.values():
        tab.context.close()
    tabs = open_tabs(browser, f"{origin}/app{INSPECTOR}")
    wait_until_drawn(tabs, "inspector")
    yield from photograph(tabs, "inspector")


def main(folder: str = "build/screenshots") -> None:
    """Write one picture for each view, size and theme into a folder, and the README's."""
    chromium = find_browser()
    if chromium is None:
        raise SystemExit("no Chromium found: set CHROMIUM=/path/to/chrome")
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as log, sync_playwright() as playwright:
        server = Server(Path(log) / "log.txt")
        try:
            server.wait()
            browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
            for name, picture in pictures(browser, server.origin):
                (target / name).write_bytes(picture)
                print(target / name)
            browser.close()
        finally:
            server.stop()
    shutil.copy(target / README, ROOT / "docs" / "images" / README)


if __name__ == "__main__":
    main(*sys.argv[1:2])
