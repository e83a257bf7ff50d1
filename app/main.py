"""Entry point of `panel serve app` and `panel serve app/main.py`: one session, one page."""

import sys

try:
    from app.document import show
    from deploy import dashboard
    from deploy.patches import plain_serving
except ImportError as problem:
    sys.exit(
        f"rotorstab: this Python cannot serve the dashboard: {problem}. Install it first: "
        "pip install 'rotorstab[app]', or in a checkout: pip install -e '.[app]'"
    )

dashboard.served = True
plain_serving.prepare()
show()
