"""Every rule sees its violations: each is put into a small tree of its own, and the rule must name its line."""

import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
LONG_FUNCTION = "void f(int n) {\n" + "    ++n;\n" * 60 + "}\n"

VIOLATIONS = [
    ("layers", "src/solvers/x.cpp", '#include "integrators/propose.hpp"\n', 1),
    ("layers", "src/forces/x.cpp", '\n#include "world/state.hpp"\n', 2),
    ("layers", "src/scene/x.cpp", "#include <carom/output.hpp>\n", 1),
    ("layers", "src/world/x.cpp", "#include <thread>\n", 1),
    ("layers", "src/world/x.cpp", "#include <nlohmann/json.hpp>\n", 1),
    ("layers", "src/news/x.cpp", "", 1),
    ("layers", "apps/x.cpp", '#include "math/roots.hpp"\n', 1),
    ("layers", "docs/architecture.md", "`src/math` `src/nothing`\n", 1),
    ("names", "src/world/x.hpp", "namespace carom {\n\nstruct Root {\n};\n\n}  // namespace carom\n", 3),
    ("names", "src/world/x.hpp", "namespace carom {\nclass alignas(64) Root : public B {\n", 2),
    ("names", "src/math/x.cpp", "namespace carom {\nnamespace {\n\nconstexpr double few = 2, little = 0.1;\n", 4),
    ("portable", "src/scene/x.cpp", "#include <random>\nstd::normal_distribution<double> d;\n", 2),
    ("portable", "src/world/x.cpp", "\n\n#include <unordered_map>\n", 3),
    ("portable", "src/math/x.hpp", "double f(double x) { return std::fma(x, x, x); }\n", 1),
    ("portable", "src/forces/x.cpp", "\nusing V = double __attribute__((vector_size(16)));\n", 2),
    ("portable", "CMakeLists.txt", "add_compile_options(-ffast-math)\n", 1),
    ("size", "src/world/x.cpp", "namespace a {\n" + LONG_FUNCTION + "}\n", 2),
    ("size", "src/world/x.cpp", "namespace a {\nclass B {\n" + LONG_FUNCTION + "};\n}\n", 3),
    ("size", "src/world/x.cpp", "int i;\n" * 501, 501),
]
INNOCENT = {
    "src/math/roots.hpp": "// std::fma( is not called here\n" + "void g();\n" * 70 + "namespace carom {\nstruct Root {\n};\n",
    "src/math/roots.cpp": "namespace carom {\nnamespace {\nstruct Root {\n};\n}  // namespace\nstruct Root;\n",
    "src/math/limits.hpp": "namespace carom {\ninline constexpr double little = 0.5;\n}\n",
    "src/world/limits.cpp": "namespace carom {\nconstexpr double little = 0.5;\n}\n",
    "src/world/state.hpp": '#include "math/roots.hpp"\n#include <carom/world.hpp>\nconst char* s = "std::hash";\n',
    "docs/architecture.md": "`src/math` `src/world`\n",
}


def run(rule, files):
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = Path(root, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        done = subprocess.run([sys.executable, HERE / f"{rule}.py", root], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr


def symbols(text, *flags, name="x.cpp.o", rule="symbols"):
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "x.cpp").write_text(text)
        subprocess.run(["g++", "-O2", *flags, "-c", "x.cpp", "-o", name], check=True, cwd=folder)
        command = [sys.executable, HERE / f"{rule}.py", Path(folder, name)]
        done = subprocess.run(command, capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr


def wrong():
    for rule in ("layers", "names", "portable", "size"):
        if (seen := run(rule, INNOCENT))[0] != 0:
            yield f"{rule} complains about innocents: {seen[1]}"
    for rule, name, text, line in VIOLATIONS:
        status, words = run(rule, INNOCENT | {name: text})
        if status == 0 or f"{name}:{line}:" not in words:
            yield f"{rule} does not see {text[:60]!r} in {name}: {words}"
    sine = "#include <cmath>\ndouble f(double x) { return std::sin(x); }\n"
    fused = "double f(double a, double b, double c) { return a * b + c; }\n"
    if "calls sin" not in symbols(sine)[1]:
        yield "symbols does not see a sine"
    if "vfm" not in symbols(fused, "-mfma", "-ffp-contract=fast")[1]:
        yield "symbols does not see a fused operation"
    if (seen := symbols(fused, "-mfma", "-ffp-contract=off"))[0] != 0:
        yield f"symbols complains about innocents: {seen[1]}"
    shared = "template <class T> T twice(T x) { return x + x; }\ntemplate double twice(double);\n"
    if "defines" not in symbols(shared, name="x_avx2.cpp.o")[1]:
        yield "symbols does not see a template that is shared by all"
    own = "namespace { double f(double x) { return x + x; } }\nextern double (*const x_kernel)(double);\n"
    if (seen := symbols(own + "double (*const x_kernel)(double) = f;\n", name="x_avx2.cpp.o"))[0] != 0:
        yield f"symbols complains about an innocent kernel: {seen[1]}"
    if "asks for less memory" not in symbols("int f(const int* x) { return *x; }\n", name="events_run.cpp.o")[1]:
        yield "symbols does not see that nobody asks for memory"
    words = "namespace fmt { struct Format {}; }\nvoid put(fmt::Format) {}\n"
    if "put(fmt::Format) under the name of others" not in symbols(words, rule="foreign")[1]:
        yield "foreign does not see another library's name"
    if (seen := symbols(words, "-Dfmt=carom_fmt", rule="foreign"))[0] != 0:
        yield f"foreign complains about a name of our own: {seen[1]}"


if __name__ == "__main__":
    words = list(wrong())
    print(*words, sep="\n")
    sys.exit(bool(words))
