"""Run the benchmarks, or those named on the command line: `python -m benchmarks solver redraw`.

With `--quick`, benchmarks that have a short form run that. The long benchmarks run only when they
are named.
"""

import importlib
import os
import platform
import sys
from inspect import signature
from pathlib import Path

BY_NAME = ("abuse", "classroom", "cost", "margin", "tongues")  # minutes long: not among all


def main(names: list[str]) -> int:
    """Print the tables one after another; return 2 for a name that is not there."""
    quick = "--quick" in names
    names = [name for name in names if name != "--quick"]
    # one thread: the solver's matrices are small, and a server shares its cores
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    known = sorted(
        path.stem.removeprefix("bench_") for path in Path(__file__).parent.glob("bench_*.py")
    )
    unknown = sorted(set(names) - set(known))
    if unknown:
        print(f"no benchmark {', '.join(unknown)}; there are {', '.join(known)}", file=sys.stderr)
        return 2
    print(f"{platform.platform()}, {os.cpu_count()} cores, Python {platform.python_version()}")
    for name in names or [one for one in known if one not in BY_NAME]:
        print(f"\n## {name}\n", flush=True)
        run = importlib.import_module(f"benchmarks.bench_{name}").main
        run(**({"quick": True} if quick and "quick" in signature(run).parameters else {}))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
