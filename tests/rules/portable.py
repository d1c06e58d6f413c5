"""What gives other bits on another compiler, library or machine has no place in the engine or in scenes.

Functions of libm are found in the object files: symbols.py."""

import re
import sys
from pathlib import Path

import source

# src/output is free, no bit of a world comes from there, and so are keys for the maps of whoever embeds the engine.
FREE = {"output.hpp", "id.hpp"}
ENGINE = {
    r"std::\w+_distribution|std::(default_random_engine|random_device|rand)\b|\bs?rand\(": "use carom::Random",
    r"std::(shuffle|sample|random_shuffle)\b": "every standard library has another order: write the loop",
    r"std::unordered_\w+|<unordered_\w+>": "iterates in an order of its own: use a vector or a map",
    r"std::hash\b": "every standard library has another one",
    r"std::(transform_)?reduce\b|std::execution|<execution>": "sums in an order of its own: write the loop",
    r"\blong double\b": "has other sizes on other machines",
    r"\bfmaf?\(|__builtin_fma|__FMA__|_mm\w*_f[n]?m(add|sub)|rsqrt|_rcp": "is not on every machine, or not exact there",
    r"#\s*pragma\s+(omp|GCC\s+optimize|STDC\s+FP_CONTRACT\s+ON)": "changes how numbers are rounded",
}
# Lanes of numbers have one home. (The unnamed kernels there and in the files that include them use its names.)
ONLY_IN_SIMD = {
    r"vector_size|ext_vector_type|__builtin_(shufflevector|shuffle|convertvector|cpu_\w+|ia32_\w+)|\b_mm\d*_|"
    r"\bv128_t\b|target_clones|__attribute__\(\(target": "instructions of one processor: src/simd alone",
}
BUILD = {
    r"-ffast-math|-Ofast|-funsafe-math|-fassociative-math|-freciprocal-math|-ffinite-math|-fno-signed-zeros|"
    r"-ffp-contract=(fast|on)|-fexcess-precision=fast": "the same bits everywhere forbid it",
}


def search(path, lines, patterns):
    for number, line in enumerate(lines, 1):
        for pattern, why in patterns.items():
            if found := re.search(pattern, line):
                yield path, number, f"{found[0].strip()}: {why}"


def broken(root):
    for folder in ("include", "src"):
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            if "output" not in path.relative_to(root).parts and path.name not in FREE:
                yield from search(path, source.code(path), ENGINE)
                if "simd" not in path.relative_to(root).parts:
                    yield from search(path, source.code(path), ONLY_IN_SIMD)
    build_files = {root / "CMakePresets.json", root / "dev", *root.glob("*/CMakeLists.txt"), *root.glob("cmake/*"),
                   *root.glob("*/*/CMakeLists.txt"), root / "CMakeLists.txt"}  # fmt: skip
    for path in sorted(build_files):
        if path.exists():
            yield from search(path, path.read_text().splitlines(), BUILD)


if __name__ == "__main__":
    root = Path(sys.argv[1])
    sys.exit(source.report(root, broken(root)))
