"""Time of garbage collection in a worker while pages open and close, with and without `gc.freeze`.

Each case runs in its own process: it holds 30 pages, closes the oldest one and builds a new one.
"""

import gc
import subprocess
import sys
import time
from collections import deque

HELD = 30
CYCLES = 20


def page():
    """A document of the dashboard, as for a browser that opens it."""
    from bokeh.document import Document
    from panel.io.state import set_curdoc

    import app.document

    document = Document()
    with set_curdoc(document):
        app.document.build().server_doc(document)
    return document


def measure(freeze):
    """Print what share of the thread's time went into collections."""
    for _ in range(2):
        page().clear()
    gc.collect()
    if freeze:
        gc.freeze()
    held = deque(page() for _ in range(HELD))
    spent = begun = 0.0

    def collecting(phase, info):
        nonlocal spent, begun
        if phase == "start":
            begun = time.thread_time()
        else:
            spent += time.thread_time() - begun

    gc.callbacks.append(collecting)
    start = time.thread_time()
    for _ in range(CYCLES):
        held.append(page())
        held.popleft().clear()
        gc.collect()  # as Panel does after a page was closed
    total = time.thread_time() - start
    before = spent
    gc.collect()
    print(
        f"| {'frozen' if freeze else 'as it is'} | {before / total:.0%} "
        f"| {1000 * (spent - before):.0f} ms | {gc.get_freeze_count()} |",
        flush=True,
    )


def main():
    """Print the table."""
    print("| objects of the start | share of the thread | one full collection | frozen objects |")
    print("|---|---|---|---|", flush=True)
    for freeze in ("0", "1"):
        subprocess.run([sys.executable, "-m", "benchmarks.bench_garbage", freeze], check=True)


if __name__ == "__main__":
    measure(sys.argv[1] == "1")
