// Views that keep a body in their middle.

#include "helpers.hpp"

namespace carom {
namespace {

using Follow = OutputTest;
constexpr Colour crimson{200, 0, 0, 255}, leaf{0, 150, 0, 255};

/// 4 x 3 m, in which the middle is at (200, 150).
View seen_around() {
    View view{.low = {0, 0}, .high = {4, 3}, .width = 400, .height = 300};
    view.caption = false;
    return view;
}

TEST_F(Follow, AViewFollowsABody) {
    World world;
    const BodyId disc = world.add(Body{.position = {1, 1.5}, .velocity = {2, 0.3}, .radius = 0.3, .colour = leaf});
    View view = seen_around();
    view.follow = disc;
    Movie movie(path("a.gif"), view, 20);
    for (int i = 0; i <= 40; ++i) {
        movie.add(world);
        world.step(0.1);
    }
    movie.commit();
    std::vector<std::string> frames;
    for (const int frame : {1, 40}) {
        output_of("ffmpeg -y -v error -i " + path("a.gif").string() + " -vf 'select=eq(n\\," + std::to_string(frame) +
                  ")' -frames:v 1 " + path("frame.png").string());
        const Pixels pixels(path("frame.png"));
        EXPECT_EQ(pixels.at(200, 150), leaf) << frame;
        frames.push_back(pixels.bytes);
    }
    EXPECT_NE(frames[0], frames[1]) << "nothing shows that it moves";
    // Of what is gone the last place stays in the middle.
    const View last = centred(view, world);
    world.remove(disc);
    EXPECT_EQ(centred(last, world).low, last.low);
}

TEST_F(Follow, APeriodicBoxGoesOnAroundWhoIsFollowed) {
    World world;
    world.add(Periodic{{0, 0}, {4, 3}});
    const BodyId a = world.add(Body{.position = {0.2, 1.5}, .colour = crimson});
    const BodyId b = world.add(Body{.position = {-0.8, 1.5}, .radius = 0.3, .colour = leaf});  // across the edge
    world.add(Spring{.a = a, .b = b, .stiffness = 1, .rest_length = 1});
    View view = seen_around();
    view.follow = a;
    const View seen = centred(view, world);
    draw(world, view, path("a.png"));
    const Pixels pixels(path("a.png"));
    const auto colour = [&](Vec2 at) { return pixels.at(seen.pixel(at).x, seen.pixel(at).y); };
    EXPECT_EQ(colour({0.2, 1.5}), crimson);
    EXPECT_EQ(colour({-0.8, 1.5}), leaf);
    // The spring is on both sides of the edge.
    for (const double x : {-0.4, 0.1}) {
        bool drawn = false;
        for (double y = 1.3; y <= 1.7; y += 0.01) drawn = drawn || colour({x, y}).r < 150;
        EXPECT_TRUE(drawn) << x;
    }
}

TEST_F(Follow, NumbersOfTheGridWereAlikeFarOut) {
    World world;
    View view = seen_around();
    view.follow = world.add(Body{.position = {6.8002205e6, 0}, .radius = 0.1});
    draw(world, centred(view, world), path("a.pdf"));
    const std::string text = output_of("pdftotext " + path("a.pdf").string() + " -");
    // Half a metre apart, and every second one has room.
    for (const char* number : {"6800219", "6800220", "6800221", "6800222"})
        EXPECT_NE(text.find(number), std::string::npos) << number << " in " << text;
    EXPECT_EQ(text.find("6800220.5"), std::string::npos) << text;
}

}  // namespace
}  // namespace carom
