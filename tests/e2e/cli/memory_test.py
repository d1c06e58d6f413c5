"""The memory that src/scene/memory.cpp asks for is what a run takes: not less, and not many times as much."""

import os
import resource
import subprocess
import unittest

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

    def test_files_that_were_read_took_the_memory_of_a_container(self):
        """Of what a container has, the pages of files that nobody uses are given back when they are needed."""
        files = {"memory.max": "8000000000", "memory.current": "7999000000", "memory.stat": "anon 1000\ninactive_file 7000000000\n"}
        for name, text in files.items():
            self.write(text, name)
        scene = self.write({"carom": 1, "builders": [grid(100)], "run": {"duration": 0.01, "step": 0.01}})

        def ran_in_a_container():
            mounts = " && ".join(f"mount --bind {self.path}/{name} /sys/fs/cgroup/{name}" for name in files)
            inside = f"mount -t tmpfs none /sys/fs/cgroup && cd /sys/fs/cgroup && touch {' '.join(files)} && cd - " \
                     f"&& {mounts} && touch there && exec {carom.PROGRAM} run {scene} --json"
            ran = subprocess.run(["unshare", "-m", "sh", "-c", inside], cwd=self.path, capture_output=True, text=True)
            if "there" not in self.files():
                raise unittest.SkipTest("no container can be imitated here")
            return ran

        ran = ran_in_a_container()
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        self.write("anon 7998000000\ninactive_file 1000\n", "memory.stat")
        ran = ran_in_a_container()
        self.assertEqual(ran.returncode, 2)
        self.assertIn("needs about", ran.stderr)


if __name__ == "__main__":
    carom.main()
