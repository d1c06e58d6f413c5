"""No two types of a namespace share a name: the linker takes the functions of one, and of containers of it, for those of
the other (built by clang++, two structs called Line crashed). No constant of a file is called as one of a file beside
it: a unity build takes a folder as one file, where the name would mean either."""

import re
import sys
from pathlib import Path

import source

NAMESPACE = re.compile(r"namespace (?:([\w:]+) )?\{$")
TYPE = re.compile(r"(?:struct|class|enum class) (?:alignas\(\w+\) )?(\w+)(?: final)?(?: : .*| \{.*)?$")
CONSTANT = re.compile(r"(?:inline |static )?(?:constexpr|const) [^=(]*?\b(\w+)(?:\[\w*\])* ?[={]")
ANOTHER = re.compile(r", (\w+) = ")


def names(path):
    """(line, namespace, kind, name) of types and constants: namespaces' members are not indented."""
    inside = []
    for number, (line, text) in enumerate(zip(source.code(path), path.read_text().split("\n")), 1):
        if opened := NAMESPACE.match(line):
            inside.append(opened[1] or "")
        elif text.startswith("}  // namespace"):  # clang-format writes it
            inside.pop()
        elif found := TYPE.match(line):
            yield number, inside, "type", found[1]
        elif found := CONSTANT.match(line):
            for name in [found[1], *ANOTHER.findall(line, found.end())]:
                yield number, inside, "constant", name


def broken(root):
    types, constants = {}, {}
    for folder in ("include", "src"):
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            for number, inside, kind, name in names(path):
                namespace = "::".join(filter(None, inside))
                if kind == "constant" and inside:
                    first = constants.setdefault((path.parent, namespace, name), path)
                elif kind == "type" and "" not in inside:
                    first = types.setdefault((namespace, name), path)
                else:
                    continue
                if first != path:
                    yield path, number, f"{namespace}::{name} is a {kind} of {first.relative_to(root)} too"


if __name__ == "__main__":
    root = Path(sys.argv[1])
    sys.exit(source.report(root, broken(root)))
