#!/bin/sh
# Print a Python >= 3.11 that can make virtual environments: $PYTHON, python3, or a newer one.
set -eu

found=
for python in ${PYTHON:-python3 python3.13 python3.12 python3.11 python}; do
    "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || continue
    found=$python
    if "$python" -c 'import ensurepip, venv' 2>/dev/null; then
        echo "$python"
        exit 0
    fi
done

if [ -z "$found" ]; then
    echo "error: Python 3.11 or newer is needed; ${PYTHON:-python3} is missing or older (set PYTHON=/path/to/python)" >&2
else
    echo "error: $found has no venv module: install it (Debian and Ubuntu: apt-get install python3-venv)" >&2
fi
exit 1
