"""What a scene's pictures and films show, and what is said about them."""

import re
import shutil
import subprocess
import unittest

from carom import FALL, SCENES, Case, main


@unittest.skipUnless(shutil.which("gnuplot"), "no gnuplot")
class Pictures(Case):
    def drawn(self, scene, *pictures):
        """The pictures of the scene as SVG texts."""
        self.succeeds("plot", self.write({**scene, "pictures": list(pictures)}), "--out", "p", "--format", "svg")
        return [file.read_text() for file in sorted((self.path / "p").iterdir(), key=lambda file: file.stat().st_mtime_ns)]

    def test_the_sun_was_left_out(self):
        sun = {"name": "Sun", "kind": "fixed", "position": [3, 2], "radius": 0.5, "colour": "#ffcc00"}
        floor = {"name": "floor", "kind": "fixed", "shapes": [{"type": "box", "width": 1e4, "height": 1}]}
        trajectories, = self.drawn({**FALL, "bodies": [*FALL["bodies"], sun, floor]}, {"type": "trajectories"})
        self.assertIn("rgb(255, 204,   0)", trajectories)
        self.assertIn(">5<", trajectories, "the long floor does not make the axes longer")

    def test_a_colour_of_its_own_was_left_out_beside_many_bodies(self):
        bodies = [{"name": f"b{k}", "position": [k, 0], "velocity": [0, 1]} for k in range(10)]
        trajectories, = self.drawn({**FALL, "bodies": [{**bodies[0], "colour": "#aa3300"}, *bodies[1:]]}, {"type": "trajectories"})
        self.assertIn("rgb(170,  51,   0)", trajectories)
        self.assertIn("stroke-dasharray", trajectories, "two bodies of one colour")

    def test_of_a_rope_the_first_twenty_beads_were_shown(self):
        beads = [{"name": f"bead{k}", "position": [k, 0]} for k in range(101)]
        nail = {"name": "nail", "kind": "fixed"}
        for bodies, said in (([nail, *beads], True), ([nail, *beads[:20]], False)):
            drawn, = self.drawn({**FALL, "bodies": bodies}, {"type": "trajectories"})
            shown = [int(k) for k in re.findall(r"<title>bead(\d+)<", drawn)]
            gaps = [b - a for a, b in zip(shown, shown[1:])]
            self.assertEqual((len(shown), shown[0], shown[-1]), (20, 0, len(bodies) - 2))
            self.assertLessEqual(max(gaps) - min(gaps), 1)
            self.assertEqual("20 of 101 bodies" in drawn, said)

    def labels(self, *pictures, **scene):
        """All that is written in the picture."""
        return re.findall("<text>(?:<tspan[^>]*>)?([^<]*)", self.drawn({**FALL, **scene}, *pictures)[0])

    def test_a_phase_portrait_left_the_unit_out(self):
        labels = self.labels({"type": "phase", "quantities": ["ball.y/2", "ball.vy"], "unit": "km"})
        self.assertIn("ball.y/2 [km]", labels)
        self.assertIn("ball.vy [m/s]", labels)

    def test_quantities_of_different_kinds_had_no_units(self):
        labels = self.labels({"type": "time", "quantities": ["ball.y", "ball.vy", "2*ball.y"]})
        self.assertLessEqual({"ball.y [m]", "ball.vy [m/s]", "2*ball.y"}, set(labels))
        labels = self.labels({"type": "time", "quantities": ["ball.y", "ball.x"]})
        self.assertLessEqual({"ball.y", "ball.x", "position [m]"}, set(labels))

    def test_a_difference_of_lengths_had_no_unit(self):
        bodies = [{"name": "a", "velocity": [1, 0]}, {"name": "b-c (d"}]
        for quantity, label in (("a.x - 'b-c (d'.x", "a.x - b-c (d.x [m]"), ("-a.x+a.y-a.x", "-a.x+a.y-a.x [m]"), ("a.x - a.vx", "a.x - a.vx"),
                                ("(a.x - a.y)*a.x", "(a.x - a.y)*a.x"), ("a.x - 1", "a.x - 1"), ("energy.kinetic + energy.gravity", "energy.kinetic + energy.gravity [J]")):
            self.assertIn(label, self.labels({"type": "time", "quantities": [quantity]}, bodies=bodies))

    def test_a_change_beside_a_large_whole_was_a_flat_line(self):
        high = [{"name": "ball", "position": [0, 1e6]}]
        words = self.labels({"type": "time", "quantities": ["ball.y", "ball.x"], "change": True}, bodies=high)
        self.assertIn("change of position [m]", words)
        self.assertIn("−4", words)  # it falls by 5 m
        self.assertIn("change of ball.y [m]", self.labels({"type": "time", "quantities": ["ball.y"], "change": True}, bodies=high))
        self.assertIn("change of energy [J]", self.labels({"type": "energy", "name": "time", "change": True}, bodies=high))

    def test_what_says_nothing_to_a_picture_was_taken(self):
        for picture, said in (({"type": "trajectories", "change": True}, "change is of pictures of the type time or energy"),
                              ({"type": "energy", "quantities": ["ball.y"]}, "quantities is of pictures of the type time or phase or twin"),
                              ({"type": "snapshots", "bodies": ["ball"]}, "bodies is of pictures of the type trajectories"),
                              ({"type": "trajectories", "at": [1]}, "at is of pictures of the type snapshots or profile")):
            self.fails(2, f"pictures[0].{said}", "plot", self.write({**FALL, "pictures": [picture]}))

    def test_a_phase_picture_had_no_poincare_section(self):
        # x = sin(t) + cos(t) - cos(2 t)/3 solves x'' = -x + cos(2 t): it takes two periods of the drive.
        scene = {**FALL, "parameters": {"w": 2}, "world": {"integrator": "gauss-radau"}, "bodies": [{"name": "ball", "position": ["2/3", 0], "velocity": [1, 0]}],
                 "forces": [{"type": "field", "x": "-x + cos(w*t)"}], "run": {"duration": "10*pi", "step": "2*pi/w/50"}}
        quantities = {"type": "phase", "quantities": ["ball.x", "ball.vx"]}

        def points(picture, *options):
            self.succeeds("plot", self.write({**scene, "pictures": [picture]}), "--format", "svg", *options)
            drawn = re.findall(r"<use xlink:href='#gpPt\d+' transform='translate\(([0-9.]+),([0-9.]+)\)", (self.path / "out/phase.svg").read_text())
            return drawn

        once = points({**quantities, "period": "2*pi/w"})
        self.assertEqual((len(once), len(set(once))), (12, 2))  # ten periods, the start, and its ring
        self.assertEqual(len(set(points({**quantities, "period": "pi/w"}))), 4)
        self.assertEqual(len(points({**quantities, "period": "2*pi/w"}, "--every", "25")), 12)
        self.assertEqual(len(points({**quantities, "period": "2*pi/w", "from": "5*pi"})), 7)
        self.assertEqual(len(points(quantities)), 1)
        self.fails(2, "pictures[0] is wrong: period must be a whole number of frames, which come every 0.06283185307179587 s, got 3 s, which are "
                   "47.7465", "plot", self.write({**scene, "pictures": [{**quantities, "period": 3}]}))
        self.fails(2, "pictures[0].period is of pictures of the type phase", "plot", self.write({**scene, "pictures": [{"type": "energy", "period": 3}]}))

    def test_a_picture_could_not_leave_out_how_it_began(self):
        late = {"type": "time", "quantities": ["ball.y"], "from": 0.5}
        self.succeeds("plot", self.write({**FALL, "pictures": [late]}), "--format", "svg")
        self.assertNotIn(">0.4<", (self.path / "out/time.svg").read_text())
        self.succeeds("plot", "scene.json", "--format", "svg", "--duration", "0.4", "--out", "short")
        self.assertFalse((self.path / "short/time.svg").exists())
        for wrong, said in (({"from": 3}, "from must be within the run, whose duration is 1 s, got 3 s"),
                            ({"until": 0.4}, "from must be before until, 0.4 s, got 0.5 s"),
                            ({"type": "phase", "quantities": ["ball.y"]}, "quantities must be two, got 1")):
            self.fails(2, f"pictures[0].{said}", "plot", self.write({**FALL, "pictures": [{**late, **wrong}]}))
        self.fails(2, "pictures[0].from is of pictures of the type time or phase", "plot", self.write({**FALL, "pictures": [{"type": "energy", "from": 0.5}]}))

    def test_speeds_were_called_velocities(self):
        bodies = [{"name": "a"}, {"name": "b"}]
        for quantities, label in ((["a.speed", "b.speed"], "speed [m/s]"), (["a.speed", "b.vx"], "velocity [m/s]")):
            self.assertIn(label, self.labels({"type": "time", "quantities": quantities}, bodies=bodies))

    def test_names_had_their_quotes(self):
        bodies = [{"name": "cue ball"}, {"name": "it's"}]
        pictures = {"type": "time", "quantities": ["'cue ball'.speed", "'it''s'.speed"]}
        self.assertLessEqual({"cue ball.speed", "it's.speed"}, set(self.labels(pictures, bodies=bodies)))

    def test_a_body_changed_its_colour_between_pictures(self):
        bodies = [{"name": "my ball", "colour": "#b405c8"}, {"name": "b", "position": [1, 1]}]
        pictures = [{"type": "time", "name": "x", "quantities": ["'my ball'.x", "b.x"]},
                    {"type": "time", "name": "p", "quantities": ["momentum.y", "b.vy", "2*'my ball'.vy"]}]
        for drawn in self.drawn({**FALL, "bodies": bodies}, *pictures):
            curves = dict(re.findall(r"<title>([^<]*)</title>.*?path stroke='rgb\(([^)]*)\)", drawn, re.DOTALL))
            by_body = [colour for quantity, colour in curves.items() if "my ball" in quantity]
            self.assertEqual(by_body, ["180,   5, 200"])
            self.assertEqual(len(set(curves.values())), len(curves))

    def test_four_twins_were_a_strip(self):
        twins = [{"quantity": f"{n}*ball.y", "formula": f"{n}*(5 - 5*t^2)", "unit": "m"} for n in range(1, 5)]
        drawn, = self.drawn({**FALL, "twins": twins}, {"type": "twin"})
        width, height = map(float, re.search(r'viewBox="0 0 (\d+) (\d+)"', drawn).groups())
        self.assertLess(height, 1.5 * width)
        self.assertEqual(drawn.count("<text>analytic"), 1)

    def test_the_third_twins_error_stood_beside_it(self):
        for count in (3, 5):
            twins = [{"quantity": f"{n}*ball.y", "formula": f"{n}*(5 - 5*t^2)", "unit": "m"} for n in range(2, 2 + count)]
            drawn, = self.drawn({**FALL, "twins": twins}, {"type": "twin"})
            places = [(float(x), float(y), words) for x, y, words in
                      re.findall(r'translate\(([\d.]+),([\d.]+)\)[^>]*>\s*<text>(?:<tspan[^>]*>)?([^<]*)', drawn)]
            quantities = [(x, y) for x, y, words in places if "ball.y" in words]
            errors = [(x, y) for x, y, words in places if "error" in words]
            self.assertEqual((len(quantities), len(errors)), (count, count))
            for x, y in quantities:
                self.assertTrue(any(abs(below - x) < 1 and 0 < lower - y < 300 for below, lower in errors), (x, y, places))
            self.assertEqual([words for _, _, words in places].count("t [s]"), 2, "a time axis for each column")

    def test_a_spring_of_bodies_that_are_not_shown_was_drawn(self):
        bodies = [{"name": "nail", "kind": "fixed"}] + [{"name": n, "position": [x, 1]} for x, n in enumerate("abcd")]
        spring = {"type": "spring", "stiffness": 1}
        for a, b, seen in (("a", "b", False), ("nail", "a", False), ("b", "c", True), ("nail", "c", True)):
            scene = {**FALL, "bodies": bodies, "forces": [{**spring, "a": a, "b": b}]}
            drawn, = self.drawn(scene, {"type": "trajectories", "bodies": ["c", "d"]})
            self.assertEqual("rgb( 85,  85,  85)" in drawn, seen, (a, b))
        rod = {"a": "a", "b": "b", "type": "distance"}
        scene = {**FALL, "world": {"solver": "softstep"}, "bodies": bodies, "joints": [rod]}
        drawn, = self.drawn(scene, {"type": "trajectories", "bodies": ["c", "d"]})
        self.assertNotIn("rgb( 85,  85,  85)", drawn)
        drawn, = self.drawn(scene, {"type": "trajectories"})
        self.assertIn("rgb( 85,  85,  85)", drawn)


class Forces(Case):
    def test_an_arrow_at_the_foot_of_the_arch_was_cut_off(self):
        self.succeeds("render", SCENES / "contacts" / "arch.json", "--file", "a.svg", "--forces")
        svg = (self.path / "a.svg").read_text()
        height = float(re.search(r'viewBox="0 0 \d+ (\d+)"', svg).group(1)) - 36  # without the caption
        heads = re.findall(r'stroke:none;[^"]*fill:rgb\(78[^"]*" d="([^"]*)"', svg)
        inside = [head for head in heads if all(float(y) < height for y in re.findall(r"[ML] [\d.-]+ ([\d.-]+)", head))]
        self.assertGreater(len(inside), 20)
        self.assertEqual(len(heads), len(inside) + 1, "the key alone is below the picture")


@unittest.skipUnless(shutil.which("ffmpeg"), "no ffmpeg")
class Films(Case):
    def test_a_gif_of_more_than_50_frames_a_second_played_wrongly(self):
        for rate in ("50.1", "60", "101"):
            said = self.fails(2, "50", "render", self.write(FALL), "--file", "x.gif", "--fps", rate, "--width", "100").stderr
            self.assertTrue(said.startswith(f"carom: x.gif: {rate} frames per second"), said)
            self.assertEqual(self.files(), ["scene.json"])
        self.succeeds("render", "scene.json", "--file", "x.gif", "--fps", "50", "--width", "100")
        self.succeeds("render", "scene.json", "--file", "x.mp4", "--fps", "60", "--width", "100")

    def test_frames_within_a_step_were_its_end_again_and_again(self):
        """Of 21 frames in two steps were three different, the second at the end of the first step."""
        ball = {"name": "ball", "position": [0, 0], "velocity": [3, 0]}
        scene = {**FALL, "world": {"solver": "events"}, "bodies": [ball], "expects": [], "run": {"duration": 1, "step": 0.5}}
        self.succeeds("render", self.write(scene), "--file", "x.gif", "--fps", "20", "--width", "200")
        hashes = subprocess.run(["ffmpeg", "-v", "error", "-i", self.path / "x.gif", "-f", "framemd5", "-"], stdout=subprocess.PIPE,
                                text=True, check=True).stdout.splitlines()
        frames = [line.split(",")[-1] for line in hashes if not line.startswith("#")]
        self.assertEqual((len(frames), len(set(frames))), (21, 21))

    def test_render_offered_a_thinning_that_it_did_not_do(self):
        for option in "--every", "--measure-from":
            self.assertNotIn(option, self.succeeds("render", "--help").stdout)
            self.fails(2, option, "render", self.write(FALL), "--file", "x.gif", option, "10")

    def test_a_flat_view_was_too_low_for_a_narrow_picture(self):
        flat = {**FALL, "world": {}, "bodies": [{"name": "a"}, {"name": "b", "position": [9, 0]}]}
        for width in 72, 100:
            self.succeeds("render", self.write(flat), "--file", "a.png", "--width", width)
            size = (self.path / "a.png").read_bytes()[16:24]
            self.assertEqual(int.from_bytes(size[:4], "big"), width)
            self.assertGreaterEqual(int.from_bytes(size[4:], "big"), 72)

    def test_a_body_is_followed(self):
        scene = {**FALL, "bodies": [{"name": "ball", "position": [0, 5], "velocity": [40, 0], "radius": 1}]}
        for options in ((), ("--trail", "0.5", "--forces", "--solver", "softstep")):
            self.succeeds("render", self.write(scene), "--file", "a.svg", "--follow", "ball", "--across", "10", *options)
            svg = (self.path / "a.svg").read_text()
            # Ten metres are 800 pixels, and in the middle is the disc.
            self.assertRegex(svg, r'viewBox="0 0 800 5(69|70|71)"')
            self.assertRegex(svg, r'd="M 48\d(\.\d+)? 26[5-9]')
        self.succeeds("render", "scene.json", "--file", "a.gif", "--follow", "ball", "--duration", "0.2", "--width", "100")
        self.fails(2, "--follow: there is no body 'bal'; did you mean 'ball'?", "render", "scene.json", "--file", "b.png", "--follow", "bal")
        self.fails(2, "--across", "render", "scene.json", "--file", "b.png", "--across", "2")
        box = {**scene, "walls": [{"type": "periodic", "low": [0, 0], "high": [9, 6]}]}
        self.fails(2, "allowed are 60 m", "render", self.write(box), "--file", "b.png", "--follow", "ball", "--across", "61")
        # Each of 2700 boxes was drawn, or of millions.
        thin = {**scene, "walls": [{"type": "periodic", "low": [0, 0], "high": [1000, 0.1]}]}
        self.fails(2, "too many times; --across 1 shows less", "render", self.write(thin), "--file", "b.png", "--follow", "ball")

    def test_forces_of_a_solver_that_has_none_were_left_out_without_a_word(self):
        for solver, noted in (("impulse", True), ("none", True), ("softstep", False)):
            ran = self.carom("render", self.write(FALL), "--file", "a.png", "--forces", "--solver", solver)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.assertEqual(f"the solver '{solver}' knows none" in ran.stderr, noted, ran.stderr)

    def test_a_film_of_one_frame_was_made_without_a_word(self):
        ran = self.carom("render", self.write({**FALL, "run": {"duration": 2e-5, "step": 1e-6}}), "--file", "x.gif", "--width", "100")
        self.assertEqual(ran.returncode, 0)
        self.assertEqual(ran.stderr, "carom: note: x.gif will have 1 frame of 2e-05 s; --speed 2e-06 makes a film of about 10 s\n")
        self.succeeds("render", "scene.json", "--file", "x.gif", "--width", "100", "--speed", "2e-6", "--fps", "2")

    def test_a_film_without_an_end_was_begun_without_a_word(self):
        box = {"type": "periodic", "low": [0, 0], "high": [9, 9]}
        scene = self.write({**FALL, "world": {}, "walls": [box], "run": {"duration": 6e7, "step": 1e5}})
        ran = self.carom("render", scene, "--file", "x.gif", env={"PATH": "/nowhere"})  # without ffmpeg it ends here
        said = "carom: note: x.gif will have 1.8e+09 frames of 6e+07 s; --speed 6e+06 makes a film of about 10 s\n"
        self.assertTrue(ran.stderr.startswith(said), ran.stderr)


if __name__ == "__main__":
    main()
