"""The error where a drawing library, the extra "app" of the package, is not installed."""

from __future__ import annotations

__all__ = ["extra_is_missing"]


def extra_is_missing(module: str, error: ImportError) -> ImportError:
    """Return the error for a module that draws when its drawing library is not installed."""
    package = (error.name or "a drawing library").partition(".")[0]
    return ImportError(
        f"{module} needs {package}, which is not installed: pip install 'rotorstab[app]'",
        name=package,
    )
