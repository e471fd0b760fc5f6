# SPDX-License-Identifier: BSD-3-Clause
"""What the tests against real programs share: running gonio, finding the other program, and saying so when it is missing.

A test is a file NAME_test.py next to this one: classes of unittest.TestCase (import TestCase from here) and `interop.main()` at the end.
Environment: GONIO is the program under test, GONIO_INTEROP the folder that tools/setup-interop fills (default build/interop).
With GONIO_INTEROP_REQUIRED=1 a missing program is a failure instead of a skipped test.
"""

import importlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = pathlib.Path(os.environ.get("GONIO_INTEROP", ROOT / "build" / "interop"))
SKIPPED = 77  # what CTest takes for "skipped"


def missing(what):
    """Skips the test that called, or fails it where everything has to be there."""
    if os.environ.get("GONIO_INTEROP_REQUIRED") == "1":
        raise AssertionError(f"{what} is missing; tools/setup-interop installs it")
    raise unittest.SkipTest(f"{what} is missing")


def module(name):
    """A Python module of another project."""
    try:
        return importlib.import_module(name)
    except ImportError:
        missing(f"the Python module {name}")


def program(name):
    """The path of another project's program."""
    found = shutil.which(name, path=f"{FOLDER / 'venv' / 'bin'}:{os.environ['PATH']}")
    return found or missing(f"the program {name}")


def node_package(name):
    """The folder of a package from npm."""
    folder = FOLDER / "npm" / "node_modules" / name
    return folder if folder.is_dir() else missing(f"the npm package {name}")


def run(*command, stdin=None, check=True):
    """Runs a program, returns its standard output as text; with `check` a failure shows what it said."""
    done = subprocess.run([str(part) for part in command], input=stdin, capture_output=True, text=True)
    if check and done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))} gave exit code {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout if check else done


def gonio(*arguments, stdin=None):
    """Standard output of the gonio under test; any exit code but 0 fails."""
    return run(os.environ["GONIO"], *arguments, stdin=stdin)


def evaluate(source, pairs, *arguments):
    """f [1/sr], cosine not included, one list of channels per pair (theta_i, phi_i, theta_o, phi_o) in degrees."""
    lines = "".join("{!r} {!r} {!r} {!r}\n".format(*map(float, pair)) for pair in pairs)
    out = gonio("eval", source, *arguments, "--quiet", stdin=lines)
    return [[float(value) for value in line.split()] for line in out.splitlines()]


class TestCase(unittest.TestCase):
    """A test with a folder of its own, `self.folder`, that is removed after it, and a count of what was asserted."""

    checks = 0

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="gonio-interop-")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def check(self, condition, message):
        TestCase.checks += 1
        self.assertTrue(condition, message)

    def near(self, value, expected, tolerance, what):
        """|value - expected| <= tolerance, NaN never."""
        self.check(abs(value - expected) <= tolerance, f"{what}: {value!r}, expected {expected!r} within {tolerance!r}")

    def fit(self, model, channels=("value",), **parameters):
        """A fit.json of a model with known parameters, as `gonio export` reads it: made by fitting the model's own values."""
        rows = ["theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg," + ",".join(channels)]
        pairs = [(i, 0, o, phi) for i in range(0, 80, 10) for o in range(0, 85, 3) for phi in range(0, 361, 15)]
        given = [part for name, value in parameters.items() for part in ("--param", f"{name}={value}")]
        for pair, values in zip(pairs, evaluate(model, pairs, *given)):
            rows.append(",".join(map(repr, [*pair, *(values * len(channels))])))
        samples = self.folder / "samples.csv"
        samples.write_text("\n".join(rows) + "\n")
        out = self.folder / f"{model}.fit.json"
        gonio("fit", samples, "--model", model, "--out", out)
        return out


def load_json(text):
    return json.loads(text)


def main():
    """Runs the tests of the calling file. Exit code 0: all passed; 77: something was skipped; 1: a failure, or nothing asserted."""
    result = unittest.main(module="__main__", exit=False, verbosity=2).result
    print(f"{TestCase.checks} checks in {result.testsRun} tests, {len(result.skipped)} skipped")
    if not result.wasSuccessful():
        sys.exit(1)
    if result.skipped:
        sys.exit(SKIPPED)
    sys.exit(0 if TestCase.checks else 1)
