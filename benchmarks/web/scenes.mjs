// The two scenes: sleep off, friction 0.5, gravity 10 m/s² down, steps of 1/60 s. web.cpp builds the same.

export const dt = 1 / 60;

export const scenes = {
  // 210 boxes of 1 m, 20 in the lowest row, on the ground.
  pyramid: {
    steps: 300,
    walls: [[-50, 0, 50, 0]],
    bodies: Array.from({ length: 20 }, (_, row) =>
      Array.from({ length: 20 - row }, (_, k) => ({ box: 0.5, x: k + 0.5 * row - 9.5, y: row + 0.5 }))).flat(),
  },
  // 2000 discs of 0.5 m fall into a box of 20 m.
  rain: {
    steps: 600,
    walls: [[-10, 0, 10, 0], [-10, 0, -10, 60], [10, 0, 10, 60]],
    bodies: Array.from({ length: 2000 }, (_, k) => {
      const row = Math.floor(k / 36);
      return { disc: 0.25, x: (k % 36) * 0.55 - 9.7 + 0.1 * (row % 2), y: 0.5 + 0.55 * row };
    }),
  },
};

/// Median and mean time of a step [ms], and how high the highest body is at the end.
export function measure(step, top, steps) {
  const times = [];
  for (let k = 0; k < steps; ++k) {
    const start = performance.now();
    step();
    times.push(performance.now() - start);
  }
  const mean = times.reduce((a, b) => a + b) / steps;
  times.sort((a, b) => a - b);
  return { median: times[steps >> 1], mean, top: top() };
}
