"""What is compiled into Carom of other libraries has a name of its own: a program that has the same library as well,
compiled with other options, would lend us its code or have ours, for a linker takes one of two that are alike."""

import re
import subprocess
import sys

# In a mangled name a namespace stands behind its length. (carom_fmt is 9carom_fmt.)
FOREIGN = re.compile(r"(?<!\d)(?:3fmt|5Eigen|8nlohmann)")


def broken(library):
    # What is shared shows a table of its own, and no other is linked with.
    table = ["--dynamic"] if ".so" in library else ["--extern-only"]
    done = subprocess.run(["nm", *table, "--defined-only", library], check=True, capture_output=True, text=True)
    for line in done.stdout.splitlines():
        if FOREIGN.search(line):
            name = subprocess.run(["c++filt", line.split()[-1]], capture_output=True, text=True).stdout.strip()
            yield f"{library}: defines {name} under the name of others (carom_headers_only in cmake/options.cmake)"


if __name__ == "__main__":
    words = sorted({line for library in sys.argv[1:] for line in broken(library)})
    print(*words, sep="\n")
    sys.exit(bool(words))
