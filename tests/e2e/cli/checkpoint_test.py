"""Long runs: killed at any moment and resumed, they end as if nothing had been; Ctrl-C; full disks; wrong checkpoints."""

import json
import os
import random
import re
import shlex
import shutil
import signal
import subprocess
import time

import carom
from carom import FALL, PROGRAM

GAS = {"carom": 1, "seed": 5, "walls": [{"type": "rectangle", "low": [0, 0], "high": [10, 10]}],
       "builders": [{"type": "gas", "temperature": 1,
                     "fill": {"low": [0, 0], "high": [10, 10], "count": 60, "smallest_radius": 0.1, "largest_radius": 0.3,
                              "body": {"restitution": 0.99, "friction": 0.1}}}],
       "run": {"duration": 60, "step": "1/60", "every": 7}}
SPRINGS = {"carom": 1, "world": {"gravity": [0, -9.81], "integrator": "gauss-radau"},
           "bodies": [{"name": "nail", "kind": "fixed"}, {"name": "a", "position": [1, 0]}, {"name": "b", "position": [2, 0.5]}],
           "forces": [{"type": "spring", "a": "nail", "b": "a", "stiffness": 50, "rest_length": 1, "damping": 0.01},
                      {"type": "spring", "a": "a", "b": "b", "stiffness": 20, "rest_length": 1}, {"type": "drag", "linear": 0.01}],
           "run": {"duration": 400.007, "step": 0.01, "every": 10},
           "expects": [{"quantity": "b.y", "statistic": "minimum", "value": 0, "tolerance": 100},
                       {"quantity": "a.x", "statistic": "mean", "value": 0, "tolerance": 100},
                       {"quantity": "b.x", "statistic": "zero", "number": 5, "value": 0, "tolerance": 1000}]}
KEPLER = {"carom": 1, "world": {"integrator": {"method": "adaptive", "tolerance": 1e-12}},
          "bodies": [{"name": "sun", "mass": 1}, {"name": "planet", "mass": 1e-3, "position": [1, 0], "velocity": [0, 0.5]},
                     {"kind": "driven", "name": "probe"}],
          "forces": [{"type": "attraction", "strength": 1}, {"type": "drive", "body": "probe", "x": "sin(t)", "y": "3"}],
          "run": {"duration": 3000, "step": 0.05, "every": 125}}
BOX = {"carom": 1, "seed": 3, "walls": [{"type": "periodic", "low": [-5, -5], "high": [5, 5]}],
       "world": {"integrator": "verlet", "threads": 2},
       "builders": [{"type": "gas", "temperature": 2, "fill": {"low": [-5, -5], "high": [5, 5], "count": 50,
                                                               "smallest_radius": 0.1, "largest_radius": 0.2}}],
       "forces": [{"type": "drag", "linear": 0.1}, {"type": "field", "x": "-x*vy", "y": "x*vx + sin(t)"}],
       "run": {"duration": 45, "step": "1/60", "every": 9}}
SCENES = {"gas": GAS, "springs": SPRINGS, "kepler": KEPLER, "box": BOX}
OUTPUTS = ("csv", "h5", "xyz")
EVERY = {"gas": 100, "springs": 1000, "kepler": 1500, "box": 100}  # some thirty checkpoints in each run: the disk is slow


class Checkpoints(carom.Case):
    def files_of(self, name):
        return [word for ending in OUTPUTS for word in ("--data", f"{name}.{ending}")]

    def whole(self, scene, *options):
        """The run that nothing disturbed."""
        ran = self.carom("run", self.write(scene), *options, *self.files_of("whole"), "--json")
        self.assertIn(ran.returncode, (0, 1), ran.stderr)
        return json.loads(ran.stdout)

    def assert_same(self, whole, report, name="cut"):
        if report:
            self.assertEqual({**whole, "wall_seconds": 0}, {**report, "wall_seconds": 0})
        for ending in OUTPUTS:
            self.assertEqual((self.path / f"whole.{ending}").read_bytes(), (self.path / f"{name}.{ending}").read_bytes(), ending)

    def started(self, *arguments):
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def killed_until_done(self, first, checkpoint, chance, longest):
        """Runs and kills at random moments; the report, and how often it was killed. No report if the last one to be
        killed had done its work, and only not said so."""
        kills, command = 0, first
        while True:
            process = self.started(*command)
            try:
                out, err = process.communicate(timeout=chance.uniform(0, longest))
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                kills += 1
                self.assertLess(kills, 400, "the run makes no headway")
                longest *= 1.02  # in the end a slow machine gets through, also to its first checkpoint
                if command is not first and not (self.path / checkpoint).exists():
                    return None, kills
                if (self.path / checkpoint).exists():
                    command = ["run", "--resume", checkpoint, "--json"]
                continue
            self.assertIn(process.returncode, (0, 1), err)
            return json.loads(out), kills


class Killed(Checkpoints):
    def test_a_killed_run_ends_as_if_it_had_not_been(self):
        chance = random.Random(1)
        for name, scene in SCENES.items():
            with self.subTest(name):
                start = time.monotonic()
                whole = self.whole(scene)
                alone = time.monotonic() - start
                kills = 0
                for attempt in range(10):
                    first = ["run", "scene.json", *self.files_of("cut"), "--checkpoint", f"every={EVERY[name]},file=c", "--json"]
                    report, more = self.killed_until_done(first, "c", chance, alone / 2)
                    self.assert_same(whole, report)
                    kills += more
                    if kills >= 20:
                        break
                self.assertGreaterEqual(kills, 20)
                left = [file for file in self.files() if not re.fullmatch(r"scene.json|(whole|cut)\.\w+", file)]
                # Only a process that died before its first checkpoint, or when all was done, can leave something that
                # nobody knows of.
                self.assertTrue(all(file.endswith(".tmp") or file == "c.lock" for file in left), left)

    def test_a_folder_of_pictures_is_whole_too(self):
        scene = {**SPRINGS, "pictures": [{"type": "time", "quantities": ["a.x", "b.y"]}, {"type": "snapshots", "at": [1, 50]},
                                         {"type": "trajectories"}, {"type": "energy"}]}
        self.assertEqual(self.carom("run", self.write(scene), "--out", "whole", "--format", "svg").returncode, 0)
        first = ["run", "scene.json", "--out", "cut", "--format", "svg", "--checkpoint", "every=1000", "--json"]
        _, kills = self.killed_until_done(first, "cut/scene.checkpoint", random.Random(2), 0.1)
        self.assertGreater(kills, 0)
        (self.path / "cut/scene.checkpoint").unlink()  # it stays
        names = sorted(os.listdir(self.path / "whole"))
        self.assertEqual([name for name in sorted(os.listdir(self.path / "cut")) if not name.endswith(".tmp")], names)
        for name in names:
            if name != "report.json":  # it has the wall time
                self.assertEqual((self.path / "whole" / name).read_bytes(), (self.path / "cut" / name).read_bytes(), name)


class Longer(Checkpoints):
    ENDS = {"gas": 20.003, "springs": 100.003, "kepler": 1000, "box": 15.05}  # some with a step that is cut short

    def outputs(self, name):
        return [*self.files_of(name), "--quantity", "energy.total", "--quantity", "t^2", "--csv", f"{name}-table.csv"]

    # A run that had come to its end left no checkpoint, and --resume refused another --duration.
    def test_a_run_that_was_done_could_not_be_made_longer(self):
        for name, scene in SCENES.items():
            with self.subTest(name):
                file, end = self.write(scene), scene["run"]["duration"]
                whole = json.loads(self.carom("run", file, *self.outputs("whole"), "--json").stdout)
                first = ["--duration", self.ENDS[name], "--checkpoint", f"every={EVERY[name]},file=c,keep"]
                self.assertIn(self.carom("run", file, *first, *self.outputs("cut")).returncode, (0, 1))
                # Again to where it was: nothing changes.
                before = [(self.path / f"cut.{ending}").read_bytes() for ending in OUTPUTS]
                self.assertIn(self.carom("run", "--resume", "c").returncode, (0, 1))
                self.assertEqual(before, [(self.path / f"cut.{ending}").read_bytes() for ending in OUTPUTS])
                middle = (self.ENDS[name] + end) / 2
                self.assertIn(self.carom("run", "--resume", "c", "--duration", middle).returncode, (0, 1))
                report = json.loads(self.carom("run", file, "--resume", "c", "--duration", end, "--json").stdout)
                self.assert_same(whole, report)
                self.assertEqual((self.path / "whole-table.csv").read_bytes(), (self.path / "cut-table.csv").read_bytes())

    def test_one_that_is_killed_while_it_is_made_longer(self):
        whole = self.whole(GAS)
        self.succeeds("run", self.write(GAS), "--duration", 20.003, "--checkpoint", "every=100,file=c,keep", *self.files_of("cut"))
        chance, kills, longest = random.Random(4), 0, 0.05
        while True:
            process = self.started("run", "--resume", "c", "--duration", 60, "--json")
            try:
                out, err = process.communicate(timeout=chance.uniform(0, longest))
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                kills, longest = kills + 1, longest * 1.1
                continue
            self.assertEqual(process.returncode, 0, err)
            break
        self.assertGreater(kills, 5)
        self.assert_same(whole, json.loads(out))

    def test_one_that_was_interrupted_can_have_another_end(self):
        scene = self.write({**GAS, "run": {"duration": 1e5, "step": "1/60", "every": 50}})
        process = self.started("run", scene, *self.files_of("cut"), "--checkpoint", "every=1h,file=c")
        while not list(self.path.glob("cut.csv.*.tmp")):
            time.sleep(0.01)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        process.communicate()
        said = self.fails(2, "--duration 0.1 ends before the checkpoint, which is of t = ", "run", "--resume", "c", "--duration", 0.1)
        end = float(re.search(r"of t = (\S+) s", said.stderr)[1]) + 20
        whole = self.whole({**GAS, "run": {"duration": 1e5, "step": "1/60", "every": 50}}, "--duration", end)
        report = json.loads(self.carom("run", "--resume", "c", "--duration", end, "--json").stdout)
        self.assert_same(whole, report)
        self.assertEqual([file for file in self.files() if file.endswith(".tmp") or file == "c"], [])  # .h5 without 'keep'

    def test_pictures_and_measures_of_a_longer_run(self):
        scene = {**GAS, "world": {"solver": "events"},
                 "pictures": [{"type": "gas"}, {"type": "snapshots", "at": [1, 9, 30]}, {"type": "energy"}]}
        for option in ("whole", "--duration", 60), ("cut", "--duration", 20, "--checkpoint", "every=300,file=c"):
            self.succeeds("run", self.write(scene), "--out", option[0], "--format", "svg", *option[1:])
        self.succeeds("run", "--resume", "c", "--duration", 60)
        for name in sorted(os.listdir(self.path / "whole")):
            if name != "report.json":  # it has the wall time
                self.assertEqual((self.path / "whole" / name).read_bytes(), (self.path / "cut" / name).read_bytes(), name)

    def test_the_command_that_makes_it_longer_could_not_be_pasted(self):
        said = self.succeeds("run", self.write(FALL, "it's a fall.json"), "--checkpoint", "every=10").stdout.splitlines()[-1]
        words = shlex.split(said)
        self.assertEqual(words[:4], ["carom", "run", "--resume", "it's a fall.checkpoint"])
        self.succeeds(*words[1:4], "--duration", 2)

    def test_what_cannot_be_made_longer_says_why(self):
        scene = self.write({**FALL, "run": {"duration": 1}, "pictures": [{"type": "snapshots"}]})
        self.succeeds("run", scene, "--out", "o", "--checkpoint", "every=10,file=c")
        before = {file: (self.path / file).read_bytes() for file in self.files() if (self.path / file).is_file()}
        self.fails(2, "the picture 'snapshots' has no 'at', and thirds of 2 s are not those of 1 s", "run", "--resume", "c", "--duration", 2)
        self.fails(2, "--duration 0.5 ends before the checkpoint", "run", "--resume", "c", "--duration", 0.5)
        self.fails(2, "--step cannot change: --duration and --threads alone can", "run", "--resume", "c", "--duration", 2, "--step", 0.1)
        self.fails(2, "is a checkpoint of another scene", "run", scene, "--resume", "c", "--duration", 2, "--step", 0.1)
        self.assertEqual(before, {file: (self.path / file).read_bytes() for file in before})
        self.assertIn("carom run --resume c --duration TIME makes it longer",
                      self.succeeds("run", scene, "--csv", "a.csv", "--checkpoint", "every=10,file=c").stdout)
        self.assertNotIn("longer", self.succeeds("run", scene, "--data", "a.h5", "--checkpoint", "every=10,file=c").stdout)
        self.assertFalse((self.path / "c").exists())


class Interrupted(Checkpoints):
    def interrupt(self, how, *arguments):
        process = self.started("run", *arguments)
        # A resumed run has its checkpoint from the start, and its data when it is about to begin.
        while not ((self.path / "c").exists() and list(self.path.glob("cut.csv.*.tmp"))):
            time.sleep(0.01)
        time.sleep(0.1)
        process.send_signal(how)
        out, err = process.communicate(timeout=60)
        self.assertEqual((process.returncode, err), (1, b""))
        return out.decode()

    def test_the_note_about_frames_was_missing_in_the_report(self):
        scene = {"carom": 1, "bodies": [{}], "run": {"duration": 1e6, "step": 1e-3, "every": 100}}
        process = self.started("run", self.write(scene), "--out", "o", "--json")
        while not list(self.path.glob("o/*.tmp")):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        notes = json.loads(process.communicate(timeout=60)[0])["notes"]
        self.assertRegex(notes[0], "keep all of 1e.07 frames until they are drawn")

    def test_ctrl_c_leaves_whole_files_and_a_checkpoint(self):
        scene = {**GAS, "run": {"duration": 800, "step": "1/60", "every": 50}}
        whole = self.whole(scene)
        data = ["scene.json", *self.files_of("cut"), "--checkpoint", "every=1h,file=c"]
        said = self.interrupt(signal.SIGINT, *data)
        self.assertIn("interrupted", said)
        self.assertIn("carom run --resume c goes on", said)
        for ending in OUTPUTS:
            ran = self.carom("run", f"cut.{ending}", "--duration", "0.1", "--json")
            self.assertEqual(json.loads(ran.stdout)["bodies"], 60)
        shorter = (self.path / "cut.csv").read_text()
        self.assertEqual(float(shorter.splitlines()[-2].split(",")[0]), json.loads(shorter.splitlines()[-1].split(": ", 1)[1])["time"])
        self.assertIn('"interrupted": true', shorter.splitlines()[-1])
        # Interrupted once more, with another signal, and then left alone.
        self.interrupt(signal.SIGTERM, "--resume", "c")
        self.assertGreater(len((self.path / "cut.csv").read_text()), len(shorter))
        report = json.loads(self.carom("run", "--resume", "c", "--json").stdout)
        self.assert_same(whole, report)
        self.assertEqual([file for file in self.files() if file.endswith(".tmp") or file == "c"], [])

    # Whoever had more cores than before could not use them.
    def test_other_threads_were_refused_though_they_change_nothing(self):
        scene = {**GAS, "run": {"duration": 800, "step": "1/60", "every": 50}}
        data = [self.write(scene), *self.files_of("cut"), "--checkpoint", "every=1h,file=c"]
        self.interrupt(signal.SIGINT, *data)
        report = json.loads(self.carom("run", "--resume", "c", "--threads", 2, "--json").stdout)
        self.assert_same(self.whole(scene, "--threads", 2), report)

    def test_a_terminal_that_was_closed_killed_the_run(self):
        data = [self.write({**GAS, "run": {"duration": 1e6, "step": "1/60"}}), *self.files_of("cut"), "--checkpoint", "every=1h,file=c"]
        self.assertIn("carom run --resume c goes on", self.interrupt(signal.SIGHUP, *data))
        self.assertTrue({"c", "cut.csv", "cut.h5", "cut.xyz"} < set(self.files()), self.files())
        # The shell and the system both tell of it, and nohup has neither heard.
        for before, survives in ((lambda: None, False), (lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN), True)):
            for file in ("c", "cut.csv"):
                (self.path / file).unlink(missing_ok=True)
            process = subprocess.Popen([PROGRAM, "run", "scene.json", "--csv", "cut.csv", "--checkpoint", "every=1h,file=c"],
                                       cwd=self.path, preexec_fn=before, stdout=subprocess.DEVNULL)
            while not list(self.path.glob("cut.csv.*.tmp")):
                time.sleep(0.01)
            for _ in range(20):
                process.send_signal(signal.SIGHUP)
            time.sleep(0.3)
            self.assertEqual(process.poll() is None, survives)
            if survives:
                process.kill()
            process.wait()
            self.assertEqual((self.path / "cut.csv").exists(), not survives)

    def test_files_stay_whole_while_a_resumed_run_goes_on(self):
        data = ["--csv", "cut.csv", "--checkpoint", "every=1h,file=c"]
        self.interrupt(signal.SIGINT, self.write({**GAS, "run": {"duration": 1e5, "step": "1/60", "every": 10}}), *data)
        before = (self.path / "cut.csv").read_bytes()
        process = self.started("run", "--resume", "c")
        time.sleep(0.5)
        process.kill()
        process.communicate()
        self.assertEqual((self.path / "cut.csv").read_bytes(), before)

    def test_a_resumed_run_may_be_elsewhere_and_have_other_checkpoints(self):
        whole = self.whole({**GAS, "run": {"duration": 300, "step": "1/60", "every": 70}})
        self.interrupt(signal.SIGINT, "scene.json", *self.files_of("cut"), "--checkpoint", "every=1h,file=c")
        (self.path / "elsewhere").mkdir()
        ran = self.carom("run", "--resume", "../c", "--json", "--checkpoint", "every=1min,file=d", cwd=self.path / "elsewhere")
        self.assert_same(whole, json.loads(ran.stdout))

    def test_time_of_the_clock(self):
        scene = {**GAS, "run": {"duration": 1e5, "step": "1/60", "every": 100}}
        process = self.started("run", self.write(scene), "--checkpoint", "every=0.1s,file=c")
        seen, end = set(), time.monotonic() + 60
        while len(seen) < 5 and time.monotonic() < end:
            time.sleep(0.02)
            if (self.path / "c").exists():
                seen.add((self.path / "c").stat().st_mtime_ns)
        process.kill()
        self.assertEqual(len(seen), 5)


    def test_a_step_without_end_leaves_nothing_behind(self):
        scene = {**GAS, "world": {"solver": "events"}, "run": {"duration": 1e9, "step": 1e9}}
        for second in (signal.SIGINT, signal.SIGTERM, None):  # None: patience ends
            process = self.started("run", self.write(scene), *self.files_of("cut"))
            while len(list(self.path.glob("cut.*.tmp"))) < len(OUTPUTS):
                time.sleep(0.01)
            time.sleep(0.3)
            process.send_signal(signal.SIGINT)
            time.sleep(0.1)
            self.assertIsNone(process.poll())
            if second:
                process.send_signal(second)
            _, err = process.communicate(timeout=60)
            self.assertEqual(process.returncode, -second if second else 1, err)
            self.assertEqual(self.files(), ["scene.json"])


class Disk(Checkpoints):
    def test_a_full_disk_leaves_the_checkpoint_before_it(self):
        scene = {**GAS, "run": {"duration": 60, "step": "1/60", "every": 2}}
        whole = self.whole(scene)
        with carom.small_disk(self.path / "disk", 2000) as disk:
            data = [word for ending in OUTPUTS for word in ("--data", disk / f"cut.{ending}")]
            ran = self.carom("run", "scene.json", *data, "--checkpoint", f"every=100,file={disk}/c")
            self.assertEqual(ran.returncode, 1)
            self.assertRegex(ran.stderr, r"^carom: cannot write .*: No space left on device; "
                                          rf"carom run --resume {re.escape(str(disk))}/c goes on from the last checkpoint\n$")
            self.assertTrue((disk / "c").exists())
            subprocess.run(["mount", "-o", "remount,size=100M", disk], check=True)
            report = json.loads(self.carom("run", "--resume", disk / "c", "--json").stdout)
            for ending in OUTPUTS:
                shutil.move(disk / f"cut.{ending}", self.path)
            self.assertEqual(os.listdir(disk), [])
        self.assert_same(whole, report)

    def test_nowhere_to_write_is_said_before_the_run(self):
        scene = self.write({**FALL, "run": {"duration": 1e9, "step": 1e-3}})
        for file, why in (("nowhere/c", "No such file or directory"), (".", "Is a directory")):
            ran = self.carom("run", scene, "--checkpoint", f"every=60s,file={file}")
            self.assertEqual(ran.returncode, 1)
            self.assertRegex(ran.stderr, rf"^carom: cannot write {re.escape(file)}: {why}.*\n$")
        for options in (("--csv", "/dev/full", "--checkpoint", "every=60s"), ("--checkpoint", "every=60s,file=/dev/full")):
            self.fails(2, "/dev/full is no ordinary file, and no run can go on with it", "run", scene, *options)


class Another(Checkpoints):
    """A run whose checkpoints would have the name of another's."""

    LONG = {**GAS, "run": {"duration": 1e6, "step": "1/60", "every": 50}}

    def first(self, *options):
        process = self.started("run", self.write(self.LONG), "--csv", "a.csv", "--checkpoint", "every=20", *options)
        while not (self.path / "scene.checkpoint").exists():
            time.sleep(0.01)
        return process

    def second(self, text):
        before = (self.path / "scene.checkpoint").read_bytes()
        self.fails(2, text, "run", "scene.json", "--seed", 2, "--csv", "b.csv", "--checkpoint", "every=20")
        return before

    def test_a_second_run_replaced_the_checkpoint_of_one_that_was_killed(self):
        process = self.first()
        time.sleep(0.5)
        process.kill()
        process.communicate()
        files = self.files()
        before = self.second("scene.checkpoint is of a run that was interrupted at t = ")
        self.second("s of 1e+06 s (a.csv): go on with it (carom run --resume scene.checkpoint), remove it, or give another "
                    "name (--checkpoint every=20,file=NAME)")
        self.assertEqual(((self.path / "scene.checkpoint").read_bytes(), self.files()),
                         (before, [file for file in files if file != "scene.checkpoint.lock"]))
        # Nor does a run that goes on from another one.
        self.succeeds("run", "scene.json", "--duration", 1, "--csv", "b.csv", "--checkpoint", "every=10,file=d")
        self.fails(2, "is of a run that was interrupted", "run", "--resume", "d", "--duration", 2, "--checkpoint",
                   "every=20,file=scene.checkpoint")
        self.assertEqual((self.path / "scene.checkpoint").read_bytes(), before)
        self.write((self.path / "scene.checkpoint").read_bytes()[:-9], "scene.checkpoint")  # it is damaged
        self.succeeds("run", "scene.json", "--duration", 1, "--csv", "b.csv", "--checkpoint", "every=20")
        self.succeeds("run", "scene.json", "--duration", 1, "--csv", "b.csv", "--checkpoint", "every=20")  # it is done

    def test_two_runs_at_a_time_wrote_one_checkpoint_and_died_of_it(self):
        process = self.first()
        self.fails(2, "scene.checkpoint is being written by another process: give another name (--checkpoint "
                   "every=20,file=NAME)", "run", "scene.json", "--csv", "b.csv", "--checkpoint", "every=20")
        (self.path / "link").symlink_to("scene.checkpoint")
        self.fails(2, "link is being written by another process", "run", "scene.json", "--checkpoint", "every=1min,file=link")
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.assertEqual(self.files(), ["a.csv", "link", "scene.checkpoint", "scene.json"])
        self.second("go on with it")

    def test_the_lock_is_gone_whatever_ends_the_run(self):
        scene = {**GAS, "world": {"solver": "events"}, "run": {"duration": 1e9, "step": 1e9}}
        process = self.started("run", self.write(scene), "--checkpoint", "every=20,file=c")
        while not (self.path / "c").exists():
            time.sleep(0.01)
        self.assertIn("c.lock", self.files())
        time.sleep(0.3)
        for _ in range(2):
            process.send_signal(signal.SIGINT)
            time.sleep(0.1)
        process.communicate()
        self.assertEqual(self.files(), ["c", "scene.json"])
        self.write("mine", "c.lock")
        self.fails(2, "c.lock is no lock of Carom's and would be removed: give another name", "run", "scene.json",
                   "--checkpoint", "every=1min,file=c")
        self.assertEqual((self.path / "c.lock").read_text(), "mine")


class Wrong(Checkpoints):
    def test_options(self):
        scene = self.write(FALL)
        for text in ("60s", "every=", "every=0", "every=-1", "every=1.5", "every=1parsec", "every=inf", "every=nan", "often=1",
                     "every=60s,file=", "every=60s,", "every=1e300"):
            self.fails(2, f"--checkpoint {text}: must be every=N", "run", scene, "--checkpoint", text)
        self.fails(2, "SCENE is required", "run")
        self.fails(2, "x.csv would be written twice", "run", scene, "--csv", "x.csv", "--data", "x.csv")

    def checkpoint(self):
        """One that a killed run left."""
        scene = self.write({**GAS, "run": {"duration": 1e6, "step": "1/60", "every": 50}})
        process = self.started("run", scene, "--csv", "x.csv", "--checkpoint", "every=100,file=c")
        while not (self.path / "c").exists():
            time.sleep(0.01)
        time.sleep(0.3)
        process.kill()
        process.communicate()
        return (self.path / "c").read_bytes()

    def test_files_that_are_none(self):
        self.fails(2, "nothing: cannot be read: No such file or directory", "run", "--resume", "nothing")
        self.fails(2, ".: is a folder, and must be a checkpoint", "run", "--resume", ".")
        for text in (b"", b"x", b"carom", json.dumps(FALL).encode(), bytes(range(256)) * 100):
            self.fails(2, "x: is no checkpoint of Carom's", "run", "--resume", self.write(text, "x"))

    def test_damaged_ones_lose_nothing(self):
        good = self.checkpoint()
        before = {file: (self.path / file).read_bytes() for file in self.files()}
        chance = random.Random(3)
        for k in range(60):
            bad = bytearray(good)
            if k % 2:
                bad[chance.randrange(17, len(bad))] ^= 1 << chance.randrange(8)
            else:
                bad = bad[:chance.randrange(17, len(bad))]
            self.fails(2, "bad: the checkpoint is damaged or not whole", "run", "--resume", self.write(bytes(bad), "bad"))
        self.fails(2, "bad: the checkpoint is damaged or not whole", "run", "bad")
        (self.path / "bad").unlink()
        self.assertEqual(before, {file: (self.path / file).read_bytes() for file in self.files()})

    def test_another_scene_or_other_files(self):
        self.checkpoint()
        self.fails(2, "--resume c: is a checkpoint of another scene than scene.json with these options",
                   "run", "scene.json", "--seed", 7, "--resume", "c")
        self.fails(2, "--resume c: goes on with its own scene, which --step cannot change", "run", "--step", 1, "--resume", "c")
        self.fails(2, "--resume c: goes on with its own files", "run", "--csv", "y.csv", "--resume", "c")

    def test_a_run_that_is_still_alive(self):
        process = self.started("run", self.write({**GAS, "run": {"duration": 1e6, "step": "1/60"}}), "--csv", "x.csv",
                               "--checkpoint", "every=100,file=c")
        while not (self.path / "c").exists():
            time.sleep(0.01)
        self.fails(2, "c is being written by another process", "run", "--resume", "c")
        (self.path / "c.lock").unlink()
        self.fails(2, "x.csv are being written by another process", "run", "--resume", "c")
        self.assertIsNone(process.poll())

    def test_data_that_are_gone_or_changed(self):
        self.checkpoint()
        (data,) = [file for file in self.files() if file.startswith("x.csv.") and file.endswith(".tmp")]
        content = (self.path / data).read_bytes()
        (self.path / data).write_bytes(content[:100])
        self.fails(2, "the data of", "run", "--resume", "c")
        (self.path / data).write_bytes(b"x" * len(content))
        self.fails(2, "are not where the checkpoint left them", "run", "--resume", "c")
        (self.path / data).unlink()
        self.fails(2, "are not where the checkpoint left them", "run", "--resume", "c")


if __name__ == "__main__":
    carom.main()
