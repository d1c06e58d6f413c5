"""The JSON Schema is one, and says no to what the program says no to, as far as a schema can know."""

import copy
import json
import random
import re
import unittest

import carom

try:
    import jsonschema
except ImportError:
    jsonschema = None


def without_comments(text):
    """Scenes may have comments of whole lines; json has none."""
    return re.sub(r"(?m)^\s*//.*$", "", text)


# One of everything.
FULL = {
    "carom": 1, "title": "all", "teaches": "nothing", "seed": 3, "parameters": {"k": 2, "twice": "2*k"},
    "world": {"gravity": [0, "-k"], "integrator": {"method": "runge-kutta", "tableau": "heun"},
              "solver": {"method": "softstep", "substeps": 4, "precise": "some"}, "long_step": "refuse", "threads": 1},
    "walls": [{"type": "rectangle", "low": [-90, -90], "high": [90, 90], "left": {"restitution": 0.5, "friction": 1}},
              {"type": "half-plane", "point": [0, -80], "normal": [0, 1], "side": {"restitution": 0.1}}],
    "bodies": [{"name": "a", "position": [1, 2], "mass": "k", "radius": 0.1, "colour": "#0072b2", "restitution": 0.5},
               {"name": "b", "kind": "fixed", "position": [3, 4]}, {"name": "c", "kind": "driven", "angle": 1},
               {"position": [50, 0], "shapes": [{"type": "box", "width": "k", "density": 2, "filter": {"mask": 3}},
                                                {"type": "polygon", "points": [[0, 0], [1, 0], [0, "k"]], "density": 1, "sensor": True}]}],
    "builders": [{"type": "rope", "anchor_a": [10, 10], "anchor_b": [12, 10], "segments": 4, "fixed_b": False, "stiffness": 10},
                 {"type": "lattice", "nx": 2, "ny": 3, "corner": [20, 20], "held": "top"},
                 {"type": "grid", "nx": 2, "ny": 2, "body": {"position": [30, 30]}},
                 {"type": "fill", "low": [40, 40], "high": [45, 45], "count": 3, "body": {}},
                 {"type": "notebook-gas", "count": 2, "seed": 5}],
    "forces": [{"type": "spring", "a": "a", "b": "b", "stiffness": 3, "damping_law": "isotropic"},
               {"type": "torsion-spring", "a": "a", "b": "b"}, {"type": "drag", "linear": 0.1, "wind": [1, 0]},
               {"type": "attraction", "strength": 1, "couples": "charge", "law": "inverse", "softening": 0.1},
               {"type": "constant", "body": "a", "force": [0, 1]}, {"type": "field", "x": "-k*x", "potential": "k*x*x/2"},
               {"type": "drive", "body": "c", "x": "sin(t)"}],
    "run": {"duration": 1, "step": "1/100", "every": 2},
    "expects": [{"quantity": "a.x", "value": 1, "tolerance": 0.1, "statistic": "mean", "relative": True, "number": 2}],
    "twins": [{"quantity": "a.x", "formula": "oscillator(t, 1, 0, k, 0)", "until": "1/2", "unit": "m", "source": "s"}],
    "pictures": [{"type": "trajectories", "bodies": ["a"]}, {"type": "snapshots", "at": [0, 1], "until": 3},
                 {"type": "time", "quantities": ["a.x"], "name": "x"}],
}

# Rules between values, which no schema knows: names and expressions that mean nothing, sizes that do not fit.
BEYOND_A_SCHEMA = re.compile(
    r"is wrong: |or an expression of the parameters|must be an expression|must be the name of a body|: it is |quantities must be"
    r"|without a folder|GB are free|at most 1e\+15 steps|means something else|outside of the walls|must lie above and right of low|must not be \(0, 0\)|got inf"
    r"|inside of discs that springs hold|must be within the run, whose duration|must leave room for random places|is of pictures of the type|must have a length between")


def places(value, path=()):
    """All places of a document."""
    yield path
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, item in items:
        yield from places(item, path + (key,))


def mutated(rng):
    """The document with one thing in it changed."""
    document = copy.deepcopy(FULL)
    *parents, last = rng.choice([path for path in places(document) if path])
    at = document
    for key in parents:
        at = at[key]
    change = rng.randrange(4)
    if change == 0:
        del at[last]
    elif change == 1 and isinstance(at, dict):
        at[rng.choice(["nonsense", "mass", "type", "name", "a", "low", "method"])] = rng.choice([1, "x", [], {}])
    else:
        at[last] = rng.choice([None, True, 0, -1, 1, 1.5, 2.0, 1e300, -1e-300, 2147483647, 2147483648, "", "k", "1", "a", [], [1, 2], [1, 2, 3],
                               ["k", "1"], {}, {"method": "rk4"}, {"type": "spring"}, "rk4", "#123", "#12345678", "none"])
    return document


@unittest.skipUnless(jsonschema, "no jsonschema")
class Schema(carom.Case):
    def setUp(self):
        super().setUp()
        self.schema = json.loads(self.succeeds("schema").stdout)

    def test_it_is_a_schema_of_draft_7(self):
        jsonschema.Draft7Validator.check_schema(self.schema)

    def test_it_accepts_all_scenes_of_ours(self):
        validator = jsonschema.Draft7Validator(self.schema)
        for file in sorted(carom.SCENES.rglob("*.json")):
            for error in validator.iter_errors(json.loads(without_comments(file.read_text()))):
                self.fail(f"{file}: {error.message}")

    def test_it_agrees_with_the_program(self):
        rng, validator = random.Random(1), jsonschema.Draft7Validator(self.schema)
        documents = [FULL] + [mutated(rng) for _ in range(1500)]
        names = [self.write(document, f"{i}.json") for i, document in enumerate(documents)]
        ran = self.carom("validate", *names)
        complaints = {line.split(": ")[1].split(":")[0]: line for line in ran.stderr.splitlines()}
        self.assertNotIn("0.json", complaints, "the document itself")
        beyond = 0
        for name, document in zip(names, documents):
            complaint = complaints.get(name)
            if complaint and BEYOND_A_SCHEMA.search(complaint):
                beyond += 1
                continue
            error = next(validator.iter_errors(document), None)
            self.assertEqual(error is None, complaint is None,
                             f"the program: {complaint}; the schema: {error and error.message[:300]}")
        self.assertLess(beyond, 600)
        self.assertGreater(len(complaints), 500)


if __name__ == "__main__":
    carom.main()
