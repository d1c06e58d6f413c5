"""The gallery shows every scene of scenes/contacts and no other, with a small picture each: ./dev gallery renews it."""
import pathlib
import sys

sys.dont_write_bytecode = True
root = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(root / "docs/gallery"))
import gallery  # noqa: E402

assert len(gallery.scenes) >= 15, f"only {len(gallery.scenes)} scenes"
assert (root / "docs/gallery.md").read_text() == gallery.page(), "docs/gallery.md is stale: ./dev gallery"
pictures = {file: file.stat().st_size for file in gallery.folder.glob("*.png")}
assert set(pictures) == {gallery.picture(scene) for scene in gallery.scenes}, sorted(pictures)
assert max(pictures.values()) < 40_000, pictures
assert sum(pictures.values()) < 1_000_000, pictures
print(f"{len(pictures)} pictures")
