"""What a server needs from the dashboard, where it serves the dashboard and not another app.

Each function imports the modules that it needs: the imports take seconds, and a worker that serves
another app does without them.
"""

import gc
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import app

if TYPE_CHECKING:
    from app.results.caches import CacheInfo

FOLDER = Path(app.__file__).parent
served = False
"""Whether this process serves the dashboard. `worker` sets it before the patches are installed.

It is a variable of the module, since Panel runs `deploy/setup.py` and the requests of `/metrics`
and `/health` without a place to hand anything over. A process serves one app from its start to its
end.
"""


def is_dashboard(path: str) -> bool:
    """Return whether a directory or file given to `panel serve` is the dashboard."""
    return Path(path).resolve() in (FOLDER, FOLDER / "main.py")


def warm_up() -> None:
    """Do the slow first things before anybody waits for them."""
    if served:
        from app.lessons import library
        from app.session import Session

        library()  # reports a broken lesson now, and not when the first student comes
        # The second message asks for the charts of the marked point.
        session = Session()
        for kind in ("hello", "settle"):
            session.respond({"type": kind})
    # These objects stay until the end, so the garbage collector need not look at them any more.
    gc.collect()
    gc.freeze()


def exports_running() -> int:
    """Return the number of files that are being made."""
    if not served:
        return 0
    from app.exports import files

    return files.making()


def caches() -> Iterator[tuple[str, "CacheInfo"]]:
    """Yield the name and the numbers of every cache that all sessions share."""
    if not served:
        return
    from app.results.caches import cache_infos

    yield from cache_infos()


def close() -> None:
    """End the processes that the dashboard has started."""
    if served:
        from app.background.printing import printer
        from app.background.processes import background

        printer.close()
        background.close()
