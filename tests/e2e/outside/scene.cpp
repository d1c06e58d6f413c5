#include <carom/carom.hpp>
#include <carom/output.hpp>
#include <carom/scene.hpp>

int main() {
    const carom::Scene scene = carom::Scene::parse(R"({"carom": 1, "bodies": [{"name": "ball", "velocity": [3, 4]}]})");
    carom::World world = scene.world();
    carom::run(world, 1, 0.1);
    carom::draw(world, carom::fit(world), "ball.png");
    return carom::energy(world).kinetic == 12.5 ? 0 : 1;
}
