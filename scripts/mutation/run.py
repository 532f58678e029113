"""Runs test programs with a mutant active."""
import os
import signal
import subprocess
import tempfile
import time

from mutation import schemata

# A mutant may wait for ever, or fill the memory.
SLOWER = 5     # times as long as without a mutant ...
GRACE = 10     # [s] ... and this in addition
MEMORY = 4096  # [MiB] of addresses


class Runner:
    """Test programs, after `measure` the fastest first."""

    def __init__(self, programs, environment):
        self._programs = dict(programs)
        self._environment = {**os.environ, **environment, "GTEST_FAIL_FAST": "1"}
        self._limits = {}

    def measure(self):
        """Runs all without a mutant.

        Returns {name: [s]}, and {name: output} of those that fail.
        """
        seconds, failed = {}, {}
        for name in self._programs:
            reason, seconds[name], output = self._run(name, 0, 600)
            if reason:
                failed[name] = "{}\n{}".format(reason, output)
        self._limits = {name: SLOWER * seconds[name] + GRACE
                        for name in sorted(seconds, key=seconds.get)}
        return seconds, failed

    def killer(self, number):
        """Returns the first program that notices the mutant and how, (None, None) if none does."""
        for name, limit in self._limits.items():
            reason, _, _ = self._run(name, number, limit)
            if reason:
                return name, reason
        return None, None

    def _run(self, name, number, limit):
        """Returns how it ended (None when it passed), how long it took, and what it printed."""
        begin = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            environment = {**self._environment, schemata.VARIABLE: str(number), "TMPDIR": folder}
            process = subprocess.Popen(
                ["prlimit", "--core=0", "--as={}".format(MEMORY << 20), str(self._programs[name])],
                cwd=folder, env=environment, start_new_session=True, stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            try:
                output, _ = process.communicate(timeout=limit)
                reason = _reason(process.returncode)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                output, _ = process.communicate()
                reason = "runs longer than {:.0f} s".format(limit)
        return reason, time.monotonic() - begin, output.decode("utf-8", "replace")[-4000:]


def _reason(status):
    if status == 0:
        return None
    return "fails" if status > 0 else "stops with " + signal.Signals(-status).name
