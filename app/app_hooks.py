"""Bokeh reads this file once, when a server loads the app and before it listens."""

import sys
from importlib.util import find_spec

try:
    # not imported here: with `--autoreload` Panel watches what `main.py` is the first to import
    for name in ("rotorstab", "app"):
        if find_spec(name) is None:
            raise ImportError(f"No module named {name!r}")
    from deploy.patches import plain_serving
except (ImportError, AttributeError) as problem:
    sys.exit(
        f"rotorstab: this Python cannot serve the dashboard: {problem}. Install it first: "
        "pip install 'rotorstab[app]', or in a checkout: pip install -e '.[app]'"
    )

plain_serving.install()
