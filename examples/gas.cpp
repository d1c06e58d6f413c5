// A hundred elastic discs in a box for a minute: impacts at their instants keep the energy to rounding, and the same
// world run twice ends in the same bits.
#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>
#include <cstdio>

int main() {
    using namespace carom;
    World world;
    world.add(Rectangle{.low = {0, 0}, .high = {10, 10}});
    build(world,
          Gas{.fill = {.low = {0, 0}, .high = {10, 10}, .count = 100, .smallest_radius = 0.2, .largest_radius = 0.2},
              .temperature = 1});
    World twin = world;  // a world is a value: this one lives on its own
    const double start = energy(world).kinetic;

    run(world, 60, 1.0 / 60);
    run(twin, 60, 1.0 / 60);

    double deepest = 0;
    for (std::size_t i = 0; i < world.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            deepest = std::max(deepest, 0.4 - length(world.positions()[i] - world.positions()[j]));

    const double kept = energy(world).kinetic / start;
    std::printf("%llu impacts, kinetic energy end/start = 1 %+.1e, deepest overlap %.1e m\n",
                static_cast<unsigned long long>(world.collisions()), kept - 1, deepest);
    const bool right = world.collisions() > 5000 && std::abs(kept - 1) < 1e-12 && deepest < 1e-12 &&
                       state_hash(world) == state_hash(twin);
    return right ? 0 : 1;
}
