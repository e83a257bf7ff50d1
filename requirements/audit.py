"""Ask for known faults of the pinned packages: `python requirements/audit.py`.

Ends with 1 where a fault is known, with 0 where there is none or the database cannot be reached,
and says which. Needs pip-audit, which `make audit` installs in an environment of its own.
"""

import json
import subprocess
import sys
from pathlib import Path

PINS = Path(__file__).with_name("serve.txt")
PATIENCE = 120  # s


def main() -> int:
    """Audit what is served; return the exit code."""
    command = [sys.executable, "-m", "pip_audit", "--requirement", str(PINS), "--disable-pip"]
    command += ["--require-hashes", "--format", "json", "--progress-spinner", "off"]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, timeout=PATIENCE, check=False
        )
        packages = json.loads(done.stdout)["dependencies"]
    except (subprocess.TimeoutExpired, ValueError, KeyError):
        packages = []
    found = [(one, fault) for one in packages for fault in one.get("vulns", ())]
    for one, fault in found:
        better = ", ".join(fault["fix_versions"]) or "none yet"
        print(f"audit: {one['name']} {one['version']}: {fault['id']}, fixed in {better}")
    checked = sum("vulns" in one for one in packages)  # the others the database does not know
    if not checked:
        print("audit: the database of known faults was not reachable; nothing was checked")
        return 0
    print(f"audit: {checked} of {len(packages)} packages checked, {len(found)} known faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
