"""The served app's own modules, which Bokeh imports under a name that is new in each process."""

import gc
import importlib
import sys
from types import ModuleType

from bokeh.settings import settings as bokeh_settings

from .patching import replace
from .settings import Settings


def module(name: str) -> ModuleType | None:
    """Return a module of the served app, or nothing where the app is a single file."""
    names = (one for one in list(sys.modules) if one.startswith("bokeh_app_") and "." not in one)
    package = next((one for one in names if sys.modules[one].__package__ == one), None)
    return importlib.import_module(f"{package}.{name}") if package else None


def install(settings: Settings):
    """Do the slow first things before anybody waits for them, and the needless ones never."""
    # of a document's references, with every page that opens; the tests look at the page itself
    replace(bokeh_settings, "perform_document_validation", False)
    lessons, session = module("lessons"), module("session")
    if lessons:
        lessons.library()  # a broken lesson is reported now, not when the first student comes
    if session:
        # with a marker: HoloViews draws the charts inside a point too, once, and holds up no user
        session.Session({"at": ["1"]})
    # What is there now stays until the end: collections of what pages leave need not look at it.
    gc.collect()
    gc.freeze()
