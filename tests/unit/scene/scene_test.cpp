#include <gtest/gtest.h>

#include <carom/analysis.hpp>
#include <carom/scene.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scene/kinds.hpp"

namespace {

using namespace carom;

const std::string small = R"({"carom": 1, "parameters": {"speed": 2, "double": "2*speed"},
    "bodies": [{"name": "ball", "velocity": ["double", 0]}, {"name": "a[1].b", "kind": "fixed"}],
    "builders": [{"type": "notebook-gas", "count": 3, "body": {"name": "disc"}},
                 {"type": "gas", "fill": {"count": 2, "body": {"name": "atom"}}}],
    "walls": [{"type": "half-plane"}]})";

template <class F>
std::string error_in(F f) {
    try {
        f();
    } catch (const Error& e) {
        EXPECT_EQ(e.cause(), Error::Cause::input);
        return e.what();
    }
    return "none";
}
std::string wrong(const std::string& rest) {
    return error_in([&] { Scene::parse("{\"carom\": 1, " + rest + "}", "f").world(); });
}
std::string cannot_set(const std::string& name, const std::string& value) {
    return error_in([&] {
        Scene scene = Scene::parse(small, "f");
        scene.set(name, value);
        scene.world();
    });
}

TEST(Scene, ErrorsOfTheDocument) {
    EXPECT_EQ(error_in([] { Scene::parse("[]", "f"); }), "f: must be an object, got []");
    EXPECT_EQ(error_in([] { Scene::parse("{}", "f"); }),
              "f: must have the field \"carom\": 1, the version of the format");
    EXPECT_EQ(error_in([] { Scene::parse(R"({"carom": 2})", "f"); }),
              "f: carom must be 1, the version of the format, got 2");
    EXPECT_EQ(wrong(R"("bodys": [])"), "f: has no field \"bodys\"; did you mean 'bodies'?");
    EXPECT_EQ(wrong(R"("bodies": {})"), "f: bodies must be a list, got {}");
    EXPECT_EQ(wrong(R"("bodies": null)"), "f: bodies must be a list, got null");
    EXPECT_EQ(wrong(R"("world": [])"), "f: world must be an object, got []");
    EXPECT_EQ(wrong(R"("title": 3)"), "f: title must be a text, got 3");
    EXPECT_EQ(wrong(R"("seed": -1)"), "f: seed must be a whole number from 0 to 2147483647, got -1");
    EXPECT_EQ(wrong(R"("seed": 2147483648)"), "f: seed must be a whole number from 0 to 2147483647, got 2147483648");
    EXPECT_EQ(wrong(R"("seed": null)"), "f: seed must be a whole number from 0 to 2147483647, got null");
    EXPECT_EQ(wrong(R"("run": {"duration": 1e300, "step": 1e-9})"),
              "f: run.duration must be at most 1e+15 steps of 1e-09 s, got 1e+300 s");
}

TEST(Scene, ErrorsOfTheParameters) {
    EXPECT_EQ(wrong(R"("parameters": {"a b": 1})"),
              "f: parameters has the name \"a b\", and a parameter's name is of letters, digits and _");
    EXPECT_EQ(wrong(R"("parameters": {"t": 1})"),
              "f: parameters has the name \"t\", which means something else in an expression");
    EXPECT_EQ(wrong(R"("parameters": {"pi": 3})"),
              "f: parameters has the name \"pi\", which means something else in an expression");
    EXPECT_EQ(wrong(R"("parameters": {"a": "b", "b": 1})"),
              "f: parameters.a must be a finite number or an expression of the parameters, got \"b\": 'b' comes later: "
              "an expression knows the parameters before it");
    EXPECT_EQ(wrong(R"("parameters": {"a": true})"), "f: parameters.a must be a finite number, got true");
}

TEST(Scene, ErrorsOfTheWorld) {
    EXPECT_EQ(wrong(R"("bodies": [{"name": "a"}, {"name": "a"}])"),
              "f: bodies[1].name must be unique, and there is a body 'a' already");
    EXPECT_EQ(wrong(R"("bodies": [{"kind": "fixed", "velocity": [1, 0]}])"),
              "f: bodies[0].velocity must be 0 for a fixed body (a driven one keeps a velocity)");
    EXPECT_EQ(wrong(R"("forces": [{}])"),
              "f: forces[0] must have the field \"type\": one of spring, torsion-spring, drag, attraction, soft-discs, "
              "constant, "
              "field, drive");
    EXPECT_EQ(wrong(R"("forces": [3])"), "f: forces[0] must be an object with a \"type\", got 3");
    EXPECT_EQ(wrong(R"("walls": [{"type": "rectangel"}])"),
              "f: walls[0].type must be one of rectangle, half-plane, stadium, periodic, got \"rectangel\"; did you "
              "mean 'rectangle'?");
    EXPECT_EQ(wrong(R"("walls": [{"type": "rectangle", "low": [2, 2]}])"),
              "f: walls[0].high must lie above and right of low (2, 2) [m], got (1, 1)");
    EXPECT_EQ(wrong(R"("bodies": [{"name": "a"}], "forces": [{"type": "drive", "body": "a", "x": "t"}])"),
              "f: forces[0] is wrong: World::drive: the body 'a' must be of kind driven");
    // Of one letter any other was as near.
    EXPECT_EQ(wrong(R"("forces": [{"type": "field", "y": "-z"}])"),
              "f: forces[0].y must be an expression of x, y, vx, vy, m, t and the parameters, got \"-z\": there is no "
              "'z' here");
    EXPECT_EQ(wrong(R"("parameters": {"m": 1}, "forces": [{"type": "field", "y": "m"}])"),
              "f: forces[0].y must be an expression of x, y, vx, vy, m, t and the parameters, got \"m\": 'm' is a "
              "variable here, and the "
              "parameter of that name needs another one");
    EXPECT_EQ(wrong(R"("builders": [{"type": "grid", "nx": 10000000, "ny": 10000000, "body": {}}])").substr(0, 66),
              "f: builders[0] needs about 9e+07 GB for 100000000000000 bodies, an");
}

TEST(Scene, NamesTheSolverThatItNeedsIfItNamesNone) {
    const auto is_soft = [](const std::string& rest) {
        const std::string box = R"({"name": "crate", "shapes": [{"type": "box"}]})";
        const std::string text = "{\"carom\": 1, \"bodies\": [" + box + "]" + rest + "}";
        return std::holds_alternative<SoftStep>(Scene::parse(text, "f").world().settings().solver);
    };
    EXPECT_TRUE(is_soft(R"(, "walls": [{"type": "half-plane"}])"));
    EXPECT_TRUE(is_soft(R"(, "world": {"gravity": [0, -1]}, "joints": [{"type": "revolute", "b": "crate"}])"));
    EXPECT_FALSE(is_soft(""));  // it meets nothing
    EXPECT_FALSE(is_soft(R"(, "world": {"solver": "none"}, "walls": [{"type": "half-plane"}])"));
}

TEST(Scene, ErrorsOfExpectationsAndPictures) {
    EXPECT_EQ(wrong(R"("expects": [{"value": 1}])"),
              "f: expects[0] must have the field \"quantity\": what is expected to have a value");
    // It was taken for 0.
    EXPECT_EQ(wrong(R"("expects": [{"quantity": "t"}])"),
              "f: expects[0] must have the field \"value\": what the quantity is expected to be");
    EXPECT_EQ(wrong(R"("expects": [{"quantity": "t", "statistic": "avg"}])"),
              "f: expects[0].statistic must be one of end, maximum, minimum, mean, zero, got \"avg\"");
    EXPECT_EQ(wrong(R"("pictures": [{"type": "phase", "quantities": ["t"]}])"),
              "f: pictures[0].quantities must be two, got 1");
    EXPECT_EQ(wrong(R"("pictures": [{"type": "time"}])"), "f: pictures[0].quantities must be one or more, got 0");
    EXPECT_EQ(wrong(R"("twins": [{"quantity": "t"}])"),
              "f: twins[0] must have the field \"formula\": the quantity's closed form");
    EXPECT_EQ(wrong(R"("pictures": [{"name": "../x"}])"),
              "f: pictures[0].name must be the name of a file, without a folder, got \"../x\"");
}

TEST(Scene, SetReachesAnyPlace) {
    Scene scene = Scene::parse(small);
    scene.set("speed", "5");
    EXPECT_EQ(scene.world().velocity(scene.world().find("ball")).x, 10);
    scene.set("speed", "1/4");
    EXPECT_EQ(scene.world().velocity(scene.world().find("ball")).x, 0.5);
    scene.set("parameters.speed", "3");
    EXPECT_EQ(scene.parameters().at("speed"), 3);
    scene.set("bodies.ball.velocity", "[7, \"-speed\"]");
    EXPECT_EQ(scene.world().velocity(scene.world().find("ball")), (Vec2{7, -3}));
    scene.set("bodies.ball.velocity[1]", "speed + 1");
    EXPECT_EQ(scene.world().velocity(scene.world().find("ball")), (Vec2{7, 4}));
    scene.set("bodies[0].mass", "9");
    EXPECT_EQ(scene.world().body(scene.world().find("ball")).mass, 9);
    scene.set("bodies.a[1].b.position", "[1, 1]");
    EXPECT_EQ(scene.world().position(scene.world().find("a[1].b")), (Vec2{1, 1}));
    scene.set("builders.disc.count", "5");
    scene.set("builders[1].fill.count", "4");
    EXPECT_EQ(scene.world().size(), 11u);
    scene.set("builders.atom.fill.count", "3");
    EXPECT_EQ(scene.world().size(), 10u);
    scene.set("title", "another one");
    EXPECT_EQ(scene.title(), "another one");
    scene.set("seed", "7");
    EXPECT_EQ(scene.seed(), 7);
    scene.set("expects", "[]");
    EXPECT_TRUE(scene.expectations().empty());
}

TEST(Scene, SetMakesWhatIsNotThereYet) {
    Scene scene = Scene::parse(small);
    scene.set("world.gravity", "[0, -1.6]");
    EXPECT_EQ(scene.world().settings().gravity, (Vec2{0, -1.6}));
    scene.set("world.solver", "impulse");
    scene.set("world.solver.time_of_impact", "false");
    EXPECT_FALSE(std::get<Impulse>(scene.world().settings().solver).time_of_impact);
    scene.set("walls[0].side.restitution", "0.5");
    EXPECT_EQ(scene.world().half_planes()[0].side.restitution, 0.5);
    scene.set("run.duration", "3");
    EXPECT_EQ(scene.plan().duration, 3);
}

TEST(Scene, SetSaysWhatItCannot) {
    EXPECT_EQ(cannot_set("sped", "1"), "f: has no parameter \"sped\"; did you mean 'speed'?");
    EXPECT_EQ(cannot_set("qqqqq", "1"), "f: has no parameter \"qqqqq\"; it has speed, double");
    EXPECT_EQ(cannot_set("ball.mass", "1"),
              "f: \"ball.mass\" cannot be set: it is within a list; did you mean 'bodies.ball.mass'?");
    EXPECT_EQ(cannot_set("wrld.gravity", "1"), "f: has no field \"wrld\"; did you mean 'world'?");
    EXPECT_EQ(cannot_set("world.gravty", "[0, 1]"), "f: world has no field \"gravty\"; did you mean 'gravity'?");
    EXPECT_EQ(cannot_set("bodies.bal.mass", "1"),
              "f: \"bodies.bal.mass\" cannot be set: the list has 2 items and no \"bal\"; did you mean 'ball'?");
    EXPECT_EQ(cannot_set("bodies[2].mass", "1"),
              "f: \"bodies[2].mass\" cannot be set: the list has 2 items and no \"2\"");
    EXPECT_EQ(cannot_set("bodies[99999999999].mass", "1"),
              "f: \"bodies[99999999999].mass\" cannot be set: the list has 2 items and no \"99999999999\"");
    EXPECT_EQ(cannot_set("carom.x", "1"), "f: \"carom.x\" cannot be set: \"x\" is inside of 1, which has no parts");
    EXPECT_EQ(cannot_set("bodies.ball.mass", "-1"), "f: bodies[0].mass must be a number > 0 in kg, got -1");
    EXPECT_EQ(cannot_set("bodies.ball.velocity", "[0, -g]"),
              "bodies.ball.velocity:1:6: syntax error while parsing value - invalid number; expected digit after '-'; "
              "last read: '-g'");
    EXPECT_EQ(cannot_set("run.step", "nan"),
              "f: run.step must be a number > 0 in s or an expression of the parameters, got \"nan\": there is no "
              "'nan' here");
    EXPECT_EQ(cannot_set("title", "3"), "f: title must be a text, got 3");
    for (const char* odd :
         {".", "[", "]", "..", "[[", "bodies[", "bodies[0", "bodies[]", "bodies.", "a.b.c.d", "bodies]0[", "world[0]"})
        EXPECT_NE(cannot_set(odd, "1"), "none") << odd;
}

TEST(Scene, AfterAnErrorItIsAsItWas) {
    Scene scene = Scene::parse(small);
    const std::string before = scene.text();
    for (const char* name : {"wrld.gravity", "run.step", "speed", "world.solver.x", "carom", "bodies.ball.q"}) {
        EXPECT_THROW(
            {
                scene.set(name, "no such thing");
                scene.world();
            },
            Error);
        if (std::string(name) != "bodies.ball.q") {  // which only the world can judge
            EXPECT_EQ(scene.text(), before) << name;
        }
    }
}

TEST(Scene, ItsTextIsCanonical) {
    for (const char* name : {"gas", "projectiles", "spring-pendulum"}) {
        const Scene scene = Scene::load(std::string(CAROM_SOURCE_DIR "/scenes/") + name + ".json");
        EXPECT_EQ(Scene::parse(scene.text()).text(), scene.text());
        EXPECT_EQ(state_hash(Scene::parse(scene.text()).world()), state_hash(scene.world()));
    }
}

TEST(Scene, FunctionsOfAScenesForcesAreCopiedWithTheWorld) {
    const Scene scene =
        Scene::parse(R"({"carom": 1, "parameters": {"k": 2}, "bodies": [{"name": "b", "position": [1, 0]}],
        "forces": [{"type": "field", "x": "-k*x", "potential": "k/2*x^2"}]})");
    auto first = std::make_unique<World>(scene.world());
    World copy = *first;
    first->step(0.1);
    const auto hash = state_hash(*first);
    first.reset();
    copy.step(0.1);
    EXPECT_EQ(state_hash(copy), hash);
    EXPECT_NEAR(energy(copy).total(), 1, 1e-3);
}

TEST(Scene, AWorldAsASceneHasTheSameBits) {
    World world({.gravity = {0, -9.81}, .integrator = Rk4{}});
    const BodyId a =
        world.add(Body{.position = {0.1, 2}, .velocity = {1.0 / 3, 0}, .mass = 0.7, .radius = 0.2, .friction = 0.3});
    world.add(
        Body{.kind = Kind::fixed, .position = {0, 5}, .name = "body0"});  // the name that the first would have got
    const BodyId b = world.add(Body{.position = {3, 1}, .angle = 0.4, .charge = 2, .name = "b"});
    world.add(Spring{.a = a, .b = b, .anchor_a = {0.1, 0}, .stiffness = 30, .rest_length = 1, .damping = 0.1});
    world.add(Drag{.linear = 0.1, .wind = {1, 0}});
    world.add(Attraction{.strength = 3, .softening = 0.1});
    world.add(ConstantForce{.body = b, .force = {0, 1}});
    world.add(HalfPlane{.point = {0, -1}});
    World again = Scene::parse(Scene::of(world, "saved").text()).world();
    EXPECT_EQ(state_hash(again), state_hash(world));
    for (int n = 0; n < 50; ++n) world.step(0.01), again.step(0.01);
    EXPECT_EQ(state_hash(again), state_hash(world));
}

TEST(Scene, ABodyWithShapesAsASceneHasTheSameBits) {
    World world({.solver = NoContact{}});
    const Shape blade{.geometry = Box{.width = 0.1, .height = 0.7, .centre = {0.3, 0.2}, .angle = 0.1}, .density = 7.};
    const Shape hilt{
        .geometry = Hull{.points = {{0, 0}, {0.3, 0}, {0.1, 0.4}, {0.1, 0.1}}}, .density = 3., .sensor = true};
    world.add(Body{.position = {1, 2}, .angle = 0.3, .angular_velocity = 2, .shapes = {blade, hilt}, .name = "knife"});
    world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = Chain{.points = {{-1, 0}, {0, 0.1}, {1, 0}}}}}});
    const Scene saved = Scene::of(world);
    World again = Scene::parse(saved.text()).world();
    EXPECT_EQ(Scene::of(again).text(), saved.text());
    EXPECT_EQ(state_hash(again), state_hash(world));
    for (int n = 0; n < 20; ++n) world.step(0.01), again.step(0.01);
    EXPECT_EQ(state_hash(again), state_hash(world));
}

TEST(Scene, FunctionsOfCppCannotBeSaved) {
    World world;
    world.add(ForceField{.force = [](Vec2, Vec2, double, double) { return Vec2{}; }});
    EXPECT_THROW(Scene::of(world), Error);
}

TEST(Quantity, KnowsBodiesAccountsAndParameters) {
    World world({.gravity = {0, -10}});
    world.add(Body{.position = {1, 2}, .velocity = {3, 4}, .mass = 2, .name = "my ball"});
    world.add(Body{.position = {5, 0}, .angle = 0.5, .angular_velocity = 2, .radius = 1, .name = "disc[0]"});
    const auto value = [&](const std::string& text) { return Quantity(text, world, {{"k", 7}})(world); };
    EXPECT_EQ(value("'my ball'.x + 'my ball'.y"), 3);
    EXPECT_EQ(value("'my ball'.speed"), 5);
    EXPECT_EQ(value("disc[0].angle*disc[0].omega"), 1);
    EXPECT_EQ(value("energy.kinetic"), 25);
    EXPECT_EQ(value("energy.gravity"), 40);
    EXPECT_EQ(value("energy.rotational"), 1);
    EXPECT_EQ(value("energy.total - energy.initial_total - energy.residual"), 0);
    EXPECT_EQ(value("momentum.x + momentum.y"), 14);
    EXPECT_EQ(value("bodies + steps + collisions + t"), 2);
    EXPECT_EQ(value("k"), 7);
    for (const char* name : {"heat.damping", "heat.drag", "heat.impact", "heat.friction", "heat.total", "work.driven",
                             "work.wind", "work.user", "work.overlap", "work.total"})
        EXPECT_EQ(value(std::string("energy.") + name), 0) << name;
}

// A mass of 2 kg on a rod that is 5 m long, of which 3 are aside: it bears what is along it.
TEST(Scene, AnchorsBesideAtWereLeftOutWithoutAWord) {
    const auto joined = [](const std::string& rest) {
        return wrong(R"("bodies": [{"name": "b", "radius": 1, "position": [1, 0]}],
                        "joints": [{"b": "b", "type": "revolute", )" +
                     rest + "}]");
    };
    const std::string said =
        "f: joints[0].at is the point of the world that both anchors are in: give either it, or anchor_a and anchor_b";
    EXPECT_EQ(joined(R"("at": [0, 0], "anchor_a": [5, 5], "anchor_b": [7, 7])"), said);
    EXPECT_EQ(joined(R"("at": [0, 0], "anchor_b": [7, 7])"), said);
    EXPECT_EQ(joined(R"("at": [0, 0], "anchor_a": [0, 0])"), "none");
    EXPECT_EQ(joined(R"("anchor_a": [2, 0], "anchor_b": [1, 0])"), "none");
}

TEST(Quantity, KnowsWhatJointsBear) {
    World world({.gravity = {0, -10}, .solver = SoftStep{}});
    const BodyId bob = world.add(Body{.position = {3, -4}, .mass = 2});
    const JointId rod = world.add(Joint{.name = "rod", .b = bob, .type = DistanceJoint{}});
    world.step(1e-6);
    const auto value = [&](const std::string& text) { return Quantity(text, world, {})(world); };
    EXPECT_NEAR(value("rod.force"), 16, 1e-9);
    EXPECT_NEAR(value("rod.force.x"), -16 * 0.6, 1e-9);
    EXPECT_NEAR(value("rod.force.y"), 16 * 0.8, 1e-9);
    EXPECT_NEAR(value("rod.coordinate"), 5, 1e-9);
    EXPECT_NEAR(value("rod.torque + rod.gap"), 0, 1e-12);
    const Quantity force("rod.force", world, {}), gap("rod.gap", world, {});
    world.remove(rod);
    EXPECT_EQ(force(world), 0);
    EXPECT_TRUE(std::isnan(gap(world)));
}

TEST(Quantity, SaysWhichNameItDoesNotKnow) {
    World world({.solver = SoftStep{}});
    const BodyId ball = world.add(Body{.name = "ball"});
    world.add(Joint{.name = "pin", .b = ball, .type = RevoluteJoint{}});
    const auto wrong_quantity = [&](const std::string& text) {
        return error_in([&] { Quantity(text, world, {{"speed", 1}}); });
    };
    EXPECT_EQ(wrong_quantity("bal.x"), "in \"bal.x\": there is no body 'bal'; did you mean 'ball'?");
    EXPECT_EQ(wrong_quantity("pni.force"), "in \"pni.force\": there is no joint 'pni'; did you mean 'pin'?");
    EXPECT_EQ(wrong_quantity("pin.froce"), "in \"pin.froce\": there is no 'pin.froce'; did you mean 'pin.force'?");
    EXPECT_EQ(wrong_quantity("ball.z"), "in \"ball.z\": there is no 'ball.z'; did you mean 'ball.x'?");
    // A quantity that there is not had no word about those that there are.
    EXPECT_EQ(wrong_quantity("pin.tension"),
              "in \"pin.tension\": there is no 'pin.tension'; "
              "a joint has .force.x .force.y .force .torque .coordinate .gap");
    EXPECT_EQ(wrong_quantity("ball.momentum"),
              "in \"ball.momentum\": there is no 'ball.momentum'; a body has .x .y .vx .vy .angle .omega .speed");
    EXPECT_EQ(wrong_quantity("energy.kinetc"),
              "in \"energy.kinetc\": there is no 'energy.kinetc'; did you mean 'energy.kinetic'?");
    EXPECT_EQ(wrong_quantity("vx"), "in \"vx\": there is no 'vx'; of the body 'ball' it is ball.vx");
    EXPECT_EQ(wrong_quantity("spee"), "in \"spee\": there is no 'spee'; did you mean 'speed'?");
    EXPECT_EQ(wrong_quantity("1 +"), "in \"1 +\": expected a number, a name or (, and there it ends");
}

// It made a parameter that nothing used, and the scene ran as it was.
TEST(Scene, SetOfAParameterThatIsNotThereWasTaken) {
    Scene scene = Scene::parse(small, "f");
    EXPECT_EQ(error_in([&] { scene.set("parameters.sped", "5"); }),
              "f: has no parameter \"sped\"; did you mean 'speed'?");
}

// nlohmann's own exception ended the program.
TEST(Scene, TextThatIsNoUtf8) {
    Scene scene = Scene::parse(small, "f");
    EXPECT_EQ(error_in([&] { scene.set("title", "\xff"); }), "title: must be a text in UTF-8, got \"\xef\xbf\xbd\"");
    EXPECT_EQ(error_in([&] { scene.set("title", "[\"\xff\"]"); }).substr(0, 7), "title: ");
    EXPECT_NE(error_in([&] { scene.set("bodies.ball.\xff", "1"); }), "none");
    EXPECT_NE(error_in([&] { scene.set("expects", "\xff"); }), "none");
    EXPECT_EQ(Scene::parse(scene.text()).text(), scene.text());
    scene.set("title", "größe");
    EXPECT_EQ(scene.title(), "größe");

    World world({.solver = SoftStep{}});
    const BodyId body = world.add(Body{.name = "\xff"});
    const std::string shown = "must be a text in UTF-8, got \"\xef\xbf\xbd\"";
    EXPECT_EQ(error_in([&] { Scene::of(world); }), "Scene::of: bodies[0].name " + shown);
    world.set(body, Body{.name = "ball"});
    EXPECT_EQ(error_in([&] { Scene::of(world, "\xff"); }), "Scene::of: title " + shown);
    world.add(Joint{.name = "\xff", .b = body, .type = RevoluteJoint{}});
    EXPECT_EQ(error_in([&] { Scene::of(world); }), "Scene::of: joints[0].name " + shown);
}

TEST(Quantity, NamesABodyWhoseNameHasAQuote) {
    World world;
    world.add(Body{.position = {3, 0}, .name = "Newton's apple"});
    world.add(Body{.position = {4, 0}, .name = "''"});
    world.add(Body{.position = {5, 0}, .name = "2nd"});
    world.add(Body{.position = {6, 0}, .name = "größe[1]"});
    EXPECT_EQ(Quantity("'Newton''s apple'.x", world)(world), 3);
    EXPECT_EQ(error_in([&] { Quantity("Newton's apple.x", world); }),
              "in \"Newton's apple.x\": expected another ' after this one at character 7, got 's apple.x; the body "
              "'Newton's apple' is written in quotes in an expression: 'Newton''s apple'.x");
    for (const BodyId id : world.ids())
        EXPECT_EQ(Quantity(in_expression(world.body(id).name) + ".x", world)(world), world.position(id).x);
    EXPECT_EQ(in_expression("größe[1]"), "größe[1]");
    EXPECT_EQ(in_expression("'"), "''''");
}

// ---- Schema and reference -------------------------------------------------------------------------------------------

TEST(Schema, IsJsonAndNamesAllFields) {
    const std::string schema = scene_schema();
    EXPECT_TRUE(nlohmann::json::accept(schema));
    std::string pages;
    for (const auto& [name, text] : reference_pages()) pages += text;
    const auto look = [&](const auto& f) {
        EXPECT_NE(schema.find(std::string("\"") + f.name + "\""), std::string::npos) << f.name;
        EXPECT_NE(pages.find(std::string("| `") + f.name + "` |"), std::string::npos) << f.name;
        EXPECT_NE(pages.find(std::string(f.text).substr(0, std::string(f.text).find_first_of("|<"))), std::string::npos)
            << f.text;
    };
    const auto look_at = [&]<class T>(const T&) {
        std::apply([&](const auto&... f) { (look(f), ...); }, fields(static_cast<const T*>(nullptr)));
    };
    const auto look_at_all = [&](const auto& types) {
        std::apply(
            [&]<class... T>(const Type<T>&... type) {
                (look_at(T{}), ...);
                ((void)type, ...);
            },
            types);
    };
    look_at(Settings{});
    look_at(Plan{});
    look_at(Body{});
    look_at(Expectation{});
    look_at(Twin{});
    look_at(Picture{});
    look_at(Side{});
    look_at(Impulse{});
    look_at(Adaptive{});
    look_at(Shape{});
    look_at(Filter{});
    look_at(Box{});
    look_at(Chain{});
    look_at_all(wall_types);
    look_at_all(force_types);
    look_at_all(builder_types);
    for (const TopKey& key : top_keys)
        EXPECT_NE(pages.find(std::string("| `") + key.name + "` |"), std::string::npos) << key.name;
    for (const auto& c : choices(static_cast<const Statistic*>(nullptr)))
        EXPECT_NE(pages.find(c.text), std::string::npos) << c.text;
}

TEST(Reference, AFieldThatIsRequiredHadADefault) {
    const auto pages = reference_pages();
    const auto says = [&](const char* page, const std::string& row) {
        EXPECT_NE(pages.at(page).find(row), std::string::npos) << page << ": " << row;
    };
    says("scene.md", "| `value` | number |  | a finite number | **required** | what is expected, in SI units |");
    says("scene.md", "| `formula` | text |  |  | **required** |");
    says("forces.md", "| `a` | body's name |  |  | **required** | body at one end |");
    says("shapes.md", "| `points` | list of [x, y] | m | a finite number | **required** | its corners");
    says("scene.md", "| `tolerance` | number |  | a number >= 0 | `0.0` |");
    EXPECT_EQ(nlohmann::json::parse(scene_schema())["properties"]["expects"]["items"]["required"].dump(),
              R"(["quantity","value"])");
    EXPECT_EQ(wrong(R"("bodies": [{"shapes": [{"type": "chain"}]}])"),
              "f: bodies[0].shapes[0] must have the field \"points\": where it leads");
}

TEST(Reference, TablesHaveAsManyCellsAsColumns) {
    for (const auto& [name, text] : reference_pages()) {
        std::istringstream lines(text);
        std::size_t columns = 0;
        for (std::string line; std::getline(lines, line);) {
            std::size_t bars = 0;
            for (std::size_t i = 0; i < line.size(); ++i) bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
            if (line.starts_with("| field") || line.starts_with("| function")) columns = bars;
            if (line.starts_with("|")) {
                EXPECT_EQ(bars, columns) << name << ": " << line;
            }
        }
    }
}

}  // namespace
