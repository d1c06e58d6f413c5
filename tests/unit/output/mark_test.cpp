// Bodies, paths and walls in the plane of a figure.

#include <cmath>

#include "helpers.hpp"
#include "output/layout.hpp"

namespace carom {
namespace {

using Marks = OutputTest;

TEST_F(Marks, ALargeDiscHidItsPath) {
    const Track track{.points = {{0, 0}, {2, 0}, {2, 1}, {2, 0}}, .radius = 3, .colour = Colour{0, 114, 178, 255}};
    save(trajectory_figure({&track, 1}), path("a.png"));
    const Pixels pixels(path("a.png"));
    const auto [left, right, top, bottom] = pixels.extent(*track.colour);
    // From the middle of the disc, where the path ends, to its start: that part was below the disc.
    std::size_t seen = 0;
    for (double x = left; x <= right; ++x)
        for (double y = top; y <= bottom; ++y)
            if (const Colour c = pixels.at(x, y); c.r < 20 && c.b > 150) {
                ++seen;
                break;
            }
    EXPECT_GT(static_cast<double>(seen), 0.95 * (right - left));
    EXPECT_GT(right - left, 150);
    EXPECT_LT(pixels.count(*track.colour), 4000u) << "the disc is paler than its path";
}

TEST_F(Marks, ABodyThatNeverMovesHasNoStart) {
    const std::vector<Track> tracks{{.points = {{1, 1}, {1, 1}}, .radius = 1, .colour = Colour{0, 114, 178, 255}},
                                    {.points = {{3, 1}, {4, 1}}, .radius = 1, .colour = Colour{230, 159, 0, 255}}};
    const Panel panel = trajectory_figure(tracks).panels[0];
    EXPECT_EQ(panel.curves.size(), 3u) << "two paths and one ring";
    EXPECT_EQ(panel.discs[0].fill, *tracks[0].colour);
    EXPECT_NE(panel.discs[1].fill, *tracks[1].colour);
}

TEST_F(Marks, DiscsInSnapshotsDidNotShowHowTheyAreTurned) {
    World world;
    world.add(
        {.position = {2, 2}, .angle = 0.5 * M_PI, .radius = 1, .friction = 0.5, .colour = Colour{200, 0, 0, 255}});
    world.add({.position = {6, 2}, .radius = 1, .colour = Colour{0, 150, 0, 255}});  // slides, and does not turn
    world.add({.kind = Kind::fixed, .position = {9, 2}, .radius = 1, .friction = 0.5});
    const Moment now = moment_of(world);
    ASSERT_TRUE(now.discs[0].angle);
    EXPECT_FALSE(now.discs[1].angle || now.discs[2].angle);
    save(snapshot_figure({&now, 1}), path("a.png"));
    const Pixels pixels(path("a.png"));
    const auto [left, right, top, bottom] = pixels.extent({200, 0, 0, 255});
    const double x = 0.5 * (left + right), y = 0.5 * (top + bottom), r = 0.5 * (right - left);
    const auto bright = [&](Vec2 at) {
        bool any = false;
        for (int dx = -2; dx <= 2; ++dx)
            for (int dy = -2; dy <= 2; ++dy) any |= pixels.at(at.x + dx, at.y + dy).g > 100;
        return any;
    };
    EXPECT_TRUE(bright({x, y - 0.5 * r})) << "the radius points up";
    EXPECT_FALSE(bright({x, y + 0.5 * r}));
    EXPECT_FALSE(bright({x + 0.5 * r, y}));
    // A disc of two pixels has no room for it.
    Moment far = now;
    far.discs.push_back({{500, 2}, 1, {}});
    save(snapshot_figure({&far, 1}), path("far.svg"));
    save(snapshot_figure({&now, 1}), path("near.svg"));
    const auto lines = [&](const char* name) {
        const std::string svg = contents(path(name));
        return svg.find("rgb(255, 255, 255)'  d=") != svg.npos;
    };
    EXPECT_TRUE(lines("near.svg"));
    EXPECT_FALSE(lines("far.svg"));
}

// In a picture that is 1000 m wide, in which points were large dots.
TEST_F(Marks, ADiscSmallerThanAPixelWasNotToBeSeen) {
    const Colour red{200, 0, 0, 255};
    const auto reds = [&](bool frame, int others) {
        World world;
        for (const Vec2 corner : {Vec2{0, 0}, Vec2{1000, 0}, Vec2{0, 1000}}) world.add(Body{.position = corner});
        for (int i = 0; i < others; ++i) world.add(Body{.position = {900, 900}, .radius = 0.1});
        world.add(Body{.position = {500, 500}, .radius = 0.4, .colour = red});
        const Moment now = moment_of(world);
        if (frame)
            draw(world, fit(world), path("a.png"));
        else
            save(snapshot_figure({&now, 1}), path("a.png"));
        return Pixels(path("a.png")).count(red);
    };
    for (const bool frame : {true, false}) {
        EXPECT_GT(reds(frame, 0), 10u);
        EXPECT_LT(reds(frame, 200), 2u) << "a crowd of discs has its true density";
    }
}

// A symmetric arch had arrows down on its left and up on its right.
TEST_F(Marks, OfTwoThatPressOnOneAnotherOneHadAForce) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{});
    world.add(Body{.position = {0, 0.5}, .radius = 0.5});
    run(world, 0.1, 0.01);
    View view{.low = {-2, -2}, .high = {2, 2}, .width = 400, .height = 400};
    view.contact_forces = true;
    view.caption = false;
    draw(world, view, path("a.png"));
    const Pixels pixels(path("a.png"));
    const Colour arrow{200, 0, 40, 255};
    const auto [left, right, top, bottom] = pixels.extent(arrow);
    EXPECT_NEAR(200 - top, 40, 6) << "the weight, on the disc";
    EXPECT_NEAR(bottom - 200, 40, 6) << "and on the floor";
}

TEST_F(Marks, AFloorHadANotchInItsMiddle) {
    const std::vector<HalfPlane> floor{{.point = {0, 0}}};
    const Track track{.points = {{0, 1}, {7, 3}}};
    const Figure figure = trajectory_figure({&track, 1}, {}, floor);
    const PanelPlace place = lay_out(figure).places[0];
    save(figure, path("a.png"));
    const Pixels pixels(path("a.png"));
    const double middle = place.left + place.width / 2,
                 floor_at = place.top + place.height * place.y.high / (place.y.high - place.y.low);
    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -20; dx <= 20; ++dx)  // between two lines of the grid
            EXPECT_EQ(pixels.at(middle + dx, floor_at + dy), pixels.at(middle - 20, floor_at + dy)) << dx << " " << dy;
    EXPECT_LT(pixels.at(middle, floor_at).r, 0xc0) << "there it is";
}

TEST_F(Marks, ALongFloorHasItsEdge) {
    World world;
    world.add({.kind = Kind::fixed, .shapes = {{.geometry = Box{.width = 1e4, .height = 1}}}});
    const Track track{.points = {{0, 3}, {7, 0.7}}, .radius = 0.2};
    const Figure figure = trajectory_figure({&track, 1}, {}, {}, surroundings_of(world));
    const PanelPlace place = lay_out(figure).places[0];
    save(figure, path("a.png"));
    const Pixels pixels(path("a.png"));
    const double x = place.left + 0.55 * place.width;
    const double y = place.top + place.height * (place.y.high - 0.5) / (place.y.high - place.y.low);
    int darkest = 255;
    for (int dy = -2; dy <= 2; ++dy) darkest = std::min<int>(darkest, pixels.at(x, y + dy).r);
    EXPECT_LT(darkest, 0xa0) << "gnuplot leaves lines away of which both ends are outside";
}

TEST_F(Marks, AtwoodsMachineHadNoRope) {
    World world({.solver = SoftStep{}});
    const BodyId heavy = world.add(Body{.position = {-1, 0}}), light = world.add(Body{.position = {1, 1}});
    world.add(Joint{.a = heavy, .b = light, .type = PulleyJoint{.ground_a = {-1, 3}, .ground_b = {1, 3}}});
    const std::vector<Line> rope = lines_of(world);
    ASSERT_EQ(rope.size(), 3u) << "up to one pulley, across to the other and down again";
    EXPECT_EQ(rope[0].from, (Vec2{-1, 0}));
    EXPECT_EQ(rope[1].from, (Vec2{-1, 3}));
    EXPECT_EQ(rope[1].to, (Vec2{1, 3}));
    EXPECT_EQ(rope[2].to, (Vec2{1, 1}));
    EXPECT_EQ(moment_of(world).discs.size(), 4u) << "both bodies and both pulleys";
    EXPECT_EQ(surroundings_of(world).discs.size(), 2u);
}

TEST_F(Marks, ABowlWasCutOffBelowTheBallInIt) {
    World world;
    world.add({.kind = Kind::fixed, .shapes = {{.geometry = Chain{.points = {{-9, 9}, {0, 0}, {9, 9}}}}}});
    Track ball{.points = {{-1, 2}, {0, 1.5}, {1, 2}}, .radius = 1};
    const auto lowest = [&] {
        const Panel panel = trajectory_figure({&ball, 1}, {}, {}, surroundings_of(world)).panels[0];
        return panel.y_range ? panel.y_range->low : INFINITY;
    };
    EXPECT_LT(lowest(), 0.5) << "where the ball was lowest its rim is not seen";
    EXPECT_GT(lowest(), 0.2) << "not all of the bowl";
    // The same as a shape, and a box that stands on its side.
    World bodies;
    ball.radius = 0;
    ball.shapes = shapes_of(bodies, bodies.add({.position = {1, 2}, .shapes = {{.geometry = Disc{.radius = 1}}}}));
    EXPECT_LT(lowest(), 0.5);
    ball.shapes = shapes_of(bodies, bodies.add({.position = {1, 2}, .shapes = {{.geometry = Box{4, 2}}}}));
    EXPECT_LT(lowest(), 0.5);
}

TEST_F(Marks, TimesOfManyDigitsHaveAPowerOfTen) {
    const auto title = [](double time) {
        const Moment now{.time = time, .discs = {{{}, 1, {}}}};
        return snapshot_figure({&now, 1}).panels[0].title;
    };
    EXPECT_EQ(title(0), "t = 0 s");
    EXPECT_EQ(title(2.5), "t = 2.5 s");
    EXPECT_EQ(title(1e-9), "t = 1e-09 s");
    EXPECT_EQ(title(63108297.299), "t = 63.1083 · 10⁶ s");
    EXPECT_EQ(title(1e5), "t = 100 · 10³ s");
}

TEST_F(Marks, AResidualOfNothingIsNotAJoule) {
    const std::vector<double> t{0, 1};
    std::vector<Energy> energy(2);
    for (Energy& e : energy) e.kinetic = 4;
    const Panel residual = energy_figure(t, energy).panels[1];
    ASSERT_TRUE(residual.y_range);
    EXPECT_GT(residual.y_range->high, 0);
    EXPECT_LT(residual.y_range->high, 1e-9);
}

TEST_F(Marks, AChangeOfAJouleWasNotSeenBesideAMegajoule) {
    const std::vector<double> t{0, 1};
    std::vector<Energy> energy(2);
    energy[0].gravity = energy[1].field = energy[0].field = 1e6;
    energy[1].gravity = 1e6 - 1;
    energy[1].heat.friction = 1;
    const Panel panel = energy_figure(t, energy, true).panels[0];
    EXPECT_EQ(panel.y_label, "change of energy [J]");
    ASSERT_TRUE(panel.y_range);
    EXPECT_LT(panel.y_range->high - panel.y_range->low, 3);
    std::map<std::string, double> last;
    for (const Curve& curve : panel.curves) {
        EXPECT_EQ(curve.y[0], 0) << curve.label;
        last[curve.label] = curve.y[1];
    }
    // What has not changed is not shown.
    EXPECT_EQ(last, (std::map<std::string, double>{{"total", -1}, {"gravity", -1}, {"heat: friction", 1}}));
}

}  // namespace
}  // namespace carom
