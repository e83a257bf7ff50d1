"""Write pictures of every page and lesson, in both themes: `python -m docs.screenshots [FOLDER]`.

Serves the dashboard on a free loopback port and photographs it with headless Chromium.
"""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

from playwright.sync_api import Browser, sync_playwright

from app.lessons import library
from tests.testing.browser import find_browser

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
FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


def serve() -> tuple[subprocess.Popen[bytes], str]:
    """Start the dashboard; return its process and address."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    process = subprocess.Popen(
        [str(ROOT / "deploy" / "start.sh")],
        env=os.environ | {"PORT": str(port), "PYTHON": sys.executable},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    address = f"http://127.0.0.1:{port}"
    for _ in range(120):
        try:
            with urllib.request.urlopen(f"{address}/health", timeout=2):
                return process, f"{address}/app"
        except OSError:
            time.sleep(0.5)
    os.killpg(process.pid, signal.SIGTERM)
    raise SystemExit("the dashboard did not start; try `make serve` to see why")


def photograph(browser: Browser, address: str, size: str, theme: str, to: Path) -> None:
    """Save one picture of a page as a user first sees it."""
    width, height = SIZES[size]
    context = browser.new_context(
        viewport={"width": width, "height": height}, color_scheme=theme, device_scale_factor=1
    )
    tab = context.new_page()
    tab.goto(address)
    tab.wait_for_function("window.rotorstab?.last && Bokeh.documents[0]?.is_idle")
    if "#lesson/" in address:
        tab.locator(".lesson").wait_for(state="visible")
    if "#paper" in address:
        tab.wait_for_selector(".picture img", timeout=60_000)
    tab.wait_for_timeout(1500)
    full = tab.evaluate("document.documentElement.scrollHeight")
    tab.set_viewport_size({"width": width, "height": max(height, full)})
    tab.wait_for_timeout(700)
    tab.screenshot(path=to)
    context.close()


def main(folder: str = "build/screenshots") -> None:
    """Write one picture for each view, size and theme into a folder, and the README's."""
    chromium = find_browser()
    if chromium is None:
        raise SystemExit("no Chromium found: set CHROMIUM=/path/to/chrome")
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    process, address = serve()
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
            for view, place in VIEWS.items():
                for size in SIZES:
                    for theme in ("light", "dark"):
                        to = target / f"{view}-{size}-{theme}.png"
                        photograph(browser, address + place, size, theme, to)
                        print(to)
            shutil.copy(target / README, ROOT / "docs" / "images" / README)
            browser.close()
    finally:
        os.killpg(process.pid, signal.SIGTERM)
        process.wait()


if __name__ == "__main__":
    main(*sys.argv[1:2])
