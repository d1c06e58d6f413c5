"""No two types of a namespace share a name: the linker takes the functions of one, and of containers of it, for those of
the other (built by clang++, two structs called Line crashed)."""

import re
import sys
from pathlib import Path

import source

NAMESPACE = re.compile(r"namespace (?:([\w:]+) )?\{$")
TYPE = re.compile(r"(?:struct|class|enum class) (?:alignas\(\w+\) )?(\w+)(?: final)?(?: : .*| \{.*)?$")


def types(path):
    """(line, namespace, name) of the types that other files see: namespaces' members are not indented."""
    inside = []
    for number, (line, text) in enumerate(zip(source.code(path), path.read_text().split("\n")), 1):
        if opened := NAMESPACE.match(line):
            inside.append(opened[1] or "")
        elif text.startswith("}  // namespace"):  # clang-format writes it
            inside.pop()
        elif (found := TYPE.match(line)) and "" not in inside:
            yield number, "::".join(inside), found[1]


def broken(root):
    seen = {}
    for folder in ("include", "src"):
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            for number, namespace, name in types(path):
                first = seen.setdefault((namespace, name), path)
                if first != path:
                    yield path, number, f"{namespace}::{name} is a type of {first.relative_to(root)} too"


if __name__ == "__main__":
    root = Path(sys.argv[1])
    sys.exit(source.report(root, broken(root)))
