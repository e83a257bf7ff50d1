"""Work for pages, on the thread of the server's loop.

From Bokeh 3.10 on the callbacks of pages run in worker threads. A worker of ours is for one core,
and its limits, its watchdog and its metrics measure one thread. So its callbacks run on the loop,
as they do in Bokeh 3.9.
"""

import bokeh
import bokeh.server.session as bokeh_session
from bokeh.server.session import ServerSession
from packaging.version import Version

from ..settings import Settings
from .patching import replace


async def on_loop(function, *args, **kwargs):
    """Call a function here and now."""
    return function(*args, **kwargs)


async def on_loop_for_session(self, function, *args):
    """Call a function here and now."""
    return function(*args)


def install(settings: Settings):
    """Keep the work of this process's server on one thread."""
    if Version(bokeh.__version__).release >= (3, 10):
        replace(bokeh_session, "_run_in_executor", on_loop)
        replace(ServerSession, "_run_in_executor", on_loop_for_session)
