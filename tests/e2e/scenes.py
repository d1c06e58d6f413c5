"""Every scene obeys the schema that the program prints, and the tour prints what the textbook's notebook prints."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import jsonschema

carom = sys.argv[1]
root = pathlib.Path(__file__).resolve().parents[2]
files = sorted((root / "scenes").rglob("*.json"))
assert len(files) >= 28, f"only {len(files)} scenes"


def run(*arguments):
    done = subprocess.run([carom, *map(str, arguments)], capture_output=True, text=True, cwd=root)
    assert done.returncode == 0, f"carom {' '.join(map(str, arguments))}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


def without_comments(text):
    """The text of a scene as plain JSON; a // within quotes stays."""
    return re.sub(r'("(?:[^"\\]|\\.)*")|//[^\n]*|/\*.*?\*/', lambda m: m.group(1) or "", text, flags=re.S)


schema = json.loads(run("schema"))
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
wrong = []
for file in files:
    scene = json.loads(without_comments(file.read_text()))
    for error in validator.iter_errors(scene):
        best = jsonschema.exceptions.best_match([error])
        wrong.append(f"{file.relative_to(root)}: {'/'.join(map(str, best.absolute_path))}: {best.message[:200]}")
assert not wrong, "\n".join(wrong)
assert not validator.is_valid({"carom": 1, "bodies": [{"mass": -1}]}), "the schema lets a negative mass through"
assert not validator.is_valid({"carom": 1, "bodis": []}), "the schema lets a misspelt key through"

lines = [line for line in run("validate", *files).splitlines() if not line.startswith("  note: ")]
assert len(lines) == len(files), f"{len(lines)} answers to {len(files)} scenes"

printed = json.loads((root / "tests/reference/textbook.json").read_text())["gas"]["printed"]
with tempfile.TemporaryDirectory() as folder:
    tour = run("tour", "--out", folder)
    assert f"Final kinetic energy: {printed}" in tour, tour
    # The table of the scenes is whole, and what stands out in it is explained below it.
    lines = tour.splitlines()
    assert [line.split()[0] for line in lines[:8]] == ["scene", "projectiles", "spring-pendulum", "gas", "rope", "cloth",
                                                       "rotation", "driven"], tour
    assert lines[8].startswith("residual: "), tour
    pictures = list(pathlib.Path(folder).rglob("*.png"))
    assert len(pictures) >= 7, pictures
print(f"{len(files)} scenes and the tour")
