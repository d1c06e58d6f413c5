#include <carom/carom.hpp>
#include <carom/output.hpp>
#include <carom/scene.hpp>

int main(int, char** arguments) {
    const carom::Scene scene = carom::Scene::parse(R"({"carom": 1, "bodies": [{"name": "ball", "velocity": [3, 4]}]})");
    carom::World world = scene.world();
    carom::run(world, 1, 0.1);
    carom::draw(world, carom::fit(world), "ball.png");
    carom::World installed = carom::Scene::load(arguments[1]).world();
    carom::run(installed, 1, 0.01);
    return carom::energy(world).kinetic == 12.5 && installed.size() > 0 ? 0 : 1;
}
