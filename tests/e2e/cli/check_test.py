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
        self.assertEqual(self.study(scene, "--step", c["refined_step"], status=0)["verdict"], "trust")
        self.assertEqual(self.study(scene, "--tolerance", "0.1", status=0)["verdict"], "trust")

    def test_a_gas_is_chaotic_and_its_energy_is_exact(self):
        c = self.study(SCENES / "gas.json", status=1)
        self.assertEqual((c["verdict"], c["state"]["order"]), ("chaotic", None))
        self.assertLess(c["horizon"], 9)
        self.assertGreater(c["lyapunov_exponent"], 0)
        self.assertIsNotNone(c["first_impact"])
        c = self.study(SCENES / "gas.json", "--quantity", "energy.kinetic", status=0)
        self.assertEqual([q["quantity"] for q in c["quantities"]], ["energy.kinetic"])

    def test_a_method_with_its_own_step_is_refined_by_its_tolerance(self):
        place = 'world.integrator={"method":"adaptive","tolerance":1e-3}'
        c = self.study(SCENES / "spring-pendulum.json", "--set", place, "--step", "0.5", "--tolerance", "1e-5", status=1)
        self.assertEqual([r["tolerance"] for r in c["runs"]], [1e-3, 1e-4, 1e-5])
        self.assertLess(c["refined_tolerance"], 1e-3)

    def test_a_picture_is_drawn(self):
        self.succeeds("check", self.write(FALL), "--out", "pictures", "--format", "svg")
        self.assertIn("pictures/convergence.svg", self.files())

    def test_wrong_input_is_status_2(self):
        scene = self.write(FALL)
        self.fails(2, "there is no body 'bal'; did you mean 'ball'?", "check", scene, "--quantity", "bal.x")
        self.fails(2, "--tolerance", "check", scene, "--tolerance", "0")
        self.fails(2, "duration", "check", scene, "--duration", "0")
        self.fails(2, "nothing.json", "check", "nothing.json")


if __name__ == "__main__":
    carom.main()
