"""Runs every example of README.md and docs/guide/*.md, and compares what comes out with what the pages say.

A fenced block is told by its first line:

    ```cpp            a whole program (it has a main)
    ```cpp body       the inside of one: the headers and `using namespace carom` are put around it
    ```json           a scene: `carom run` must end with status 0
    ```json NAME      the same, and the file NAME is there for the blocks below
    ```json into NAME keys for the scene NAME above, without braces, in place of those of the same name
    ```sh             commands, with `carom`, `./dev`, scenes/ and the page's files at hand
    ```sh fails N     commands of which the last ends with status N
    ```text           behind a cpp or sh block: all that it prints; … stands for anything, on a line of its own for
                      any lines

Blocks of other languages are only read. All C++ blocks become one program (`extract`), which ctest builds; `run` runs
everything, each page in a folder of its own; `update` does so too and writes what was printed into the text blocks.
"""

import argparse
import difflib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
TIME_LIMIT = 120


class Block:
    def __init__(self, page, line, info, text):
        words = info.split()
        self.page, self.line, self.text = page, line, text
        self.language, self.words = (words[0] if words else ""), words[1:]
        self.expected = None  # the text block behind it

    def __str__(self):
        return f"{self.page.relative_to(ROOT)}:{self.line}"


def pages():
    return [ROOT / "README.md", *sorted((ROOT / "docs" / "guide").glob("*.md"))]


def blocks_of(page):
    blocks, start, last = [], None, None
    for number, line in enumerate(page.read_text().split("\n"), 1):
        if not line.startswith("```"):
            continue
        if start is None:
            start = (number, line[3:].strip())
            continue
        lines = page.read_text().split("\n")[start[0]:number - 1]
        block = Block(page, start[0], start[1], "\n".join(lines))
        start = None
        if block.language == "text" and last is not None and last.expected is None:
            last.expected = block
        else:
            last = block if block.language in ("cpp", "sh") else None
            blocks.append(block)
    if start is not None:
        sys.exit(f"{page.relative_to(ROOT)}:{start[0]}: this block does not end")
    return blocks


# ---- C++ ------------------------------------------------------------------------------------------------------------

HEADERS = """#include <carom/carom.hpp>
#include <carom/output.hpp>
#include <carom/scene.hpp>
#include <cmath>
#include <cstdio>
"""


def cpp_blocks():
    return [block for page in pages() for block in blocks_of(page) if block.language == "cpp"]


def extract(target):
    """One source of all blocks, each in a namespace of its own, the includes in front."""
    includes, bodies, cases = set(HEADERS.splitlines()), [], []
    for k, block in enumerate(cpp_blocks()):
        lines = block.text.split("\n")
        includes.update(line for line in lines if line.startswith("#include"))
        code = "\n".join("" if line.startswith("#include") else line for line in lines)
        where = f'#line {block.line + 1} "{block.page.relative_to(ROOT)}"\n'
        if block.words == ["body"]:
            code = f"using namespace carom;\nint main() {{\n{where}{code}\nreturn 0;\n}}"
        else:
            # Only the program's own main may end without a return.
            end = code.rindex("}")
            code = f"{where}{code[:end]}return 0;\n{code[end:]}"
        bodies.append(f"namespace block_{k} {{\n{code}\n}}\n")
        cases.append(f"        if (k == {k}) return block_{k}::main();\n")
    source = "\n".join(sorted(includes)) + "\n#include <string>\n\n" + "\n".join(bodies)
    source += '#line 1 "run_docs.py"\n'
    source += "int main(int, char** arguments) {\n    const int k = std::stoi(arguments[1]);\n    try {\n"
    source += "".join(cases)
    source += "    } catch (const carom::Error& e) {\n"
    source += '        std::fprintf(stderr, "%s\\n", e.what());\n        return 1;\n    }\n    return 3;\n}\n'
    target.write_text(source)


# ---- Running --------------------------------------------------------------------------------------------------------

class Runner:
    def __init__(self, carom, program, scratch):
        self.carom, self.program, self.scratch = Path(carom).resolve(), Path(program).resolve(), Path(scratch).resolve()
        self.cpp_number = {(b.page, b.line): k for k, b in enumerate(cpp_blocks())}
        self.failures, self.count = [], 0
        shutil.rmtree(self.scratch, ignore_errors=True)
        bin_folder = self.scratch / "bin"
        bin_folder.mkdir(parents=True)
        (bin_folder / "carom").symlink_to(self.carom)
        dev = bin_folder / "dev"  # stands for ./dev: what needs no building is run, the rest must at least exist
        dev.write_text(f'''#!/bin/sh
case $1 in
    carom) shift; exec carom "$@" ;;
    tour) exec carom "$@" ;;
    *) "{ROOT}/dev" help | grep -q "^  $1 " ;;
esac
''')
        dev.chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{bin_folder}:{os.environ['PATH']}"}

    def folder(self, page):
        folder = self.scratch / page.stem
        if not folder.exists():
            folder.mkdir()
            (folder / "scenes").symlink_to(ROOT / "scenes")
            (folder / "dev").symlink_to(self.scratch / "bin" / "dev")
        return folder

    def execute(self, block, command, status=0):
        """Runs a command in the page's folder; returns what it prints."""
        self.count += 1
        try:
            done = subprocess.run(command, cwd=self.folder(block.page), env=self.environment, timeout=TIME_LIMIT,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        except subprocess.TimeoutExpired:
            self.failures.append(f"{block}: still running after {TIME_LIMIT} s")
            return ""
        if done.returncode != status:
            self.failures.append(f"{block}: ended with status {done.returncode} and not {status}; it printed\n{done.stdout}")
        return done.stdout

    def run(self, block):
        if block.language == "cpp":
            return self.execute(block, [self.program, str(self.cpp_number[block.page, block.line])])
        if block.language == "sh":
            status = int(block.words[1]) if block.words[:1] == ["fails"] else 0
            return self.execute(block, ["bash", "-eu", "-c", block.text], status)
        if block.language == "json":
            name = block.words[-1] if block.words else f"block{block.line}.json"
            file = self.folder(block.page) / name
            file.write_text(merged(file, block.text) if block.words[:1] == ["into"] else block.text)
            return self.execute(block, [self.carom, "run", name])
        return None


def merged(file, text):
    plain = lambda words: json.loads(re.sub(r"^\s*//.*$|\s//\s.*$", "", words, flags=re.M))
    scene = plain(file.read_text())
    for key, value in plain("{" + text + "}").items():
        scene[key] = value
    return json.dumps(scene, indent=2)


def matches(expected, actual):
    """Numbers are compared as they stand, but for those below 1e-11: they are rounding, and one is as good as another."""
    noise = lambda text: re.sub(r" *-?\b\d(\.\d+)?e-(1[2-9]|[2-9]\d)\b", " ~0", text)
    expected, actual = noise(expected), noise(actual)
    pattern = ""
    for line in expected.split("\n"):
        pattern += r"(?:.*\n)*" if line.strip() == "…" else re.escape(line.rstrip()).replace("…", ".*") + r"\n"
    return re.fullmatch(pattern, clean(actual) + "\n") is not None


def elided(output):
    """Without what differs from run to run, or with the last bit."""
    return re.sub(r"\bstate hash \w{16}", "state hash …", re.sub(r"\bin \d+\.\d\d s,", "in … s,", output))


def clean(output):
    return "\n".join(line.rstrip() for line in output.rstrip("\n").split("\n"))


def run(arguments):
    runner = Runner(arguments.carom, arguments.program, arguments.scratch)
    for page in pages():
        printed = {}
        for block in blocks_of(page):
            output = runner.run(block)
            if block.expected is None or output is None or matches(block.expected.text, output):
                continue
            if arguments.what == "update":
                printed[block.expected.line] = elided(clean(output))
                continue
            difference = difflib.unified_diff(block.expected.text.split("\n"), clean(output).split("\n"), "expected",
                                              "printed", lineterm="")
            runner.failures.append(f"{block.expected}: the block above prints something else\n" + "\n".join(difference))
        if printed:
            rewrite(page, printed)
    for failure in runner.failures:
        print(failure, end="\n\n")
    if any("prints something else" in failure for failure in runner.failures):
        print("If it is the page that is out of date, `./dev docs` writes what is printed now.\n")
    print(f"{runner.count} blocks run, {len(runner.failures)} failures")
    return 1 if runner.failures or runner.count == 0 else 0


def rewrite(page, printed):
    """Puts new contents into the text blocks that begin on these lines."""
    out, skipping = [], False
    for number, line in enumerate(page.read_text().split("\n"), 1):
        if skipping and line.startswith("```"):
            skipping = False
        if not skipping:
            out.append(line)
        if number in printed:
            out.append(printed[number])
            skipping = True
    page.write_text("\n".join(out))


# ---- Reference pages ------------------------------------------------------------------------------------------------

def reference(arguments):
    """The committed pages and schema are those that the program writes today."""
    scratch = Path(arguments.scratch)
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    subprocess.run([arguments.carom, "schema", "--reference", scratch], check=True)
    schema = subprocess.run([arguments.carom, "schema"], check=True, stdout=subprocess.PIPE, text=True).stdout
    (scratch / "scene.schema.json").write_text(schema)
    committed = ROOT / "docs" / "reference"
    if arguments.what == "update-reference":
        shutil.copytree(scratch, committed, dirs_exist_ok=True)
    names = {file.name for folder in (scratch, committed) for file in folder.iterdir()}
    content = lambda file: file.read_text() if file.exists() else None
    wrong = sorted(name for name in names if content(scratch / name) != content(committed / name))
    for name in wrong:
        print(f"docs/reference/{name} is not what the program writes; `./dev docs` writes it anew")
    return 1 if wrong or not names else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["extract", "run", "update", "reference", "update-reference"])
    parser.add_argument("--carom", help="the program")
    parser.add_argument("--program", help="what was built from the extracted source")
    parser.add_argument("--scratch", help="folder to run in; it is emptied")
    parser.add_argument("--to", type=Path, help="where `extract` writes the source")
    arguments = parser.parse_args()
    if arguments.what == "extract":
        extract(arguments.to)
        return 0
    return reference(arguments) if "reference" in arguments.what else run(arguments)


if __name__ == "__main__":
    sys.exit(main())
