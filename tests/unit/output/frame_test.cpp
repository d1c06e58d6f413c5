#include <sys/wait.h>

#include <cmath>

#include "helpers.hpp"

namespace carom {
namespace {

using Frames = OutputTest;
constexpr Colour red{200, 0, 0, 255}, green{0, 150, 0, 255}, white{255, 255, 255, 255};

View plain(Vec2 low, Vec2 high) {
    View view{.low = low, .high = high, .width = 400, .height = 300};
    view.caption = false;
    return view;
}

TEST_F(Frames, DiscIsAtItsPlaceInItsSizeAndColour) {
    World world;
    world.add(Body{.position = {3, 2}, .radius = 0.5, .colour = red});
    const View view = plain({0, 0}, {4, 3});
    EXPECT_DOUBLE_EQ(view.scale(), 100);
    draw(world, view, path("a.png"));
    const Pixels pixels(path("a.png"));
    EXPECT_EQ(pixels.at(300, 100), red);
    const auto [left, right, top, bottom] = pixels.extent(white);
    EXPECT_EQ(std::tuple(left, right, top, bottom), std::tuple(0, 399, 0, 299));
    // Along its diameters the first pixel that is not white.
    double first = 0, last = 399;
    while (pixels.at(first, 100) == white) ++first;
    while (pixels.at(last, 100) == white) --last;
    EXPECT_NEAR(first, 250, 1);
    EXPECT_NEAR(last, 349, 1);
    first = 0;
    while (pixels.at(300, first) == white) ++first;
    EXPECT_NEAR(first, 50, 1);
    const double area = 400.0 * 300 - static_cast<double>(pixels.count(white));
    EXPECT_NEAR(area, 3.14159 * 50 * 50, 0.03 * area);
}

TEST_F(Frames, RadiusShowsTheAngle) {
    World world;
    world.add(Body{.position = {2, 1.5}, .angle = 1.5707963, .radius = 1, .friction = 0.5, .colour = red});
    draw(world, plain({0, 0}, {4, 3}), path("a.png"));
    const Pixels pixels(path("a.png"));
    EXPECT_EQ(pixels.at(200, 110), white) << "no radius to the top, where it points";
    for (Vec2 other : {Vec2{200, 190}, Vec2{160, 150}, Vec2{240, 150}}) EXPECT_EQ(pixels.at(other.x, other.y), red);
}

/// The colour of a picture of 4 × 3 m at a place.
struct At {
    const Pixels& pixels;
    Colour operator()(double x, double y) const { return pixels.at(100 * x, 300 - 100 * y); }
};

TEST_F(Frames, ShapesAreAsTheyAre) {
    const std::vector<Vec2> corner{{0, 0}, {1, 0}, {1, 0.2}, {0.2, 0.2}, {0.2, 1}, {0, 1}};
    World world;
    const auto add = [&](Vec2 position, double angle, Geometry geometry) {
        // Held, or it would be moved to its centre of mass.
        world.add({.kind = Kind::driven, .position = position, .angle = angle, .shapes = {{geometry}}, .colour = red});
    };
    add({0.6, 2}, 0.7853981633974483, Box{.width = 0.8, .height = 0.2});
    add({0.6, 0.6}, 0, Capsule{.a = {-0.3, 0}, .b = {0.3, 0}, .radius = 0.2});
    add({1.5, 0.2}, 0, Polygon{.points = corner});
    add({3, 0.6}, 0, Box{.width = 1, .height = 0.8, .rounding = 0.4});
    add({3, 2}, 0, Hull{.points = {{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}, {0.2, 0.3}}, .rounding = 0.1});
    add({2, 2}, 0, Disc{.centre = {0, 0.3}, .radius = 0.3});
    draw(world, plain({0, 0}, {4, 3}), path("a.png"));
    const Pixels pixels(path("a.png"));
    const At at{pixels};
    for (const Vec2 in : {Vec2{0.8, 2.2}, Vec2{0.6, 0.75}, Vec2{0.17, 0.6}, Vec2{2.4, 0.3}, Vec2{1.6, 1.1},
                          Vec2{2.55, 0.6}, Vec2{3.3, 0.85}, Vec2{2.95, 2.2}, Vec2{3.4, 2.55}, Vec2{2, 2.5}})
        EXPECT_EQ(at(in.x, in.y), red) << in.x << ", " << in.y;
    for (const Vec2 out :
         {Vec2{0.8, 1.8}, Vec2{0.13, 0.75}, Vec2{1.8, 0.5}, Vec2{2.55, 0.95}, Vec2{2.92, 1.92}, Vec2{2, 1.95}})
        EXPECT_EQ(at(out.x, out.y), white) << out.x << ", " << out.y;
}

TEST_F(Frames, LinesAndSensorsCanBeTold) {
    World world;
    world.add({.kind = Kind::fixed, .shapes = {{.geometry = Chain{.points = {{0, 1}, {4, 1}}}}}});
    world.add({.kind = Kind::fixed, .shapes = {{.geometry = Segment{{0, 2}, {4, 2}}}}});
    world.add({.position = {2, 2.5},
               .shapes = {{.geometry = Box{.width = 2, .height = 0.4}, .sensor = true}},
               .colour = red});
    draw(world, plain({0, 0}, {4, 3}), path("a.png"));
    const Pixels pixels(path("a.png"));
    const At at{pixels};
    EXPECT_NE(at(2, 1), white);
    EXPECT_NE(at(2, 2), white);
    int above = 0, below = 0, rim = 0;
    for (double x = 0.1; x < 3.9; x += 0.01) {
        above += at(x, 1.04) != white || at(x, 2.04) != white || at(x, 1.96) != white;
        below += at(x, 0.96) != white;
        rim += x > 1.1 && x < 2.9 && at(x, 2.695) != at(2, 2.5);
    }
    EXPECT_EQ(above, 0);
    EXPECT_GT(below, 20) << "the ground of a chain is not seen";
    EXPECT_GT(rim, 60);
    EXPECT_LT(rim, 150) << "not dashed";
    EXPECT_GT(at(2, 2.5).g, 200) << "a sensor hides what is in it";
    EXPECT_NE(at(2, 2.5), white);
}

TEST_F(Frames, BoundsAreThoseOfTheShapes) {
    World world;
    world.add(
        {.kind = Kind::driven,
         .position = {10, 5},
         .angle = 1.5707963267948966,
         .shapes = {{.geometry = Box{.width = 4, .height = 2}}, {.geometry = Disc{.centre = {3, 0}, .radius = 1}}}});
    const Bounds seen = bounds(world);
    EXPECT_NEAR(seen.low.x, 9, 1e-2);
    EXPECT_NEAR(seen.high.x, 11, 1e-2);
    EXPECT_NEAR(seen.low.y, 3, 1e-2);
    EXPECT_NEAR(seen.high.y, 9, 1e-2);
}

TEST_F(Frames, SceneKeepsItsProportionsInAnyPicture) {
    const View wide{.low = {0, 0}, .high = {1, 1}, .width = 900, .height = 336};
    EXPECT_DOUBLE_EQ(wide.scale(), 300);  // 36 pixels for the caption
    EXPECT_EQ(wide.pixel({0.5, 0.5}), (Vec2{450, 150}));
    EXPECT_EQ(wide.pixel({1, 1}), (Vec2{600, 0}));
}

TEST_F(Frames, TrailStoppedAtThePeriodicEdge) {
    World world;
    world.add(Periodic{.low = {0, 0}, .high = {4, 3}});
    View view = plain({0, 0}, {4, 3});
    view.tracks = {{.points = {{3.2, 1}, {5, 1}, {5.2, 1}}, .colour = red}};  // out on the right, in on the left
    draw(world, view, path("a.png"));
    const Pixels pixels(path("a.png"));
    const At at{pixels};
    for (const double x : {3.5, 3.95, 0.05, 0.5, 1.1}) EXPECT_NE(at(x, 1), white) << x;
    for (const double x : {1.4, 2.0, 3.0}) EXPECT_EQ(at(x, 1), white) << x;
}

TEST_F(Frames, ForcesHadNoScale) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = Box{4, 0.2}}}});
    world.add(Body{.position = {0, 0.6}, .shapes = {{.geometry = Box{1, 1}}}, .colour = Colour{0, 0, 255, 255}});
    for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
    const auto reds = [&](bool forces) {
        View view{.low = {-2, -1}, .high = {2, 2}, .width = 400, .height = 336};
        view.contact_forces = forces;
        draw(world, view, path("a.png"));
        const Pixels pixels(path("a.png"));
        int count = 0;
        for (int x = 0; x < 400; ++x)
            for (int y = 302; y < 334; ++y) {  // in the caption
                const Colour c = pixels.at(x, y);
                count += c.r > 150 && c.g < 60;
            }
        return count;
    };
    EXPECT_GT(reds(true), 20);
    EXPECT_EQ(reds(false), 0);
}

TEST_F(Frames, WallsAreWhereTheyAre) {
    World world;
    world.add(HalfPlane{.point = {0, 1}, .normal = {0, 2}});
    draw(world, plain({0, 0}, {4, 3}), path("a.png"));
    const Pixels floor(path("a.png"));
    EXPECT_EQ(floor.at(50, 197), white);
    EXPECT_NE(floor.at(50, 201), white);
    EXPECT_NE(floor.at(50, 280), white);

    World slope;
    slope.add(HalfPlane{.point = {2, 1.5}, .normal = {-1, 1}});
    draw(slope, plain({0, 0}, {4, 3}), path("b.png"));
    const Pixels ramp(path("b.png"));
    EXPECT_EQ(ramp.at(200 - 50, 150 - 0), white);  // left of the wall, which rises to the right
    EXPECT_EQ(ramp.at(200 + 50, 150 - 60), white);
    EXPECT_NE(ramp.at(200 + 50, 150 - 40), white);
    EXPECT_NE(ramp.at(200 + 50, 150), white);

    World room;
    room.add(Rectangle{{1, 1}, {3, 2}});
    draw(room, plain({0, 0}, {4, 3}), path("c.png"));
    const Pixels box(path("c.png"));
    for (Vec2 inside : {Vec2{102, 150}, Vec2{298, 150}, Vec2{200, 102}, Vec2{200, 198}}) {
        EXPECT_EQ(box.at(inside.x, inside.y), white);
    }
    for (Vec2 outside : {Vec2{98, 150}, Vec2{301, 150}, Vec2{200, 98}, Vec2{200, 201}, Vec2{5, 5}}) {
        EXPECT_NE(box.at(outside.x, outside.y), white);
    }
}

TEST_F(Frames, PeriodicBoxShowsBothHalvesOfADisc) {
    World world;
    world.add(Periodic{{0, 0}, {4, 3}});
    world.add(Body{.position = {4.1 + 8, 1.5}, .radius = 0.5, .colour = red});  // two boxes away
    draw(world, plain({-1, -0.75}, {5, 3.75}), path("a.png"));
    const Pixels pixels(path("a.png"));
    const View view = plain({-1, -0.75}, {5, 3.75});
    const auto colour = [&](Vec2 at) { return pixels.at(view.pixel(at).x, view.pixel(at).y); };
    EXPECT_EQ(colour({0.1, 1.5}), red);
    EXPECT_EQ(colour({3.8, 1.5}), red);
    EXPECT_EQ(colour({-0.2, 1.5}), white) << "drawn outside of the box";
    EXPECT_EQ(colour({2, 1.5}), white);
}

TEST_F(Frames, SpringsJoinTheirBodies) {
    const auto dark = [&](int springs) {
        World world;
        const auto a = world.add(Body{.kind = Kind::fixed, .position = {1, 1}});
        const auto b = world.add(Body{.position = {3, 1}});
        for (int i = 0; i < springs; ++i) world.add(Spring{.a = a, .b = b, .rest_length = 1});
        draw(world, plain({0, 0}, {4, 3}), path("a.png"));
        const Pixels pixels(path("a.png"));
        std::array<int, 2> beside{};
        for (int x = 130; x < 270; ++x) {
            beside[0] += pixels.at(x, 200) != white;
            beside[1] += pixels.at(x, 205) != white;
        }
        return beside;
    };
    EXPECT_EQ(dark(0), (std::array{0, 0}));
    EXPECT_GT(dark(1)[1], 10) << "a coil is wider than a line";
    EXPECT_GT(dark(300)[0], 130) << "many are straight lines";
    EXPECT_EQ(dark(300)[1], 0);
}

// A spring of 1e11 N/m stands for a rod: the weight of a kilogram stretches it by 1e-10 m.
TEST_F(Frames, ASpringThatNothingStretchesIsDrawnAsARod) {
    const auto beside = [&](double stiffness, double g) {
        World world({.gravity = {0, -g}});
        const auto a = world.add(Body{.kind = Kind::fixed, .position = {1, 1}});
        const auto b = world.add(Body{.position = {3, 1}});
        world.add(Spring{.a = a, .b = b, .stiffness = stiffness, .rest_length = 2});
        draw(world, plain({0, 0}, {4, 3}), path("a.png"));
        const Pixels pixels(path("a.png"));
        int count = 0;
        for (int x = 130; x < 270; ++x) count += pixels.at(x, 205) != white;
        return count;
    };
    EXPECT_EQ(beside(1e11, 9.81), 0);
    EXPECT_GT(beside(1e3, 9.81), 10);
    EXPECT_GT(beside(1e11, 0), 10) << "where nothing weighs, nobody knows what would stretch it";
}

TEST_F(Frames, KindsLookDifferent) {
    std::vector<std::string> pictures;
    for (Kind kind : {Kind::dynamic, Kind::fixed, Kind::driven}) {
        for (double radius : {0.0, 0.5}) {
            World world;
            world.add(Body{.kind = kind, .position = {2, 1.5}, .radius = radius});
            draw(world, plain({0, 0}, {4, 3}), path("a.png"));
            pictures.push_back(contents(path("a.png")));
        }
    }
    std::sort(pictures.begin(), pictures.end());
    EXPECT_EQ(std::unique(pictures.begin(), pictures.end()), pictures.end());
}

TEST_F(Frames, ABobWasHiddenByThePinOfItsRod) {
    for (const double radius : {0.0, 0.02}) {
        World world;
        const BodyId bob = world.add(Body{.position = {3, 1}, .radius = radius, .colour = red});
        world.add(Joint{.b = bob, .anchor_a = {1, 2}, .type = DistanceJoint{}});
        draw(world, plain({0, 0}, {4, 3}), path("a.png"));
        const Pixels pixels(path("a.png"));
        EXPECT_EQ(pixels.at(300, 200), red);
        EXPECT_EQ(pixels.at(100, 100), white) << "the rod hangs on a pin";
    }
}

// A sleeper's colour is two parts of grey to one of its own, and it wakes with its own.
TEST_F(Frames, SleepersAreGrey) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{.point = {0, 0.2}, .side = {.restitution = 0, .friction = 0.5}});
    const BodyId id = world.add(Body{
        .position = {2, 0.7}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0, .friction = 0.5, .colour = red});
    const auto colour = [&] {
        draw(world, plain({0, 0}, {4, 3}), path("a.png"));
        return Pixels(path("a.png")).at(220, 230);
    };
    EXPECT_EQ(colour(), red);
    run(world, 2, 1.0 / 60);
    ASSERT_TRUE(world.asleep(id));
    const Colour grey = colour();
    EXPECT_NEAR(grey.r, (2 * 200 + red.r) / 3, 1);
    EXPECT_NEAR(grey.g, 2 * 200 / 3, 1);
    EXPECT_NEAR(grey.b, 2 * 200 / 3, 1);
    world.set_velocity(id, {0, 0.1}, 0);
    EXPECT_EQ(colour(), red);
}

TEST_F(Frames, NoForceHadAKey) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(Body{.position = {0, 1}, .radius = 0.5, .colour = green});
    const View view{.low = {-2, -1}, .high = {2, 2}, .contact_forces = true};
    draw(world, view, path("a.png"));
    const Colour arrow{200, 0, 40, 255};
    EXPECT_EQ(Pixels(path("a.png")).count(arrow), 0u);
    world.add(HalfPlane{.point = {0, 0.5}});
    run(world, 0.1, 0.01);
    draw(world, view, path("a.png"));
    EXPECT_GT(Pixels(path("a.png")).count(arrow), 100u);
}

TEST_F(Frames, CaptionTellsTimeAndScale) {
    World world;
    world.add(Body{.radius = 1});
    world.step(0.25);
    draw(world, View{.low = {-4, -3}, .high = {4, 3}}, path("a.pdf"));
    auto text = output_of("pdftotext " + path("a.pdf").string() + " -");
    std::erase(text, ' ');  // pdftotext guesses them
    EXPECT_CONTAINS(text, "t=0.250s");
    EXPECT_CONTAINS(text, "1m");
    EXPECT_CONTAINS(output_of("pdfinfo " + path("a.pdf").string()), "800 x 600 pts");
}

TEST_F(Frames, SvgHasItsSize) {
    World world;
    draw(world, plain({0, 0}, {4, 3}), path("a.svg"));
    EXPECT_CONTAINS(contents(path("a.svg")), "viewBox=\"0 0 400 300\"");
    EXPECT_EQ(output_of("xmllint --noout " + path("a.svg").string() + " 2>&1"), "");
}

TEST_F(Frames, FitShowsEverythingThereIs) {
    World world({.gravity = {0, -9.81}});
    world.add(Body{.position = {-30, 8}, .radius = 2});
    world.add(Body{.position = {5, 3}});
    world.add(HalfPlane{});
    const View view = fit(world);
    const auto inside = [&](Vec2 point) {
        const Vec2 at = view.pixel(point);
        return at.x >= 0 && at.y >= 0 && at.x <= view.width && at.y <= view.height - 36;
    };
    for (Vec2 point : {Vec2{-32, 8}, Vec2{-30, 10}, Vec2{5, 3}, Vec2{-12, 0}}) EXPECT_TRUE(inside(point));
    EXPECT_EQ(std::max(view.width, view.height), 800);
    EXPECT_GT(37 * view.scale(), 0.9 * view.width) << "much of the picture is empty";

    world.add(Rectangle{{-100, -50}, {100, 50}});
    const Bounds room = bounds(world);
    EXPECT_EQ(room.low, (Vec2{-100, -50}));
    EXPECT_EQ(room.high, (Vec2{100, 50}));
    const Bounds both = join(room, {{0, 0}, {200, 1}});
    EXPECT_EQ(both.high, (Vec2{200, 50}));
    EXPECT_GT(fit(World{}).scale(), 0);
}

TEST_F(Frames, NameWhatIsWrong) {
    World world;
    EXPECT_CONTAINS(error_of([&] { draw(world, plain({0, 0}, {4, 3}), path("a.jpg")); }, Error::Cause::input), "a.jpg");
    error_of([&] { draw(world, plain({0, 0}, {0, 3}), path("a.png")); }, Error::Cause::input);
    error_of([&] { draw(world, plain({0, 0}, {NAN, 3}), path("a.png")); }, Error::Cause::input);
    View vast = plain({0, 0}, {4, 3});
    vast.width = 100000;
    EXPECT_CONTAINS(error_of([&] { draw(world, vast, path("a.png")); }, Error::Cause::input), "100000");
    for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
        const auto words = error_of([&] { draw(world, plain({0, 0}, {4, 3}), path("no") / name); });
        EXPECT_CONTAINS(words, "No such file or directory");
    }
    EXPECT_TRUE(files().empty());
}

TEST_F(Frames, SayThatTheDiskIsFull) {
    World world;
    for (const char* ending : {".png", ".svg", ".pdf"}) {
        const auto full = path(std::string("full") + ending);
        make_full_device(full);
        const auto words = error_of([&] { draw(world, plain({0, 0}, {4, 3}), full); });
        EXPECT_CONTAINS(words, "No space left on device");
    }
    for (const char* ending : {".mp4", ".webm", ".gif"}) {
        const auto full = path(std::string("full") + ending);
        make_full_device(full);
        const auto words = error_of([&] {
            Movie movie(full, plain({0, 0}, {4, 3}));
            for (int i = 0; i < 3; ++i) movie.add(world);
            movie.commit();
        });
        EXPECT_CONTAINS(words, "No space left on device");
    }
}

World crossing() {
    World world;
    world.add(Body{.position = {0, 1.5}, .velocity = {4, 0}, .radius = 0.3, .colour = green});
    return world;
}

TEST_F(Frames, FilmHasAFrameForEachAdd) {
    for (const char* name : {"a.mp4", "a.webm", "a.gif"}) {
        World world = crossing();
        View view = plain({0, 0}, {4, 3});
        view.width = 401;  // odd, which mp4 cannot have
        Movie movie(path(name), view, 20);
        for (int i = 0; i < 17; ++i) {
            movie.add(world);
            world.step(0.05);
        }
        EXPECT_FALSE(std::filesystem::exists(path(name)));
        movie.commit();
        const auto facts =
            output_of("ffprobe -v error -count_frames -show_entries stream=nb_read_frames,r_frame_rate -of csv=p=0 " +
                      path(name).string());
        EXPECT_EQ(facts, "20/1,17\n") << name;
        // The tenth frame: at 0.5 s the disc is in the middle.
        output_of("ffmpeg -v error -i " + path(name).string() + " -vf 'select=eq(n\\,10)' -frames:v 1 " +
                  path("frame.png").string());
        const Colour middle = Pixels(path("frame.png")).at(200, 150);
        EXPECT_NEAR(middle.r, green.r, 8) << name;
        EXPECT_NEAR(middle.g, green.g, 8) << name;
        EXPECT_NEAR(middle.b, green.b, 8) << name;
        std::filesystem::remove(path("frame.png"));
    }
    EXPECT_EQ(files().size(), 3u);
}

TEST_F(Frames, FilmShowsTheTrailOfTheLastSeconds) {
    World world = crossing();
    View view = plain({0, 0}, {4, 3});
    view.trail = 0.25;
    Movie movie(path("a.gif"), view, 20);
    for (int i = 0; i <= 15; ++i) {
        movie.add(world);
        world.step(0.05);
    }
    movie.commit();
    output_of("ffmpeg -v error -i " + path("a.gif").string() + " -vf 'select=eq(n\\,15)' -frames:v 1 " +
              path("frame.png").string());
    const Pixels pixels(path("frame.png"));  // the disc is at x = 3 m = 300 pixels
    EXPECT_EQ(pixels.at(300, 150), green);
    EXPECT_NE(pixels.at(250, 150), white);
    EXPECT_EQ(pixels.at(180, 150), white) << "longer than the last 0.25 s";
}

TEST_F(Frames, UnfinishedFilmLeavesNothing) {
    std::ofstream(path("a.mp4")) << "old";
    {
        World world = crossing();
        Movie movie(path("a.mp4"), plain({0, 0}, {4, 3}));
        movie.add(world);
    }
    EXPECT_EQ(contents(path("a.mp4")), "old");
    EXPECT_EQ(files().size(), 1u);
    Movie empty(path("b.mp4"), plain({0, 0}, {4, 3}));
    EXPECT_CONTAINS(error_of([&] { empty.commit(); }, Error::Cause::input), "a film without a frame");
}

TEST_F(Frames, FilmCommittedTwiceTookTheEndOfAnotherChild) {
    const World world;
    Movie movie(path("a.mp4"), plain({0, 0}, {4, 3}));
    movie.add(world);
    movie.commit();
    const pid_t child = ::fork();
    if (child == 0) ::_exit(3);
    EXPECT_CONTAINS(error_of([&] { movie.commit(); }, Error::Cause::input), "a.mp4: the film is whole already");
    EXPECT_CONTAINS(error_of([&] { movie.add(world); }, Error::Cause::input), "a.mp4: the film is whole already");
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(WEXITSTATUS(status), 3);
}

TEST_F(Frames, FilmSaysWhatFailed) {
    const View view = plain({0, 0}, {4, 3});
    EXPECT_CONTAINS(error_of([&] { Movie(path("a.avi"), view); }, Error::Cause::input), "a.avi");
    error_of([&] { Movie(path("a.mp4"), view, 0); }, Error::Cause::input);
    EXPECT_CONTAINS(error_of([&] { Movie(path("no/a.mp4"), view); }), "No such file or directory");
    {
        const WithPath nowhere(folder_.string());
        EXPECT_CONTAINS(error_of([&] { Movie(path("a.mp4"), view); }),
                        "ffmpeg failed, which films need: it is not installed (or not in PATH)");
    }
    // Dies after the first frame: the pipe breaks, which would end this process too.
    const auto fake = path("bin");
    std::filesystem::create_directory(fake);
    std::ofstream(fake / "ffmpeg") << "#!/bin/sh\nhead -c 100 >/dev/null\necho 'No space left on device' >&2\nexit 1\n";
    std::filesystem::permissions(fake / "ffmpeg", std::filesystem::perms::owner_all);
    const WithPath first(fake.string() + ":/usr/bin:/bin");
    const World world = crossing();
    const auto words = error_of([&] {
        Movie movie(path("a.mp4"), view);
        for (int i = 0; i < 100; ++i) movie.add(world);
        movie.commit();
    });
    EXPECT_CONTAINS(words, "No space left on device");
    EXPECT_EQ(files().size(), 1u);
}

}  // namespace
}  // namespace carom
