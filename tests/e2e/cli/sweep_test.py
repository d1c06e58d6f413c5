"""carom run --sweep: a run for each value, a row for each run."""

import json
import math
import re
import shutil
import signal
import statistics
import subprocess
import time
import unittest

import carom
from carom import FALL, SCENES, without_notes

THROW = {**FALL, "title": "A fall", "parameters": {"g": 10, "h": 5}, "world": {"gravity": [0, "-g"]},
         "expects": [{"text": "speed", "quantity": "ball.vy", "value": "-g", "tolerance": 1e-9}]}
# Whose ends are fine in a sweep over m, and not what is in their middle.
SQUARE = {**FALL, "parameters": {"m": 1}, "bodies": [{"mass": "m*m"}]}


class Sweep(carom.Case):
    def test_a_row_is_what_a_run_of_its_value_gives(self):
        ran = self.succeeds("run", self.write(THROW), "--sweep", "g=1:4", "--csv", "table.csv")
        lines = ran.stdout.splitlines()
        self.assertEqual(lines[0], "A fall")
        self.assertEqual(lines[1].split(), ["g", "speed", "[m/s]"])
        self.assertEqual([line.split() for line in lines[2:-1]], [[str(g), str(-g)] for g in (1, 2, 3, 4)])
        self.assertEqual(lines[-1], "wrote table.csv")
        rows = self.table("table.csv")
        self.assertEqual(rows[0], ["g", "speed [m/s]", "as expected"])
        for row in rows[1:]:
            alone = json.loads(self.succeeds("run", "scene.json", "--set", f"g={row[0]}", "--json").stdout)
            self.assertEqual((float(row[1]), row[2]), (alone["expectations"][0]["value"], "yes"))
        swept = json.loads(self.succeeds("run", "scene.json", "--sweep", "g=1:4", "--json").stdout)
        self.assertEqual([(r["value"], r["report"]["expectations"][0]["ok"]) for r in swept["runs"]],
                         [(str(g), True) for g in (1, 2, 3, 4)])
        self.succeeds("run", "table.csv")  # as every data file

    def test_values_are_ranges_or_lists(self):
        values = lambda text: [r["value"] for r in json.loads(
            self.succeeds("run", self.write(FALL), "--sweep", text, "--json").stdout)["runs"]]
        self.assertEqual(values("seed=1:3"), ["1", "2", "3"])
        self.assertEqual(values("run.step=0.1:0.3:0.1"), ["0.1", "0.2", "0.3"])
        self.assertEqual(values("run.step=0.3:0.1:-0.1"), ["0.3", "0.2", "0.1"])
        # A list could have expressions, and a range not.
        self.assertEqual(values("run.step=1/10:3/10:1/10"), ["0.1", "0.2", "0.3"])
        for k, angle in zip((2, 3, 4), values("bodies[0].angle=30*deg:60*deg:15*deg")):
            self.assertAlmostEqual(float(angle), k * math.pi / 12, delta=2e-16)  # an ulp, of two sums
        self.assertEqual(values("run.step=1/10,1/20"), ["1/10", "1/20"])
        self.assertEqual(values("world.gravity=[0,-1],[0,-2]"), ["[0,-1]", "[0,-2]"])
        self.assertEqual(values("world.integrator=verlet,rk4"), ["verlet", "rk4"])

    # To twelve digits five values were one, and what should be 0 was a rounding error of 0.1.
    def test_values_of_a_range_were_rounded_until_they_were_the_same(self):
        scene = self.write({**THROW, "expects": []})

        def values(text):
            self.succeeds("run", scene, "--sweep", text, "--quantity", "g", "--csv", "t.csv")
            return [row[0] for row in self.table("t.csv")[1:]]

        self.assertEqual(values("g=10:10.0000000000004:1e-13"), ["10", *(f"10.000000000000{k}" for k in (1, 2, 3, 4))])
        self.assertEqual(values("g=-0.3:0.3:0.1"), ["-0.3", "-0.2", "-0.1", "0", "0.1", "0.2", "0.3"])
        self.assertEqual(values("g=-1:1:0.001"), [f"{k / 1000:g}" for k in range(-1000, 1001)])
        self.assertEqual(values("g=1e-20:1:0.5"), ["1e-20", "0.5", "1"])
        self.assertEqual(values("g=-pi:pi:pi/3")[3], "0")

    # "1/3" is text to who reads the table.
    def test_the_swept_column_of_a_table_held_expressions(self):
        scene = self.write({**THROW, "expects": []})

        def first(text):
            self.succeeds("run", scene, "--sweep", text, "--csv", "t.csv")
            return [row[0] for row in self.table("t.csv")[1:]]

        self.assertEqual([float(v) for v in first("g=1/4,2^2,30*deg")], [0.25, 4, math.pi / 6])
        self.assertEqual([float(v) for v in first("bodies[0].mass=1/4,2*g,pi")], [0.25, 20, math.pi])
        self.assertEqual(first("g=0.1:0.3:0.1"), ["0.1", "0.2", "0.3"])
        # What changes with time was taken for its value at the start.
        driven = {"type": "field", "x": "0", "y": "0"}
        scene = self.write({**THROW, "expects": [], "forces": [driven]})
        self.assertEqual(first("forces[0].x=sin(t),cos(t),2*g"), ["sin(t)", "cos(t)", "20"])
        self.assertEqual(first("world.integrator=verlet,rk4"), ["verlet", "rk4"])
        self.assertEqual(first("world.gravity=[0,-1],[0,-2]"), ["[0,-1]", "[0,-2]"])

    def test_quantities_are_its_columns_if_they_are_named(self):
        ran = self.succeeds("run", self.write(THROW), "--sweep", "g=2:4:2", "--quantity", "ball.vy", "--quantity", "g*h", "--csv", "t.csv")
        self.assertEqual(self.table("t.csv")[0], ["g", "ball.vy [m/s]", "g*h", "as expected"])
        self.assertEqual([[round(float(cell), 9) for cell in row[:3]] for row in self.table("t.csv")[1:]], [[2, -2, 10], [4, -4, 20]])
        self.assertIn("g*h", ran.stdout)

    def test_runs_over_seeds_had_no_mean(self):
        gas = {"carom": 1, "walls": [{"type": "rectangle", "low": [0, 0], "high": [4, 4]}],
               "builders": [{"type": "gas", "temperature": 1, "fill": {"low": [0, 0], "high": [4, 4], "count": 8,
                                                                      "smallest_radius": 0.1, "largest_radius": 0.1}}],
               "run": {"duration": 1, "step": 0.1}}
        ran = self.succeeds("run", self.write(gas), "--sweep", "seed=1:6", "--quantity", "momentum.x", "--quantity", "2", "--csv", "t.csv")
        samples = [float(row[1]) for row in self.table("t.csv")[1:]]
        self.assertEqual(len(samples), 6)
        mean, error = statistics.mean(samples), statistics.stdev(samples) / math.sqrt(6)
        digits = math.floor(math.log10(abs(mean))) - math.floor(math.log10(error)) + 2  # two of the error
        row = f"{mean:.{digits}g} ± {error:.2g}"
        self.assertRegex(ran.stdout, rf"\nmean +{re.escape(row)} +2 ± 0\n")
        self.assertIn(f"\n# mean of 6 runs: momentum.x [kg m/s]: {row}; 2: 2 ± 0\n", (self.path / "t.csv").read_text())
        for others in ("seed=1", "run.step=0.1,0.05"):  # one sample says nothing, and other steps are no samples
            self.assertNotIn("\nmean", self.succeeds("run", "scene.json", "--sweep", others).stdout)

    # They broke off somewhere, and their numbers of that moment were samples of the end.
    def test_runs_that_broke_off_were_in_the_mean(self):
        scene = {"carom": 1, "parameters": {"v": 1}, "bodies": [{"name": "a", "velocity": ["v", 0]}],
                 "builders": [{"type": "gas", "temperature": 1, "exact": False,
                               "fill": {"low": [9, 9], "high": [10, 10], "count": 1, "smallest_radius": 0.1, "largest_radius": 0.1}}],
                 "forces": [{"type": "field", "body": "a", "x": "sqrt(1 - x)"}], "run": {"duration": 0.5, "step": 0.01}}
        swept = ("--sweep", "v=0.1,9", "--sweep", "seed=1:3", "--quantity", "t", "--quantity", "momentum.x", "--csv", "t.csv")
        ran = self.carom("run", self.write(scene), *swept)
        self.assertEqual(ran.returncode, 1)
        lines = [line.split() for line in ran.stdout.splitlines()]
        means = [line for line in lines if "mean" in line]
        self.assertEqual([line[-2:] for line in lines if line[0] == "9"][:3], [["broke", "off"]] * 3)
        self.assertEqual((means[0][:4], means[1]), (["0.1", "mean", "0.5", "±"], "9 mean - - of 0 of 3 runs".split()))
        rows = self.table("t.csv")[1:]
        self.assertEqual([row[-1] for row in rows], ["yes"] * 3 + ["broke off"] * 3)
        samples = [float(row[3]) for row in rows[:3]]
        error = statistics.stdev(samples) / math.sqrt(3)
        text = (self.path / "t.csv").read_text()
        self.assertRegex(text, r"\n# mean at v=0.1 of 3 runs: t \[s\]: 0.5 ± 0; momentum.x \[kg m/s\]: \S+ ± " + re.escape(f"{error:.2g}\n"))
        self.assertIn("\n# mean at v=9 of 0 of 3 runs: t [s]: -; momentum.x [kg m/s]: -\n", text)
        slow, fast = json.loads(self.carom("run", "scene.json", *swept, "--json").stdout)["means"]
        self.assertEqual((slow["value"], slow["runs"], slow["whole"]), (["0.1", "mean"], 3, 3))
        self.assertEqual((fast["value"], fast["runs"], fast["whole"]), (["9", "mean"], 3, 0))
        column = slow["columns"][1]
        self.assertEqual((column["name"], column["unit"], column["samples"]), ("momentum.x", "kg m/s", 3))
        self.assertAlmostEqual(column["mean"], statistics.mean(samples), delta=1e-15)
        self.assertAlmostEqual(column["standard_error"], error, delta=1e-15)
        self.assertEqual([(c["mean"], c["samples"]) for c in fast["columns"]], [(None, 0)] * 2)

    # Where its error was smaller, a mean was cut to six digits.
    def test_a_mean_had_fewer_digits_than_its_error(self):
        scene = {"carom": 1, "walls": [{"type": "rectangle", "low": [0, 0], "high": [4, 4]}], "run": {"duration": 1, "step": 0.1},
                 "builders": [{"type": "gas", "temperature": 1, "fill": {"low": [0, 0], "high": [4, 4], "count": 8,
                                                                        "smallest_radius": 0.1, "largest_radius": 0.1}}]}
        ran = self.succeeds("run", self.write(scene), "--sweep", "seed=1:6", "--quantity", "1 + 1e-9*momentum.x", "--csv", "t.csv")
        samples = [float(row[1]) for row in self.table("t.csv")[1:]]
        mean, error = statistics.mean(samples), statistics.stdev(samples) / math.sqrt(6)
        self.assertTrue(1e-9 < error < 1e-8 and mean < 1, (mean, error))
        self.assertIn(f" {mean:.10f} ± {error:.2g}\n", ran.stdout)

    def test_columns_of_one_quantity_have_their_own_numbers(self):
        scene = {"carom": 1, "parameters": {"v": 5}, "world": {"gravity": [0, -10]},
                 "bodies": [{"name": "the ball", "velocity": [1, "v"]}], "run": {"duration": 1, "step": 0.01},
                 "expects": [{"quantity": "'the ball'.y", **of, "value": value, "tolerance": 1e-3}
                             for of, value in (({}, "v-5"), ({"statistic": "maximum"}, "v^2/20"),
                                               ({"statistic": "mean"}, 0), ({"at": 0.5}, "v/2-1.25"))]}
        self.carom("run", self.write(scene), "--sweep", "v=4,5", "--csv", "t.csv")
        heading, *rows = self.table("t.csv")
        self.assertEqual(heading[1:3], ["'the ball'.y [m]", "maximum of 'the ball'.y [m]"])
        for row in rows:
            v = float(row[0])
            for cell, value in zip(row[1:], (v - 5, v**2 / 20, v / 2 - 5 / 3, v / 2 - 1.25)):
                self.assertAlmostEqual(float(cell), value, delta=1e-3)
            self.assertEqual(row[-1], "no")  # the mean

    def test_a_run_that_breaks_off_is_not_as_expected(self):
        scene = {"carom": 1, "parameters": {"s": 1}, "bodies": [{"name": "a", "position": [1, 0]}],
                 "forces": [{"type": "field", "name": "blow", "x": "s*exp(x^2)"}], "run": {"duration": 5, "step": 0.05}}
        ran = self.carom("run", self.write(scene), "--sweep", "s=-1e-6,1", "--quantity", "a.x", "--csv", "t.csv")
        self.assertEqual((ran.returncode, [row[-1] for row in self.table("t.csv")[1:]]), (1, ["yes", "broke off"]))
        self.assertRegex(ran.stderr, r"^carom: s=1: the run went wrong at t = .*\n$")

    def test_measures_have_their_errors(self):
        gas = {"carom": 1, "world": {"solver": "events"}, "walls": [{"type": "periodic", "low": [0, 0], "high": [10, 10]}],
               "parameters": {"n": 40}, "run": {"duration": 50, "step": 0.1},
               "builders": [{"type": "gas", "temperature": 1, "fill": {"low": [0, 0], "high": [10, 10], "count": "n",
                                                                     "smallest_radius": 0.3, "largest_radius": 0.3}}]}
        ran = self.succeeds("run", self.write(gas), "--sweep", "n=20,40", "--csv", "t.csv")
        self.assertIn(" ± ", ran.stdout)
        heading, *rows = self.table("t.csv")
        at, pressures = heading.index("pressure by the virial [N/m]"), []
        self.assertEqual(heading[at + 1], "pressure by the virial standard error [N/m]")
        for row in rows:
            pressures.append(float(row[at]))
            self.assertGreater(float(row[at + 1]), 0)
        self.assertGreater(pressures[1], 2 * pressures[0])  # twice as many of them, and each with less room

    # What the first run did not have, no run had.
    def test_a_measure_left_out_of_the_first_run_was_dropped_for_all(self):
        gas = {"carom": 1, "world": {"solver": "events"}, "walls": [{"type": "periodic", "low": [0, 0], "high": [20, 20]}],
               "parameters": {"n": 20}, "run": {"duration": 100, "step": 0.1, "every": 5},
               "builders": [{"type": "gas", "temperature": 1, "fill": {"low": [0, 0], "high": [20, 20], "count": "n",
                                                                     "smallest_radius": 0.5, "largest_radius": 0.5}}]}
        tables = []
        for counts in ("20,150", "150,20"):
            ran = self.carom("run", self.write(gas), "--sweep", f"n={counts}", "--csv", "t.csv")
            self.assertEqual(ran.returncode, 0)
            self.assertRegex(ran.stderr, r"^carom: note: in 1 of 2 runs, first at n=20: diffusion is left out: in .* a disc meets .*\n$")
            self.assertIn("diffusion [m²/s]", ran.stdout)
            heading, *rows = self.table("t.csv")
            tables.append({row[0]: dict(zip(heading, row)) for row in rows})
            self.assertEqual([row[-1] for row in rows], ["yes", "yes"])  # of what they did not expect, one was not
        self.assertEqual(tables[0], tables[1])
        self.assertTrue(math.isnan(float(tables[0]["20"]["diffusion [m²/s]"] or "nan")))
        self.assertGreater(float(tables[0]["150"]["diffusion [m²/s]"]), 0)

    def test_the_pipe_was_read_for_the_first_run_alone(self):
        scene = json.dumps({**THROW, "expects": []})
        piped = self.carom("run", "-", "--sweep", "g=1:3", stdin=None, input=scene)
        self.assertEqual(piped.stderr, "")
        self.assertEqual(piped.stdout, self.succeeds("run", self.write(scene), "--sweep", "g=1:3").stdout)

    def test_a_failure_is_said_in_its_row_and_the_status(self):
        scene = {**THROW, "expects": [{"text": "speed", "quantity": "ball.vy", "value": -2, "tolerance": 1e-9}]}
        ran = self.carom("run", self.write(scene), "--sweep", "g=1:3", "--csv", "t.csv")
        self.assertEqual((ran.returncode, [("FAIL" in line) for line in ran.stdout.splitlines()[2:5]]), (1, [True, False, True]))
        self.assertEqual([row[-1] for row in self.table("t.csv")[1:]], ["no", "yes", "no"])

    # Columns of quantities alone do not show them: the table was without a fault, and the status 1.
    def test_expectations_that_were_not_met_went_unsaid(self):
        scene = self.write({**THROW, "expects": [{"quantity": "ball.vy", "value": -2, "tolerance": 1e-9},
                                                 {"quantity": "ball.x", "value": 0}]})
        ran = self.carom("run", scene, "--sweep", "g=1:3", "--quantity", "ball.vy")
        self.assertEqual((ran.returncode, ran.stderr),
                         (1, "carom: expectations of the scene were not met: 1 of 2 for 1, 1 of 2 for 3; "
                             "--set 'expects=[]' leaves them out\n"))
        ran = self.carom("run", scene, "--sweep", "g=11:19", "--quantity", "ball.vy")
        self.assertIn(", 1 of 2 for 15, and of 4 values more; ", ran.stderr)
        self.succeeds("run", scene, "--sweep", "g=2,2.0", "--quantity", "ball.vy")

    def test_two_parameters_make_a_grid(self):
        scene = self.write({**THROW, "expects": []})
        ran = self.succeeds("run", scene, "--sweep", "g=1:3", "--sweep", "h=2:4:2", "--quantity", "g*h", "--csv", "t.csv")
        grid = [(g, h) for g in (1, 2, 3) for h in (2, 4)]
        self.assertEqual([line.split() for line in ran.stdout.splitlines()[1:-1]],
                         [["g", "h", "g*h"]] + [[str(g), str(h), str(g * h)] for g, h in grid])
        self.assertEqual([[float(cell) for cell in row[:3]] for row in self.table("t.csv")[1:]], [[g, h, g * h] for g, h in grid])
        swept = json.loads(self.succeeds("run", scene, "--sweep", "g=1:3", "--sweep", "h=2:4:2", "--json").stdout)
        self.assertEqual((swept["sweep"], [r["value"] for r in swept["runs"]]), (["g", "h"], [[str(g), str(h)] for g, h in grid]))

    @unittest.skipUnless(shutil.which("gnuplot"), "no gnuplot")
    def test_a_picture_is_a_curve_a_family_of_them_or_a_heat_map(self):
        def words(*sweeps):
            sweep = [word for text in sweeps for word in ("--sweep", text)]
            ran = self.succeeds("run", self.write(THROW), *sweep, "--quantity", "ball.vy", "--picture", "a.svg")
            self.assertTrue(ran.stdout.endswith("wrote a.svg\n"), ran.stdout)
            return set(re.findall(r">([^<>]+)<", (self.path / "a.svg").read_text()))

        self.assertLessEqual({"A fall", "g", "ball.vy [m/s]"}, words("g=1:3"))
        self.assertLessEqual({"g", "ball.vy [m/s]", "h = 2", "h = 4"}, words("g=1:3", "h=2:4:2"))
        # Along x are numbers.
        self.assertLessEqual({"g", "world.integrator = verlet", "world.integrator = rk4"}, words("world.integrator=verlet,rk4", "g=1:3"))
        self.assertLessEqual({"g", "h", "ball.vy [m/s]"}, words("g=1:3", "h=1:8"))
        self.assertNotIn("h = 1", words("g=1:3", "h=1:8"))
        # Around a number that is so large gnuplot saw no range.
        self.assertLessEqual({"h [10¹⁵]", "ball.vy [m/s]"}, words("h=1e16"))
        self.assertLessEqual({"h [10¹⁵]", "ball.vy [m/s]"}, words("h=1e16,10000000000000002"))

    @unittest.skipUnless(shutil.which("gnuplot"), "no gnuplot")
    def test_a_run_that_broke_off_was_drawn_like_a_whole_one(self):
        scene = {**THROW, "expects": [], "forces": [{"type": "field", "x": "g > 2 ? sqrt(0.5 - t) : 0"}]}
        self.assertEqual(self.carom("run", self.write(scene), "--sweep", "g=1:4", "--quantity", "t", "--picture", "a.svg").returncode, 1)
        self.assertEqual(len(re.findall(r"<use xlink:href='#gpPt\d+' transform='translate", (self.path / "a.svg").read_text())), 2)

    @unittest.skipUnless(shutil.which("gnuplot"), "no gnuplot")
    def test_the_order_of_a_method_could_not_be_read_off(self):
        """Its steps were squeezed into a corner; on axes of decades they are as far from one another."""
        def points(sweep, quantity):
            self.succeeds("run", self.write({**THROW, "expects": []}), "--sweep", sweep, "--quantity", quantity, "--picture", "a.svg")
            marks = re.findall(r"<use xlink:href='#gpPt\d+' transform='translate\(([0-9.]+),([0-9.]+)\)", (self.path / "a.svg").read_text())
            places = [[float(at[k]) for at in marks] for k in (0, 1)]
            return [[b - a for a, b in zip(place, place[1:])] for place in places]

        right, up = points("g=0.01,0.1,1,10,100", "g^2/h^2")
        for gaps in right, up:
            self.assertLess(max(gaps) - min(gaps), 1)
            self.assertGreater(min(map(abs, gaps)), 80)
        right, up = points("g=0.5,0.2,0.1,0.05,0.02,0.01", "-g")  # which is negative
        self.assertLess(max(right), 2 * min(right))
        self.assertGreater(max(up), 20 * min(up))
        right, up = points("g=1:200:10", "2*g")
        for gaps in right, up:
            self.assertLess(max(gaps) - min(gaps), 1)
        # Halved steps lay on an even axis, and their errors on one of decades.
        for steps, order in ("g=0.1,0.05,0.025,0.0125", 2), ("g=0.1,0.05,0.02,0.01,0.005", 1), ("g=4,2,1", 1):
            right, up = points(steps, f"g^{order}")
            slopes = [b / a for a, b in zip(right, up)]
            self.assertLess(max(slopes) - min(slopes), 0.02 * max(map(abs, slopes)), "of a pixel, of 40")
        points("g=1e-300,1e-250,1e100", "g")
        points("g=1e-280,1e-250,1e100", "g")

    @unittest.skipUnless(shutil.which("gnuplot"), "no gnuplot")
    def test_columns_of_a_heat_map_over_decades_were_slivers(self):
        self.succeeds("run", self.write({**THROW, "expects": []}), "--sweep", "g=1,10,100,1000", "--sweep", "h=1:8", "--quantity", "g*h",
                      "--picture", "a.svg")
        drawn = (self.path / "a.svg").read_text()
        cells = re.findall(r"<polygon[^>]*points = '([0-9.]+),[0-9.]+ ([0-9.]+),", drawn)[:4 * 8]
        widths = [float(right) - float(left) for left, right in cells]
        self.assertLess(max(widths), 1.02 * min(widths), "each goes on under the next by a pixel, of 200")

    @unittest.skipUnless(shutil.which("gnuplot"), "no gnuplot")
    def test_a_sweeps_picture_had_no_error_bars(self):
        box = {"low": [0, 0], "high": [20, 20]}
        fill = {**box, "count": 60, "smallest_radius": 0.5, "largest_radius": 0.5}
        gas = {"carom": 1, "world": {"solver": "events"}, "walls": [{"type": "periodic", **box}],
               "builders": [{"type": "gas", "temperature": 1, "fill": fill}], "run": {"duration": 20, "step": 0.1}}
        self.succeeds("run", self.write(gas), "--sweep", "seed=1:3", "--picture", "a.svg", "--csv", "a.csv")
        errors = sum("standard error" in column for column in self.table("a.csv")[0])
        self.assertGreater(errors, 4)
        drawn = re.findall(r'id="gnuplot_plot_\d', (self.path / "a.svg").read_text())
        self.assertEqual(len(drawn), 2 * errors, "the points of each, and their bars")

    @unittest.skipUnless(shutil.which("gnuplot"), "no gnuplot")
    def test_the_eighth_line_of_a_sweep_looked_like_the_first(self):
        methods = "euler,symplectic-euler,verlet,pefrl,rk4,runge-kutta,adaptive,gauss-radau,implicit"
        self.succeeds("run", self.write(THROW), "--sweep", f"world.integrator={methods}", "--sweep", "g=1:3", "--quantity", "ball.vy",
                      "--picture", "a.svg")
        drawn = (self.path / "a.svg").read_text()
        self.assertEqual(len(set(re.findall(r"gnuplot_plot_\d+[ab]?\"", drawn))) > 8, True)
        self.assertGreaterEqual(drawn.count("stroke-dasharray"), 2)

    # What had been computed was lost with the first value that is none.
    def test_a_wrong_value_is_known_before_the_first_run(self):
        scene = self.write(THROW)
        self.fails(2, "--sweep bodies[0].mass=-3: ", "run", scene, "--sweep", "bodies[0].mass=1,2,-3,4", "--csv", "z.csv")
        self.fails(2, "--sweep g=nothing: ", "run", scene, "--sweep", "g=1,nothing")
        dragged = self.write({**THROW, "forces": [{"type": "drag", "linear": 0.1}]})
        self.fails(2, "'nystrom' needs forces that depend on places", "run", dragged,
                   "--sweep", "world.integrator=verlet,nystrom,rk4", "--csv", "z.csv")
        self.assertEqual(self.files(), ["scene.json"])

    def test_a_wrong_quantity_was_put_down_to_the_values(self):
        self.fails(2, "carom: --quantity foo.x: in \"foo.x\": there is no body 'foo'", "run", self.write(FALL),
                   "--sweep", "run.step=0.1,0.01", "--quantity", "foo.x")

    def test_never_was_called_nan(self):
        scene = {**FALL, "expects": [{"quantity": "ball.y + 9", "statistic": "zero", "value": 1}]}
        ran = self.carom("run", self.write(scene), "--sweep", "run.step=0.1,0.01")
        self.assertEqual(ran.stdout.count("never FAIL"), 2, ran.stdout)
        self.assertIn(" never ", self.carom("run", "scene.json").stdout)

    def test_rows_are_kept_when_a_later_run_cannot_be_made(self):
        gas = {"carom": 1, "world": {"solver": "events"}, "walls": [{"type": "periodic", "low": [0, 0], "high": [10, 10]}],
               "run": {"duration": 2, "step": 0.1},
               "builders": [{"type": "gas", "temperature": 1, "fill": {"low": [0, 0], "high": [10, 10], "count": 20,
                                                                     "smallest_radius": 0.3, "largest_radius": 0.3}}]}
        ran = self.carom("run", self.write(gas), "--sweep", "run.measure_from=0,1,2", "--csv", "z.csv")
        self.assertEqual(ran.returncode, 2)
        # Which of the values it was, nobody said.
        self.assertRegex(ran.stderr, "carom: --sweep run.measure_from=2: .*nothing would be measured")
        self.assertEqual([row[0] for row in self.table("z.csv")[1:]], ["0", "1"])

    # The row of the run that was going on said that it had been one.
    def test_an_interrupted_sweep_has_whole_runs_alone(self):
        scene = self.write({**THROW, "expects": [], "parameters": {"g": 10, "h": 5, "T": 0.1}, "run": {"duration": "T", "step": 1e-4}})
        process = subprocess.Popen([carom.PROGRAM, "run", scene, "--sweep", "T=0.1,1e8", "--quantity", "t", "--csv", "t.csv"],
                                   cwd=self.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual((process.returncode, err), (1, "carom: interrupted after 1 of 2 runs\n"))
        self.assertNotIn("1e8", out)
        self.assertEqual([row[0] for row in self.table("t.csv")], ["T", "0.1"])
        self.assertTrue((self.path / "t.csv").read_text().endswith("# interrupted after 1 of 2 runs\n"))

    # It built each scene before the first run, and had nothing to show for two seconds of that.
    def test_ctrl_c_was_not_heard_while_a_sweep_reads_its_scenes(self):
        scene = self.write({**THROW, "expects": [], "parameters": {"g": 10, "h": 5}})
        process = subprocess.Popen([carom.PROGRAM, "run", scene, "--sweep", "h=0:1:0.000002", "--csv", "t.csv"],
                                   cwd=self.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        time.sleep(1.5)
        process.send_signal(signal.SIGINT)
        start = time.monotonic()
        out, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1)
        runs = int(re.fullmatch("carom: interrupted after ([0-9]+) of 500001 runs\n", err)[1])
        self.assertLess(time.monotonic() - start, 3)
        self.assertGreater(runs, 0)
        self.assertEqual(len(self.table("t.csv")), runs + 1)

    # Its runs were one after another, whatever --threads.
    def test_runs_side_by_side_make_the_same_table(self):
        gas = {"carom": 1, "world": {"solver": "events"}, "walls": [{"type": "rectangle", "low": [0, 0], "high": [10, 10]}],
               "builders": [{"type": "gas", "temperature": 1, "fill": {"low": [0, 0], "high": [10, 10], "count": 20,
                                                                     "smallest_radius": 0.3, "largest_radius": 0.3}}],
               "run": {"duration": 1, "step": 0.1}}
        sweep = ("run", self.write(gas), "--sweep", "seed=1:40", "--quantity", "momentum.x", "--quantity", "steps")
        one = self.succeeds(*sweep)
        for threads in 2, 7, 40, 41:
            many = self.succeeds(*sweep, "--threads", threads)
            self.assertEqual(many.stdout, one.stdout, threads)
            self.assertEqual(without_notes(many.stderr), without_notes(one.stderr), threads)

    def test_what_goes_wrong_on_the_way_stands_behind_the_rows_before(self):
        for threads in 1, 4:
            ran = self.carom("run", self.write(FALL), "--sweep", "bodies[0].mass=3:-3:-2", "--quantity", "t", "--csv", "t.csv",
                             "--threads", threads)
            self.assertEqual((ran.returncode, ran.stdout), (2, ""))  # the last value is known before the first run
            # The ends are fine, and the middle is not, which of so many is looked at when it comes.
            ran = self.carom("run", self.write(SQUARE), "--sweep", "m=-2:1200", "--quantity", "t", "--csv", "t.csv",
                             "--threads", threads)
            self.assertEqual(ran.returncode, 2)
            self.assertIn("carom: --sweep m=0: scene.json: bodies[0].mass must be a number > 0", ran.stderr)
            self.assertEqual([row[0] for row in self.table("t.csv")], ["m", "-2", "-1"])
            self.assertTrue((self.path / "t.csv").read_text().endswith("# ended by an error after 2 of 1203 runs\n"))

    def test_a_bad_value_in_the_middle_of_a_few_was_found_when_it_came(self):
        self.fails(2, "carom: --sweep m=0: scene.json: bodies[0].mass must be a number > 0", "run", self.write(SQUARE),
                   "--sweep", "m=-3:3", "--quantity", "t", "--csv", "t.csv")
        self.assertEqual(self.files(), ["scene.json"])

    def test_an_error_on_the_way_took_json_and_picture_with_it(self):
        ran = self.carom("run", self.write(SQUARE), "--sweep", "m=-2:1200", "--quantity", "t", "--json", "--picture", "p.svg")
        self.assertEqual(ran.returncode, 2)
        self.assertIn("carom: --sweep m=0: ", ran.stderr)
        found = json.loads(ran.stdout)
        self.assertTrue(found["interrupted"])
        self.assertEqual([run["value"] for run in found["runs"]], ["-2", "-1"])
        self.assertIn("p.svg", self.files())

    def test_energy_that_a_sweep_invents_was_in_no_note(self):
        spring = {"type": "spring", "a": "w", "b": "b", "stiffness": 1e4}
        scene = {"carom": 1, "parameters": {"l": 1}, "bodies": [{"name": "w", "kind": "fixed"}, {"name": "b", "position": [1, 0]}],
                 "joints": [{"name": "rod", "type": "distance", "b": "b", "length": "l"}], "run": {"duration": 2, "step": 0.001}}
        swept = ("run", self.write(scene), "--sweep", "l=1,2", "--quantity", "b.x")
        ran = self.carom(*swept, "--csv", "t.csv")
        self.assertEqual(ran.stderr.count("carom: note: "), 1)
        self.assertIn("carom: note: in 1 of 2 runs, first at l=2: at the start joint 'rod' gapes by 1 m. ", ran.stderr)
        self.assertIn("# note: in 1 of 2 runs, first at l=2: ", (self.path / "t.csv").read_text())
        runs = json.loads(self.carom(*swept, "--json").stdout)["runs"]
        self.assertEqual([len(run["report"]["notes"]) for run in runs], [0, 1])
        scene.update(joints=[], forces=[spring])
        ran = self.carom("run", self.write(scene), "--sweep", "run.step=0.001,0.015,0.1,0.05", "--sweep", "l=1,2", "--quantity", "b.x")
        self.assertEqual(ran.stderr.count("carom: note: "), 1)
        self.assertRegex(ran.stderr, r"carom: note: in 6 of 8 runs, first at run\.step=0\.015 l=1: in steps of .* made or lost up to")
        self.assertEqual(self.carom("run", "scene.json", "--sweep", "run.step=0.001,0.0005").stderr, "")

    def test_wrong_input_is_status_2(self):
        scene = self.write(THROW)
        for wrong in ("g", "=1:2", "g=", "g=1,,2", "g=1:2:0", "g=0:1:1e-9"):
            self.fails(2, f"--sweep {wrong}: must be NAME=FROM:TO", "run", scene, "--sweep", wrong)
        self.fails(2, "--sweep g=2:1: leads away from 1: from 2 to it BY is < 0", "run", scene, "--sweep", "g=2:1")
        self.fails(2, "leads away from 0.5: from 0.9 to it BY is < 0", "run", scene, "--sweep", "g=0.9:0.5:0.1")
        # It ran 0.5 alone.
        self.fails(2, "goes from 0.5 in steps of 1, which do not lead to 0.9: say by how much, as in 0.5:0.9:0.1", "run", scene,
                   "--sweep", "g=0.5:0.9")
        twice = ("run", scene, "--sweep", "g=1:2", "--sweep")
        self.fails(2, "--sweep g=3:4: g is swept already", *twice, "g=3:4")
        self.fails(2, "--sweep run.step=1,2: a sweep is over one parameter or two", *twice, "h=1:2", "--sweep", "run.step=1,2")
        self.fails(2, "2 x 500001 runs, and a million is the most", *twice, "h=0:1:2e-6")
        self.fails(2, "--sweep g=1 bodies[0].mass=-1: ", *twice, "bodies[0].mass=1,-1")
        picture = ("run", scene, "--picture", "a.png", "--sweep")
        self.fails(2, "must end with .png, .svg or .pdf", "run", scene, "--sweep", "g=1:2", "--picture", "a.gif")
        self.fails(2, "not all values of world.integrator are", *picture, "world.integrator=verlet,rk4")
        self.fails(2, "draws over numbers up to 1e+300, and a value of h is -1.7e+308", *picture, "h=-1.7e308,1.7e308")  # it crashed
        self.fails(2, "the scene that is run", "run", scene, "--sweep", "g=1:2", "--picture", scene)
        self.fails(2, "--picture draws a --sweep", "run", scene, "--picture", "a.png")
        # It was taken for one value, and refused as no number.
        self.fails(2, 'must be numbers from FROM to TO in steps of BY, as in 0:1:0.25 or 0:pi:pi/4, got "h"', "run", scene,
                   "--sweep", "g=1:4:h")
        self.fails(2, 'has no parameter "speed"', "run", scene, "--sweep", "speed=1:2")
        self.fails(2, "there is no body 'bal'", "run", scene, "--sweep", "g=1:2", "--quantity", "bal.x")
        self.fails(2, "--sweep is of one scene", "run", scene, scene, "--sweep", "g=1:2")
        self.fails(2, "are of one run", "run", scene, "--sweep", "g=1:2", "--data", "x.h5")
        self.fails(2, "there is none", "run", scene, "--quantity", "t")
        self.assertEqual(self.files(), ["scene.json"])


if __name__ == "__main__":
    carom.main()
