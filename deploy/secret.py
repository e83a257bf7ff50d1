"""The secret that signs sessions: BOKEH_SECRET_KEY, or a file that only its owner can read.

`python -m deploy.secret` makes the secret that several workers share, in ROTORSTAB_SECRET_FILE; an
existing secret stays.
"""

import os
import secrets
from contextlib import suppress
from pathlib import Path

from .kinds import SECRET
from .settings import SettingError, Settings, exit_with, read

__all__ = ["find_secret", "make_secret"]


def find_secret(settings: Settings, make: bool) -> str:
    """Return the secret.

    Parameters
    ----------
    settings : Settings
        Of this server.
    make : bool
        Whether to make the secret where there is none yet.

    Raises
    ------
    SettingError
        Where there is no secret that can be used; the message says what to do.
    """
    if settings.secret:
        return settings.secret
    path = Path(settings.secret_file).expanduser()
    try:
        if not path.exists():
            if not make:
                raise SettingError(
                    f"{settings.workers} workers need one secret: set BOKEH_SECRET_KEY to the same"
                    " text of at least 32 characters for all of them, or ROTORSTAB_SECRET_FILE to"
                    f" a file that holds it ({path} is not there)"
                )
            make_secret(path)
        if path.stat().st_mode & 0o077:
            raise SettingError(f"{path} must be for its owner only: chmod 600 '{path}'")
        text = path.read_text(encoding="ascii").strip()
        return str(SECRET.read(text or "none"))
    except OSError as problem:
        raise SettingError(
            f"ROTORSTAB_SECRET_FILE: {problem.strerror}: {path};"
            " set it to another path, or BOKEH_SECRET_KEY to a secret"
        ) from None
    except ValueError as problem:
        if isinstance(problem, SettingError):
            raise
        raise SettingError(f"{path} must hold {SECRET.allowed}; remove it for a new one") from None


def make_secret(path: Path) -> None:
    """Write a new secret, complete or not at all; an existing secret stays."""
    new = path.with_name(f".{path.name}.{os.getpid()}")
    path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    try:
        with open(os.open(new, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
            file.write(secrets.token_hex(32) + "\n")
        with suppress(FileExistsError):
            os.link(new, path)
    finally:
        with suppress(OSError):
            new.unlink()


if __name__ == "__main__":
    try:
        find_secret(read(), make=True)
    except SettingError as problem:
        exit_with(problem)
