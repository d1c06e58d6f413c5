"""Force fields written as expressions: what is said of those that are no numbers, and which methods take them."""

import json

import carom
from carom import FALL


class Fields(carom.Case):
    # So it was said of a field that is no number, for which no step is short enough; and not which of the fields.
    def test_a_field_that_is_no_number_was_told_to_take_a_shorter_step(self):
        def said(field, *options, bodies=FALL["bodies"]):
            ran = self.carom("run", self.write({**FALL, "bodies": bodies, "forces": [{"type": "field", "y": "1"}, field]}), *options)
            self.assertEqual(ran.returncode, 1)
            self.assertEqual(ran.stderr.count("\n"), 1)
            return ran.stderr

        ball = [{"name": "ball", "position": [0.5, 0], "velocity": [-1, 0]}]
        root = {"type": "field", "x": "-1/sqrt(x)"}
        nowhere = r"is \(nan, 0\) N for body 'ball' at \(-\S+, \S+\) m with velocity \(-\S+, \S+\) m/s and mass 1 kg at t = 0\.\d+ s: it must be a number wherever"
        self.assertRegex(said(root, bodies=ball), rf"; the force field 2 {nowhere}")
        self.assertRegex(said({**root, "name": "well"}, bodies=ball), rf"; the force field 'well' {nowhere}")
        for method in "adaptive", "gauss-radau", "rk4", "symplectic-euler":
            self.assertRegex(said(root, "--integrator", method, bodies=ball), r"the force field 2 is \(nan, 0\) N for body 'ball' at \(-")
        self.assertNotIn("shorter step", said(root, bodies=ball))
        # What grows without bound may be passed by.
        self.assertRegex(said({"type": "field", "x": "-1e300*x^9"}, bodies=[{"name": "ball", "position": [1, 0]}]),
                         r"the force field 2 is \(inf, 0\) N for body 'ball' .*; a shorter step may help")
        curve = {"type": "drive", "body": "d", "x": "sqrt(0.5 - t)"}
        scene = self.write({**FALL, "bodies": [{"name": "d", "kind": "driven"}], "forces": [curve]})
        self.assertRegex(self.carom("run", scene).stderr, "body 'd' is at .*; the curve that drives it is no finite number there")
        scene = self.write({**FALL, "forces": [{"type": "field", "y": "0*t", "name": "pit", "potential": "sqrt(0.5 - t)"}]})
        self.assertRegex(self.carom("run", scene).stderr, "; the potential of the force field 'pit' is nan J for body 'ball' at ")

    # All fields were refused as functions of velocity, those whose expressions have none of it among them.
    def test_a_field_without_velocities_was_refused_by_nystrom(self):
        def with_field(field):
            return self.write({**FALL, "bodies": [{"position": [1, 0]}], "world": {"integrator": "nystrom"}, "forces": [{"type": "field", **field}]})

        well = {"x": "-x", "y": "-2*y", "potential": "x^2/2 + y^2"}
        self.assertLess(abs(json.loads(self.succeeds("run", with_field(well), "--json").stdout)["energy"]["residual"]), 1e-9)
        refused = "the integrator 'nystrom' needs forces that depend on places and time alone: "
        for field, why in ({**well, "y": "-2*y + 0*vx"}, "ForceField 1 depends on velocity"), ({"x": "-x"}, "the work of ForceField 1, which has no potential, does not"):
            self.fails(2, refused + why, "run", with_field(field))

    # After ten thousand steps the run had gone wrong; were its masses too large? And the table had "unaccounted -nan".
    def test_charges_at_one_place_were_no_mistake_before_the_end(self):
        nucleus, electron = {"name": "nucleus", "kind": "fixed", "charge": 1}, {"charge": -1, "velocity": [0, 3]}
        force = {"type": "attraction", "couples": "charge"}
        scene = {"carom": 1, "world": {"solver": "none"}, "bodies": [{"name": "other"}, nucleus, electron], "forces": [force]}
        said = ("scene.json: at the start 'nucleus' and body 2 are both at (0, 0) m, where an attraction between them has no finite energy: "
                "put them apart, or give the attraction a softening")
        for command in "run", "validate", "plot":
            self.fails(2, said, command, self.write(scene))
        for bodies, more in (([nucleus, electron], {"softening": 0.1}), ([nucleus, {**electron, "position": [1, 0]}], {}),
                             ([nucleus, {"name": "other"}], {})):
            self.succeeds("run", self.write({**scene, "bodies": bodies, "forces": [{**force, **more}], "run": {"duration": 0.1, "step": 0.001}}))

    def test_a_quantity_that_is_no_number_came_out_never(self):
        ran = self.carom("run", self.write({**FALL, "expects": [{"quantity": "0/0", "value": 1}]}))
        self.assertIn(" no number ", ran.stdout)


if __name__ == "__main__":
    carom.main()
