"""What the tests of the command line share. The program is the first argument of every test file."""

import contextlib
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else "carom"
SCENES = pathlib.Path(__file__).resolve().parents[3] / "scenes"

# One body that falls: the least that runs.
FALL = {
    "carom": 1,
    "world": {"gravity": [0, -10]},
    "bodies": [{"name": "ball", "position": [0, 5]}],
    "run": {"duration": 1, "step": 0.01},
}


class Case(unittest.TestCase):
    """A test in a folder of its own."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def write(self, text, name="scene.json"):
        """A file with a text, bytes, or a scene."""
        file = self.path / name
        if isinstance(text, bytes):
            file.write_bytes(text)
        else:
            file.write_text(text if isinstance(text, str) else json.dumps(text))
        return name

    def carom(self, *arguments, **options):
        options.setdefault("timeout", 120)
        options.setdefault("stdin", subprocess.DEVNULL)
        options.setdefault("cwd", self.path)
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, errors="replace",
                              **options)

    def fails(self, status, text, *arguments, **options):
        """The program ends with this status and one line on standard error that has the text."""
        ran = self.carom(*arguments, **options)
        self.assertEqual(ran.returncode, status, ran.stderr)
        self.assertEqual(ran.stdout, "")
        self.assertTrue(ran.stderr.startswith("carom: "), ran.stderr)
        self.assertEqual(ran.stderr.count("\n"), 1, ran.stderr)
        self.assertLess(len(ran.stderr), 700)
        self.assertIn(text, ran.stderr)
        return ran

    def succeeds(self, *arguments, **options):
        ran = self.carom(*arguments, **options)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertEqual(without_notes(ran.stderr), "")
        return ran

    def table(self, name):
        """The rows of a CSV file, its heading first; comments are left away."""
        with open(self.path / name) as lines:
            return list(csv.reader(line for line in lines if not line.startswith("#")))

    def files(self):
        return sorted(str(file.relative_to(self.path)) for file in self.path.rglob("*") if file.is_file())


def without_notes(stderr):
    """What is most likely a mistake is said, and is no error."""
    return "".join(line for line in stderr.splitlines(True) if not line.startswith("carom: note: "))


@contextlib.contextmanager
def small_disk(path, kilobytes):
    """A file system of a few kilobytes at the path; skips the test where none can be mounted."""
    path.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", path], capture_output=True)
    if mounted.returncode != 0:
        raise unittest.SkipTest("no file system can be mounted here")
    try:
        yield path
    finally:
        subprocess.run(["umount", path], check=True)


def main():
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
