"""Write pictures of every page and lesson, in both themes: `python -m docs.screenshots [FOLDER]`.

Serves the dashboard on a free loopback port and photographs it with headless Chromium.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from playwright.sync_api import BrowserContext, Page, sync_playwright

from app.lessons import library
from tests.testing.browser import FLAGS, find_browser
from tests.testing.serving import Server

ROOT = Path(__file__).resolve().parent.parent
VIEWS = {
    "explore": "#explore",
    "inspector": "?v=1&at=1&f=1.0844&b=0.5#explore",
    "stiffness": "#stiffness",
    "paper": "#paper",
    "lessons": "#lessons",
    **{f"lesson-{key}": f"#lesson/{key}/1" for key in library().lessons},
}
SIZES = {"wide": (1920, 1080), "desktop": (1280, 1000), "tablet": (820, 1100), "phone": (390, 844)}
README = "explore-desktop-light.png"
DRAWN = """(page) => window.rotorstab?.last?.page === page && rotorstab.last.at_rest
  && (page !== "explore" || rotorstab.last.settled) && Bokeh.documents[0]?.is_idle"""


def open_view(context: BrowserContext, address: str) -> dict[str, Page]:
    """Open a view in one tab for each size, all at the same time, and wait until all are drawn."""
    tabs = {}
    for size, (width, height) in SIZES.items():
        tabs[size] = context.new_page()
        tabs[size].set_viewport_size({"width": width, "height": height})
        tabs[size].goto(address, wait_until="commit")
    name = address.partition("#")[2]
    for tab in tabs.values():
        shown = "explore" if name.startswith("lesson/") else name
        tab.wait_for_function(DRAWN, arg=shown, timeout=60_000)
        if name.startswith("lesson/"):
            tab.locator(".lesson").wait_for(state="visible")
        if name == "paper":
            tab.wait_for_selector(".picture img", timeout=60_000)
    tab.wait_for_timeout(1500)  # for every tab: Bokeh puts tools in their places late
    return tabs


def photograph(tab: Page, width: int, height: int) -> Iterator[tuple[str, bytes]]:
    """Picture an open view from its top to its end, in both themes."""
    full = tab.evaluate("document.documentElement.scrollHeight")
    tab.set_viewport_size({"width": width, "height": max(height, full)})
    tab.wait_for_timeout(400)  # layout and colours of the charts
    yield "light", tab.screenshot()
    tab.evaluate(
        """() => {
          document.querySelector("button.theme").click();
          localStorage.removeItem("rotorstab-theme");  // other tabs open in the light
        }"""
    )
    tab.wait_for_timeout(400)
    yield "dark", tab.screenshot()


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
            context = browser.new_context(color_scheme="light", device_scale_factor=1)
            for view, place in VIEWS.items():
                tabs = open_view(context, f"{server.origin}/app{place}")
                for size, tab in tabs.items():
                    for theme, picture in photograph(tab, *SIZES[size]):
                        to = target / f"{view}-{size}-{theme}.png"
                        to.write_bytes(picture)
                        print(to)
                    tab.close()
            browser.close()
        finally:
            server.stop()
    shutil.copy(target / README, ROOT / "docs" / "images" / README)


if __name__ == "__main__":
    main(*sys.argv[1:2])
