"""Reading C++ for the rules."""

import re

TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.S)


def code(path):
    """The lines of a file, comments and the contents of literals blanked out (digit separators survive: 1'000)."""

    def blank(match):
        text = match[0]
        if text[0] == "'" and match.start() and match.string[match.start() - 1].isalnum():
            return text
        return re.sub(r"[^\n]", " ", text)

    return TOKEN.sub(blank, path.read_text()).split("\n")


def report(root, broken):
    """Prints what is broken and returns the exit status."""
    broken = list(broken)
    for path, line, words in broken:
        print(f"{path.relative_to(root)}:{line}: {words}")
    return bool(broken)
