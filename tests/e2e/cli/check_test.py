"""carom check: what it prints, and its exit status."""

import json

import carom
from carom import FALL, SCENES


class Check(carom.Case):
    def study(self, *arguments, status):
        ran = self.carom("check", *arguments, "--json")
        self.assertEqual((ran.returncode, ran.stderr), (status, ""))
        return json.loads(ran.stdout)

    def test_what_is_fine_is_status_0(self):
        c = self.study(self.write(FALL), status=0)
        self.assertEqual((c["verdict"], c["state"]["by"], c["state"]["order"]), ("trust", "exact to rounding", None))
        self.assertEqual([r["step"] for r in c["runs"]], [0.01, 0.005, 0.0025])
        ran = self.succeeds("check", "scene.json")
        self.assertTrue(ran.stdout.splitlines()[-1].startswith("Trust it: "), ran.stdout)

    def test_what_is_not_names_a_step_that_is(self):
        scene = SCENES / "spring-pendulum.json"
        c = self.study(scene, status=1)
        self.assertEqual(c["verdict"], "refine")
        self.assertAlmostEqual(c["state"]["order"], 1, delta=0.15)  # symplectic Euler
        fine = self.study(scene, "--step", c["refined_step"], status=0)
        self.assertEqual(fine["verdict"], "trust")
        # and not much better than what was asked for
        self.assertGreater(max(f["relative"] for f in [fine["state"], *fine["quantities"]]), 1e-3 / 4)
        self.assertEqual(self.study(scene, "--tolerance", "0.1", status=0)["verdict"], "trust")

    def test_a_gas_is_chaotic_and_its_energy_is_exact(self):
        c = self.study(SCENES / "gas.json", status=1)
        self.assertEqual((c["verdict"], c["state"]["order"]), ("chaotic", None))
        self.assertLess(c["horizon"], 9)
        self.assertGreater(c["lyapunov_exponent"], 0)
        self.assertIsNotNone(c["first_impact"])
        c = self.study(SCENES / "gas.json", "--quantity", "energy.kinetic", status=0)
        self.assertEqual([q["quantity"] for q in c["quantities"]], ["energy.kinetic"])

    def test_what_was_asked_for_and_is_all_error_is_not_trusted(self):
        wall = {"type": "half-plane", "side": {"friction": 0.5}}
        box = {"shapes": [{"type": "box", "width": 1, "height": 1}], "friction": 0.5, "restitution": 0}
        scene = {
            "carom": 1,
            "world": {"gravity": [0, -9.81], "solver": {"method": "softstep", "statics": False}},  # it would stand
            "walls": [wall],
            # In a small world two would be exact.
            "bodies": [dict(box, name="b1", position=[0, 0.5]), dict(box, name="b2", position=[0, 1.5])] +
                      [dict(box, position=[2 * i + 2, 0.5]) for i in range(20)],
            "run": {"duration": 20, "step": "1/60"},
        }
        name = self.write(scene)
        c = self.study(name, "--quantity", "b1.x", status=1)
        self.assertEqual(c["verdict"], "unjudged")
        self.assertIn("b1.x is all error", c["sentence"])
        self.assertNotIn("rust it", c["sentence"])
        self.assertIn("all error", c["quantities"][0]["left_out"])
        # Beside one that can be judged it still leaves the answer open; that one alone does not.
        c = self.study(name, "--quantity", "b1.x", "--quantity", "b2.y", status=1)
        self.assertEqual((c["verdict"], c["quantities"][1]["left_out"]), ("unjudged", None))
        self.assertEqual(self.study(name, "--quantity", "b2.y", status=0)["verdict"], "trust")
        # How near to zero is near enough is for the scene to say.
        for tolerance, status, verdict in ((0.1, 0, "trust"), (1e-7, 1, "refine")):
            scene["expects"] = [{"quantity": "b1.x", "value": 0, "tolerance": tolerance}]
            self.assertEqual(self.study(self.write(scene), "--quantity", "b1.x", status=status)["verdict"], verdict)

    # It had none beside the energy of the sun, which is larger, in joules, than this is in metres.
    def test_a_place_lost_its_size_beside_a_heavy_mass(self):
        for mass in 1e-20, 1, 1e9, 1e30:
            scene = {
                "carom": 1,
                "world": {"solver": "none"},
                "bodies": [{"name": "sun", "mass": 2 * mass},
                           {"name": "earth", "mass": 6e-6 * mass, "position": [1.5e11, 0], "velocity": [0, 29800]},
                           {"name": "moon", "mass": 7e-8 * mass, "position": [1.504e11, 0], "velocity": [0, 30800]}],
                "forces": [{"type": "attraction", "strength": 1.33e20 / (2 * mass)}],
                "run": {"duration": 3.15e7, "step": 43200},
            }
            name = self.write(scene)
            c = self.study(name, "--quantity", "earth.x", "--quantity", "earth.vy", status=0)
            self.assertEqual((c["verdict"], [q["left_out"] for q in c["quantities"]]), ("trust", [None] * 2), mass)
            self.assertGreater(c["quantities"][0]["size"], 2e11)
            # What is all error is so, whatever the unit.
            c = self.study(name, "--quantity", "momentum.x", status=1)
            self.assertEqual(c["verdict"], "unjudged", mass)

    # Its range is nothing but error, and 68 % of that were: it was to be refined to two microseconds.
    def test_the_length_of_a_rod_was_held_against_its_own_error(self):
        scene = {"carom": 1, "parameters": {"L": 1, "g": 9.81, "start": "150*deg"}, "world": {"gravity": [0, "-g"]},
                 "bodies": [{"name": "bob", "position": ["L*sin(start)", "-L*cos(start)"]}],
                 "joints": [{"name": "rod", "type": "distance", "b": "bob"}], "run": {"duration": 10, "step": 0.002},
                 "expects": [{"quantity": "hypot(bob.x, bob.y)", "value": "L", "tolerance": 1e-9}]}
        c = self.study(self.write(scene), status=0)
        length = next(q for q in c["quantities"] if q["quantity"].startswith("hypot"))
        self.assertEqual((c["verdict"], length["left_out"]), ("trust", None))
        self.assertGreater(length["size"], 1e-3)

    # The height of a box on a belt has a range of 1e-13 m, and its error was held against that.
    def test_what_rests_was_to_be_refined_for_its_rounding(self):
        for method in "verlet", "adaptive":
            c = self.study(SCENES / "contacts/conveyor.json", "--integrator", method, status=0)
            self.assertEqual(c["verdict"], "trust", method)
            height = next(q for q in c["quantities"] if q["quantity"] == "box.y")
            self.assertAlmostEqual(height["size"], 0.2)

    def test_what_is_never_a_number_is_not_trusted(self):
        c = self.study(self.write(FALL), "--quantity", "sqrt(-1)", status=1)
        self.assertEqual(c["verdict"], "unjudged")
        self.assertIn("sqrt(-1) is never a number", c["sentence"])

    def test_angular_momentum_is_no_row_in_a_periodic_box(self):
        scene = dict(FALL, world={"solver": "none"}, walls=[{"type": "periodic", "low": [0, 0], "high": [10, 10]}])
        scene["bodies"] = [{"name": "ball", "position": [0, 5], "velocity": [3, 40]}]
        name = self.write(scene)
        self.assertEqual([r["angular_momentum_drift"] for r in self.study(name, status=0)["runs"]], [None] * 3)
        self.assertNotIn("angular", self.succeeds("check", name).stdout)
        self.assertIn("angular", self.succeeds("check", self.write(FALL)).stdout)

    def test_a_method_with_its_own_step_is_refined_by_its_tolerance(self):
        place = 'world.integrator={"method":"adaptive","tolerance":1e-3}'
        c = self.study(SCENES / "spring-pendulum.json", "--set", place, "--step", "0.5", "--tolerance", "1e-5", status=1)
        self.assertEqual([r["tolerance"] for r in c["runs"]], [1e-3, 1e-4, 1e-5])
        self.assertLess(c["refined_tolerance"], 1e-3)

    # It varied the tolerance alone, found three runs that agreed to the last digit, and trusted an error of 2.7 %.
    def test_a_pendulum_on_a_rod_was_exact_to_rounding_where_the_step_made_its_error(self):
        scene = {
            "carom": 1,
            "world": {"gravity": [0, -9.81], "solver": "softstep"},
            "bodies": [{"name": "nail", "kind": "fixed"}, {"name": "bob", "position": [0.5, "-sqrt(3)/2"]}],
            "joints": [{"type": "distance", "a": "nail", "b": "bob", "length": 1}],
            "run": {"duration": 5, "step": 0.25},
        }
        name = self.write(scene)
        verlet = self.study(name, status=1)
        for method in "adaptive", "gauss-radau", "nystrom":  # under gravity alone they fly as Verlet does
            c = self.study(name, "--integrator", method, status=1)
            self.assertEqual((c["verdict"], [r["step"] for r in c["runs"]]), ("refine", [0.25, 0.125, 0.0625]), method)
            for k in range(3):
                self.assertAlmostEqual(c["runs"][k]["tolerance"] / 10 ** (-9 - k), 1, delta=1e-12)
            self.assertAlmostEqual(c["state"]["order"], 2, delta=0.15)
            self.assertAlmostEqual(c["state"]["error"] / verlet["state"]["error"], 1, delta=1e-6)
            self.study(name, "--integrator", method, "--step", c["refined_step"], status=0)
        self.assertIn("joints and contacts are solved in parts of dt",
                      self.carom("check", name, "--integrator", "adaptive").stdout)
        for method, said in ("pefrl", True), ("implicit", True), ("verlet", False), ("euler", False):
            text = self.carom("check", name, "--integrator", method).stdout
            self.assertEqual("joints are solved in parts of dt, to second order" in text, said, method)

    # Nor was a contact's error looked for, which a looser tolerance did not make.
    def test_a_bounce_under_a_method_with_its_own_step_is_refined_by_the_step(self):
        scene = {
            "carom": 1,
            "world": {"gravity": [0, -9.81], "solver": "softstep", "integrator": "gauss-radau"},
            "walls": [{"type": "half-plane"}],
            "bodies": [{"name": "ball", "position": [0, 3], "velocity": [1, 0], "radius": 0.5},
                       {"name": "nail", "kind": "fixed", "position": [0, 5]}],
            "forces": [{"type": "spring", "a": "nail", "b": "ball", "stiffness": 2, "rest_length": 1}],
            "run": {"duration": 5, "step": 0.1},
        }
        c = self.study(self.write(scene), status=1)
        self.assertEqual([r["step"] for r in c["runs"]], [0.1, 0.05, 0.025])
        self.assertIsNotNone(c["refined_step"])
        scene["walls"] = []  # nothing is touched
        self.assertEqual([r["step"] for r in self.study(self.write(scene), status=0)["runs"]], [0.1] * 3)

    def test_a_body_whose_name_has_a_quote_was_not_found(self):
        scene = {**FALL, "bodies": [{"name": "Newton's apple", "position": [0, 5]}]}
        c = self.study(self.write(scene), status=0)
        self.assertEqual([q["quantity"] for q in c["quantities"]][:2], ["'Newton''s apple'.x", "'Newton''s apple'.y"])
        said = self.succeeds("check", "scene.json").stdout
        self.assertIn("'Newton''s apple'.y [m]", said)

    # Runs at h, h/2 and h/4 that all see whole periods of a force see a constant one, agree, and are 2 m off.
    def test_a_force_faster_than_the_step_was_trusted_for_the_runs_agreed(self):
        scene = {
            "carom": 1,
            "parameters": {"W": "2*pi*240"},
            "world": {"solver": "none"},
            "bodies": [{"name": "m"}, {"name": "wall", "kind": "fixed"}],
            "forces": [{"type": "field", "body": "m", "x": "cos(W*t)"},
                       {"type": "spring", "a": "wall", "b": "m", "stiffness": 1}],
            "run": {"duration": 3, "step": "1/60"},
        }
        name = self.write(scene)
        for case in ([], ["--integrator", "rk4", "--step", "0.05", "--set", "W=2*pi*160"]):
            c = self.study(name, *case, status=1)
            self.assertEqual((c["verdict"], c["state"]["order"]), ("refine", None), case)
            self.assertIn("agree with one another and not with the reference", c["sentence"])
            x = next(q for q in c["quantities"] if q["quantity"] == "m.x")
            # It swings by 2 F/W² = 9e-7 m about 0, and the runs about 1 m, which in 3 s is 2 m at most.
            self.assertAlmostEqual(x["error"], 1.99, delta=0.01)
        self.study(name, "--integrator", "adaptive", status=0)

    # Three runs under a tolerance that is no part of 1e-18 m are one and the same run.
    def test_a_tiny_oscillator_was_exact_to_rounding_and_off_by_a_thousand_amplitudes(self):
        scene = {
            "carom": 1,
            "parameters": {"A": 1e-18, "g": 0.05},
            "world": {"solver": "none", "integrator": "adaptive"},
            "bodies": [{"name": "a", "kind": "fixed"}, {"name": "b", "position": ["A", 0]}],
            "forces": [{"type": "spring", "a": "a", "b": "b", "stiffness": 1, "damping": "2*g",
                        "damping_law": "isotropic"}],
            "run": {"duration": 30, "step": 1},
            "twins": [{"quantity": "b.x/A", "formula": "oscillator(t,1,0,1,g)"}],
        }
        name = self.write(scene)
        for damping in "0.05", "0":
            c = self.study(name, "--set", f"g={damping}", status=1)
            self.assertEqual((c["verdict"], [r["step"] for r in c["runs"]]), ("refine", [1, 0.5, 0.25]), damping)
            self.study(name, "--set", f"g={damping}", "--step", c["refined_step"], status=0)
            off = json.loads(self.succeeds("run", name, "--set", f"g={damping}", "--step", c["refined_step"],
                                           "--json").stdout)["twins"][0]
            self.assertLess(off["max_error"], 1e-3)  # the tolerance of the check, of an amplitude of 1
        self.assertIn("the method's own steps are bound by dt", self.carom("check", name).stdout)
        # At its size the same tolerance would have done.
        self.study(name, "--set", 'world.integrator={"method":"adaptive","tolerance":1e-27}', status=0)

    # Tolerances of 0.1 to 0.001 that a step of 0.1 s all but keeps are one run, too.
    def test_what_a_looser_tolerance_does_not_change_is_refined_by_the_step(self):
        scene = {
            "carom": 1,
            "world": {"solver": "none",
                      "integrator": {"method": "adaptive", "pair": "dormand-prince54", "tolerance": 0.1}},
            "bodies": [{"name": "a", "kind": "fixed"}, {"name": "b", "position": [1, 0]}],
            "forces": [{"type": "spring", "a": "a", "b": "b", "stiffness": 1}],
            "run": {"duration": 30, "step": 0.1},
            "twins": [{"quantity": "b.x", "formula": "cos(t)"}],
        }
        name = self.write(scene)
        c = self.study(name, "--tolerance", "1e-5", status=1)
        self.assertEqual(c["verdict"], "refine")
        x = next(q for q in c["quantities"] if q["quantity"] == "b.x")
        run = json.loads(self.succeeds("run", name, "--json").stdout)
        self.assertAlmostEqual(x["error"] / run["twins"][0]["max_error"], 1, delta=0.01)

    # "Refine it to a quarter of the step; with that it stayed below", and at that again to a quarter: the finest run was
    # held against a reference in its own steps.
    def test_a_seesaw_was_to_be_refined_by_four_without_end(self):
        rough = {"restitution": 0, "friction": 0.6}
        def box(name, x, y, mass, width, height):
            return {"name": name, "position": [x, y], "mass": mass, **rough, "shapes": [{"type": "box", "width": width, "height": height}]}
        stand = {"name": "stand", "kind": "fixed", "shapes": [{"type": "polygon", "points": [[-0.3, 0], [0.3, 0], [0, 0.7]]}]}
        scene = {
            "carom": 1,
            "world": {"gravity": [0, -9.81]},
            "walls": [{"type": "half-plane", "side": rough}],
            "bodies": [stand, box("plank", 0, 0.75, 20, 4, 0.1), box("Anna", -1.5, 1.1, 25, 0.4, 0.6),
                       box("Ben", 1.5, 1.1, 30, 0.4, 0.6)],
            "joints": [{"name": "pivot", "a": "stand", "b": "plank", "at": [0, 0.75], "type": "revolute"}],
            "run": {"duration": 1.3, "step": "1/60"},  # Ben's end lands at 1.17 s
        }
        name = self.write(scene)
        c = self.study(name, status=1)
        self.assertEqual((c["verdict"], c["state"]["by"]), ("refine", "from the finest run"))
        self.assertIsNotNone(c["refined_step"])
        again = self.study(name, "--step", c["refined_step"], status=0)
        self.assertEqual((again["verdict"], again["refined_step"]), ("trust", None))

    def test_a_picture_is_drawn(self):
        self.succeeds("check", self.write(FALL), "--out", "pictures", "--format", "svg")
        self.assertIn("pictures/convergence.svg", self.files())

    def test_wrong_input_is_status_2(self):
        scene = self.write(FALL)
        self.fails(2, "there is no body 'bal'; did you mean 'ball'?", "check", scene, "--quantity", "bal.x")
        for wrong in "0", "-1", "inf", "nan", "x":
            self.fails(2, f"--tolerance: must be a number > 0, got {wrong} (", "check", scene, "--tolerance", wrong)
        self.fails(2, "duration", "check", scene, "--duration", "0")
        self.fails(2, "nothing.json", "check", "nothing.json")


if __name__ == "__main__":
    carom.main()
