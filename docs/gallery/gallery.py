"""Writes docs/gallery.md and its pictures anew: gallery.py CAROM. A page of the scenes in scenes/contacts, each as it
looks at the middle one of its snapshots, above the line that says what it teaches."""
import json
import pathlib
import subprocess
import sys
import tempfile

folder = pathlib.Path(__file__).resolve().parent
root = folder.parents[1]
scenes = sorted((root / "scenes/contacts").glob("*.json"))


def picture(scene):
    return folder / f"{scene.stem}.png"


def page():
    text = ["# Gallery\n", "<!-- made by ./dev gallery -->\n",
            "Piles, friction and impacts under the solver `softstep`. Each of these is a scene in `scenes/contacts` and a test:",
            "`carom run` says what it expects, and whether it came true.\n"]
    for scene in scenes:
        says = json.loads(scene.read_text())
        text += [f"## {says['title']}\n", f"{says['teaches']}\n", f"![{says['title']}](gallery/{scene.stem}.png)\n",
                 f"[scenes/contacts/{scene.name}](../scenes/contacts/{scene.name})\n"]
    return "\n".join(text)


def draw(carom, scene, scratch):
    shown = [p for p in json.loads(scene.read_text())["pictures"] if p["type"] == "snapshots"][0]["at"]
    drawn = scratch / "drawn.png"
    subprocess.run([carom, "render", scene, "--file", drawn, "--at", str(shown[len(shown) // 2]), "--trail", "1", "--width", "480"],
                   check=True, stdout=subprocess.DEVNULL)
    # 48 colours are enough, and make a file a third as large.
    few = "split[a][b];[a]palettegen=max_colors=48[p];[b][p]paletteuse=dither=none"
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", drawn, "-vf", few, picture(scene)], check=True)


def make(carom):
    for old in folder.glob("*.png"):
        old.unlink()
    with tempfile.TemporaryDirectory() as scratch:
        for scene in scenes:
            draw(carom, scene, pathlib.Path(scratch))
    (root / "docs/gallery.md").write_text(page())


if __name__ == "__main__":
    make(pathlib.Path(sys.argv[1]).resolve())
