"""A function fits on a screen and a file in a head. Tables of numbers (*_tables.hpp, tables.cpp) are no reading."""

import re
import sys
from pathlib import Path

import source

LONGEST_FUNCTION = 60
LONGEST_FILE = 500
FOLDERS = ("include", "src", "apps", "tests", "examples", "benchmarks", "python", "web")

# A brace after these opens a scope in which functions are defined; after anything else with (…), a function.
SCOPE = re.compile(r"^\s*(inline\s+)?(namespace|class|struct|union|enum|extern)\b|^\s*(template\b.*>)?\s*(class|struct)\b")


def functions(lines):
    """First and last line of every function that is in no other function."""
    scopes = []  # of each open brace: the line on which its statement began if it is a function, else None
    statement, began = "", 1
    for number, line in enumerate(lines, 1):
        for sign in line:
            if sign == "{":
                inside = any(scopes)
                opens = not inside and "(" in statement and not SCOPE.match(statement) and "=" not in statement.split("(")[0]
                scopes.append(began if opens else None)
                statement = ""
            elif sign == "}":
                start = scopes.pop() if scopes else None
                if start:
                    yield start, number
                statement = ""
            elif sign == ";" and statement.count("(") <= statement.count(")"):
                statement = ""
            else:
                if not statement.strip():
                    statement, began = "", number
                statement += sign
        if line.lstrip().startswith("#"):
            statement = ""
        statement += " "


def broken(root):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".cpp", ".hpp", ".py", ".ts", ".js") or path.stem.endswith("tables"):
                continue
            if "node_modules" in path.parts:
                continue
            length = len(path.read_text().splitlines())
            if length > LONGEST_FILE:
                yield path, length, f"a file of {length} lines; at most {LONGEST_FILE}"
            if path.suffix not in (".cpp", ".hpp"):
                continue
            for first, last in functions(source.code(path)):
                if last - first + 1 > LONGEST_FUNCTION:
                    yield path, first, f"a function of {last - first + 1} lines; at most {LONGEST_FUNCTION}"


if __name__ == "__main__":
    root = Path(sys.argv[1])
    sys.exit(source.report(root, broken(root)))
