"""Slider to painted: the dashboard against a bare Bokeh page that patches the same arrays.

From the slider's input event to the last of the three charts painted with the arrays that the
solver returns for that value, in a headless Chromium, alternating between the two pages.
Then sustained dragging at 60 events/s: what happens after the last event.
"""

import argparse
import json
import os
import statistics
import sys
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path

from playwright.sync_api import sync_playwright

from app.state import State
from benchmarks.redraw.moves import RATE, SECONDS, SLIDERS, drag, probes, values
from tests.browser import FLAGS, HELP, find_browser
from tests.serving import Server

ROOT = Path(__file__).parents[1]
REDRAW = Path(__file__).parent / "redraw"
PROBE = (REDRAW / "probe.js").read_text(encoding="utf-8")
VIEWPORT = {"width": 1920, "height": 1080}
SESSIONS = 10
WARM = 4  # moves of each slider before the clock counts
TARGETS = (1.3, 1.5)  # ratio of medians, of 95th percentiles
MOST_REDRAWS = 2  # after the last event of a drag


def cpu_seconds(process):
    """Return the processor time of a process so far [s], or None where /proc does not tell."""
    try:
        fields = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return None
    return (int(fields[11]) + int(fields[12])) / 100


def share(values, part):
    """Return the value below which a part of the values lies."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(part * len(ordered)))]


class Tab:
    """One page of a server in a context of its own, with the probe in it."""

    def __init__(self, browser, url, server):
        self.server = server
        self.page = browser.new_context(viewport=VIEWPORT).new_page()
        self.page.set_default_timeout(60_000)
        self.page.goto(url)
        self.page.wait_for_function("window.Bokeh?.documents[0]?.is_idle")
        self.page.wait_for_function("!window.rotorstab || window.rotorstab.last")
        time.sleep(1.5)  # late layout
        self.page.evaluate(PROBE)

    def move(self, slider, value, wanted):
        """Return the time from the input event to the last chart painted [ms]."""
        argument = {"slider": slider, "value": value, "wanted": wanted}
        return self.page.evaluate("argument => bench.move(argument)", argument)

    def rest(self):
        """Wait until the page has also drawn what it draws once the slider rests."""
        self.page.wait_for_function("!window.rotorstab || rotorstab.last.settled")
        time.sleep(0.05)

    def return_to_start(self, slider):
        """Bring the slider back to the base case."""
        start = State.param[slider].default
        self.move(slider, start, probes(slider, start))
        self.rest()

    def start_drag(self, slider, steps):
        """Drag through steps at 60 events/s without waiting for the end."""
        argument = {
            "slider": slider,
            "steps": steps,
            "rate": RATE,
            "wanted": probes(slider, steps[-1]),
        }
        self.page.evaluate("argument => { window.outcome = bench.drag(argument); }", argument)

    def outcome(self):
        """Return what followed the drag, once it has ended."""
        return self.page.evaluate("() => window.outcome")


def serve(stack, folder, name, **options):
    """Start a server that ends with the stack."""
    path = os.pathsep.join([str(ROOT / "src"), str(ROOT)])
    server = Server(folder / f"{name}.txt", PYTHONPATH=path, **options)
    stack.callback(server.stop)
    return server.wait()


def redraws(floor, own, count):
    """Time single moves, page after page; return {slider: {page: times}} and processor times."""
    times, cpu = {}, {floor: 0.0, own: 0.0}
    for slider in SLIDERS:
        times[slider] = {floor: [], own: []}
        for number, value in enumerate(values(slider, WARM + count)[WARM:]):
            wanted = probes(slider, value)
            # each goes first every other time
            for tab in (floor, own) if number % 2 else (own, floor):
                before = cpu_seconds(tab.server.process)
                times[slider][tab].append(tab.move(slider, value, wanted))
                if before is not None:
                    cpu[tab] += cpu_seconds(tab.server.process) - before
                tab.rest()
        for tab in (floor, own):
            tab.return_to_start(slider)
    return times, cpu


def row(*cells):
    """Print a line of the table."""
    print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


def report_redraws(times, cpu, floor, own):
    """Print the times of both pages and their ratios; return whether the targets are met."""
    row("slider", "floor median / p95 ms", "dashboard median / p95 ms", "ratio median / p95")
    row(*["---"] * 4)
    pooled = {tab: [t for one in times.values() for t in one[tab]] for tab in (floor, own)}
    for name, one in [*times.items(), ("all", pooled)]:
        low, high = ((statistics.median(one[tab]), share(one[tab], 0.95)) for tab in (floor, own))
        ratios = [mine / bare for mine, bare in zip(high, low, strict=True)]
        row(
            name, *(f"{x:.0f} / {y:.0f}" for x, y in (low, high)), "{:.2f} / {:.2f}".format(*ratios)
        )
    if all(cpu.values()):
        spent = [1e3 * cpu[tab] / len(pooled[tab]) for tab in (floor, own)]
        print("\nserver's time a redraw: floor {:.1f} ms, dashboard {:.1f} ms".format(*spent))
    met = all(ratio <= limit for ratio, limit in zip(ratios, TARGETS, strict=True))
    print("target, of all: <= {} and <= {}:".format(*TARGETS), "met" if met else "MISSED")
    return met


def report_drags(name, sessions, outcomes):
    """Print what followed the last events; return whether it was as few redraws as wanted."""
    settle = [one["settle"] for one in outcomes]
    most = max(one["redraws"] for one in outcomes)
    rate = statistics.median(one["rate"] for one in outcomes)
    times = f"{statistics.median(settle):.0f} / {max(settle):.0f}"
    row(name, sessions, f"{rate:.1f}", times, most)
    return most <= MOST_REDRAWS


def main(count=60, rounds=3):
    """Serve both pages, time them, print the tables; return whether the targets are met."""
    path = find_browser()
    if path is None:
        sys.exit(HELP)
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        playwright = stack.enter_context(sync_playwright())
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        stack.callback(browser.close)
        dashboard = serve(stack, folder, "dashboard")
        own = Tab(browser, dashboard.origin + "/app", dashboard)
        bare = serve(
            stack,
            folder,
            "floor",
            command=[sys.executable, "-m", "bokeh", "serve", REDRAW / "floor.py", "--port", "PORT"],
            FLOOR_COUNT=str(WARM + count),
            FLOOR_SIZES=json.dumps(own.page.evaluate("bench.sizes")),
        )
        floor = Tab(browser, bare.origin + "/floor", bare)
        for tab in (floor, own):
            for slider in SLIDERS:
                for value in values(slider, WARM + count)[:WARM]:
                    tab.move(slider, value, probes(slider, value))
                    tab.rest()
                tab.return_to_start(slider)
        met = report_redraws(*redraws(floor, own, count), floor, own)

        print(f"\ndragging at {RATE} events/s for {SECONDS} s\n")
        row(
            "page",
            "sessions",
            "redraws/s each",
            "last event to settled, median / worst ms",
            "redraws",
        )
        row(*["---"] * 5)
        outcomes = {floor: [], own: []}
        for _ in range(rounds):
            for tab in outcomes:
                tab.start_drag("spin_speed", drag("spin_speed"))
                outcomes[tab].append(tab.outcome())
                tab.rest()
        report_drags("floor", 1, outcomes[floor])
        settled = report_drags("dashboard", 1, outcomes[own])
        floor.page.close()
        own.return_to_start("spin_speed")
        crowd = [own]
        while len(crowd) < SESSIONS:
            crowd.append(Tab(browser, dashboard.origin + "/app", dashboard))
        for number, tab in enumerate(crowd):
            slider = SLIDERS[number % len(SLIDERS)]
            tab.start_drag(slider, drag(slider, number))
        settled &= report_drags("dashboard", SESSIONS, [tab.outcome() for tab in crowd])
        print(f"target: {MOST_REDRAWS} redraws or fewer:", "met" if settled else "MISSED")
    return met and settled


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=60, help="moves a slider")
    main(parser.parse_args().count)
