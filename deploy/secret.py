"""Make the secret that several workers share, in ROTORSTAB_SECRET_FILE; one that is there stays."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from deploy.server.secret import find_secret
from deploy.server.settings import SettingError, read, stop

if __name__ == "__main__":
    try:
        find_secret(read(), make=True)
    except SettingError as problem:
        stop(problem)
