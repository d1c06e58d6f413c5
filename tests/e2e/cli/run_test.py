"""Runs: what they print, how they fail, how they are interrupted."""

import json
import math
import os
import pty
import re
import resource
import select
import signal
import subprocess
import time
import unittest

import carom
from carom import FALL, PROGRAM, SCENES

ENDLESS = {**FALL, "run": {"duration": 1e6, "step": 1e-4, "every": 100},
           "bodies": [{"name": "ball", "position": [0, 5]}, {"name": "other", "position": [3, 5]}]}
# Explodes within a second: the force grows with the distance.
EXPLODES = {**FALL, "forces": [{"type": "field", "x": "exp(x*x) * x * 100"}], "bodies": [{"name": "ball", "position": [1, 0]}]}


class Report(carom.Case):
    def report(self, scene, *options, status=0):
        ran = self.carom("run", self.write(scene), "--json", *options)
        self.assertEqual(ran.returncode, status, ran.stderr)
        return json.loads(ran.stdout)

    def test_json_is_one_object_with_all_fields(self):
        r = self.report({**FALL, "expects": [{"quantity": "ball.y", "value": 0, "tolerance": 1e-9}]})
        self.assertEqual(r["scene"], "scene.json")
        self.assertEqual((r["time"], r["steps"], r["bodies"], r["collisions"]), (1, 100, 1, 0))
        self.assertEqual(set(r["energy"]), {"kinetic", "rotational", "gravity", "spring", "field", "total", "initial_total",
                                            "heat", "work", "residual", "unaccounted"})
        self.assertEqual(set(r["energy"]["heat"]), {"damping", "drag", "impact", "friction", "joint_damping",
                                                    "joint_friction", "limit", "bath", "total"})
        self.assertEqual(set(r["energy"]["work"]), {"driven", "wind", "user", "motor", "overlap", "correction", "total"})
        self.assertAlmostEqual(r["energy"]["kinetic"], 50)
        self.assertEqual(len(r["momentum"]), 2)
        self.assertAlmostEqual(r["momentum"][1], -10)
        self.assertIsInstance(r["angular_momentum"], float)
        given = r["momentum_from"]
        self.assertEqual(set(given), {"initial", "gravity", "walls", "held", "medium", "field", "user", "residual",
                                      "unaccounted"})
        self.assertAlmostEqual(given["gravity"][1], -10)
        self.assertRegex(r["state_hash"], "^[0-9a-f]{16}$")
        self.assertGreaterEqual(r["wall_seconds"], 0)
        self.assertEqual((r["interrupted"], r["failure"]), (False, None))
        (e,) = r["expectations"]
        self.assertEqual((e["quantity"], e["expected"], e["tolerance"], e["ok"]), ("ball.y", 0, 1e-9, True))
        self.assertAlmostEqual(e["value"], 0)

    def test_json_of_an_expectation_lacked_its_text_and_error(self):
        scene = {**FALL, "expects": [{"text": "lands", "quantity": "ball.y", "value": 2, "tolerance": 0.5, "relative": True}]}
        (e,) = self.report(scene, status=1)["expectations"]
        self.assertEqual((e["text"], e["allowed"], e["judged"]), ("lands", 1, True))
        self.assertAlmostEqual(e["error"], -2)

    def test_a_value_that_is_no_number_is_null(self):
        scene = {**FALL, "expects": [{"quantity": "sqrt(-1)", "value": 0}, {"quantity": "t", "at": 5, "value": 0}], "run": {"duration": 5, "step": 0.01}}
        r = self.report(scene, "--duration", "1", status=1)
        self.assertEqual([(e["value"], e["ok"]) for e in r["expectations"]], [(None, False), (None, False)])

    def test_an_unmet_expectation_is_status_1(self):
        scene = {**FALL, "expects": [{"text": "where it lands", "quantity": "ball.y", "value": 1, "tolerance": 0.1}]}
        self.assertFalse(self.report(scene, status=1)["expectations"][0]["ok"])
        ran = self.carom("run", self.write(scene))
        self.assertEqual((ran.returncode, ran.stderr), (1, ""))
        self.assertRegex(ran.stdout, r"FAIL where it lands +\S+ +1 +1 +0\.1")

    def test_the_hash_is_that_of_the_same_run(self):
        self.assertEqual(self.report(FALL)["state_hash"], self.report(FALL)["state_hash"])
        self.assertNotEqual(self.report(FALL)["state_hash"], self.report(FALL, "--step", "0.02")["state_hash"])

    def test_options_change_the_scene(self):
        r = self.report({**FALL, "parameters": {"g": 10}}, "--set", "g=1.6", "--set", 'world.gravity=[0,"-g"]', "--duration", "2*g", "--step", "1/100",
                        "--integrator", "rk4", "--seed", "7")
        self.assertAlmostEqual(r["time"], 3.2)
        self.assertAlmostEqual(r["momentum"][1], -1.6 * 3.2)
        self.assertEqual(r["seed"], 7)

    def test_standard_input_is_a_scene_too(self):
        ran = self.carom("run", "-", "--json", stdin=None, input=json.dumps(FALL))
        self.assertEqual(json.loads(ran.stdout)["steps"], 100)

    def test_columns_are_aligned(self):
        ran = self.succeeds("run", SCENES / "projectiles.json")
        columns = [line for line in ran.stdout.splitlines() if line.startswith("  ok ")]
        self.assertEqual(len({line.index("textbook run") for line in columns}), 1)
        units = [line.index(" J") for line in ran.stdout.splitlines() if re.match(r"  [a-z ]+ +-?[\d.e+-]+ J", line)]
        self.assertGreater(len(units), 3)
        self.assertEqual(len(set(units)), 1)

    def test_numbers_stood_behind_a_long_text(self):
        expects = [{"text": text, "quantity": "ball.y", "value": 0, "tolerance": 1, "source": "a book"} for text in ("short", "µ" * 40, "long " * 20)]
        twins = [{"quantity": quantity, "formula": "5 - 5*t^2", "source": "a book"} for quantity in ("ball.y", "ball.y" + " + 0" * 20)]
        ran = self.succeeds("run", self.write({**FALL, "expects": expects, "twins": twins}))
        lines = [line for line in ran.stdout.splitlines() if line.endswith("a book")]
        self.assertEqual(len(lines), 5)
        self.assertEqual(len({line.index("a book") for line in lines[:3]}), 1)
        self.assertEqual(len({line.index("a book") for line in lines[3:]}), 1)
        self.assertIn("  ok   " + "long " * 20 + "\n" + 48 * " ", ran.stdout)

    def test_several_scenes_are_a_line_each(self):
        bad = self.write({**FALL, "expects": [{"quantity": "ball.y", "value": 1}]}, "bad.json")
        ran = self.carom("run", self.write(FALL, "good.json"), bad, "nothing.json")
        self.assertEqual(ran.returncode, 2)
        self.assertEqual(re.findall(r"^(ok|FAIL) +(\S+)", ran.stdout, re.M), [("ok", "good.json"), ("FAIL", "bad.json"), ("FAIL", "nothing.json")])
        self.assertEqual(self.carom("run", bad, bad).returncode, 1)
        self.fails(2, "--json, --quantity, --csv, --data, --out, --checkpoint and --resume are of one scene", "run", "good.json", bad, "--json")

    def test_every_number_has_its_unit(self):
        expects = [{"quantity": "ball.vy", "value": -10, "tolerance": 1e-9, "source": "g t"},
                   {"text": "half way", "quantity": "ball.y - 2.5", "statistic": "zero", "value": "sqrt(0.5)", "tolerance": 1e-6}]
        ran = self.succeeds("run", self.write({**FALL, "expects": expects}), "--step", "1", "--set", "expects[1].tolerance=1")
        self.assertIn("1 body, 1 step to t = 1 s", ran.stdout)
        self.assertRegex(ran.stdout, r"ball.vy .* 1e-09  m/s     g t\n")
        self.assertRegex(ran.stdout, r"half way .* 1  s\n")
        self.assertRegex(self.succeeds("check", "scene.json").stdout, r"ball.y \[m\] ")

    def test_twins_are_reported(self):
        twins = [{"quantity": "ball.y", "formula": "projectile(t, 5, 0, -10)"},
                 {"quantity": "ball.y", "formula": "5 - t", "until": 0.5}]
        r = self.report({**FALL, "twins": twins})
        self.assertEqual([t["quantity"] for t in r["twins"]], ["ball.y", "ball.y"])
        self.assertLess(r["twins"][0]["max_error"], 1e-13)  # Verlet is exact here
        self.assertAlmostEqual(r["twins"][1]["max_error"], 0.75)  # 5 t² - t at t = 1/2
        self.assertAlmostEqual(r["twins"][1]["end_error"], 0.75)
        ran = self.succeeds("run", "scene.json")
        self.assertRegex(ran.stdout, r"closed form of +largest error +at the end")
        self.assertRegex(ran.stdout, r"ball.y +\S+ +\S+  m\n")
        self.fails(2, "twins[0] is wrong", "run", self.write({**FALL, "twins": [{"quantity": "bal.y", "formula": "t"}]}))
        self.fails(2, "twins[0] is wrong", "run", self.write({**FALL, "twins": [{"quantity": "ball.y", "formula": "x"}]}))
        # An orbit of eccentricity 2 was drawn.
        self.fails(2, "twins[0] is wrong at t = 0 s: 'kepler_x' needs 0 <= e < 1, got e = 2", "plot",
                   self.write({**FALL, "twins": [{"quantity": "ball.y", "formula": "kepler_x(t, 1, 2, 1)"}]}))

class Failure(carom.Case):
    def test_a_run_that_explodes_says_when_and_what_and_keeps_its_data(self):
        ran = self.carom("run", self.write(EXPLODES), "--json", "--csv", "x.csv")
        self.assertEqual(ran.returncode, 1)
        self.assertRegex(ran.stderr, r"^carom: the run went wrong at t = \S+ s: body 'ball' is at .*\n$")
        r = json.loads(ran.stdout)
        self.assertRegex(r["failure"], "^the run went wrong at t = ")
        rows = self.table("x.csv")
        self.assertGreater(len(rows), 1)
        self.assertTrue(all(math.isfinite(float(cell)) for row in rows[1:] for cell in row[2:]))

    def test_which_of_several_scenes_exploded_was_not_said(self):
        said = self.carom("run", self.write(FALL, "fall.json"), self.write(EXPLODES), "fall.json").stderr
        self.assertRegex(said, r"^carom: scene\.json: the run went wrong at t = .*\n$")

    def test_energies_beyond_all_numbers_were_all_well(self):
        for bodies, run in (([{"velocity": [1e160, 0]}], FALL["run"]),
                            ([{"mass": "1e300", "position": [1e300, 0], "velocity": [1e300, 1e300]}], {"duration": 0})):
            scene = {"carom": 1, "bodies": bodies, "run": run}
            ran = self.carom("run", self.write(scene))
            self.assertEqual(ran.returncode, 1)
            self.assertRegex(ran.stderr, r"carom: the run went wrong at t = \S+ s: its energy is \S+ J")

    def test_a_title_that_is_no_utf8_is_an_error_of_ours(self):
        self.fails(2, "title: must be a text in UTF-8", "run", self.write(FALL), "--set", "title=\udcff")

    # "a shorter step may help", it said, and none could.
    def test_two_points_in_one_place_were_told_to_take_a_shorter_step(self):
        # One comes there when the run is under way, and is too light to have moved the other.
        scene = {**FALL, "world": {"solver": "none", "integrator": "rk4"}, "bodies": [{"name": "s", "kind": "driven", "mass": 5e-324}, {"name": "p"}],
                 "forces": [{"type": "attraction"}, {"type": "drive", "body": "s", "x": "t < 0.494 ? 9 : 0"}]}
        ran = self.carom("run", self.write(scene))
        self.assertEqual(ran.returncode, 1)
        self.assertIn("an attraction without softening has no bound where two bodies are in one place", ran.stderr)
        scene["forces"][0]["softening"] = 0.1
        self.succeeds("run", self.write(scene))

    def test_a_step_too_long_says_how_long_it_may_be(self):
        scene = {**FALL, "world": {"long_step": "refuse"}, "run": {"step": 0.5},
                 "bodies": [{"name": "a"}, {"name": "b", "position": [1, 0]}],
                 "forces": [{"type": "spring", "a": "a", "b": "b", "stiffness": 1000}]}
        ran = self.carom("run", self.write(scene), "--json")
        self.assertEqual(ran.returncode, 1)
        self.assertRegex(ran.stderr, r"dt must be at most 0\.0\d+ s for the springs to be stable under verlet, got 0.5 s\n$")
        self.assertEqual(json.loads(ran.stdout)["steps"], 0)
        # Of four substeps each may be as long.
        self.assertRegex(self.carom("run", "scene.json", "--solver", "softstep").stderr, r"at most 0\.1\d+ s for .*, got 0.5 s\n$")

    def test_what_is_no_number_had_a_minus(self):
        field = {"type": "field", "body": "ball", "x": "sqrt(0.5 - t)"}
        ran = self.carom("run", self.write({**FALL, "forces": [field]}))
        self.assertEqual(ran.returncode, 1)
        self.assertIn("with velocity (nan, ", ran.stderr)
        self.assertNotIn("-nan", ran.stderr + ran.stdout)
        far = {"name": "far", "position": [0, -1e160], "velocity": [1e160, 0], "mass": 1e10}  # inf J and -inf J
        for change in {"forces": [{"type": "field", "y": "0*t", "potential": "sqrt(0.5 - t)"}]}, {"world": {"gravity": [0, -1e150]}, "bodies": [far]}:
            ran = self.carom("run", self.write({**FALL, **change}))
            self.assertIn("its energy is nan J", ran.stderr)
        ran = self.carom("run", self.write(FALL), "--sweep", "run.step=0.1", "--quantity", "0/0", "--quantity", "-(0/0)", "--csv", "t.csv")
        self.assertEqual((ran.stdout.count("-nan"), self.table("t.csv")[1]), (0, ["0.1", "nan", "nan", "yes"]))

    def test_more_substeps_than_anybody_waits_for(self):
        scene = {**FALL, "bodies": [{"name": "a"}, {"name": "b", "position": [1, 0]}],
                 "forces": [{"type": "spring", "a": "a", "b": "b", "stiffness": 1e30}]}
        ran = self.carom("run", self.write(scene))
        self.assertEqual(ran.returncode, 1)
        self.assertIn("parts for the springs to be stable", ran.stderr)

    def test_a_scene_beyond_memory_is_refused_before_it_is_built(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
        scene = {"carom": 1, "builders": [{"type": "grid", "nx": 10000, "ny": 1000, "body": {}}], "run": {"duration": 0}}
        self.fails(2, "builders[0] needs about 9 GB for 10000000 bodies, and", "run", self.write(scene), preexec_fn=limit)
        self.fails(2, "and 0.1 GB are free", "run", self.write(scene), env={**os.environ, "CAROM_MEMORY": "1e8"})


class Interruption(carom.Case):
    def start(self, scene, *arguments, **options):
        process = subprocess.Popen([PROGRAM, *arguments[:1], self.write(scene), *arguments[1:]], cwd=self.path,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
        self.addCleanup(process.kill)
        return process

    def test_a_run_made_shorter_shows_its_end_in_place_of_later_snapshots(self):
        done = self.carom("run", SCENES / "gas.json", "--duration", "0.01", "--out", "short")
        self.assertEqual((done.returncode, carom.without_notes(done.stderr)), (1, ""))  # what it expects at its end did not come
        self.assertTrue((self.path / "short/snapshots.png").exists())
        self.fails(2, "--scenes nowhere: the tour's scenes are not there", "tour", "--scenes", "nowhere")

    def test_ctrl_c_leaves_what_there_is_whole(self):
        process = self.start(ENDLESS, "run", "--json", "--csv", "x.csv")
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual((process.returncode, err), (1, ""))
        report = json.loads(out)
        self.assertTrue(report["interrupted"])
        self.assertGreater(report["steps"], 0)
        rows = self.table("x.csv")
        self.assertGreater(len(rows), 3)
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})
        self.assertEqual(len(rows) % 2, 1)  # a heading, and two bodies at every time
        self.assertEqual(self.files(), ["scene.json", "x.csv"])

    def test_data_of_an_interrupted_run_ended_long_before_it(self):
        process = self.start({**ENDLESS, "run": {**ENDLESS["run"], "every": 10**9}}, "run", "--json", "--csv", "x.csv")
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        report = json.loads(process.communicate(timeout=60)[0])
        self.assertGreater(report["time"], 0)
        self.assertEqual(float(self.table("x.csv")[-1][0]), report["time"])

    def test_an_interrupted_run_judged_what_it_expected_at_its_end(self):
        scene = {**ENDLESS, "expects": [{"quantity": "ball.y", "value": 5, "tolerance": 1e9},
                                        {"quantity": "ball.y", "at": 0.001, "value": 5, "tolerance": 1}]}
        process = self.start(scene, "run")
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual((process.returncode, err), (1, ""))
        self.assertNotIn("FAIL", out)
        self.assertNotIn("nan", out)
        self.assertRegex(out, r" {6,}ball.y +not reached")
        self.assertRegex(out, r"ok +ball.y at t = 0.001 s")

    def test_a_long_step_could_not_be_interrupted(self):
        # 900 000 substeps of a hundred thousand springs in one step
        net = {"type": "lattice", "nx": 220, "ny": 220, "stiffness": 1e6, "mass": 1}
        scene = {**FALL, "bodies": [], "world": {"solver": "none"}, "builders": [net], "run": {"duration": 400, "step": 200}}
        process = self.start(scene, "run", "--csv", "x.csv")
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=30)
        self.assertEqual((process.returncode, err), (1, "carom: interrupted within a step, whose end would have taken too long\n"))
        self.assertNotIn("x.csv", self.files())

    @unittest.skipUnless(os.path.exists("/usr/bin/ffmpeg"), "no ffmpeg")
    def test_a_film_ends_where_it_was_interrupted(self):
        process = self.start({**ENDLESS, "walls": [{"type": "rectangle", "low": [-5, -9], "high": [5, 9]}]}, "render",
                             "--file", "x.mp4", "--width", "160")
        time.sleep(1.5)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1)
        frames = subprocess.run(["ffprobe", "-v", "error", "-count_packets", "-show_entries", "stream=nb_read_packets", "-of",
                                 "csv=p=0", "x.mp4"], cwd=self.path, capture_output=True, text=True)
        self.assertGreater(int(frames.stdout), 1)
        self.assertEqual(self.files(), ["scene.json", "x.mp4"])

    @unittest.skipUnless(os.path.exists("/usr/bin/ffmpeg"), "no ffmpeg")
    def test_ctrl_c_of_a_terminal_took_the_film_with_it(self):
        """A terminal sends it to all processes of the foreground, and ffmpeg was one of them."""
        process = self.start({**ENDLESS, "walls": [{"type": "rectangle", "low": [-5, -9], "high": [5, 9]}]}, "render",
                             "--file", "x.mp4", "--width", "160", start_new_session=True)
        time.sleep(1.5)
        os.killpg(process.pid, signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1)
        self.assertRegex(carom.without_notes(err), r"^carom: interrupted at t = \S+ s of \S+ s, where what is drawn ends\n$")
        self.assertEqual(self.files(), ["scene.json", "x.mp4"])

    @unittest.skipUnless(os.path.exists("/usr/bin/ffmpeg"), "no ffmpeg")
    def test_a_film_in_slow_motion_was_lost(self):
        """An interruption was looked for between steps, and a step had millions of frames, each of which was looked at for its bounds, too."""
        many = [{"name": f"b{k}", "position": [k, 0]} for k in range(400)]
        for scene, speed in (({**ENDLESS, "walls": [{"type": "rectangle", "low": [-5, -9], "high": [5, 9]}]}, "1e-9"),
                             ({**FALL, "bodies": many}, "1e-6")):
            process = self.start(scene, "render", "--file", "x.mp4", "--width", "160", "--speed", speed)
            time.sleep(3)
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 1)
            self.assertRegex(carom.without_notes(err), r"^carom: interrupted at t = \S+ s of \S+ s, where what is drawn ends\n$")
            self.assertEqual(self.files(), ["scene.json", "x.mp4"])
            (self.path / "x.mp4").unlink()

    def test_a_reader_that_goes_away_is_no_crash(self):
        ran = subprocess.run(["bash", "-c", f"{PROGRAM} schema | head -1; echo ${{PIPESTATUS[0]}}"], capture_output=True, text=True)
        self.assertEqual(ran.stderr, "")
        self.assertIn(ran.stdout, ("{\n141\n", "{\n0\n"))
        quiet = f"trap '' PIPE; {PROGRAM} schema | true; echo ${{PIPESTATUS[0]}}"  # as under some supervisors
        ran = subprocess.run(["bash", "-c", quiet], capture_output=True, text=True)
        self.assertIn(ran.stdout, ("1\n", "0\n"))


class Terminal(carom.Case):
    def on_terminal(self, seconds, *arguments, interrupt_after=math.inf):
        """What is seen on a terminal after so long."""
        pid, terminal = pty.fork()
        if pid == 0:
            os.chdir(self.path)
            os.execv(PROGRAM, [PROGRAM, *arguments])
        seen, start = b"", time.monotonic()
        while time.monotonic() < start + seconds:
            if time.monotonic() > start + interrupt_after:
                os.write(terminal, b"\x03")
                interrupt_after = math.inf
            if select.select([terminal], [], [], 0.1)[0]:
                try:
                    seen += os.read(terminal, 65536)
                except OSError:
                    break
        os.kill(pid, signal.SIGKILL)
        os.waitpid(pid, 0)
        os.close(terminal)
        return seen.decode(errors="replace")

    def test_the_progress_bar_is_for_terminals_alone(self):
        self.write(ENDLESS)
        self.assertIn("%", self.on_terminal(2.5, "run", "scene.json"))
        process = subprocess.Popen([PROGRAM, "run", "scene.json"], cwd=self.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.communicate(timeout=60)[1], "")

    def test_a_sweep_that_reads_its_scenes_showed_nothing(self):
        self.write({**ENDLESS, "parameters": {"a": 1}})
        seen = self.on_terminal(30, "run", "scene.json", "--sweep", "a=1:500000", interrupt_after=2.5)
        self.assertRegex(seen, r"1/500000 a=1 +\d+ % ")  # of a range the ends alone are read before

    # A long run took as long again to draw what there was, without a word.
    def test_what_is_done_after_ctrl_c_is_said(self):
        self.write(ENDLESS)
        seen = self.on_terminal(30, "run", "scene.json", "--csv", "x.csv", interrupt_after=1)
        self.assertIn("carom: interrupted; writes what there is (Ctrl-C again gives that up)", seen)
        self.assertIn("wrote x.csv", seen)
        self.assertNotIn("writes what", self.on_terminal(30, "run", "scene.json", interrupt_after=1))

    def test_pictures_of_a_long_run_filled_the_memory_without_a_word(self):
        self.write({**ENDLESS, "run": {"duration": 1e6, "step": 1e-3, "every": 100}})
        self.assertIn("keep all of 1e+07 frames until they are drawn; --every 1000 makes a million of them",
                      self.on_terminal(1, "plot", "scene.json"))
        self.assertNotIn("frames", self.on_terminal(1, "plot", "scene.json", "--every", "1000"))
        self.assertNotIn("frames", self.on_terminal(1, "run", "scene.json"))

    def test_a_short_run_shows_none(self):
        self.write(FALL)
        self.assertNotIn("%", self.on_terminal(10, "run", "scene.json"))


if __name__ == "__main__":
    carom.main()
