#include <algorithm>
#include <carom/analysis.hpp>
#include <carom/gas.hpp>
#include <vector>

namespace carom {

Vec2 momentum(const World& world) { return momentum_balance(world).total.linear; }
double angular_momentum(const World& world) { return momentum_balance(world).total.angular; }

Vec2 centre_of_mass(const World& world) {
    Vec2 sum{};
    double mass = 0;
    for (std::size_t i = 0; i < world.size(); ++i) {
        if (world.kinds()[i] != Kind::dynamic) continue;
        sum += world.masses()[i] * world.positions()[i];
        mass += world.masses()[i];
    }
    if (mass == 0) throw Error("centre_of_mass: the world must have a dynamic body, and has none");
    return sum / mass;
}

std::uint64_t state_hash(const World& world) {
    std::vector<std::size_t> order(world.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return world.ids()[a].index < world.ids()[b].index; });
    std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a, 64 bits
    const auto mix = [&hash](double value) {
        for (auto bits = __builtin_bit_cast(std::uint64_t, value), k = std::uint64_t{0}; k < 8; ++k, bits >>= 8)
            hash = (hash ^ (bits & 0xff)) * 0x100000001b3u;
    };
    for (const std::size_t i : order) {
        const Vec2 x = world.positions()[i], v = world.velocities()[i];
        for (const double value : {x.x, x.y, world.angles()[i], v.x, v.y, world.angular_velocities()[i]}) mix(value);
    }
    return hash;
}

bool is_measured(const World& world) {
    const auto kinds = world.kinds();
    constexpr std::ptrdiff_t gas = 10;
    return std::holds_alternative<Events>(world.settings().solver) &&
           std::count(kinds.begin(), kinds.end(), Kind::dynamic) >= gas;
}

}  // namespace carom
