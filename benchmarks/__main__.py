"""Run every benchmark, or those named on the command line: `python -m benchmarks solver redraw`."""

import importlib
import os
import platform
import sys
from pathlib import Path


def main(names: list[str]) -> int:
    """Print the tables one after another; return 2 for a name that is not there."""
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
    for name in names or known:
        print(f"\n## {name}\n", flush=True)
        importlib.import_module(f"benchmarks.bench_{name}").main()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
