// A bob on an undamped spring for a minute, under every integrator: how much energy each makes or loses.
#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>
#include <cstdio>
#include <iterator>

double worst_residual(const carom::Integrator& method) {
    using namespace carom;
    World world({.gravity = {0, -9.8}, .integrator = method});
    const BodyId anchor = world.add(Body{.kind = Kind::fixed, .position = {0, 8}});
    const BodyId bob = world.add(Body{.position = {4, 8}, .velocity = {2, 0}});
    world.add(Spring{.a = anchor, .b = bob, .stiffness = 15, .rest_length = 4});
    double worst = 0;
    run(world, 60, 0.02, [&](const World& now) { worst = std::max(worst, std::abs(energy(now).residual)); });
    return worst;
}

int main() {
    using namespace carom;
    struct Claim {
        Integrator method;
        double at_least, at_most;  // J, of some 60 J that go to and fro
    };
    const Claim claims[] = {
        {Euler{}, 10, 1e9},       {SymplecticEuler{}, 0.1, 3}, {Verlet{}, 1e-3, 0.1}, {Pefrl{}, 0, 1e-5},
        {Rk4{}, 0, 1e-3},         {RungeKutta{}, 0, 1e-4},     {Adaptive{}, 0, 1e-5}, {Nystrom{}, 0, 1e-11},
        {GaussRadau{}, 0, 1e-11}, {Implicit{}, 0, 1e-9}};
    static_assert(std::size(claims) == std::variant_size_v<Integrator>, "every integrator has its claim");
    bool right = true;
    for (const Claim& claim : claims) {
        const double worst = worst_residual(claim.method);
        std::visit([&](const auto& m) { std::printf("%-18s%10.1e J\n", m.name, worst); }, claim.method);
        right = right && worst >= claim.at_least && worst <= claim.at_most;
    }
    return right ? 0 : 1;
}
