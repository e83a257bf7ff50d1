"""First paint and size of the page, with an empty and a filled cache, in headless Chromium."""

import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

from tests.testing.browser import FLAGS, find_browser
from tests.testing.serving import Server

RUNS = 4


def load(context, address):
    """Open the page; return seconds to the first picture, requests and bytes over the wire."""
    page = context.new_page()
    session = context.new_cdp_session(page)
    session.send("Network.enable")
    sizes = []
    session.on("Network.loadingFinished", lambda event: sizes.append(event["encodedDataLength"]))
    page.goto(address)
    page.wait_for_function("window.rotorstab?.painted && Bokeh.documents[0]?.is_idle")
    seconds = page.evaluate("performance.now()") / 1000
    page.wait_for_timeout(500)
    page.close()
    return seconds, len(sizes), sum(sizes)


def main():
    """Print the table."""
    chromium = find_browser()
    if chromium is None:
        raise SystemExit("no Chromium found: set CHROMIUM=/path/to/chrome")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        server = Server(Path(folder) / "server.log")
        try:
            server.wait()
            browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
            rows = {"cold": [], "cached": []}
            for _ in range(RUNS):
                context = browser.new_context()
                for row in rows.values():
                    row.append(load(context, f"{server.origin}/app"))
                context.close()
            browser.close()
        finally:
            server.stop()
    print(f"{'':8}{'first picture s':>18}{'requests':>10}{'MB':>8}   (median of {RUNS})")
    for name, row in rows.items():
        seconds, requests, size = (statistics.median(column) for column in zip(*row, strict=True))
        print(f"{name:8}{seconds:18.2f}{requests:10.0f}{size / 1e6:8.2f}")
    first = rows["cold"][0][0]
    print(f"the very first page of the server, which compiles nothing later: {first:.2f} s")


if __name__ == "__main__":
    main()
