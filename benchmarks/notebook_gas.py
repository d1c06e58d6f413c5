"""The gas as a notebook writes it: numpy vectors, two nested loops over pairs in Python. Milliseconds a step.

Radii 1 : 4, packing fraction 0.3, elastic, a step of 1/240 s, as in gas.cpp. Needs Debian's python3-numpy:
    /usr/bin/python3 benchmarks/notebook_gas.py [DISCS...]
"""

import sys
import time

import numpy as np


class Disc:
    def __init__(self, position, velocity, radius):
        self.position, self.velocity, self.radius = position, velocity, radius
        self.mass = radius**2


def make(count):
    random = np.random.RandomState(99)
    radii = random.uniform(0.5, 2, count)
    side = np.sqrt(np.pi * np.sum(radii**2) / 0.3)
    discs = []
    for radius in radii:
        while True:
            at = random.uniform(radius, side - radius, 2)
            if all(np.linalg.norm(at - d.position) > radius + d.radius for d in discs):
                break
        discs.append(Disc(at, 3 * random.randn(2), radius))
    return discs, side


def step(discs, side, dt):
    for d in discs:
        d.position = d.position + d.velocity * dt
        for axis in range(2):
            if d.position[axis] < d.radius or d.position[axis] > side - d.radius:
                d.position[axis] = np.clip(d.position[axis], d.radius, side - d.radius)
                d.velocity[axis] = -d.velocity[axis]
    for i, a in enumerate(discs):
        for b in discs[i + 1:]:
            apart = b.position - a.position
            distance = np.linalg.norm(apart)
            overlap = a.radius + b.radius - distance
            if overlap <= 0:
                continue
            normal = apart / distance
            a.position = a.position - 0.5 * overlap * normal
            b.position = b.position + 0.5 * overlap * normal
            push = 2 * np.dot(a.velocity - b.velocity, normal) / (1 / a.mass + 1 / b.mass)
            a.velocity = a.velocity - push / a.mass * normal
            b.velocity = b.velocity + push / b.mass * normal


def energy(discs):
    return sum(0.5 * d.mass * np.dot(d.velocity, d.velocity) for d in discs)


for count in [int(n) for n in sys.argv[1:]] or [25, 100, 400, 1000]:
    discs, side = make(count)
    before = energy(discs)
    steps = max(2, 200000 // count**2)
    start = time.perf_counter()
    for _ in range(steps):
        step(discs, side, 1 / 240)
    spent = (time.perf_counter() - start) / steps
    print(f"{count:6d} discs  {1e3 * spent:10.3f} ms a step, energy kept {energy(discs) / before:.6f}")
