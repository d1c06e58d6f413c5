// The exact gas: collisions per CPU second of equal elastic discs in a periodic box, by their number and the fraction
// of the area that they cover, with one thread and, of a million, with two; and the memory of a disc. `events 1000 0.5`
// for one of them, `events 1000000 0.5 2` with two threads, `events 10000 0.5 1 1e9` for so many collisions.

#include <malloc.h>

#include <atomic>
#include <carom/carom.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <new>
#include <vector>

using namespace carom;

namespace {

/// Bytes that were asked for and not given back, by all threads, and the most there were.
std::atomic<std::size_t> in_use{0}, most_in_use{0};

void* counted(void* memory) {
    if (!memory) throw std::bad_alloc();
    const std::size_t bytes = malloc_usable_size(memory), now = in_use += bytes;
    for (std::size_t most = most_in_use; now > most && !most_in_use.compare_exchange_weak(most, now);) {
    }
    return memory;
}
void give_back(void* memory) {
    in_use -= malloc_usable_size(memory);
    std::free(memory);
}

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t bytes) { return counted(std::malloc(bytes)); }
[[gnu::noinline]] void* operator new(std::size_t bytes, std::align_val_t alignment) {
    void* memory = nullptr;
    return counted(posix_memalign(&memory, static_cast<std::size_t>(alignment), bytes) == 0 ? memory : nullptr);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { give_back(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { give_back(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { give_back(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { give_back(memory); }

namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Discs of unit diameter and mass at kT = 1, from a triangular lattice: rows of it are a little apart, so that all
/// fit.
World lattice_gas(int count, double packing, int threads) {
    constexpr double pi = 3.14159265358979;
    const int columns = static_cast<int>(std::lround(std::sqrt(count * std::sqrt(0.75) / 1.0)));
    const int rows = 2 * ((count / columns + 1) / 2);
    const double n = static_cast<double>(columns) * rows;
    const double area = n * pi / 4 / packing;
    const double stretch = std::sqrt(area / (columns * rows * std::sqrt(0.75)));
    const Vec2 cell{stretch, stretch * std::sqrt(0.75)};
    World world({.solver = Events{}, .threads = threads});
    world.add(Periodic{{0, 0}, {columns * cell.x, rows * cell.y}});
    Random random(1);
    std::vector<Vec2> v;
    Vec2 sum{};
    for (int k = 0; k < columns * rows; ++k) {
        const double x = random.normal();
        v.push_back({x, random.normal()});
        sum += v.back();
    }
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            world.add(Body{.position = {(column + 0.25 + 0.5 * (row % 2)) * cell.x, (row + 0.5) * cell.y},
                           .velocity = v[static_cast<std::size_t>(row * columns + column)] - sum / n,
                           .radius = 0.5});
    return world;
}

/// For three seconds, or for so many collisions if that takes longer.
void measure(int count, double packing, int threads, double collisions = 0) {
    constexpr double seconds = 3;
    const std::size_t nothing = in_use;
    World world = lattice_gas(count, packing, threads);
    const double n = static_cast<double>(world.size());
    (void)energy(world);  // what the world derives from its bodies is not the gas's
    const std::size_t bodies = in_use;
    // Until the lattice is forgotten, some ten collisions of a disc.
    const double rho = packing * 4 / 3.14159265, rate = 3.5 * rho / ((1 - packing) * (1 - packing));
    const double step = 8 / rate;
    for (int k = 0; k < 2; ++k) world.step(step);
    const double before = energy(world).kinetic;
    most_in_use = in_use.load();
    const auto hits = world.collisions();
    const auto begin = std::chrono::steady_clock::now();
    const double start = cpu_seconds();
    double spent = 0, done = 0;
    do {
        world.step(step);
        spent = cpu_seconds() - start;
        done = static_cast<double>(world.collisions() - hits);
    } while (spent < seconds || done < collisions);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf(
        "%8.0f discs, packing %.2f, threads %d: %6.3f million collisions per CPU second, %6.3f per second of wall "
        "clock, energy 1 %+.0e, momentum %.0e of a disc's after %.2g collisions; %.1f bytes a disc, and %.0f that the "
        "world has of a body\n",
        n, packing, threads, done / spent * 1e-6, done / wall * 1e-6, energy(world).kinetic / before - 1,
        length(momentum(world)), done, static_cast<double>(most_in_use - bodies) / n,
        static_cast<double>(bodies - nothing) / n);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc >= 3) {
        measure(std::atoi(argv[1]), std::atof(argv[2]), argc > 3 ? std::atoi(argv[3]) : 1,
                argc > 4 ? std::atof(argv[4]) : 0);
        return 0;
    }
    for (const double packing : {0.1, 0.5, 0.7})
        for (const int count : {1000, 10000, 100000, 1000000}) measure(count, packing, 1);
    measure(1000000, 0.5, 2);
}
