"""A worker is killed while a real browser shows one of its pages."""

import os
import signal
import time

from playwright.async_api import async_playwright

from tests.testing.browser import FLAGS, find_browser

SHOWN = "value => window.rotorstab?.last?.values.spin_speed === value"
STATE = 1.37


async def kill_under_a_page(deployment):
    """Return the seconds until the page is back with its state; None without a browser."""
    path = find_browser()
    if path is None:
        return None
    before = sockets(deployment)
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(executable_path=path, args=FLAGS)
        page = await browser.new_page()
        page.set_default_timeout(120_000)
        await page.goto(deployment.origin + "/app")
        await page.wait_for_function("window.rotorstab?.last")
        await page.evaluate(f"rotorstab.change('spin_speed', {STATE})")
        await page.wait_for_function(SHOWN, arg=STATE)
        # the address is written at rest
        await page.wait_for_function(f"location.search.includes('spin={STATE}')")
        after = sockets(deployment)
        port = next(port for port, count in after.items() if count > before.get(port, 0))
        await page.evaluate("window.old = true")
        start = time.perf_counter()
        os.kill(deployment.workers()[port], signal.SIGKILL)
        await page.wait_for_function(f"value => !window.old && ({SHOWN})(value)", arg=STATE)
        seconds = time.perf_counter() - start
        await browser.close()
    return seconds


def sockets(deployment):
    """Return {port: open sockets}."""
    return {port: one["rotorstab_sockets"] for port, one in deployment.metrics().items()}
