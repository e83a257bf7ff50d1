"""What a server asks of the dashboard, where it serves that and not another app.

The dashboard's modules are imported when they are asked: that takes seconds, and a worker that
serves another app does without.
"""

import gc
from collections.abc import Iterator
from functools import _CacheInfo
from pathlib import Path

import app

FOLDER = Path(app.__file__).parent
served = False
"""Whether this process serves the dashboard."""


def is_dashboard(path: str) -> bool:
    """Whether a directory or file given to `panel serve` is the dashboard."""
    return Path(path).resolve() in (FOLDER, FOLDER / "main.py")


def warm_up() -> None:
    """Do the slow first things before anybody waits for them."""
    if served:
        from app.lessons import library
        from app.session import Session

        library()  # a broken lesson is reported now, not when the first student comes
        # with a marker: HoloViews draws the charts inside a point too, once, and holds up no user
        Session({"at": ["1"]}).respond({"type": "hello"})
    # What is there now stays until the end: collections of what pages leave need not look at it.
    gc.collect()
    gc.freeze()


def exports_running() -> int:
    """Return the number of files that are being made."""
    if not served:
        return 0
    from app.exports import files

    return files.making()


def caches() -> Iterator[tuple[str, _CacheInfo]]:
    """Yield (name, cache_info) of every cache that all sessions share."""
    if not served:
        return
    from app.lessons import quantities
    from app.pages import marked_point
    from app.results import analysis, comparisons, curves, growth_maps

    for module in (analysis, curves, comparisons, growth_maps, marked_point, quantities):
        part = module.__name__.rpartition(".")[2]
        for name, value in vars(module).items():
            if hasattr(value, "cache_info") and value.__module__ == module.__name__:
                yield f"{part}.{name.lstrip('_')}", value.cache_info()


def close() -> None:
    """End the processes that the dashboard has started."""
    if served:
        from app.background.printing import printer
        from app.background.processes import background

        printer.close()
        background.close()
