"""The deployment under test: nginx and workers as delivered, on loopback, with their own folder."""

import random
import re
import signal
import socket
import sys
import time
from contextlib import suppress
from http.client import HTTPException
from pathlib import Path

from prometheus_client.parser import text_string_to_metric_families

from tests.testing.serving import Server

ENDING = 30  # s


def free_ports(count):
    """Return the first of some free ports in a row, none of which a client may be given."""
    # below the system's own choice: a client that asks before anybody listens meets itself
    while True:
        first = random.randrange(20000, 30000)
        if all(is_free(first + number) for number in range(count)):
            return first


def is_free(port):
    """Whether nobody listens on a port of loopback."""
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) != 0


class Deployment(Server):
    """`python -m deploy.lab` with some workers; ended with all that it started."""

    def __init__(self, folder, workers=2, **environment):
        self.first_port, self.count = free_ports(workers), workers
        super().__init__(
            Path(folder) / "lab.txt",
            command=[sys.executable, "-m", "deploy.lab"],
            ROTORSTAB_WORKERS=str(workers),
            ROTORSTAB_WORKER_PORT=str(self.first_port),
            **environment,
        )

    def wait(self):
        """Return once every worker answers through its own port, and nginx does."""
        deadline = time.monotonic() + 180
        while time.monotonic() < deadline and self.process.poll() is None:
            try:
                self.get("/nowhere", Host=self.origin.removeprefix("http://"))
                if len(self.metrics()) == self.count:
                    return self
            except OSError:
                pass
            time.sleep(0.2)
        self.stop()
        raise RuntimeError("the deployment did not start:\n" + self.log.read_text())

    def workers(self):
        """Return {port: process id} of the workers that run."""
        found = {}
        for process, parent in parents().items():
            if parent != self.process.pid:
                continue
            with suppress(OSError):
                entry = Path(f"/proc/{process}")
                port = re.search(rb"\0PORT=(\d+)\0", (entry / "environ").read_bytes())
                if port and b"deploy.worker" in (entry / "cmdline").read_bytes():
                    found[int(port[1])] = process
        return found

    def memory(self):
        """Return {port: resident memory [MB]} of the workers, without their helpers."""
        return {port: resident(process) for port, process in self.workers().items()}

    def metrics(self):
        """Return {port: {name of a sample: its value}} of the workers that answer."""
        found = {}
        for port in range(self.first_port, self.first_port + self.count):
            worker = object.__new__(Server)
            worker.port = port
            try:
                status, _, text = worker.get("/metrics", Host=self.origin.removeprefix("http://"))
            except (OSError, HTTPException):
                continue
            if status == 200:
                found[port] = {
                    sample.name
                    + "".join(f" {value}" for value in sample.labels.values()): sample.value
                    for family in text_string_to_metric_families(text)
                    for sample in family.samples
                }
        return found

    def total(self, name):
        """Return the sum of a sample over all workers."""
        return sum(one.get(name, 0.0) for one in self.metrics().values())

    def stop(self):
        """End the launcher, which ends all else."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            try:
                self.process.wait(ENDING)
            except Exception:
                super().stop()


class Others:
    """How much of the machine other programs take meanwhile (Linux)."""

    def __init__(self, deployment):
        self._deployment = deployment
        self._start = self._spent()

    def _spent(self):
        user, nice, system, idle, wait, *rest = (
            int(word) for word in Path("/proc/stat").read_text().split()[1:9]
        )
        busy = (user + nice + system + sum(rest)) / 100
        own = sum(map(processor_time, family(self._deployment.process.pid)))
        return busy, busy + (idle + wait) / 100, own + time.process_time()

    def share(self):
        """Return the part of all cores that others took since the start."""
        busy, whole, own = (
            now - then for now, then in zip(self._spent(), self._start, strict=True)
        )
        return max(0.0, busy - own) / whole if whole else 0.0


def parents():
    """Return {process: its parent} of the machine."""
    found = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with suppress(OSError):
                fields = (entry / "stat").read_text().rpartition(")")[2].split()
                found[int(entry.name)] = int(fields[1])
    return found


def family(process):
    """Return a process and all that descend from it."""
    known, found = parents(), {process}
    while more := {one for one, parent in known.items() if parent in found} - found:
        found |= more
    return found


def processor_time(process):
    """Return the processor time of a process [s], 0 of one that has gone."""
    with suppress(OSError):
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / 100
    return 0.0


def resident(process):
    """Return the resident memory of a process [MB]."""
    text = Path(f"/proc/{process}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+)", text)[1]) / 1024
