"""carom bench: what a scene costs, and which part of a step takes it."""

import json

import carom
from carom import FALL, SCENES


class Bench(carom.Case):
    def test_parts_add_up_to_the_steps(self):
        ran = self.succeeds("bench", SCENES / "contacts" / "stack.json", "--duration", "1", "--json")
        cost = json.loads(ran.stdout)
        self.assertEqual((cost["steps"], cost["threads"]), (60, 1))
        self.assertAlmostEqual(cost["wall"], 60 * cost["mean_step"], delta=1e-9)
        self.assertLessEqual(cost["median_step"], cost["longest_step"])
        # The clock that steps are measured with goes on where they are counted: a tenth leaves room for that.
        parts = sum(cost["stages"].values())
        self.assertLessEqual(parts, cost["mean_step"])
        self.assertGreater(parts, 0.9 * cost["mean_step"])
        for part in ("pairs", "narrow phase", "motion"):
            self.assertGreater(cost["stages"][part], 0, part)

    def test_a_table_names_the_parts(self):
        scene = SCENES / "contacts" / "stack.json"
        self.assertIn("a step ", self.succeeds("bench", scene, "--duration", "0.5").stdout)
        self.assertIn("contacts", self.succeeds("bench", scene, "--duration", "0.5").stdout)

    def test_one_body_was_called_bodies(self):
        said = self.succeeds("bench", self.write(FALL), "--duration", "0.01").stdout
        self.assertTrue(said.startswith("1 body, 1 step of 0.01 s, 1 thread\n"), said)
        said = self.succeeds("bench", SCENES / "gas.json", "--duration", "0.1", "--threads", "2").stdout
        self.assertRegex(said, r"\d bodies, \d+ steps of .* s, 2 threads\n")

    def test_other_solvers_have_no_parts(self):
        self.assertNotIn("part of a step", self.succeeds("bench", self.write(FALL)).stdout)

    def test_wrong_input_is_status_2(self):
        self.fails(2, "nothing.json", "bench", "nothing.json")
        self.fails(2, "duration", "bench", self.write(FALL), "--duration", "0")


if __name__ == "__main__":
    carom.main()
