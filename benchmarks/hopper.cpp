// Granular flow: gravel of 1.8 to 2 cm runs out of a hopper, a rough funnel of 45° that opens by 20 of them. SoftStep
// at four substeps, beside LAMMPS with gran/hooke on the same discs for the same time (benchmarks/hopper.lmp), whose
// steps have to be a 25th of a contact's duration.
//
// `hopper [DISCS] [SECONDS] [THREADS]` runs it; `hopper write FILE [DISCS]` writes LAMMPS's data.

#include <algorithm>
#include <carom/carom.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

using namespace carom;

namespace {

constexpr double d = 0.02;  // m

struct Grain {
    Vec2 at;
    double radius;
    bool fixed;
};

std::vector<Grain> hopper(int discs) {
    constexpr double opening = 20 * d, width = 250 * d, slant = (width - opening) / 2;
    std::vector<Grain> grains;
    const int along = static_cast<int>(slant * std::sqrt(2) / d);
    const double filled = discs / 250.0 * 0.9 * d;
    for (const double side : {-1.0, 1.0}) {
        for (int i = 0; i <= along; ++i) {
            const double out = i * d / std::sqrt(2);
            grains.push_back({{side * (opening / 2 + d / 2 + out), out}, d / 2, true});
        }
        for (double y = slant; y < slant + filled + 20 * d; y += d)
            grains.push_back({{side * (width / 2 + d / 2), y}, d / 2, true});
    }
    Random random(1);
    const double pitch = 1.02 * d, rise = pitch * std::sqrt(0.75);
    for (int row = 0, count = 0; count < discs; ++row) {
        const double y = d + row * rise, half = std::min(opening / 2 + y, width / 2) - 1.2 * d;
        const double shift = row % 2 ? pitch / 2 : 0;
        for (double x = -std::floor((half + shift) / pitch) * pitch + shift; x <= half && count < discs;
             x += pitch, ++count)
            grains.push_back({{x, y}, random.uniform(0.45, 0.5) * d, false});
    }
    return grains;
}

int write(const char* file, int discs) {
    const std::vector<Grain> grains = hopper(discs);
    std::FILE* out = std::fopen(file, "w");
    if (!out) return std::perror(file), 1;
    std::fprintf(out, "hopper\n\n%zu atoms\n2 atom types\n-3 3 xlo xhi\n-3 30 ylo yhi\n-0.01 0.01 zlo zhi\n\nAtoms\n\n",
                 grains.size());
    for (std::size_t i = 0; i < grains.size(); ++i)
        std::fprintf(out, "%zu %d %.9g 2600 %.9g %.9g 0\n", i + 1, grains[i].fixed ? 2 : 1, 2 * grains[i].radius,
                     grains[i].at.x, grains[i].at.y);
    return std::fclose(out);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 2 && std::strcmp(argv[1], "write") == 0) return write(argv[2], argc > 3 ? std::atoi(argv[3]) : 100000);
    const int discs = argc > 1 ? std::atoi(argv[1]) : 100000;
    const double seconds = argc > 2 ? std::atof(argv[2]) : 0.5;
    const int threads = argc > 3 ? std::atoi(argv[3]) : 1;
    if (discs < 1 || seconds <= 0 || threads < 1) {
        std::fputs("usage: hopper [DISCS] [SECONDS] [THREADS], or hopper write FILE [DISCS]\n", stderr);
        return 2;
    }
    constexpr double dt = 1.0 / 240;
    World world({.gravity = {0, -10}, .solver = SoftStep{}, .threads = threads});
    for (const Grain& grain : hopper(discs))
        world.add(Body{.kind = grain.fixed ? Kind::fixed : Kind::dynamic,
                       .position = grain.at,
                       .radius = grain.radius,
                       .restitution = 0.5,
                       .friction = 0.5});
    const auto start = std::chrono::steady_clock::now();
    const int steps = static_cast<int>(std::lround(seconds / dt));
    for (int n = 0; n < steps; ++n) world.step(dt);
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto at = world.positions();
    const auto out = std::count_if(at.begin(), at.end(), [](Vec2 x) { return x.y < 0; });
    std::printf(
        "%d discs, %d threads: %.3g s in %d steps took %.1f s: %.3g of the time; %.2f ms a step; %td have run out\n",
        discs, threads, seconds, steps, took, took / seconds, 1e3 * took / steps, out);
}
