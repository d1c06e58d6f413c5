"""The exact gas as its users meet it: measures in files, from when on, killed and resumed; wrong starts."""

import json
import random
import signal
import subprocess
import time
import unittest

import carom
import numpy
from carom import PROGRAM

try:
    import h5py
except ImportError:
    h5py = None

FILL = {"low": [0, 0], "high": [10, 10], "count": 60, "smallest_radius": 0.3, "largest_radius": 0.3}
GAS = {"carom": 1, "seed": 5, "world": {"solver": "events"}, "walls": [{"type": "periodic", "low": [0, 0], "high": [10, 10]}],
       "builders": [{"type": "gas", "temperature": 1, "fill": FILL}], "pictures": [{"type": "gas"}, {"type": "energy"}],
       "run": {"duration": 100, "step": 0.2}}
TABLES = ("measures.csv", "curves.csv", "fields.csv")
RELAX = {"method": "events", "relax": True}


class Measures(carom.Case):
    def run_gas(self, *options, scene=GAS):
        ran = self.carom("run", self.write(scene), *options, "--json")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        return json.loads(ran.stdout)

    @unittest.skipUnless(h5py, "no h5py")
    def test_all_files_have_the_same(self):
        measures = {n["name"]: n for n in self.run_gas("--out", "out", "--data", "x.h5")["measures"]}
        self.assertEqual(list(measures), ["temperature k T", "mean speed", "pressure by the virial", "collisions of a disc",
                                          "mean free path", "diffusion"])
        rows = self.table("out/measures.csv")
        self.assertEqual(rows[0], ["measure", "value", "standard error", "unit"])
        motion = (self.path / "out/trajectory.csv").read_text().splitlines() if (self.path / "out/trajectory.csv").exists() else None
        for name in TABLES:
            comments = [line for line in (self.path / "out" / name).read_text().splitlines() if line.startswith("#")]
            self.assertEqual([line.split(":")[0] for line in comments],
                             ["# carom.version", "# carom.build", "# carom.seed", "# carom.scene", "# carom.summary"])
            if motion: self.assertEqual(comments, [line for line in motion if line.startswith("#")])
            self.succeeds("run", f"out/{name}", "--duration", "1")
        curves = self.table("out/curves.csv")
        self.assertEqual(curves[0], ["curve", "x", "y", "standard error", "law", "what x is", "what y is"])
        self.assertEqual({row[0]: row[5:] for row in curves[1:]}["mean squared way"], ["t [s]", "way² [m²]"])
        self.assertEqual([(row[0], float(row[1]), float(row[2]), row[3]) for row in rows[1:]],
                         [(n["name"], n["value"], n["error"], n["unit"]) for n in measures.values()])
        self.assertTrue(all(n["error"] > 0 for n in measures.values()))
        with h5py.File(self.path / "x.h5") as f:
            gas = f["observables/gas"]
            for name, n in measures.items():
                stored = gas[name.replace(" ", "_")]
                self.assertEqual((stored[()], stored.attrs["standard_error"]), (n["value"], n["error"]))
            self.assertEqual(gas["pressure_by_the_virial"].attrs["unit"], b"N m-1")
            self.assertEqual(gas["diffusion"].attrs["unit"], b"m2 s-1")
            self.assertEqual(gas["collisions_of_a_disc"].attrs["unit"], b"s-1")
            curves = self.table("out/curves.csv")[1:]
            for name in ("speeds", "pair correlation", "mean squared way", "memory of the velocity"):
                rows, curve = [row for row in curves if row[0] == name], gas["curves"][name.replace(" ", "_")]
                numpy.testing.assert_array_equal(curve["x"][()], [float(row[1]) for row in rows])
                numpy.testing.assert_array_equal(curve["y"][()], [float(row[2]) for row in rows])
                numpy.testing.assert_array_equal(curve["standard_error"][()], [float(row[3] or "nan") for row in rows])
            self.assertEqual(gas["curves/speeds"].attrs["law"], b"Maxwell")
            cells = self.table("out/fields.csv")[1:]
            self.assertEqual(len(cells), 256)
            for column, name in ((2, "density"), (3, "density_error"), (4, "flow_x"), (9, "temperature_error")):
                numpy.testing.assert_array_equal(gas["fields"][name][()], [float(row[column]) for row in cells])
            # 60 discs on 100 m² at rest, k T = 1: within five errors, 256 times.
            fields = gas["fields"]
            self.assertAlmostEqual(fields["density"][()].mean(), 0.6)
            self.assertTrue((abs(fields["density"][()] - 0.6) < 5 * fields["density_error"][()]).all())
            self.assertTrue((abs(fields["flow_x"][()]) < 5 * fields["flow_x_error"][()]).all())
            self.assertTrue((abs(fields["temperature"][()] - 59 / 60) < 6 * fields["temperature_error"][()]).all())
        self.assertTrue((self.path / "out/gas.png").stat().st_size > 10000)

    def test_what_is_left_out_was_so_without_a_word(self):
        def why(*options, scene=GAS):
            report = self.run_gas(*options, scene=scene)
            out = {absent["quantity"]: absent["why"] for absent in report["left_out"]}
            self.assertFalse(out.keys() & {n["quantity"] for n in report["measures"]})
            return out

        self.assertEqual(why(), {})
        self.assertRegex(why("--step", "0.02", "--duration", "20")["gas.diffusion"],
                         r"^in 0.5 s a disc meets [0-9.]+ others, too few to have forgotten its velocity: look less often")
        self.assertRegex(self.succeeds("run", "scene.json", "--step", "0.02", "--duration", "20").stdout,
                         r"\n  diffusion +is left out: in 0.5 s a disc meets ")
        self.assertEqual(why("--duration", "2"), {"gas.diffusion": "it takes more than 50 frames: look more often, or longer"})
        walls = {**GAS, "walls": [{"type": "rectangle", "low": [0, 0], "high": [10, 10]}]}
        self.assertRegex(why(scene=walls)["gas.diffusion"], r"^in 9.8 s walls take \d+ % of what ways grow by, more than 5 %: ")
        self.assertEqual(why("--duration", "0.001", "--step", "0.001")["gas.mean_free_path"], "no disc met another one")

    def test_diffusion_did_not_say_over_which_times(self):
        self.assertRegex(self.succeeds("run", self.write(GAS)).stdout, r"\n  diffusion .* m²/s ± [0-9.]+, over 5 to 9.8 s\n")
        over = {n["quantity"]: n["over"] for n in self.run_gas()["measures"] if "over" in n}
        self.assertEqual(over, {"gas.diffusion": [25 * 0.2, 49 * 0.2]})

    def test_they_can_be_expected(self):
        def judged(*expects, options=()):
            ran = self.carom("run", self.write({**GAS, "expects": list(expects)}), *options, "--json")
            return ran.returncode, json.loads(ran.stdout)

        # What is judged is what is printed, and looks as often: not at every step.
        names = [f"{name}{error}" for name in ("gas.pressure", "gas.diffusion", "gas.mean_free_path") for error in ("", ".error")]
        options = ("--every", "3", "--measure-from", "20")
        status, r = judged(*({"quantity": name, "value": 0, "tolerance": 9} for name in names), options=options)
        printed = {}
        for n in r["measures"]:
            printed.update({n["quantity"]: n["value"], n["quantity"] + ".error": n["error"]})
        self.assertEqual((status, [v["value"] for v in r["expectations"]]), (0, [printed[name] for name in names]))
        # An expectation in units of the standard error: 1.4556 is the virial series to its eighth term, for 0.17 of the
        # room are discs, and one of the sixty is in the motion of them all.
        law = "(gas.pressure - 0.59*gas.temperature*1.4556)/gas.pressure.error"
        self.assertEqual(judged({"quantity": law, "value": 0, "tolerance": 4})[0], 0)
        self.assertEqual(judged({"quantity": law.replace("1.4556", "1.55"), "value": 0, "tolerance": 4})[0], 1)
        self.assertEqual(self.carom("check", "scene.json").returncode, 1)  # follows what is of a moment
        for wrong, expectation in (("known at the end alone", {"quantity": "gas.pressure", "value": 1, "statistic": "mean"}),
                                   ("known at the end alone", {"quantity": "gas.pressure", "value": 1, "at": 3}),
                                   ("did you mean 'gas.pressure'?", {"quantity": "gas.presure", "value": 1})):
            self.fails(2, wrong, "run", self.write({**GAS, "expects": [expectation]}))
        self.fails(2, "'expects' alone may name it", "check", self.write(GAS), "--quantity", "gas.pressure")
        self.fails(2, "under the solver 'events'", "run",
                   self.write({**GAS, "world": {"solver": "impulse"}, "expects": [{"quantity": "gas.pressure", "value": 1}]}))

    def test_they_begin_when_they_should(self):
        """What was counted before, and how hot it was then, is forgotten."""
        cold = {**GAS, "walls": [{"type": "rectangle", "low": [0, 0], "high": [10, 10], "left": {"temperature": 4}}]}
        counts = [self.run_gas("--duration", t, scene=cold) for t in (50, 100)]
        for option in (["--measure-from", "50"], ["--set", "run.measure_from=50"]):
            report = self.run_gas(*option, scene=cold)
            self.assertEqual(report["state_hash"], counts[1]["state_hash"])
            measures = {n["name"]: n["value"] for n in report["measures"]}
            first, everything = ({n["name"]: n["value"] for n in count["measures"]} for count in counts)
            # The second half is twice the whole less the first half, of means over time.
            for name in ("temperature k T", "collisions of a disc"):
                self.assertAlmostEqual(measures[name] / (2 * everything[name] - first[name]), 1, delta=1e-9)
                self.assertNotAlmostEqual(measures[name] / everything[name], 1, delta=1e-3)
        self.fails(2, "run.measure_from must be before the end of the run at 100 s, got 100 s", "run", "scene.json",
                   "--measure-from", "100")

    def test_a_killed_run_has_what_there_was(self):
        process = subprocess.Popen([PROGRAM, "run", self.write(GAS), "--duration", "1e6", "--out", "out"], cwd=self.path,
                                   stdout=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        end = time.monotonic() + 60
        while not all((self.path / "out" / name).exists() for name in TABLES) and time.monotonic() < end:
            time.sleep(0.05)
        process.send_signal(signal.SIGKILL)
        process.wait()
        measures = {row[0]: float(row[1]) for row in self.table("out/measures.csv")[1:]}
        self.assertAlmostEqual(measures["temperature k T"], 1, delta=1e-9)
        self.assertEqual(len(self.table("out/fields.csv")), 257)

    def test_a_resumed_run_measures_the_same(self):
        scene = {**GAS, "run": {"duration": 400, "step": 0.05, "every": 3, "measure_from": 30},
                 "expects": [{"quantity": "gas.pressure", "value": 0.85, "tolerance": 0.1}]}
        whole = self.run_gas("--out", "whole", "--format", "svg", scene=scene)
        chance, kills, report = random.Random(4), 0, None
        command = ["run", "scene.json", "--out", "cut", "--format", "svg", "--checkpoint", "every=100,file=c", "--json"]
        while report is None:
            process = subprocess.Popen([PROGRAM, *command], cwd=self.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            try:
                out, err = process.communicate(timeout=chance.uniform(0, 0.3) * 1.02**kills)
                self.assertEqual(process.returncode, 0, err)
                report = json.loads(out)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                kills += 1
                if (self.path / "c").exists():
                    command = ["run", "--resume", "c", "--json"]
                elif "--resume" in command:
                    report = whole  # it had done its work, and only not said so
        self.assertGreater(kills, 0)
        self.assertEqual({**report, "wall_seconds": 0}, {**whole, "wall_seconds": 0})
        for name in (*TABLES, "gas.svg"):
            self.assertEqual((self.path / "whole" / name).read_bytes(), (self.path / "cut" / name).read_bytes(), name)

    def test_a_picture_of_no_gas_spoke_of_a_meter(self):
        scene = self.write({"carom": 1, "pictures": [{"type": "gas"}], "run": {"duration": 1}})
        self.fails(2, "pictures[0] is wrong: the measures of a gas are of dynamic bodies, and there is none", "plot", scene)

    def test_a_piston_was_said_to_be_driven(self):
        gas = {"type": "gas", "temperature": 1, "fill": {"low": [0, 0], "high": [6, 4], "count": 20, "smallest_radius": 0.1, "largest_radius": 0.1}}
        piston = {"name": "piston", "position": [7, 2], "shapes": [{"type": "box", "width": 0.2, "height": 3.9}]}
        scene = {"carom": 1, "world": {"solver": "events"}, "walls": [{"type": "rectangle", "low": [0, 0], "high": [10, 4]}], "builders": [gas],
                 "bodies": [piston], "run": {"duration": 1, "step": 0.01}}
        said = self.carom("run", self.write(scene)).stdout
        self.assertIn("pressure by the virial   is left out: the room changes, for what is no disc moves in it", said)


class Starts(carom.Case):
    def bodies(self, *bodies, solver="events", walls=({"type": "rectangle", "low": [0, 0], "high": [4, 4]},)):
        return self.write({"carom": 1, "world": {"solver": solver}, "walls": list(walls), "bodies": list(bodies),
                           "run": {"duration": 1, "step": 0.1}})

    def test_overlaps_are_named_and_relaxed_if_wanted(self):
        two = [{"name": "a", "position": [1, 1], "velocity": [1, 0], "radius": 0.5}, {"name": "b", "position": [1.6, 1], "radius": 0.5},
               {"name": "c", "position": [4.5, 3], "radius": 0.3}]
        self.fails(2, "bodies[2].position must not be outside of the walls", "run", self.bodies(*two))
        self.fails(2, "bodies 'a' and 'b' by 0.4 m. Move them apart, or let the solver's option 'relax' do that", "run",
                   self.bodies(*two[:2]))
        said = self.succeeds("run", self.bodies(*two, solver=RELAX)).stdout
        self.assertRegex(said, r"moved apart by +0\.80\d+ m, the farthest of the discs that overlapped at the start")
        report = json.loads(self.succeeds("run", "scene.json", "--json").stdout)
        self.assertAlmostEqual(report["moved_apart"], 0.8003)

    def test_what_cannot_be(self):
        disc = {"position": [2, 2], "radius": 0.5, "velocity": [1, 0]}
        many = [{**disc, "position": [k % 5 * 0.8 + 0.4, k // 5 * 0.8 + 0.4]} for k in range(25)]
        for solver in ("events", RELAX):
            self.fails(2, "they fill 1.227 of the room, and no packing of equal discs fills more than 0.9069, π/(2√3)", "run",
                       self.bodies(*many, solver=solver))
            self.fails(2, "at rest and there is no gravity, so that nothing would ever happen", "run",
                       self.bodies({**disc, "velocity": [0, 0]}, solver=solver))
        self.fails(2, "could not relax the discs: after 5000 rounds", "run", self.bodies(*many[:18], solver=RELAX))
        for wrong in (1.01, -0.1):
            self.fails(2, "restitution", "run", self.bodies({**disc, "restitution": wrong}))
        self.fails(2, "radius", "run", self.bodies({**disc, "radius": -1}))
        points = [{"position": [k, 1], "velocity": [1 - k, 0]} for k in range(3)]
        self.fails(2, "points without a radius never meet", "run", self.bodies(*points, walls=()))
        self.succeeds("run", self.bodies(*points))


if __name__ == "__main__":
    carom.main()
