"""The memory that src/scene/memory.cpp asks for is what a run takes: not less, and not many times as much."""

import os
import resource

import carom


def grid(n, **body):
    return {"type": "grid", "nx": n, "ny": n, "body": body}


class Memory(carom.Case):
    def peak(self, scene, memory=None):
        """Bytes that a run takes at most."""
        file = self.write(scene)
        environment = {**os.environ, **({"CAROM_MEMORY": str(memory)} if memory else {})}
        pid = os.fork()
        if pid == 0:
            os.chdir(self.path)
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            os.dup2(1, 2)
            os.execve(carom.PROGRAM, [carom.PROGRAM, "run", file, "--json"], environment)
        _, status, usage = os.wait4(pid, 0)
        return usage.ru_maxrss * 1024, os.waitstatus_to_exitcode(status)

    def test_what_is_asked_for_suffices(self):
        n = 300
        nothing, _ = self.peak({"carom": 1})
        for builder in (grid(n), grid(n, name="disc"), grid(n, radius=0.3, velocity=[1, 0.3]),
                        {"type": "lattice", "nx": n, "ny": n},
                        {"type": "lattice", "nx": n, "ny": n, "shear_stiffness": 100, "bend_stiffness": 10, "name": "cloth"},
                        {"type": "rope", "segments": n * n, "anchor_b": [1000, 0]}):
            for method in ("verlet", "rk4"):
                scene = {"carom": 1, "world": {"integrator": method}, "builders": [builder], "run": {"duration": 0.02, "step": 0.01}}
                ran = self.carom("run", self.write(scene), env={**os.environ, "CAROM_MEMORY": "1e6"})
                asked = 1e9 * float(ran.stderr.split("needs about ")[1].split(" GB")[0])
                taken, status = self.peak(scene)
                self.assertEqual(status, 0)
                what = f"{builder} with {method}: asked {asked / 1e6:.0f} MB, took {(taken - nothing) / 1e6:.0f} MB"
                self.assertLess(taken - nothing, 1.15 * asked, what)
                self.assertGreater(taken - nothing, 0.2 * asked, what)

    def test_a_document_takes_what_is_asked_for_at_most(self):
        nothing, _ = self.peak({"carom": 1})
        text = '{"carom": 1, "bodies": [' + ",".join(["0"] * 2_000_000) + "]}"
        taken, status = self.peak(text)
        self.assertEqual(status, 2)  # numbers are no bodies, but they have been read
        self.assertLess(taken - nothing, 30 * len(text))
        self.fails(2, "needs about", "run", self.write(text), env={**os.environ, "CAROM_MEMORY": "1e7"})


if __name__ == "__main__":
    carom.main()
