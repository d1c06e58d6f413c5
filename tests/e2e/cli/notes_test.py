"""What a person had better know of a run, most likely a mistake: `carom run` says it on standard error."""

import json

import carom
from carom import FALL


class Notes(carom.Case):
    """What is most likely a mistake, and no error, is said on standard error."""

    def note(self, scene):
        return self.carom("run", self.write(scene)).stderr

    def test_a_joint_without_its_place_moved_its_body_without_a_word(self):
        rod = {"name": "rod", "position": [1, 0], "shapes": [{"type": "box", "width": 2, "height": 0.1}]}
        scene = {**FALL, "bodies": [rod], "joints": [{"name": "pin", "type": "revolute", "b": "rod"}]}
        self.assertIn("carom: note: at the start joint 'pin' gapes by 1 m. ", self.note(scene))
        self.assertIn("note: at the start joint 'pin' gapes by 1 m. ", self.carom("validate", "scene.json").stdout)
        scene["joints"] = [{"type": "revolute", "b": "rod", "at": [0, 0]}, {"type": "revolute", "b": "rod", "anchor_a": [2, 0], "anchor_b": [1, 0]}]
        self.assertEqual(self.note(scene), "")
        scene["joints"] = [{"type": "distance", "b": "rod", "length": 1.0001}]
        self.assertEqual(self.note(scene), "")
        scene["joints"] = [{"type": "distance", "b": "rod", "length": 3}]
        self.assertIn("joint 0 gapes by 2 m", self.note(scene))
        # Of a point where the joint is any rounding was more than its size.
        self.assertEqual(self.note({**FALL, "bodies": [{"name": "p", "position": [0, 8e-18]}], "joints": [{"type": "revolute", "b": "p"}]}), "")

    # World::overlaps found them, and the notes were of other solvers alone.
    def test_bodies_in_steps_that_overlap_beside_a_gas_were_no_note(self):
        boxes = [{"name": name, "position": [x, 0.3], "shapes": [{"type": "box"}], "restitution": 0} for name, x in (("left", 3), ("right", 3.7))]
        gas = {"name": "disc", "position": [1, 2], "velocity": [1, 0], "radius": 0.1}
        scene = {**FALL, "world": {"solver": "events"}, "bodies": [*boxes, gas], "walls": [{"type": "half-plane"}]}
        said = "note: at the start 'right' is 0.3 m inside of 'left', 'left' is 0.2 m inside of half-plane 0, 'right' is 0.2 m inside of half-plane 0. "
        self.assertIn("carom: " + said, self.note(scene))
        self.assertIn(said, self.carom("validate", "scene.json").stdout)
        for apart in boxes:
            apart["position"][1] = 0.5
        boxes[1]["position"][0] = 5
        self.assertEqual(self.note(scene), "")
        # A disc of the gas is moved before it starts.
        scene.update(world={"solver": {"method": "events", "relax": True}}, bodies=[*boxes, {**gas, "position": [1, 0.05]}])
        self.assertEqual(self.note(scene), "")

    # The default restitution is 1, and a box on the floor chatters for ever.
    def test_shapes_that_lose_nothing_were_no_note(self):
        box = {"name": "crate", "position": [0, 1], "shapes": [{"type": "box", "width": 1, "height": 1}]}
        scene = {**FALL, "world": {"gravity": [0, -10], "solver": "softstep"}, "walls": [{"type": "half-plane"}], "bodies": [box]}
        said = "note: no body and no wall has a restitution, which is then 1: 'crate' bounces"
        self.assertIn("carom: " + said, self.note(scene))
        self.assertIn(said, self.carom("validate", "scene.json").stdout)
        for other in ({"bodies": [{**box, "restitution": 1}]}, {"world": {"solver": "softstep"}}, {"walls": []},
                      {"bodies": [{"name": "disc", "position": [0, 1], "radius": 0.5}]},
                      {"walls": [{"type": "half-plane", "side": {"restitution": 0.5}}]}):
            self.assertNotIn("no body and no wall", self.note({**scene, **other}))
        # It falls past a wall, and what --set says counts.
        beside = {"walls": [{"type": "half-plane", "point": [-5, 0], "normal": [1, 0]}]}
        self.assertNotIn("no body and no wall", self.note({**scene, **beside}))
        slope = {"walls": [{"type": "half-plane", "point": [0, -1], "normal": [0.6, 0.8]}]}
        self.assertIn("no body and no wall", self.note({**scene, **slope}))
        self.write(scene)
        for field in "bodies[0].restitution", "walls[0].side.restitution":
            ran = self.carom("run", "scene.json", "--set", field + "=0.5")
            self.assertEqual((ran.returncode, ran.stderr.count("no body and no wall")), (0, 0), ran.stderr)

    def test_velocities_that_a_joint_does_not_allow_were_stopped_without_a_word(self):
        bar = {"name": "bar", "position": [1, 0], "velocity": [0, 1], "shapes": [{"type": "box", "width": 2, "height": 0.1}]}
        scene = {**FALL, "world": {}, "bodies": [bar], "joints": [{"name": "pin", "type": "revolute", "b": "bar", "at": [0, 0]}]}
        said = "at the start the velocities break joint 'pin' by 1 m/s. "
        self.assertIn("carom: note: " + said, self.note(scene))
        self.assertIn("note: " + said, self.carom("validate", "scene.json").stdout)
        bar["angular_velocity"] = 1
        self.assertEqual(self.note(scene), "")
        scene["joints"] = [{"type": "weld", "b": "bar", "at": [1, 0]}]
        self.assertIn("break joint 0 by 1 m/s and 1 rad/s. ", self.note(scene))
        # What gives way allows any velocity.
        scene["joints"] = [{"type": "handle", "b": "bar", "at": [1, 0]}, {"type": "friction", "b": "bar", "at": [1, 0]},
                           {"type": "wheel", "axis": [0, 1], "b": "bar", "at": [1, 0], "motor": {"speed": 3}, "spring": {"stiffness": 1}},
                           {"type": "distance", "b": "bar", "anchor_a": [1, 1], "limits": {"upper": 1}}]
        self.assertEqual(self.note(scene), "")
        # A crank that is driven turns from the start.
        scene["bodies"] = [{"name": "crank", "kind": "driven", "radius": 1}, {"name": "pen", "position": [1, 0], "velocity": [0, 2], "angular_velocity": 2}]
        scene["forces"] = [{"type": "drive", "body": "crank", "angle": "2*t"}]
        scene["joints"] = [{"type": "revolute", "a": "crank", "b": "pen", "at": [1, 0]}]
        self.assertEqual(self.note(scene), "")

    def test_a_disc_at_rest_on_a_disc_heated_without_end_and_without_a_word(self):
        discs = [{"position": [0, y], "radius": 0.1, "restitution": 0.5} for y in (0.1, 0.3)]
        pile = {"carom": 1, "world": {"gravity": [0, -9.81]}, "bodies": discs, "run": {"duration": 1, "step": "1/60"},
                "walls": [{"type": "half-plane", "side": {"restitution": 0.5}}]}
        self.assertIn("--solver softstep carries them", self.note(pile))
        pile["world"]["solver"] = {"method": "softstep"}
        self.assertEqual(self.note(pile), "")
        pile["world"]["solver"] = {"method": "impulse"}
        pile["bodies"] = discs[:1]
        self.assertEqual(self.note(pile), "")

    def test_a_heap_that_had_moved_much_before_it_lay_heated_without_a_word(self):
        heap = {"carom": 1, "world": {"gravity": [0, -9.81]}, "walls": [{"type": "rectangle", "low": [0, 0], "high": [1, 2]}],
                "builders": [{"type": "fill", "low": [0, 0], "high": [1, 2], "count": 30, "smallest_radius": 0.05, "largest_radius": 0.08,
                              "body": {"name": "d", "restitution": 0.2, "friction": 0.3}}], "run": {"duration": 4, "step": 0.005}}
        self.assertIn("--solver softstep carries them", self.note(heap))
        heap["world"] = {}  # nothing lies
        self.assertEqual(self.note(heap), "")

    def test_a_step_that_is_too_long_lost_half_of_the_energy_without_a_word(self):
        spring = {"carom": 1, "bodies": [{"name": "w", "kind": "fixed"}, {"name": "b", "position": [1, 0]}],
                  "forces": [{"type": "spring", "a": "w", "b": "b", "stiffness": 1e4}], "run": {"duration": 2, "step": 0.01}}
        for step, noted in ((0.1, True), (0.015, True), (0.01, True), (0.002, False)):
            spring["run"]["step"] = step
            self.assertEqual("made or lost up to" in self.note(spring), noted, step)
        pair = {"carom": 1, "bodies": [{"position": [-1, 0], "radius": 0}, {"position": [1, 0]}],
                "forces": [{"type": "attraction", "strength": 1}], "run": {"duration": 3, "step": 0.01}}
        self.assertIn("made or lost up to", self.note(pair))
        self.assertEqual(self.note(FALL), "")
        rests = {**FALL, "bodies": [{"name": "a", "position": [3, 0]}], "joints": [{"type": "distance", "b": "a", "anchor_a": [3, 1]}]}
        self.assertEqual(self.note(rests), "")

    def test_of_what_contacts_or_joints_make_the_note_advised_another_integrator(self):
        box = {"name": "box", "kind": "fixed", "shapes": [{"type": "box", "width": 2, "height": 1}]}
        inside = {**FALL, "world": {"gravity": [0, -9.81], "solver": "softstep"}, "run": {"duration": 20, "step": 0.01},
                  "bodies": [box, {"position": [0.5, 0.3], "radius": 0.2, "restitution": 0}]}
        bar = {"name": "bar", "position": [1, 0], "velocity": [0, 1], "shapes": [{"type": "box", "width": 2, "height": 0.1}]}
        hinge = {**FALL, "world": {}, "bodies": [bar], "joints": [{"type": "revolute", "b": "bar", "at": [0, 0]}]}
        for scene in inside, hinge:
            note = self.note(scene).splitlines()[-1]
            self.assertIn("made or lost up to", note)
            self.assertIn("A shorter step (--step) keeps it; another integrator does not, where joints or contacts made it; ", note)
            self.assertIn("carom check finds out", note)

    def test_a_wrong_potential_was_told_to_take_a_shorter_step(self):
        field = {"type": "field", "body": "a", "name": "trap", "x": "-2*x", "potential": "x^2/2"}
        scene = {"carom": 1, "bodies": [{"name": "a", "position": [1, 0]}], "forces": [field], "run": {"duration": 1, "step": 0.01}}
        note = self.note(scene)
        self.assertIn("the potential of a force field 'trap' says (", note)
        self.assertNotIn("shorter step", note)
        field["potential"] = "x^2"
        self.assertEqual(self.note(scene), "")

    def test_a_nail_inside_its_block_was_said_to_be_pushed_apart(self):
        scene = {**FALL, "bodies": [{"name": "nail", "kind": "fixed"}, {"name": "block", "shapes": [{"type": "box", "width": 0.4, "height": 0.2}]}],
                 "forces": [{"type": "spring", "a": "nail", "b": "block", "stiffness": 1000}], "run": {"duration": 1, "step": 0.001},
                 "world": {"gravity": [0, -10], "solver": "softstep"},
                 "expects": [{"quantity": "block.y", "statistic": "minimum", "value": -0.02, "tolerance": 1e-6}]}
        ran = self.carom("run", self.write(scene))
        self.assertIn("at the start 'nail' is 0.1 m inside of 'block'. A point is not pushed out of a shape, and stops", ran.stderr)
        self.assertEqual((ran.returncode, "pushed apart" in ran.stderr), (1, False))  # the block does not fall
        scene["joints"] = [{"type": "filter", "a": "nail", "b": "block"}]
        ran = self.carom("run", self.write(scene))
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))

    def test_notes_were_dropped_where_several_scenes_are_run(self):
        spring = {"carom": 1, "bodies": [{"name": "w", "kind": "fixed"}, {"name": "b", "position": [1, 0]}],
                  "forces": [{"type": "spring", "a": "w", "b": "b", "stiffness": 1e4}], "run": {"duration": 2, "step": 0.015}}
        rod = {**FALL, "bodies": [{"name": "a", "position": [1, 0]}], "joints": [{"name": "rod", "type": "distance", "b": "a", "length": 2}]}
        said = self.carom("run", self.write(spring, "spring.json"), self.write(rod, "rod.json"), self.write(FALL, "fall.json")).stderr.splitlines()
        self.assertEqual(len(said), 2, said)
        self.assertRegex(said[0], r"^carom: note: spring\.json: in steps of .* made or lost up to")
        self.assertRegex(said[1], r"^carom: note: rod\.json: at the start joint 'rod' gapes by 1 m")
        alone = self.carom("run", "spring.json", "--json")
        notes = json.loads(alone.stdout)["notes"]
        self.assertEqual(alone.stderr, "".join(f"carom: note: {note}\n" for note in notes))
        self.assertEqual(len(notes), 1)
        self.assertEqual(json.loads(self.carom("run", "fall.json", "--json").stdout)["notes"], [])

    def test_a_torque_on_a_point_turned_nothing_without_a_word(self):
        point, wheel = {"name": "wheel", "position": [0, 5]}, {"name": "wheel", "position": [0, 5], "radius": 0.5}
        said = "carom: note: 'wheel' is a point, which no torque turns: it needs a radius, shapes or a moment_of_inertia\n"
        for force in ({"type": "constant", "body": "wheel", "torque": 3}, {"type": "constant", "body": "wheel", "force": [1, 0], "point": [0, 1]},
                      {"type": "torsion-spring", "a": "frame", "b": "wheel"}):
            for body, note in ((point, said), (wheel, ""), ({**wheel, "fixed_rotation": True}, "")):
                scene = {**FALL, "bodies": [{"name": "frame", "kind": "fixed"}, body], "forces": [force]}
                self.assertEqual(self.carom("run", self.write(scene)).stderr, note)

    def test_a_point_fell_through_a_chain_without_a_word(self):
        floor = {"name": "floor", "kind": "fixed", "shapes": [{"type": "chain", "points": [[-3, 0], [3, 0]]}]}
        spring = {"type": "spring", "a": "floor", "b": "ball", "stiffness": 10, "rest_length": 2}
        said = "carom: note: 'ball' is a point, which passes through segments and chains: to be stopped by them it needs a radius\n"
        for more, forces, note in (({}, [], said), ({"radius": 0.1}, [], ""), ({}, [spring], "")):
            scene = {"carom": 1, "bodies": [floor, {"name": "ball", "position": [0, 2], **more}], "forces": forces,
                     "run": {"duration": 0.1, "step": 0.01}}
            self.assertEqual(self.carom("run", self.write(scene)).stderr, note)

    def test_the_angle_of_a_point_stayed_0_without_a_word(self):
        bob = {"name": "my bob", "position": [0.6, 4.2]}
        scene = {**FALL, "bodies": [bob], "joints": [{"type": "distance", "b": "my bob", "anchor_a": [0, 5]}]}
        said = ("carom: note: 'my bob'.angle never changes: 'my bob' is a point, and does not turn. The direction in which it lies is "
                "that of its place, as atan2('my bob'.x, -'my bob'.y) of a pendulum that hangs at (0, 0)\n")
        looks = ({"pictures": [{"type": "time", "quantities": ["2*'my bob'.angle"]}]},
                 {"twins": [{"quantity": "'my bob'.angle", "formula": "0"}]},
                 {"expects": [{"quantity": "'my bob'.angle", "value": 0, "tolerance": 1}]})
        for more in looks:
            self.assertEqual(self.note({**scene, **more}), said)
        for option in "--csv", "--sweep":
            scene["parameters"] = {"a": 1}
            value = {"--csv": "t.csv", "--sweep": "a=1"}[option]
            self.assertIn("never changes", self.carom("run", self.write(scene), option, value, "--quantity", "'my bob'.angle").stderr)
        for turns in ({"radius": 0.1}, {"moment_of_inertia": 1}, {"angular_velocity": 1}, {"shapes": [{"type": "box", "width": 1, "height": 1}]}):
            scene["bodies"] = [{**bob, **turns}]
            self.assertEqual(self.note({**scene, **looks[0]}), "")

    def test_a_body_fell_through_a_chain_from_behind_without_a_word(self):
        ground = {"name": "ground", "kind": "fixed", "shapes": [{"type": "chain", "points": [[3, 0], [0, -0.5], [-3, 0]]}]}
        ball, floor = {"name": "ball", "position": [1, 2], "radius": 0.1}, {"kind": "fixed", "shapes": [{"type": "box", "width": 9, "height": 0.1}]}
        scene = {"carom": 1, "world": {"gravity": [0, -9.81]}, "bodies": [ground, ball], "run": {"duration": 0.1, "step": 0.01}}
        said = ("carom: note: 'ball' is behind a chain of 'ground', which is solid from the left of its points alone, and falls through it: "
                "turn the order of its points round\n")
        self.assertEqual(self.note(scene), said)
        self.assertEqual(self.note({**scene, "bodies": [ground, {**ball, "shapes": [{"type": "box", "width": 1, "height": 1}], "radius": 0}]}), said)
        turned = {**ground, "shapes": [{"type": "chain", "points": [[-3, 0], [0, -0.5], [3, 0]]}]}
        other = {**ball, "radius": 0, "shapes": [{"type": "disc", "radius": 0.1, "filter": {"mask": 2}}]}
        for bodies in ([turned, ball], [ground, {**ball, "position": [1, -1]}], [ground, {**ball, "position": [4, 2]}],
                       [ground, ball, {**floor, "position": [0, 1]}], [ground, other], [ground, {**ball, "kind": "fixed"}]):
            self.assertEqual(self.note({**scene, "bodies": bodies}), "")
        for more in ({"joints": [{"type": "revolute", "b": "ball", "at": [1, 2.5]}]}, {"world": {}},
                     {"forces": [{"type": "spring", "a": "ground", "b": "ball", "stiffness": 100, "rest_length": 2.236}]},
                     {"forces": [{"type": "field", "y": "9.81"}]}):
            self.assertEqual(self.note({**scene, **more}), "")

    def test_a_motor_without_a_maximum_drove_its_body_through_a_wall_without_a_word(self):
        wall = {"walls": [{"type": "half-plane", "point": [3, 0], "normal": [-1, 0]}]}
        block = {"bodies": [{"name": "b", "radius": 0.2}, {"name": "block", "kind": "fixed", "position": [5, 0], "shapes": [{"type": "box", "width": 4, "height": 1}]}]}
        tail = ". The motor of joint 'slide' has no maximum, and drives what it moves through whatever is in the way: give it one\n"
        for there, said in ((wall, "'b' is 2.2 m inside of half-plane 0"), (block, "'b' is 0.699 m inside of 'block'")):
            scene = {"carom": 1, "bodies": [{"name": "b", "radius": 0.2}], "run": {"duration": 2.5, "step": 0.01}, **there,
                     "joints": [{"name": "slide", "type": "prismatic", "b": "b", "motor": {"speed": 2}}]}
            self.assertIn("carom: note: at the end " + said + tail, self.note(scene))
            pushed = {**scene, "bodies": [*scene["bodies"], {"name": "hand", "radius": 0.1, "position": [-1, 0]}],
                      "joints": [{"type": "filter", "a": "hand", "b": "b"}, {"type": "distance", "a": "hand", "b": "b"},
                                 {"name": "slide", "type": "motor", "b": "hand", "velocity": [2, 0]}]}
            self.assertIn("The motor of joint 'slide' has no maximum", self.note(pushed))  # by way of a rod
            scene["joints"][0]["motor"]["maximum"] = 5
            self.assertNotIn("has no maximum", self.note(scene))
            scene["joints"] = [{"type": "prismatic", "b": "b", "motor": {"speed": 2}, "limits": {"upper": 1}}]
            self.assertNotIn("has no maximum", self.note(scene))

    def test_a_turning_point_on_a_joint_was_an_engine_without_a_word(self):
        point = {"name": "cam", "angular_velocity": 2}
        scene = {"carom": 1, "bodies": [point], "run": {"duration": 1, "step": 0.01},
                 "joints": [{"type": "wheel", "b": "cam", "at": [1, 2], "spring": {"stiffness": 1}}]}
        said = "carom: note: 'cam' is a point that turns at 2 rad/s, 2.24 m beside joint 0. Nothing slows down what has no moment of inertia: "
        self.assertIn(said, self.note(scene))
        for body, at in (({**point, "moment_of_inertia": 1}, [1, 2]), ({"name": "cam"}, [1, 2]), (point, [0, 0])):
            self.assertNotIn("slows down", self.note({**scene, "bodies": [body], "joints": [{**scene["joints"][0], "at": at}]}))

    def test_options_that_change_nothing_were_taken_without_a_word(self):
        self.fails(2, "--format requires --out", "run", self.write(FALL), "--format", "pdf")
        self.fails(2, "--format requires --out", "check", "scene.json", "--format", "pdf")
        self.assertIn("run.measure_from is of the measures of a gas", self.carom("run", "scene.json", "--measure-from", "0.5").stderr)
        late = self.write({**FALL, "run": {**FALL["run"], "measure_from": 0.5}})
        self.assertIn("note: run.measure_from is of the measures of a gas", self.carom("validate", late).stdout)

    # The first point of each picture of a force was 0, and so was the least.
    def test_a_joint_bears_what_it_bears_from_the_start(self):
        scene = {"carom": 1, "parameters": {"g": 9.81, "a": 2}, "world": {"gravity": [0, "-g"]},
                 "bodies": [{"name": "bob", "position": ["sin(a)", "-cos(a)"], "mass": 3}],
                 "joints": [{"name": "rod", "type": "distance", "b": "bob"}], "run": {"duration": 1, "step": 0.01},
                 "expects": [{"quantity": "rod.force", "at": 0, "value": "abs(3*g*cos(a))", "tolerance": 1e-4},
                             {"quantity": "rod.force.y", "at": 0, "value": "3*g*cos(a)^2", "tolerance": 1e-4},
                             {"quantity": "rod.coordinate", "at": 0, "value": 1, "tolerance": 1e-12},
                             {"quantity": "rod.torque", "at": 0, "value": 0, "tolerance": 1e-9},
                             {"quantity": "rod.gap", "statistic": "maximum", "value": 0, "tolerance": 1e-9}]}
        self.succeeds("run", self.write(scene))
        scene["joints"][0]["length"] = 1.25
        scene["expects"] = [{"quantity": "rod.gap", "at": 0, "value": 0.25, "tolerance": 1e-12}]
        self.assertEqual(self.carom("run", self.write(scene)).returncode, 0)

    def test_pictures_of_what_there_is_not_were_taken_where_none_was_asked_for(self):
        scene = {**FALL, "pictures": [{"type": "trajectories", "bodies": ["bal"]}]}
        self.fails(2, "pictures[0] is wrong: there is no body 'bal'", "run", self.write(scene))


if __name__ == "__main__":
    carom.main()
