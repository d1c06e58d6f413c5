#include <carom/carom.hpp>
#include <cstdio>

int main() {
    carom::World world({.gravity = {0, -9.81}});
    const auto ball = world.add(carom::Body{.position = {0, 20}, .velocity = {3, 0}});
    carom::run(world, 2, 0.01);
    const carom::Vec2 x = world.position(ball);
    std::printf("after %g s the ball is at (%g, %g) m\n", world.time(), x.x, x.y);
    return x.y < 0.39 && x.y > 0.37 ? 0 : 1;  // 20 − ½ · 9.81 · 2²
}
