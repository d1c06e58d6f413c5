"""Files that are written: which, whole or not at all, on full and forbidden disks; pictures and films."""

import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import time
import unittest

import carom
from carom import FALL, SCENES

LONG = {**FALL, "run": {"duration": 100, "step": 0.001}}


class Unwritable(carom.Case):
    def setUp(self):
        super().setUp()
        self.scene = self.write(FALL)
        self.write("a file", "file")

    def test_data(self):
        self.fails(1, "cannot write file/x.csv: Not a directory", "run", self.scene, "--csv", "file/x.csv")
        self.fails(1, "cannot write nowhere/x.png: No such file or directory: make the folder nowhere first", "render", self.scene,
                   "--file", "nowhere/x.png")
        self.fails(1, "cannot write nowhere/x.csv: No such file or directory", "run", self.scene, "--csv", "nowhere/x.csv")
        self.fails(1, "cannot write /proc/x.csv:", "run", self.scene, "--csv", "/proc/x.csv")
        self.fails(1, "cannot write .: Is a directory", "run", self.scene, "--csv", ".")
        self.fails(1, "cannot write /dev/full: No space left on device", "run", self.scene, "--csv", "/dev/full")

    def test_folders(self):
        self.fails(1, "the folder file cannot be made: Not a directory", "run", self.scene, "--out", "file")
        self.fails(1, "the folder file/out cannot be made: Not a directory", "run", self.scene, "--out", "file/out")
        self.fails(1, "the folder /proc/out cannot be made:", "run", self.scene, "--out", "/proc/out")
        self.fails(1, "the folder file cannot be made: Not a directory", "plot", self.scene, "--out", "file")
        self.fails(1, "the folder file cannot be made: Not a directory", "schema", "--reference", "file")
        # It was told after the study, which may be a long one.
        self.fails(1, "the folder file cannot be made: Not a directory", "check", self.scene, "--out", "file")

    # It was to be made first, by hand.
    def test_a_file_in_the_folder_that_is_made_was_refused(self):
        for folder in ("o", "p/"):
            self.succeeds("run", self.scene, "--out", folder, "--data", "./" + folder.rstrip("/") + "/a.h5")
            self.assertTrue((self.path / folder / "a.h5").is_file())
        self.fails(1, "make the folder q/r first", "run", self.scene, "--out", "q", "--data", "q/r/a.h5")

    def test_a_folder_named_minus_was_made(self):
        for command in (("run", self.scene), ("plot", self.scene), ("check", self.scene), ("tour",)):
            self.fails(2, "- is standard output, and no folder", *command, "--out", "-")
        self.assertEqual(self.files(), ["file", "scene.json"])

    def test_pictures_and_films_are_tried_before_the_run(self):
        forever = self.write({**FALL, "run": {"duration": 1e9, "step": 1e-3}})
        for ending in ("png", "svg", "pdf"):
            self.fails(1, f"cannot write file/x.{ending}: Not a directory", "render", forever, "--file", f"file/x.{ending}")
        room = self.write({**FALL, "run": {"duration": 1e9, "step": 1e-3}, "walls": [{"type": "rectangle", "low": [-9, -9], "high": [9, 9]}]})
        for ending in ("mp4", "webm", "gif"):
            self.fails(1, f"cannot write file/x.{ending}: Not a directory", "render", room, "--file", f"file/x.{ending}")

    def test_standard_output(self):
        for arguments in ("schema", f"run {self.scene}", f"run {self.scene} --json", "--help"):
            ran = subprocess.run(f"{carom.PROGRAM} {arguments} > /dev/full", shell=True, cwd=self.path, capture_output=True, text=True)
            self.assertEqual(ran.returncode, 1, arguments)
            self.assertEqual(ran.stderr, "carom: cannot write to standard output: No space left on device\n")  # of schema it was "file"
        # Whoever has nobody to tell is not aborted.
        self.assertEqual(subprocess.run(f"{carom.PROGRAM} nothing > /dev/full 2>&1", shell=True, cwd=self.path).returncode, 2)


class Overwritten(carom.Case):
    """What a run would have written over is said before anything is run."""

    def keeps(self, text, *options, file="scene.json"):
        before = {name: (self.path / name).read_bytes() for name in self.files()}
        self.fails(2, text, "run", file, *options)
        self.assertEqual({name: (self.path / name).read_bytes() for name in self.files()}, before)

    def setUp(self):
        super().setUp()
        self.write(FALL)
        (self.path / "link.json").symlink_to("scene.json")
        (self.path / "folder").mkdir()

    def test_a_checkpoint_deleted_a_thesis(self):
        self.write("A thesis\n", "thesis.txt")
        for name in "thesis.txt", "folder/../thesis.txt":
            self.keeps("is no checkpoint of Carom's and would be overwritten", "--checkpoint", f"every=10,file={name}")
        self.write("A thesis\n", "c.tmp")  # where a checkpoint is written
        self.keeps("c.tmp is no checkpoint of Carom's", "--checkpoint", "every=10,file=c")

    def test_outputs_overwrote_the_scene(self):
        said = "is the scene that is run, and would be overwritten"
        for name in "scene.json", "./scene.json", "folder/../scene.json", "link.json", self.path / "scene.json":
            self.keeps(said, "--csv", name)
            self.keeps(said, "--checkpoint", f"every=10,file={name}")
            self.keeps(said, "--csv", "scene.json", file=name)
            self.keeps(said, "--sweep", "world.gravity=[0,-1],[0,-2]", "--csv", name)
        self.keeps(said, "--out", ".")
        self.keeps(said, "--out", "folder/..", file="link.json")
        self.succeeds("run", "scene.json", "--data", "x.csv")  # a data file is a scene, too
        self.keeps(said, "--data", "./x.csv", file="x.csv")

    def test_two_outputs_were_one_file(self):
        said = "would be written twice"
        self.keeps(said, "--data", "a.h5", "--data", "./a.h5")
        self.keeps(said, "--csv", "a.csv", "--data", "folder/../a.csv")
        self.keeps(said, "--out", "folder", "--csv", "folder/report.json")
        self.keeps(said, "--csv", "a.csv", "--checkpoint", "every=10,file=./a.csv")

    # It made a file of that name.
    def test_minus_was_a_file_to_write(self):
        for options in ("--csv", "-"), ("--csv", "-", "--sweep", "run.step=0.1,0.2"), ("--checkpoint", "every=10,file=-"):
            self.fails(2, "- is standard input, and no file to write", "run", self.write(FALL), *options)
        self.fails(2, "-: a data file ends with .csv", "run", "scene.json", "--data", "-")
        self.assertNotIn("-", self.files())

    def test_what_a_run_left_may_be_replaced(self):
        for _ in range(2):
            self.succeeds("run", "scene.json", "--out", "folder", "--checkpoint", "every=10,file=c")
        self.assertEqual(self.carom("run", "scene.json", "--csv", "/dev/stdout").returncode, 0)


class FullDisk(carom.Case):
    def test_a_file_that_does_not_fit_is_not_there(self):
        with carom.small_disk(self.path / "disk", 64) as disk:
            (disk / "old.csv").write_text("old\n")
            self.fails(1, "cannot write disk/x.csv: No space left on device", "run", self.write(LONG), "--csv", "disk/x.csv")
            self.fails(1, "cannot write disk/old.csv: No space left on device", "run", "scene.json", "--csv", "disk/old.csv")
            self.fails(1, "No space left on device", "run", "scene.json", "--out", "disk/out")
            shutil.rmtree(disk / "out", ignore_errors=True)
            for ending in "png", "pdf":  # the name was there twice
                ran = self.carom("plot", self.write(FALL, "fall.json"), "--out", "disk/out", "--format", ending, "--step", 1e-5)
                self.assertRegex(ran.stderr, rf"carom: cannot write disk/out/\w+\.{ending}: No space left on device\n$")
            shutil.rmtree(disk / "out", ignore_errors=True)
            (self.path / "fall.json").unlink()
            self.assertEqual(self.files(), ["disk/old.csv", "scene.json"])
            self.assertEqual((disk / "old.csv").read_text(), "old\n")

    def test_a_limit_on_the_size_of_files(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
        self.fails(1, "cannot write x.csv: File too large", "run", self.write(LONG), "--csv", "x.csv", preexec_fn=limit)
        self.assertEqual(self.files(), ["scene.json"])


class Written(carom.Case):
    def test_a_folder_has_everything(self):
        ran = self.succeeds("run", SCENES / "gas.json", "--out", "a/b/out")
        said = [line.removeprefix("wrote ") for line in ran.stdout.splitlines() if line.startswith("wrote ")]
        self.assertEqual(sorted(said), self.files())
        self.assertEqual({pathlib.Path(file).name for file in said},
                         {"trajectory.csv", "report.json", "scene.json", "end.png", "snapshots.png", "energy.png"})
        out = self.path / "a/b/out"
        report = json.loads((out / "report.json").read_text())
        again = json.loads(self.succeeds("run", "a/b/out/scene.json", "--json").stdout)
        self.assertEqual(report["state_hash"], again["state_hash"])
        self.assertEqual(len(self.table("a/b/out/trajectory.csv")), 1 + 15 * 301)

    @unittest.skipUnless(shutil.which("gnuplot"), "no gnuplot")
    def test_the_panels_of_an_instant_were_all_of_its_start(self):
        scene = {**FALL, "run": {"duration": 1e-9, "step": 5e-10}, "pictures": [{"type": "snapshots", "at": [0, 5e-10, 1e-9]}]}
        self.succeeds("run", self.write(scene), "--out", "out", "--format", "svg")
        drawn = (self.path / "out/snapshots.svg").read_text()
        self.assertEqual([f"t = {at} s" in drawn for at in ("0", "5e-10", "1e-09")], [True] * 3)

    def test_every_thins_the_data(self):
        self.succeeds("run", self.write(FALL), "--csv", "x.csv", "--every", "30")
        times = [float(row[0]) for row in self.table("x.csv")[1:]]
        for time, expected in zip(times, (0, 0.3, 0.6, 0.9, 1.0), strict=True):
            self.assertAlmostEqual(time, expected)

    def test_a_path_has_the_colour_of_its_body(self):
        violet = {"name": "ball", "position": [0, 5], "colour": "#b405c8"}
        other = {"name": "other", "position": [1, 5]}
        self.succeeds("plot", self.write({**FALL, "bodies": [violet, other]}), "--out", "p", "--format", "svg")
        self.assertRegex((self.path / "p/trajectories.svg").read_text(), "(?i)#b405c8|rgb\\( ?180, +5, 200\\)")

    def test_a_gas_is_no_tangle_of_paths(self):
        fill = {"high": [9, 9], "count": 30, "smallest_radius": 0.2, "largest_radius": 0.2}
        gas = {"carom": 1, "world": {"solver": "events"}, "walls": [{"type": "rectangle", "high": [9, 9]}],
               "builders": [{"type": "gas", "temperature": 1, "fill": fill}], "run": {"duration": 5, "step": 0.1}}
        self.assertEqual(self.succeeds("plot", self.write(gas), "--out", "p").stdout, "p/gas.png\np/energy.png\n")

    def test_plot_prints_the_files_it_made(self):
        ran = self.succeeds("plot", SCENES / "spring-pendulum.json", "--out", "p", "--format", "svg")
        self.assertEqual(sorted(ran.stdout.split()), self.files())
        self.assertIn("p/energy.svg", ran.stdout)

    def test_two_pictures_of_one_type_are_two_files(self):
        pictures = [{"type": "time", "quantities": ["ball.x"]}, {"type": "time", "quantities": ["ball.vy"]}]
        ran = self.succeeds("plot", self.write({**FALL, "pictures": pictures}))
        self.assertEqual(ran.stdout.split(), ["out/time.png", "out/time-2.png"])

    def test_a_picture_was_overwritten_by_another_of_its_name(self):
        named = [{"type": "time", "name": name, "quantities": ["ball.x"]} for name in ("a", "a", "a-2", "trajectories-2", "end")]
        scene = self.write({**FALL, "pictures": [{"type": "trajectories"}, {"type": "trajectories"}, *named]})
        files = [f"out/{name}.png" for name in ("trajectories", "trajectories-3", "a", "a-3", "a-2", "trajectories-2", "end-2")]
        self.assertEqual(self.succeeds("plot", scene).stdout.split(), files)
        wrote = re.findall("wrote (.*png)", self.succeeds("run", scene, "--out", "out").stdout)
        self.assertEqual(wrote, ["out/end.png", *files])

    def test_a_quantity_has_one_colour_in_all_pictures(self):
        pictures = [{"type": "time", "quantities": list(some)} for some in (["ball.x", "ball.vy"], ["ball.vy", "ball.vx"])]
        self.succeeds("plot", self.write({**FALL, "pictures": pictures}), "--format", "svg")
        colours = {}
        for name in ("time", "time-2"):
            text = (self.path / f"out/{name}.svg").read_text()
            for quantity, rest in re.findall(r"<title>(ball\.\w+)[^<]*</title>(.*?)(?=<title>|$)", text, re.DOTALL):
                own = next(c for c in re.findall(r"path stroke='rgb\(([^)]*)\)", rest) if c.split(",") != [" 34", "  34", "  34"])
                colours.setdefault(quantity, []).append(own)
        self.assertEqual({q: len(seen) for q, seen in colours.items()}, {"ball.x": 1, "ball.vy": 2, "ball.vx": 1})
        self.assertEqual(*colours["ball.vy"])
        self.assertEqual(len({seen[0] for seen in colours.values()}), 3, colours)

    def test_a_failed_run_keeps_all_but_the_last_picture(self):
        scene = {**FALL, "forces": [{"type": "field", "x": "exp(x*x) * x * 100"}], "bodies": [{"name": "b", "position": [1, 0]}]}
        ran = self.carom("run", self.write(scene), "--out", "out")
        self.assertEqual(ran.returncode, 1)
        self.assertIn("the run went wrong", ran.stderr)
        self.assertTrue((self.path / "out/trajectory.csv").exists())
        self.assertIn("the run went wrong", json.loads((self.path / "out/report.json").read_text())["failure"])

    # gnuplot took the first two of three quotes for a text of its own.
    def test_a_name_in_quotes_was_a_word_of_gnuplots(self):
        ball = {"name": "my ball", "position": [0, 5]}
        pictures = [{"type": "time", "quantities": ["'my ball'.y"], "title": "'my ball'"},
                    {"type": "phase", "quantities": ["'my ball'.y", "'my ball'.vy"]}, {"type": "trajectories"}]
        scene = self.write({**FALL, "bodies": [ball, {**ball, "name": "it's `ls`"}], "pictures": pictures})
        self.succeeds("plot", scene, "--out", "p", "--format", "svg")
        self.assertIn(">my ball.y [m]<", (self.path / "p/time.svg").read_text())
        self.assertIn(">my ball.vy [m/s]<", (self.path / "p/phase.svg").read_text())
        self.assertIn(">it's `ls`<", (self.path / "p/trajectories.svg").read_text())

    def test_a_picture_that_failed_was_the_last(self):
        (self.path / "p/first.svg").mkdir(parents=True)
        pictures = [{"type": "time", "name": name, "quantities": ["ball.y"]} for name in ("first", "second")]
        scene = self.write({**FALL, "pictures": pictures})
        self.fails(1, "cannot write p/first.svg: Is a directory", "plot", scene, "--out", "p", "--format", "svg")
        self.assertIn("p/second.svg", self.files())

    # It went on alone, at 100 % of a core, and Carom said after five seconds that it was within a step.
    def test_ctrl_c_left_gnuplot_behind(self):
        tools = self.path / "bin"
        tools.mkdir()
        gnuplot = tools / "gnuplot"
        gnuplot.write_text("#!/bin/sh\necho $$ > pid\ncat > /dev/null\nexec sleep 100\n")
        gnuplot.chmod(0o755)
        pictures = [{"type": "time", "name": name, "quantities": ["ball.y"]} for name in ("first", "second")]
        scene = self.write({**FALL, "pictures": pictures})
        for times in 1, 2:
            process = subprocess.Popen([carom.PROGRAM, "plot", scene, "--out", "p"], cwd=self.path, stderr=subprocess.PIPE,
                                       text=True, env={**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"})
            self.addCleanup(process.kill)
            for _ in range(200):
                time.sleep(0.05)
                if (self.path / "pid").exists() and (self.path / "pid").read_text():
                    break
            child = int((self.path / "pid").read_text())
            for _ in range(times):
                process.send_signal(signal.SIGINT)
            start = time.monotonic()
            _, err = process.communicate(timeout=60)
            self.assertLess(time.monotonic() - start, 3)  # and not five seconds, after which it gives up
            if times == 1:
                self.assertEqual((process.returncode, err), (1, "carom: interrupted while gnuplot drew (p/first.png)\n"))
            self.assertFalse(pathlib.Path(f"/proc/{child}").exists() and
                             "Z" not in pathlib.Path(f"/proc/{child}/stat").read_text().split()[2])
            (self.path / "pid").unlink()

    def test_data_are_there_when_pictures_cannot_be(self):
        tools = self.path / "bin"  # without gnuplot
        tools.mkdir()
        ran = self.carom("run", self.write(FALL), "--out", "out", env={"PATH": str(tools)})
        self.assertEqual(ran.returncode, 1)
        self.assertRegex(ran.stderr, "^carom: gnuplot .*\n$")
        self.assertTrue((self.path / "out/trajectory.csv").exists())
        self.assertTrue((self.path / "out/report.json").exists())


def size_of_png(file):
    head = file.read_bytes()[:24]
    return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")


@unittest.skipUnless(shutil.which("ffmpeg"), "no ffmpeg")
class Rendered(carom.Case):
    def probe(self, file):
        ran = subprocess.run(["ffprobe", "-v", "error", "-count_packets", "-show_entries", "stream=width,height,nb_read_packets",
                              "-of", "json", file], cwd=self.path, capture_output=True, text=True, check=True)
        return json.loads(ran.stdout)["streams"][0]

    def test_pictures_of_each_kind(self):
        for ending, magic in (("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")):
            option = "-o" if ending == "png" else "--file"
            self.succeeds("render", self.write(FALL), option, f"x.{ending}", "--at", "0.5")
            self.assertTrue((self.path / f"x.{ending}").read_bytes().startswith(magic))

    def test_a_picture_of_a_time_after_the_end_was_one_of_a_longer_run(self):
        said = "--at 99: scene.json ends at 1 s; --duration 99 would run it so long"
        self.fails(2, said, "render", self.write(FALL), "--file", "x.png", "--at", "99")
        self.fails(2, "--at: must be a number >= 0, got -1", "render", "scene.json", "--file", "x.png", "--at", "-1")
        self.assertEqual(self.files(), ["scene.json"])
        for at in ("1", "0"):
            self.succeeds("render", "scene.json", "--file", "x.png", "--at", at)
        self.succeeds("render", "scene.json", "--file", "x.png", "--at", "2", "--duration", "2")

    def test_the_width_is_that_of_the_picture(self):
        for width in (160, 301, 1200):
            self.succeeds("render", SCENES / "gas.json", "--file", "x.png", "--width", width)
            self.assertEqual(size_of_png(self.path / "x.png")[0], width)

    def test_films_of_each_kind(self):
        for ending in ("mp4", "webm", "gif"):
            self.succeeds("render", self.write(FALL), "--file", f"x.{ending}", "--fps", "10", "--width", "100")
            film = self.probe(f"x.{ending}")
            self.assertEqual(film["width"], 100)
            self.assertEqual(int(film["nb_read_packets"]), 11)  # 1 s of 10 frames a second, and both its ends

    def test_speed_and_rate_set_the_number_of_frames(self):
        self.succeeds("render", self.write(FALL), "--file", "x.mp4", "--fps", "20", "--speed", "0.5", "--width", "160")
        self.assertEqual(int(self.probe("x.mp4")["nb_read_packets"]), 41)

    def test_a_film_of_an_instant_has_its_frames(self):
        scene = {**FALL, "run": {"duration": 1e-9, "step": 1e-11}}
        self.succeeds("render", self.write(scene), "--file", "x.mp4", "--fps", "10", "--speed", "1e-9", "--width", "160")
        self.assertEqual(int(self.probe("x.mp4")["nb_read_packets"]), 11)

    def test_a_film_sees_where_bodies_go(self):
        """A ball that flies from (0, 0) to (30, 0): the picture is wide from its first frame."""
        scene = {"carom": 1, "bodies": [{"radius": 0.5, "velocity": [30, 0]}], "run": {"duration": 1, "step": 0.05}}
        self.succeeds("render", self.write(scene), "--file", "x.mp4", "--fps", "10", "--width", "400")
        film = self.probe("x.mp4")
        self.assertGreater(film["width"] / film["height"], 2)

    def test_an_unfinished_film_is_not_there(self):
        self.carom("render", self.write(FALL), "--file", "x.mp4", env={"PATH": "/nowhere"})
        self.assertEqual(self.files(), ["scene.json"])


if __name__ == "__main__":
    carom.main()
