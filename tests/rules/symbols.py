"""What the compiler made of the engine: no call of libm whose bits differ from machine to machine, no fused operation;
in a file compiled for processors that not everybody has, nothing that the linker might take for all; and memory is
asked for where the text says so, which a compiler may leave out without a word."""

import re
import subprocess
import sys

LIBM = """sin cos tan sincos asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 exp10 expm1 log log2 log10
log1p pow cbrt hypot fma erf erfc tgamma lgamma sinpi cospi""".split()
DIFFERENT = {name + suffix for name in LIBM for suffix in ("", "f", "l")}
FUSED = re.compile(r"^\s*[0-9a-f]+:\s+(vfn?m(?:add|sub)\w*|v?rsqrt\w+|v?rcp\w+|fmadd|fmsub|fnmadd|fnmsub|fmla|fmls)\b")

# Files in which so many instructions at least ask for memory, if they are optimised for x86 (src/simd/prefetch.hpp).
ASKS, LEAST = re.compile(r"(events.run|abreast)\.cpp\.o$"), 15
WIDER = re.compile(r"_avx\d*\.cpp\.o")


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()


def broken(objects):
    for line in run("nm", "--undefined-only", "-A", *objects):
        name = line.split()[-1].split("@")[0]
        if name in DIFFERENT:
            yield f"{line.split(':')[0]}: calls {name} of libm: use portable::{name} (src/math/elementary.hpp)"
    for path in objects:
        if not WIDER.search(path):
            continue
        for line in run("nm", "--defined-only", "-C", path):
            kind, name = line.split(maxsplit=2)[1:]
            if kind in "VWuv" or (kind in "TDBR" and not name.endswith("_kernel")):
                yield f"{path}: defines {name} for all, with instructions that not all have (src/simd/lanes.hpp)"
    for path in objects:
        lines = run("objdump", "-d", "--no-show-raw-insn", path)
        optimised = any("%r" in line for line in lines) and not any("8prefetch" in line for line in lines)
        if ASKS.search(path) and optimised and sum("prefetch" in line for line in lines) < LEAST:
            yield f"{path}: asks for less memory ahead than it says: use prefetch (src/simd/prefetch.hpp)"
        for line in lines:
            if found := FUSED.match(line):
                yield f"{path}: {found[1]} is rounded once where others round twice, or not exact"


if __name__ == "__main__":
    words = sorted(set(broken(sys.argv[1:])))
    print(*words, sep="\n")
    sys.exit(bool(words))
