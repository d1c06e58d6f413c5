"""Data files: what others read in them, the run in each of them, memory that does not grow."""

import csv
import json
import math
import os
import re
import subprocess
import sys
import time
import unittest

import carom
import numpy
from carom import FALL, PROGRAM, SCENES

try:
    import h5py
except ImportError:
    h5py = None

try:
    sys.path.append("/usr/lib/python3/dist-packages")  # where Debian's package python3-ase puts it
    import ase.io
except ImportError:
    ase = None

BOX = {"carom": 1, "title": "Discs in a \"box\" \\ of\nwalls", "seed": 4, "parameters": {"hot": 2},
       "walls": [{"type": "periodic", "low": [-2, -1], "high": [3, 4]}],
       "bodies": [{"name": "a, b #1", "position": [0, 0], "velocity": [3, -1], "radius": 0.1, "angular_velocity": 2},
                  {"kind": "fixed", "position": [2, 2], "radius": 0.2, "mass": 3, "charge": 0.5}],
       "run": {"duration": 3, "step": 0.01, "every": 5}}
ENDINGS = ("csv", "h5", "h5md", "xyz", "extxyz")


def rows_of(file):
    """The table as Python's own reader has it, without comments."""
    with open(file) as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def frames_of(file):
    """Extended XYZ: a list of (pairs, columns)."""
    frames = []
    with open(file) as lines:
        for line in lines:
            comment = next(lines)
            pairs = {key: re.sub(r"\\(.)", r"\1", quoted) if quoted else plain
                     for key, quoted, plain in re.findall(r'(\w+)=(?:"((?:[^"\\]|\\.)*)"|(\S+))', comment)}
            frames.append((pairs, [next(lines).split() for _ in range(int(line))]))
    return frames


class Formats(carom.Case):
    def run_box(self):
        self.succeeds("run", self.write(BOX), "--csv", "x.csv", "--data", "x.h5", "--data", "x.xyz")
        return rows_of(self.path / "x.csv")

    def test_csv_has_units_and_comments_that_readers_skip(self):
        rows = self.run_box()
        self.assertEqual(list(rows[0]), ["t [s]", "body", "x [m]", "y [m]", "angle [rad]", "vx [m/s]", "vy [m/s]", "omega [rad/s]"])
        self.assertEqual([row["body"] for row in rows[:2]], ["a, b #1", "1"])
        self.assertEqual(len(rows), 2 * 61)
        plain = self.path / "plain.csv"
        self.succeeds("run", self.write(FALL), "--csv", plain)
        numbers = numpy.genfromtxt(plain, delimiter=",", skip_header=5, usecols=(0, 3))
        self.assertEqual(numbers.shape, (101, 2))
        self.assertAlmostEqual(numbers[-1, 1], 0)
        lines = plain.read_text().splitlines()
        self.assertEqual([line.split(":")[0] for line in lines if line.startswith("#")],
                         ["# carom.version", "# carom.build", "# carom.seed", "# carom.scene", "# carom.summary"])
        self.assertTrue(lines[4].startswith("t [s],body"), "four lines before the table")
        self.assertTrue(lines[-1].startswith("# carom.summary"))

    @unittest.skipUnless(h5py, "no h5py")
    def test_h5md_is_as_its_specification_wants_it(self):
        self.run_box()
        with h5py.File(self.path / "x.h5") as f:
            self.assertEqual(f["h5md"].attrs["version"].tolist(), [1, 1])
            self.assertEqual(f["h5md/creator"].attrs["name"], b"Carom")
            self.assertIn("name", f["h5md/author"].attrs)
            self.assertEqual(f["h5md/modules/units"].attrs["system"], b"SI")
            bodies = f["particles/bodies"]
            self.assertEqual(int(bodies["box"].attrs["dimension"]), 2)
            self.assertEqual(bodies["box"].attrs["boundary"].tolist(), [b"periodic", b"periodic"])
            self.assertEqual(bodies["box/edges"][()].tolist(), [5, 5])
            for name, unit in (("position", b"m"), ("velocity", b"m s-1"), ("angle", b"rad"), ("angular_velocity", b"rad s-1")):
                self.assertEqual(bodies[name]["value"].attrs["unit"], unit)
                self.assertEqual(bodies[name]["step"], bodies["position/step"], "one and the same")
                self.assertEqual(bodies[name]["time"].attrs["unit"], b"s")
                self.assertEqual(bodies[name]["value"].shape[:2], (61, 2))
            self.assertEqual(bodies["position/step"][:3].tolist(), [0, 5, 10])
            self.assertEqual(h5py.check_enum_dtype(bodies["species"].dtype)["fixed"], bodies["species"][1])
            self.assertEqual(bodies["name"][()].tolist(), [b"a, b #1", b""])
            self.assertEqual(bodies["mass"][()].tolist(), [1, 3])
            self.assertEqual(bodies["charge"][()].tolist(), [0, 0.5])
            self.assertEqual(bodies["id"][()].tolist(), [0, 1])
            self.assertEqual(f["parameters/hot"][()], 2)
            self.assertEqual(f["observables/energy_total/value"].attrs["unit"], b"J")
            numpy.testing.assert_allclose(f["observables/energy_total/value"][()], 5.01)
            self.assertEqual(bodies["position/value"].compression, "gzip")

    @unittest.skipUnless(h5py, "no h5py")
    def test_all_formats_have_the_same_numbers(self):
        rows = self.run_box()
        ball = [row for row in rows if row["body"] != "1"]
        frames = frames_of(self.path / "x.xyz")
        with h5py.File(self.path / "x.h5") as f:
            bodies = f["particles/bodies"]
            position, image = bodies["position/value"][:, 0], bodies["image/value"][:, 0]
            self.assertTrue(((position >= [-2, -1]) & (position < [3, 4])).all())
            self.assertTrue(image.any())
            unwrapped = position + image * bodies["box/edges"][()]
            for k, row in enumerate(ball):
                self.assertEqual(float(row["t [s]"]), bodies["position/time"][k])
                self.assertEqual([float(row["vx [m/s]"]), float(row["vy [m/s]"])], bodies["velocity/value"][k, 0].tolist())
                self.assertEqual(float(row["angle [rad]"]), bodies["angle/value"][k, 0])
                numpy.testing.assert_allclose(unwrapped[k], [float(row["x [m]"]), float(row["y [m]"])], atol=1e-14)
                pairs, columns = frames[k]
                self.assertEqual(float(pairs["Time"]), float(row["t [s]"]))
                numpy.testing.assert_allclose([float(cell) for cell in columns[0][1:3]], position[k], atol=1e-14)
                self.assertEqual([float(cell) for cell in columns[0][4:6]], [float(row["vx [m/s]"]), float(row["vy [m/s]"])])
                self.assertEqual([row[8] for row in columns], ["0", "1"])
        self.assertEqual(len(frames), len(ball))
        pairs, _ = frames[-1]
        self.assertEqual((pairs["pbc"], pairs["Lattice"]), ("T T F", "5 0 0 0 5 0 0 0 1"))
        self.assertIn("species:S:1:pos:R:3:velo:R:3", pairs["Properties"])

    @unittest.skipUnless(h5py, "no h5py")
    @unittest.skipUnless(ase, "no ase")
    def test_extended_xyz_is_read_by_others(self):
        self.succeeds("run", self.write(BOX), "--data", "x.xyz", "--csv", "x.csv")
        frames = ase.io.read(self.path / "x.xyz", index=":", format="extxyz")
        rows = rows_of(self.path / "x.csv")
        self.assertEqual(len(rows), 2 * len(frames))
        last = frames[-1]
        self.assertEqual((list(last.cell.lengths()[:2]), list(last.pbc[:2])), ([5, 5], [True, True]))
        for body, row in enumerate(rows[-2:]):
            position = [float(value) for name, value in row.items() if name.split(" ")[0] in ("x", "y")]
            for here, there in zip(last.positions[body], position):  # inside the box; a table has what was travelled
                self.assertAlmostEqual(math.remainder(here - there, 5), 0, delta=1e-12)
            self.assertEqual(last.arrays["radius"][body], (0.1, 0.2)[body])

    def test_worlds_without_bodies_frames_or_names(self):
        self.succeeds("run", self.write({"carom": 1, "run": {"duration": 0.1}}), *sum((["--data", f"x.{e}"] for e in ENDINGS), []))
        with h5py.File(self.path / "x.h5") as f:
            self.assertEqual(f["particles/bodies/id/value"][()].tolist(), [[-1]] * 7)
            self.assertTrue(math.isnan(f["particles/bodies/position/value"][0, 0, 0]))
        self.assertEqual(len(frames_of(self.path / "x.xyz")), 7)

    def test_an_ending_that_is_none(self):
        self.fails(2, "x.dat: a data file ends with .csv, .xyz, .extxyz, .h5 or .h5md", "run", self.write(FALL), "--data", "x.dat")

    def test_h5md_on_a_full_disk_or_a_device(self):
        scene = self.write({**FALL, "run": {"duration": 100, "step": 0.001}})
        with carom.small_disk(self.path / "disk", 200) as disk:
            (disk / "old.h5").write_text("old")
            for file in ("x.h5", "old.h5"):
                self.fails(1, f"cannot write disk/{file}: No space left on device", "run", scene, "--data", f"disk/{file}")
            self.assertEqual(os.listdir(disk), ["old.h5"])
        os.symlink("/dev/null", self.path / "null.h5")
        self.fails(1, "cannot write null.h5: HDF5 needs an ordinary file", "run", scene, "--data", "null.h5")
        self.fails(1, "cannot write nowhere/x.h5: No such file", "run", scene, "--data", "nowhere/x.h5")

    def test_h5md_that_fits_only_as_raw_frames(self):
        """The disk fills up while the file is made: an error, and neither half a file nor a crash."""
        scene = self.write({**GASES, "run": {"duration": 2, "step": 0.01}})
        sizes = range(350, 1000, 60)
        ends = set()
        for size in sizes:
            with carom.small_disk(self.path / "disk", size) as disk:
                ran = self.carom("run", scene, "--data", "disk/x.h5", "--json")
                ends.add(ran.returncode)
                self.assertIn(ran.returncode, (0, 1))
                self.assertEqual(os.listdir(disk), ["x.h5"] if ran.returncode == 0 else [])
                if ran.returncode == 1:
                    self.assertRegex(ran.stderr, r"^carom: cannot write disk/x.h5: No space left on device\n$")
            (self.path / "disk").rmdir()
        self.assertEqual(ends, {0, 1})


GASES = {"carom": 1, "walls": [{"type": "rectangle", "low": [0, 0], "high": [10, 10]}],
         "builders": [{"type": "gas", "temperature": 1, "fill": {"low": [0, 0], "high": [10, 10], "count": 40,
                                                                 "smallest_radius": 0.2, "largest_radius": 0.2}}]}


class TheRunInside(carom.Case):
    def hash_of(self, *arguments):
        ran = self.carom("run", *arguments, "--json")
        self.assertIn(ran.returncode, (0, 1), ran.stderr)
        return json.loads(ran.stdout)["state_hash"]

    def test_a_data_file_runs_and_makes_itself(self):
        """With the options that were given, for they are in the scene inside."""
        self.write(BOX)
        for k, ending in enumerate(ENDINGS):
            first, again = f"x.{ending}", f"y.{ending}"
            want = self.hash_of("scene.json", "--set", "hot=3", "--integrator", "rk4", "--seed", k, "--data", first)
            self.assertEqual(self.hash_of(first, "--data", again), want)
            self.assertEqual((self.path / first).read_bytes(), (self.path / again).read_bytes(), ending)

    def test_all_commands_take_them(self):
        self.carom("run", SCENES / "bounce.json", "--csv", "x.csv", "--data", "x.h5", "--data", "x.xyz")
        for file in ("x.csv", "x.h5", "x.xyz"):
            self.assertIn(f"{file}: ok, ", self.succeeds("validate", file).stdout)
            self.assertIn("A ball that bounces", self.carom("check", file, "--quantity", "energy.total").stdout)
            self.succeeds("render", file, "--file", "x.png")
            self.succeeds("plot", file, "--format", "svg")

    def test_what_a_file_says_of_its_run(self):
        ran = self.carom("run", self.write(BOX), "--csv", "x.csv", "--data", "x.xyz", "--data", "x.h5", "--json")
        report = json.loads(ran.stdout)
        said = dict(re.findall(r"^# carom\.(\w+): (.*)$", (self.path / "x.csv").read_text(), re.M))
        self.assertEqual(set(said), {"version", "build", "seed", "scene", "summary"})
        self.assertEqual(said["version"], report["version"])
        self.assertRegex(said["build"], r"^(g|clang)\+\+ \d+")
        self.assertEqual(said["seed"], "4")
        self.assertEqual(json.loads(said["scene"]), BOX)
        summary = json.loads(said["summary"])
        for passing in ("scene", "version", "seed", "wall_seconds"):
            report.pop(passing)
        self.assertEqual(summary, report)
        pairs, _ = frames_of(self.path / "x.xyz")[0]
        self.assertEqual({key: pairs["carom_" + key] for key in said if key != "summary"},
                         {key: words for key, words in said.items() if key != "summary"})
        last, _ = frames_of(self.path / "x.xyz")[-1]
        self.assertEqual(last["state_hash"], report["state_hash"])
        self.assertEqual(float(last["energy_total"]), report["energy"]["total"])
        if h5py:
            with h5py.File(self.path / "x.h5") as f:
                self.assertEqual(json.loads(f["carom/scene"][()]), BOX)
                self.assertEqual(json.loads(f["carom/summary"][()]), report)
                self.assertEqual(f["carom/build"][()].decode(), said["build"])

    def test_files_without_a_run(self):
        self.fails(2, "x.csv:1:1: syntax error", "run", self.write("a,b\n1,2\n", "x.csv"))
        self.fails(2, "x.csv: is empty", "run", self.write("# carom.seed: 3\n1,2\n", "x.csv"))
        self.fails(2, "x.xyz:2:", "run", self.write("1\nTime=3\nH 0 0 0\n", "x.xyz"))
        self.fails(2, "x.h5: cannot be read:", "run", self.write(b"\x89HDF\r\n\x1a\n" + bytes(1000), "x.h5"))
        if h5py:
            h5py.File(self.path / "x.h5", "w").close()
            self.fails(2, "x.h5: is HDF5, and has no scene of Carom's in it", "run", "x.h5")
        self.carom("run", self.write(FALL), "--data", "x.h5")
        whole = (self.path / "x.h5").read_bytes()
        for length in range(8, len(whole) - 1, len(whole) // 9):
            self.fails(2, "x.h5: ", "run", self.write(whole[:length], "x.h5"))


class QuantitiesOverTime(carom.Case):
    """What a joint bears, an energy, any expression could be drawn over time, and its numbers were in no file."""

    PENDULUM = {"carom": 1, "world": {"gravity": [0, -10]}, "parameters": {"L": 1},
                "bodies": [{"name": "bob", "position": ["L", 0], "mass": 2}],
                "joints": [{"name": "rod, of steel", "b": "bob", "type": "distance"}],
                "run": {"duration": 1, "step": 0.01, "every": 10}}

    def test_a_table_of_what_a_joint_bears(self):
        ran = self.succeeds("run", self.write(self.PENDULUM), "--quantity", "'rod, of steel'.force", "--quantity", "bob.vy/L",
                            "--quantity", "energy.kinetic", "--csv", "x.csv", "--data", "motion.csv")
        self.assertTrue(ran.stdout.endswith("wrote motion.csv\nwrote x.csv\n"), ran.stdout)
        rows, motion = rows_of(self.path / "x.csv"), rows_of(self.path / "motion.csv")
        self.assertEqual(list(rows[0]), ["t [s]", "'rod, of steel'.force [N]", "bob.vy/L", "energy.kinetic [J]"])
        self.assertEqual([float(row["t [s]"]) for row in rows], [float(row["t [s]"]) for row in motion])
        for row, state in zip(rows, motion):
            self.assertEqual(row["bob.vy/L"], state["vy [m/s]"])
            # m v²/L + m g cos = 3 m g cos of a pendulum from rest; the force is that of the step's last part, h/8 before.
            force = -3 * 2 * 10 * float(state["y [m]"])
            self.assertAlmostEqual(float(row["'rod, of steel'.force [N]"]), force, delta=60 * 6 * 0.01 / 8)
            speed2 = float(state["vx [m/s]"]) ** 2 + float(state["vy [m/s]"]) ** 2
            self.assertAlmostEqual(float(row["energy.kinetic [J]"]), speed2, delta=1e-12)
        self.succeeds("run", "x.csv")  # the run is in it

    def test_a_folder_has_the_table(self):
        said = self.succeeds("run", self.write(FALL), "--quantity", "ball.y", "--out", "o").stdout
        self.assertIn("wrote o/quantities.csv\n", said)
        self.assertAlmostEqual(float(rows_of(self.path / "o/quantities.csv")[-1]["ball.y [m]"]), 0, delta=1e-12)

    def test_a_killed_run_has_the_whole_table_in_the_end(self):
        scene = self.write({**self.PENDULUM, "run": {"duration": 300, "step": 0.01}})
        table = ("--quantity", "'rod, of steel'.force", "--quantity", "t^2")
        self.succeeds("run", scene, *table, "--csv", "whole.csv")
        process = subprocess.Popen([PROGRAM, "run", scene, *table, "--csv", "cut.csv", "--checkpoint", "every=100,file=c"],
                                   cwd=self.path, stdout=subprocess.DEVNULL)
        while not (self.path / "c").exists() and process.poll() is None:
            time.sleep(0.001)
        process.kill()
        process.wait()
        self.assertTrue((self.path / "c").exists(), "it was done before it was killed")
        self.fails(2, "goes on with its own files", "run", "--resume", "c", "--quantity", "t")
        self.succeeds("run", "--resume", "c")
        self.assertEqual((self.path / "cut.csv").read_bytes(), (self.path / "whole.csv").read_bytes())

    def test_what_no_table_can_have(self):
        scene = self.write(FALL)
        self.fails(2, "there is none: name a file with --csv or a folder with --out", "run", scene, "--quantity", "ball.y")
        self.fails(2, "--quantity bal.y: in \"bal.y\": there is no body 'bal'; did you mean 'ball'?", "run", scene,
                   "--quantity", "bal.y", "--csv", "x.csv")
        self.fails(2, f"{scene} is the scene that is run", "run", scene, "--quantity", "t", "--csv", scene)
        self.fails(2, "o/quantities.csv would be written twice", "run", scene, "--quantity", "t", "--out", "o", "--data",
                   "o/quantities.csv")
        self.fails(1, "make the folder no first", "run", scene, "--quantity", "t", "--csv", "no/x.csv")
        self.assertEqual(self.files(), [scene])


class Streaming(carom.Case):
    def peak(self, frames, *data):
        """Bytes at the most, of a run of so many frames."""
        scene = {**GASES, "builders": [{"type": "grid", "nx": 100, "ny": 100, "spacing": [1, 1], "body": {"velocity": [0.1, 0.3]}}],
                 "walls": [], "run": {"duration": frames, "step": 1}}
        self.write(scene)
        pid = os.fork()
        if pid == 0:
            os.chdir(self.path)
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            os.execv(PROGRAM, [PROGRAM, "run", "scene.json", "--json", *data])
        _, status, usage = os.wait4(pid, 0)
        self.assertEqual(status, 0)
        return usage.ru_maxrss * 1024

    def test_memory_does_not_grow_with_the_frames(self):
        for ending in ("csv", "h5", "xyz"):
            data = ("--data", f"x.{ending}", "--checkpoint", "every=50,file=c")
            few, many = self.peak(4, *data), self.peak(200, *data)
            self.assertGreater((self.path / f"x.{ending}").stat().st_size, 2e6)
            self.assertLess(many - few, 10e6, ending)


if __name__ == "__main__":
    carom.main()
