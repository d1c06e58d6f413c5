"""Who may see whom: an included file lies in the same folder, in a lower layer, or in include/carom."""

import re
import sys
from pathlib import Path

import source

LAYERS = {
    "text": 0, "simd": 0,
    "math": 1,
    "threads": 2,
    "state": 3,
    "forces": 4, "collision": 4, "joints": 4,
    "integrators": 5, "solvers": 5,
    "world": 6,
    "analysis": 7, "scene": 7, "output": 7,
}  # fmt: skip

# Where what is not plain C++ may be seen.
ONLY_IN = {
    r"Eigen/": {"integrators", "solvers"},
    r"nlohmann/": {"scene"},
    r"cairo|hdf5": {"output"},
    r"carom/scene\.hpp": {"scene"},
    r"carom/output\.hpp": {"output"},
    r"\w*intrin\.h|wasm_simd128\.h|arm_neon\.h": {"simd"},
    r"(thread|atomic|mutex|shared_mutex|condition_variable|semaphore|barrier|latch|future)$": {"threads"},
    r"(unistd|fcntl|signal|poll|spawn|sys/(?!mman)\w+)\.h|csignal": {"output", "scene"},
    r"sys/mman\.h": {"math"},
}

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if found := INCLUDE.match(line):
            yield number, found[1] == '"', found[2]


def broken_in_src(root):
    for path in sorted((root / "src").rglob("*.[ch]pp")):
        folder = path.relative_to(root / "src").parts[0]
        if folder not in LAYERS:
            yield path, 1, f"src/{folder} has no layer: give it one in tests/rules/layers.py"
            continue
        for number, quoted, name in includes(path):
            if quoted:
                other = name.split("/")[0]
                if other != folder and not LAYERS.get(other, 99) < LAYERS[folder]:
                    yield path, number, f'"{name}": {folder} may see only itself and layers below {LAYERS[folder]}'
            for pattern, folders in ONLY_IN.items():
                if not quoted and re.match(pattern, name) and folder not in folders:
                    yield path, number, f"<{name}>: only {' and '.join(sorted(folders))} may see it"


def broken_at_the_doors(root):
    """Programs and public headers know the public headers alone."""
    for door in ("include", "apps", "examples", "benchmarks", "python", "web"):
        for path in sorted((root / door).rglob("*.[ch]pp")):
            for number, quoted, name in includes(path):
                if quoted and not (path.parent / name).exists():
                    yield path, number, f'"{name}": outside src only <carom/…> and files beside this one'


def broken_in_docs(root):
    page = root / "docs/architecture.md"
    named = set(re.findall(r"`src/(\w+)/?`", page.read_text()))
    there = {path.name for path in (root / "src").iterdir() if path.is_dir()}
    for folder in sorted(there - named):
        yield page, 1, f"does not name `src/{folder}`"
    for folder in sorted(named - there):
        yield page, 1, f"names `src/{folder}`, which is not there"


if __name__ == "__main__":
    root = Path(sys.argv[1])
    sys.exit(source.report(root, [*broken_in_src(root), *broken_at_the_doors(root), *broken_in_docs(root)]))
