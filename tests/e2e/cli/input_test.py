"""Wrong input: one line that names the file, the place, the value and what is allowed; exit status 2."""

import copy

import carom
from carom import FALL


class WrongScene(carom.Case):
    def wrong(self, text, **parts):
        """A scene with these parts beside (or in place of) those of FALL is wrong."""
        scene = {**copy.deepcopy(FALL), **parts}
        self.fails(2, text, "run", self.write(scene))

    def wrong_text(self, text, document):
        self.fails(2, text, "run", self.write(document))

    def test_a_field_of_the_wrong_type(self):
        self.wrong('scene.json: bodies[0].mass must be a number > 0 in kg, got true', bodies=[{"mass": True}])
        self.wrong('scene.json: bodies[0].position must be [x, y] in m, got 3', bodies=[{"position": 3}])
        self.wrong('scene.json: bodies must be a list, got {}', bodies={})
        self.wrong('scene.json: world must be an object, got []', world=[])

    # Of one letter any other was as near.
    def test_a_field_of_one_letter_was_taken_for_another(self):
        spring = {"type": "spring", "a": "ball", "b": "ball", "k": 3}
        self.wrong("""forces[0] has no field "k"; known are """, forces=[spring])

    def test_a_decimal_comma(self):
        self.wrong("""got "2,5": a number has a point and no comma at character 2""", bodies=[{"mass": "2,5"}])
        self.fails(2, "--step 0,01: ", "run", self.write(FALL), "--step", "0,01")
        self.wrong_text("scene.json:1:35: a number has a point and no comma", '{"carom": 1, "bodies": [{"mass": 2,5}]}')

    def test_the_numbers_of_a_run_that_failed_are_no_table_of_nan(self):
        blow = {"type": "field", "name": "blow", "x": "exp(x^2)"}
        ran = self.carom("run", self.write({**FALL, "bodies": [{"position": [1, 0]}], "forces": [blow], "run": {"duration": 9}}))
        self.assertEqual(ran.returncode, 1)
        self.assertNotIn("nan", ran.stdout)

    def test_an_unknown_field_has_the_nearest_name(self):
        self.wrong("""bodies[0] has no field "mas"; did you mean 'mass'?""", bodies=[{"mas": 1}])
        self.wrong("""has no field "bodys"; did you mean 'bodies'?""", bodys=[])
        self.wrong("""world has no field "gravty"; did you mean 'gravity'?""", world={"gravty": 3})

    def test_errors_of_the_engine_named_its_own_structs(self):
        self.wrong("scene.json: builders[0].radius must be at most half the spacing", builders=[{"type": "lattice", "radius": 5}])
        self.wrong("scene.json: bodies[1].velocity must be 0 for a fixed body",
                   bodies=[{"name": "a"}, {"kind": "fixed", "velocity": [1, 0]}])
        self.wrong("scene.json: bodies[0].shapes[0]", bodies=[{"shapes": [{"geometry": {"type": "polygon", "points": [[0, 0]]}}]}])

    def test_a_disc_inside_a_net_made_energy_and_an_endless_step(self):
        net = {"type": "lattice", "nx": 20, "ny": 20, "corner": [0, 1], "spacing": 0.2, "radius": 0.08, "mass": 0.1, "stiffness": 5000}
        ball = {"name": "ball", "position": [2.05, 3.02], "radius": 0.5}
        self.wrong("scene.json: bodies[0].position must not be inside of discs that springs hold, as one at (",
                   builders=[net], bodies=[ball])
        rope = {"type": "rope", "anchor_b": [2, 0], "segments": 40, "radius": 0.02, "stiffness": 5000}
        self.wrong("scene.json: bodies[0].position must not be inside of discs", builders=[rope],
                   bodies=[{**ball, "position": [1, 0.02], "radius": 0.2}])

    def test_a_body_outside_of_its_walls_was_taken(self):
        walls = [{"type": "rectangle", "low": [0, 0], "high": [4, 4]}]
        body = {"position": [5, 2], "radius": 0.1}
        self.wrong("scene.json: bodies[1].position must not be outside of the walls from (0, 0) to (4, 4) m, got [5, 2]",
                   walls=walls, bodies=[{"position": [1, 1]}, body])
        self.wrong("scene.json: builders make a body outside of the walls from (0, 0) to (4, 4) m, at (5, 2) m",
                   walls=walls, bodies=[], builders=[{"type": "grid", "body": {"position": [3, 2]}, "nx": 2, "ny": 1, "spacing": [2, 1]}])
        for fine, note in (({**body, "kind": "fixed"}, ""), ({**body, "position": [4, 2]}, "body 0 is 0.1 m inside of the right wall")):
            ran = self.carom("run", self.write({**FALL, "walls": walls, "bodies": [fine]}))
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.assertIn(note, ran.stderr)
            self.assertEqual(bool(note), ran.stderr.startswith("carom: note: "), ran.stderr)

    def test_unknown_names_of_types_methods_and_choices(self):
        self.wrong("forces[0].type must be one of spring, torsion-spring,", forces=[{"type": "sprng"}])
        self.wrong("""world.integrator must be one of euler, symplectic-euler,""", world={"integrator": "rk5"})
        self.wrong("world.integrator.method must be one of", world={"integrator": {"method": "rk5"}})
        self.wrong("bodies[0].kind must be one of dynamic, fixed, driven", bodies=[{"kind": "fixd"}])

    def test_numbers_that_are_not_finite(self):
        self.wrong_text("scene.json:1:34: numbers are finite here, and NaN is none", '{"carom": 1, "bodies": [{"mass": NaN}]}')
        self.wrong_text("and Infinity is none", '{"carom": 1, "bodies": [{"mass": Infinity}]}')
        self.wrong_text("scene.json:1:38: the number is too large: '1e999'", '{"carom": 1, "bodies": [{"mass": 1e999}]}')

    def test_expressions(self):
        self.wrong("bodies[0].mass must be a number > 0 in kg, got \"1/0\": it is inf", bodies=[{"mass": "1/0"}])
        self.wrong("got \"sqrt(-1)\": it is no number", bodies=[{"mass": "sqrt(-1)"}])  # it was -nan
        self.wrong("there is no 'q' here", bodies=[{"mass": "q"}])
        self.wrong("expected a number, a name or ( at character 3, got *2", bodies=[{"mass": "1+*2"}])
        self.wrong("forces[0].x must be an expression of x, y, vx, vy, m, t", forces=[{"type": "field", "x": "q"}])

    # Nine bodies were expected, and found, in a world of one.
    def test_a_parameter_took_the_place_of_a_quantity_of_the_world(self):
        for name in "bodies", "steps", "collisions", "angular_momentum", "t":
            self.wrong(f'parameters has the name "{name}", which means something else in an expression',
                       parameters={name: 9}, expects=[{"quantity": name, "value": 9}])

    def test_an_abbreviation_is_nearer_than_a_slip(self):
        self.wrong("""got "max"; did you mean 'maximum'?""", expects=[{"quantity": "t", "statistic": "max"}])
        self.wrong("""got "min"; did you mean 'minimum'?""", expects=[{"quantity": "t", "statistic": "min"}])

    def test_a_number_with_its_unit(self):
        for text in "2 kg", "2kg", "1.5 m/s", "-3e2 N":
            self.wrong("numbers are in SI units, which are not written", bodies=[{"mass": text}])
        for text in "30 deg", "30°", "30 degrees":
            self.wrong("angles are in rad, and so many degrees are 30*deg", bodies=[{"angle": text}])
        for text in "2 q", "kg", "2*":
            self.assertNotIn("SI units", self.carom("run", self.write({**FALL, "bodies": [{"mass": text}]})).stderr)

    def test_a_name_that_needs_quotes(self):
        bodies = [{"name": "a-b", "position": [0, 5]}, {"name": "my ball"}, {"name": "a"}]
        for text, name in ("a-b.x", "a-b"), ("2*a-b.vx + t", "a-b"), ("my ball.x", "my ball"):
            self.wrong(f"; the body '{name}' is written in quotes in an expression: '{name}'.", bodies=bodies,
                       expects=[{"quantity": text, "value": 0}])
        self.succeeds("run", self.write({**FALL, "bodies": bodies, "expects": [{"quantity": "'a-b'.x + 'my ball'.x", "value": 0}]}))

    def test_values_out_of_range(self):
        self.wrong("bodies[0].mass must be a number > 0 in kg, got -1", bodies=[{"mass": -1}])
        self.wrong("bodies[0].restitution must be a number from 0 to 1, got 2", bodies=[{"restitution": 2}])
        self.wrong("run.step must be a number > 0 in s, got 0", run={"step": 0})

    def test_what_makes_no_sense_together(self):
        self.wrong("builders[0].anchor_b must be away from the other end", builders=[{"type": "rope"}])
        self.wrong("bodies[1].name must be unique", bodies=[{"name": "a"}, {"name": "a"}])
        self.wrong("""forces[0].b must be the name of a body, got "bal": there is no body 'bal'; did you mean 'ball'?""",
                   forces=[{"type": "spring", "a": "ball", "b": "bal"}])
        self.wrong('forces[0] must have the field "b": body at the other end', forces=[{"type": "spring", "a": "ball"}])
        self.wrong("""expects[0].quantity is wrong: in "bal.x": there is no body 'bal'; did you mean 'ball'?""",
                   expects=[{"quantity": "bal.x", "value": 0}])

    def test_huge_numbers_of_anything(self):
        self.wrong("run.duration must be at most 1e+15 steps of 1e-09 s, got 1e+300 s", run={"duration": 1e300, "step": 1e-9})
        self.wrong("builders[0].nx must be a whole number from 1 to 10000000", builders=[{"type": "grid", "nx": 1e9, "body": {}}])
        self.wrong("needs about 9e+07 GB for 100000000000000 bodies",
                   builders=[{"type": "grid", "nx": 10000000, "ny": 10000000, "body": {}}])
        fill = {"type": "fill", "high": [1e60, 1e60], "fraction": 0.3, "smallest_radius": 0.1, "largest_radius": 0.1}
        self.assertRegex(self.carom("run", self.write({**FALL, "builders": [fill]})).stderr, r"GB for 9\.5\d+e\+120 bodies, and")

    def test_json_that_is_none(self):
        self.wrong_text("scene.json:2:15: the text ends here, and a ] is missing",
                        '{"carom": 1,\n "bodies": [{}')
        self.wrong_text("scene.json:2:14: a comma is missing after ]", '{"carom": 1,\n "bodies": []\n x}')
        self.wrong_text("scene.json: is empty, and must be a scene", "")
        self.wrong_text("scene.json: is not a text", bytes(range(256)))
        self.wrong_text("scene.json:1:", bytes(range(128, 256)))
        self.wrong_text("scene.json: objects and lists must be nested at most 64 deep", "[" * 100_000)
        self.wrong_text("""scene.json: bodies[0] has the key "mass" twice""", '{"carom": 1, "bodies": [{"mass": 1, "mass": 2}]}')
        self.wrong_text("scene.json: must be an object, got 3", "3")

    def test_files_that_are_none(self):
        self.fails(2, "nothing.json: cannot be read: No such file or directory", "run", "nothing.json")
        self.fails(2, ".: is a folder, and must be a scene file", "run", ".")
        self.fails(2, "is not a text", "run", "/dev/zero")
        self.fails(2, "is empty", "run", "/dev/null")
        self.fails(2, "carom: -: is empty, and must be a scene", "run", "-")

    def test_all_doors_say_the_same(self):
        file = self.write({**FALL, "bodies": [{"mass": -1}]})
        for command in (["run"], ["run", "--json"], ["plot"], ["render"], ["validate"]):
            self.fails(2, "scene.json: bodies[0].mass must be a number > 0 in kg, got -1", command[0], file, *command[1:])
        self.assertEqual(self.files(), ["scene.json"])

    def test_pictures_are_checked_before_the_run(self):
        file = self.write({**FALL, "pictures": [{"type": "time", "quantities": ["bal.x"]}]})
        for command in ("plot", "validate"):
            self.fails(2, "scene.json: pictures[0] is wrong: in \"bal.x\": there is no body 'bal'", command, file)
        self.fails(2, "scene.json: pictures[0] is wrong", "run", file, "--out", "out")
        self.assertEqual(self.files(), ["scene.json"])


class OffCurves(carom.Case):
    def test_a_body_that_was_put_off_its_curve_jumped_there_without_a_word(self):
        def said(body, curve):
            scene = {**FALL, "parameters": {"a": 0.1}, "bodies": [*FALL["bodies"], {"name": "piston", "kind": "driven", **body}],
                     "forces": [{"type": "drive", "body": "piston", **curve}]}
            ran = self.carom("run", self.write(scene))
            self.assertEqual(ran.returncode, 0, ran.stderr)
            return ran.stderr

        waves = {"x": "a*cos(t)"}
        self.assertEqual(said({"position": [3, 0]}, waves),
                         "carom: note: 'piston' is put at (3, 0) m, and the curve that drives it begins at (0.1, 0) m. A curve says where the "
                         "body is from the start on: leave the place away, or let the curve begin there\n")
        self.assertIn("note: 'piston' is put at (3, 0) m", self.carom("validate", "scene.json").stdout)
        self.assertIn("at an angle of 1 rad, and the curve that drives it begins at 0.5 rad", said({"angle": 1}, {"angle": "0.5 + t"}))
        for body, curve in (({}, waves), ({"position": [0.1, 0]}, waves), ({"position": ["a", 7]}, waves), ({"position": [0.10001, 0]}, waves),
                            ({"angle": 1}, waves), ({"position": [0, 3]}, {"angle": "t"})):
            self.assertEqual(said(body, curve), "")


class Idle(carom.Case):
    def test_a_force_that_does_nothing_did_so_without_a_word(self):
        nail, ball = {"name": "nail", "kind": "fixed"}, {"name": "ball", "position": [0, 5]}
        charges, off = {"type": "attraction", "couples": "charge"}, "does nothing, for it is fixed"
        for force, said in (({"type": "drag", "wind": [1, 0]}, "a drag does nothing without a coefficient: linear, quadratic or angular"),
                            ({"type": "drag", "body": "nail", "linear": 1}, f"a drag on 'nail' {off}"),
                            ({"type": "constant", "body": "ball"}, "a constant force does nothing without a force or a torque"),
                            ({"type": "constant", "body": "nail", "force": [1, 0]}, f"a constant force on 'nail' {off}"),
                            ({"type": "field", "body": "nail", "x": "1"}, f"a field on 'nail' {off}"),
                            (charges, "an attraction between charges does nothing without two bodies that have a charge")):
            scene = self.write({**FALL, "bodies": [nail, ball], "forces": [force]})
            self.assertEqual(self.carom("run", scene).stderr, f"carom: note: {said}\n")
            self.assertIn(f"note: {said}", self.carom("validate", scene).stdout)
        for kind in "spring", "torsion-spring":
            force, words = {"type": kind, "a": "nail", "b": "wall"}, kind.replace("-", " ")
            for count, said in ((1, f"carom: note: a {words} between 'nail' and 'wall' does nothing, for both are fixed\n"), (4, "")):
                scene = {**FALL, "bodies": [nail, {"name": "wall", "kind": "fixed", "position": [1, 0]}], "forces": [force] * count}
                self.assertEqual(self.carom("run", self.write(scene)).stderr, said)  # of four, it is the edge of a net
        for force in ({"type": "drag", "linear": 1}, {"type": "drag", "angular": 1}, {"type": "constant", "body": "ball", "torque": 0, "force": [0, 1]},
                      {"type": "field", "x": "1"}, charges):
            scene = {**FALL, "bodies": [{**nail, "charge": 1, "position": [50, 0]}, {**ball, "charge": 1e-9}], "forces": [force]}
            self.assertEqual(self.carom("run", self.write(scene)).stderr, "")


class WrongOptions(carom.Case):
    def setUp(self):
        super().setUp()
        self.scene = self.write({**FALL, "parameters": {"speed": 3}})

    def wrong(self, text, *options):
        self.fails(2, text, "run", self.scene, *options)

    def test_set(self):
        self.wrong("--set speed: must be NAME=VALUE", "--set", "speed")
        self.wrong("--set =3: must be NAME=VALUE", "--set", "=3")
        self.wrong("""has no parameter "sped"; did you mean 'speed'?""", "--set", "sped=3")
        self.wrong("which has no parts", "--set", "run.step.x=3")
        self.wrong("world.gravity must be [x, y] in m/s", "--set", "world.gravity=3")
        self.wrong("""the list has 1 item and no "bal"; did you mean 'ball'?""", "--set", "bodies.bal.mass=3")
        self.wrong("bodies[0].mass must be a number > 0 in kg, got -3", "--set", "bodies.ball.mass=-3")

    def test_step_and_duration(self):
        for value, reason in (("0", "got 0"), ("-1", "got -1"), ("nan", "there is no 'nan' here"), ("inf", "there is no 'inf' here"),
                              ("abc", "there is no 'abc' here"), ("1e999", "the number 1e999 is too large"), ("1/0", "it is inf")):
            self.wrong(f"--step {value}: scene.json: run.step must be a number > 0 in s", "--step", value)
            self.wrong(reason, "--step", value)
        self.wrong("--duration 1e308: scene.json: run.duration must be at most 1e+15 steps of 0.01 s, got 1e+308 s", "--duration", "1e308")
        self.wrong("--duration -1: scene.json: run.duration must be a number >= 0 in s", "--duration", "-1")

    def test_methods_and_counts(self):
        self.wrong("; did you mean 'rk4'?", "--integrator", "rk5")
        self.wrong("world.solver must be one of", "--solver", "x")
        self.wrong("world.threads must be a whole number from 1 to 1024, got 0", "--threads", "0")
        self.wrong("run.every must be a whole number >= 1", "--every", "0")
        self.wrong("seed must be a whole number from 0 to 2147483647, got -1", "--seed", "-1")

    def test_the_command_line_itself(self):
        self.wrong("(carom run --help shows what there is)", "--stp", "3")
        self.fails(2, "not expected: -p out.png (carom render --help shows what there is)", "render", self.scene, "-p", "out.png")
        self.fails(2, "SCENE is required (carom run --help shows what there is)", "run")
        self.fails(2, "there is no command 'rnu'; there are run, plot, render, check,", "rnu", self.scene)
        self.fails(2, "--format", "plot", self.scene, "--format", "bmp")
        self.fails(2, "--file x.bmp: must end with .png, .svg or .pdf for a picture", "render", self.scene, "--file", "x.bmp")
        self.fails(2, "--at is for pictures", "render", self.scene, "--file", "x.mp4", "--at", "1")
        self.assertEqual(self.files(), ["scene.json"])


class Validate(carom.Case):
    def test_one_body_was_called_1_bodies(self):
        scene = {**FALL, "expects": [{"quantity": "t", "value": 1}]}
        self.assertIn("ok, 1 body, 1 expectation\n", self.succeeds("validate", self.write(scene)).stdout)

    def test_what_the_solver_cannot_do_was_ok_until_the_first_step(self):
        box = {"name": "crate", "position": [0, 1], "shapes": [{"type": "box"}]}
        world = {"carom": 1, "world": {"solver": "impulse"}, "bodies": [box]}
        crate = self.write({**world, "walls": [{"type": "half-plane"}]}, "crate.json")
        rod = self.write({**world, "joints": [{"type": "revolute", "b": "crate", "at": [0, 2]}]}, "rod.json")
        for command in "validate", "run":
            self.fails(2, "crate.json: world is wrong: body 'crate' has shapes, and the solver 'impulse' collides discs alone",
                       command, crate)
            self.fails(2, "rod.json: world is wrong: joints need the solver 'softstep'", command, rod)
        self.succeeds("run", crate, "--solver", "softstep")

    def test_a_twin_with_unknown_names_was_ok_until_the_run(self):
        for formula, said in ("1*t+b", "there is no 'b' here"), ("foo(t)", "there is no function 'foo'"):
            scene = self.write({**FALL, "twins": [{"quantity": "ball.x", "formula": formula}]})
            for command in "validate", "run":
                self.fails(2, f'scene.json: twins[0] is wrong: in "{formula}": {said}', command, scene)

    def test_what_is_looked_at_after_the_end_was_ok(self):
        late = self.write({**FALL, "expects": [{"quantity": "t", "value": 99, "at": 99}]}, "late.json")
        drawn = self.write({**FALL, "pictures": [{"type": "snapshots", "at": [0, 99]}]}, "drawn.json")
        for command in "validate", "run", "plot":
            self.fails(2, "late.json: expects[0].at must be within the run, whose duration is 1 s, got 99 s", command, late)
            self.fails(2, "drawn.json: pictures[0].at[1] must be within the run, whose duration is 1 s, got 99 s", command, drawn)
        # A run that is made shorter leaves out what would come later, and what it writes can be run again.
        whole = self.write({**FALL, "pictures": [{"type": "snapshots", "at": [0, 1]}]}, "whole.json")
        self.succeeds("run", whole, "--duration", "0.5", "--csv", "short.csv")
        self.succeeds("run", "short.csv")

    def test_what_an_option_makes_look_after_the_end_never_came(self):
        scene = self.write({**FALL, "parameters": {"T": 9}, "expects": [{"quantity": "t", "value": 1, "at": 1}]})
        for place, got in (("expects[0].at=7", 7), ("expects[0].at=T", 9)):
            self.fails(2, f"scene.json: expects[0].at must be within the run, whose duration is 1 s, got {got} s", "run", scene, "--set", place)
        picture = 'pictures=[{"type": "snapshots", "at": [0, 5]}]'
        self.fails(2, "scene.json: pictures[0].at[1] must be within the run, whose duration is 1 s, got 5 s", "plot", scene, "--set", picture)
        # One that is made longer has times that its file had not, and one made shorter does not come to all.
        late = self.write({**FALL, "expects": [{"quantity": "t", "value": 2, "at": 2, "tolerance": 1e-9}]}, "late.json")
        self.succeeds("run", late, "--duration", "3")
        self.fails(2, "late.json: expects[0].at must be within", "run", late)
        short = self.carom("run", late, "--sweep", "run.duration=2,3")
        self.assertEqual((short.returncode, short.stderr), (0, ""))
        ran = self.carom("run", scene, "--duration", "0.5")
        self.assertEqual((ran.returncode, "not reached" in ran.stdout, "never" in ran.stdout), (1, True, False))
        self.assertIn("0.5           not reached FAIL", self.carom("run", scene, "--sweep", "run.duration=1,0.5").stdout)

    def test_walls_joints_and_forces_are_counted(self):
        scene = {**FALL, "world": {"solver": "softstep"}, "walls": [{"type": "half-plane"}, {"type": "rectangle", "low": [-9, -9], "high": [9, 9]}],
                 "bodies": [{"name": "a", "position": [0, 5]}, {"name": "b", "position": [1, 5]}],
                 "joints": [{"type": "revolute", "b": "a", "at": [0, 5]}],
                 "forces": [{"type": "spring", "a": "a", "b": "b"}, {"type": "drag", "linear": 1}, {"type": "field", "x": "1"}]}
        self.assertEqual(self.succeeds("validate", self.write(scene)).stdout,
                         "scene.json: ok, 2 bodies, 2 walls, 1 joint, 1 spring, 2 other forces, 0 expectations\n")
        scene = {**FALL, "walls": [{"type": "periodic", "low": [0, 0], "high": [9, 9]}], "forces": [{"type": "drag", "linear": 1}]}
        self.assertEqual(self.succeeds("validate", self.write(scene)).stdout,
                         "scene.json: ok, 1 body, a periodic box, 1 force, 0 expectations\n")

    def test_what_an_option_makes_of_a_scene_could_not_be_validated(self):
        scene = self.write({**FALL, "parameters": {"m": 2}, "bodies": [{"name": "ball", "mass": "m"}]})
        self.fails(2, "scene.json: bodies[0].mass must be a number > 0 in kg, got \"m\": it is -1", "validate", scene, "--set", "m=-1")
        self.succeeds("validate", scene, "--set", "m=3", "--solver", "softstep")

    def test_one_wrong_scene_does_not_hide_the_next(self):
        right = self.write(FALL, "right.json")
        ran = self.carom("validate", self.write("{}", "a.json"), right, self.write("[", "b.json"))
        self.assertEqual(ran.returncode, 2)
        self.assertEqual(ran.stdout, "right.json: ok, 1 body, 0 expectations\n")
        self.assertEqual([line.split(":")[1] for line in ran.stderr.splitlines()], [" a.json", " b.json"])

    def test_all_scenes_of_ours(self):
        scenes = sorted(carom.SCENES.rglob("*.json"))
        self.assertGreater(len(scenes), 2)
        self.succeeds("validate", *scenes)


if __name__ == "__main__":
    carom.main()
