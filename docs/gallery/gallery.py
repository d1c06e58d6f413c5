"""Writes docs/gallery.md and its pictures anew: gallery.py CAROM [NAME…]; with names only the pictures that have one of them in theirs. A
page of the scenes in scenes/contacts and scenes/joints, each as it looks at the middle one of its snapshots, and of those in scenes/exact, the
same or, if that comes first, with their plot, above the line that says what it teaches."""
import json
import pathlib
import subprocess
import sys
import tempfile

folder = pathlib.Path(__file__).resolve().parent
root = folder.parents[1]
scenes = [s for part in ("contacts", "joints", "exact") for s in sorted((root / "scenes" / part).glob("*.json"))]


def picture(scene):
    return folder / (f"{scene.stem}.png" if scene.parent.name == "contacts" else f"{scene.parent.name}-{scene.stem}.png")


def page():
    text = ["# Gallery\n", "<!-- made by ./dev gallery -->\n",
            "Piles, friction, impacts and joints under the solver `softstep`, gases under `events`. Each of these is a scene in `scenes` and a test:",
            "`carom run` says what it expects, and whether it came true.\n"]
    for scene in scenes:
        says = json.loads(scene.read_text())
        text += [f"## {says['title']}\n", f"{says['teaches']}\n", f"![{says['title']}](gallery/{picture(scene).name})\n",
                 f"[scenes/{scene.parent.name}/{scene.name}](../scenes/{scene.parent.name}/{scene.name})\n"]
    return "\n".join(text)


def draw_first(carom, scene, scratch):
    first = json.loads(scene.read_text())["pictures"][0]
    subprocess.run([carom, "plot", scene, "--out", scratch], check=True, stdout=subprocess.DEVNULL)
    return scratch / f"{first.get('name', first['type'])}.png"


def draw_middle(carom, scene, scratch):
    shown = [p for p in json.loads(scene.read_text())["pictures"] if p["type"] == "snapshots"][0]["at"]
    drawn = scratch / "drawn.png"
    subprocess.run([carom, "render", scene, "--file", drawn, "--at", str(shown[len(shown) // 2]), "--trail", "1", "--width", "480"],
                   check=True, stdout=subprocess.DEVNULL)
    return drawn


def draw(carom, scene, scratch):
    exact, first = scene.parent.name == "exact", json.loads(scene.read_text())["pictures"][0]
    plot = exact and (first["type"] != "snapshots" or len(first["at"]) == 1)
    drawn = (draw_first if plot else draw_middle)(carom, scene, scratch)
    # 48 colours are enough, or 16 for discs alone, and make a file a third as large.
    few = ("scale=640:-1:flags=area," if plot else "") + f"split[a][b];[a]palettegen=max_colors={48 if plot or not exact else 16}[p];[b][p]paletteuse=dither=none"
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", drawn, "-vf", few, picture(scene)], check=True)


def make(carom, names):
    for old in folder.glob("*.png"):
        if old not in [picture(scene) for scene in scenes]:
            old.unlink()
    with tempfile.TemporaryDirectory() as scratch:
        for scene in scenes:
            if not names or any(name in picture(scene).name for name in names):
                draw(carom, scene, pathlib.Path(scratch))
    (root / "docs/gallery.md").write_text(page())


if __name__ == "__main__":
    make(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:])
