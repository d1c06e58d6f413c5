"""What a scene's pictures and films show, and what is said about them."""

import re
import shutil
import unittest

from carom import FALL, Case, main


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

    def labels(self, *pictures, **scene):
        """All that is written in the picture."""
        return re.findall("<text>(?:<tspan[^>]*>)?([^<]*)", self.drawn({**FALL, **scene}, *pictures)[0])


if __name__ == "__main__":
    main()
