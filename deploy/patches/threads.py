"""The work for pages runs on the thread of the server's loop.

From Bokeh 3.10 on the callbacks of pages run in worker threads. A worker of ours is for one core,
and its limits, its watchdog and its metrics measure one thread. So its callbacks run on the loop,
as they do in Bokeh 3.9.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import bokeh
import bokeh.server.session as bokeh_session
from bokeh.server.session import ServerSession
from packaging.version import Version

from ..settings import Settings
from .patching import replace

T = TypeVar("T")
THREADS_SINCE = (3, 10)  # release of Bokeh


async def on_loop(function: Callable[..., T], *args: Any, **kwargs: Any) -> T:
    """Call a function on this thread."""
    return function(*args, **kwargs)


async def on_loop_for_session(self: Any, function: Callable[..., T], *args: Any) -> T:
    """Call a function on this thread."""
    return function(*args)


def install(settings: Settings) -> None:
    """Keep the work of this process's server on one thread."""
    if Version(bokeh.__version__).release >= THREADS_SINCE:
        replace(bokeh_session, "_run_in_executor", on_loop)
        replace(ServerSession, "_run_in_executor", on_loop_for_session)
