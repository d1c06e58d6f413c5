// How curves are told apart when there are more of them than colours.

#include <gtest/gtest.h>

#include <carom/output.hpp>
#include <set>

namespace {

using namespace carom;

/// Colour and stroke of each line.
auto ways(const Figure& figure) {
    std::vector<std::tuple<int, int, int, Stroke>> all;
    for (const Curve& c : figure.panels.at(0).curves)
        if (c.stroke != Stroke::ring) all.emplace_back(c.colour.r, c.colour.g, c.colour.b, c.stroke);
    return all;
}

TEST(Strokes, TheEighthBodyWasDrawnLikeTheFirst) {
    std::vector<Track> tracks;
    for (int i = 0; i < 20; ++i) tracks.push_back({.points = {{0, 1.0 * i}, {1, 1.0 * i}}});
    const auto drawn = ways(trajectory_figure(tracks));
    EXPECT_EQ(drawn.size(), 20u);
    EXPECT_EQ(std::set(drawn.begin(), drawn.end()).size(), 20u);
    EXPECT_EQ(std::get<3>(drawn[6]), Stroke::line);
    EXPECT_EQ(std::get<3>(drawn[7]), Stroke::dashed);
    EXPECT_EQ(std::get<3>(drawn[14]), Stroke::dotted);
}

TEST(Strokes, WhiteBodiesAreToldApart) {
    std::vector<Track> tracks(3, {.points = {{0, 0}, {1, 1}}, .colour = Colour{255, 255, 255, 255}});
    const auto drawn = ways(trajectory_figure(tracks));
    EXPECT_LT(std::get<0>(drawn[0]), 200);  // on white
    EXPECT_EQ(std::set(drawn.begin(), drawn.end()).size(), 3u);
}

TEST(Strokes, OfManyQuantitiesTheEighthWasDrawnLikeTheFirst) {
    const std::vector<double> time{0, 1};
    const std::vector<Series> series(14, {.values = {0, 1}});
    for (const Figure& figure : {time_figure(time, series, "y"), phase_figure(series, series, "x", "v")}) {
        const auto drawn = ways(figure);
        EXPECT_EQ(std::set(drawn.begin(), drawn.end()).size(), 14u);
    }
}

TEST(Strokes, TheEighthMomentOfAProfileWasDrawnLikeTheFirst) {
    const std::vector<Profile> profiles(14, {.density = {1, 2}, .flow = {0, 0}, .temperature = {1, 1}});
    const auto drawn = ways(profile_figure(profiles, {.low = {0, 0}, .high = {2, 1}}));
    EXPECT_EQ(std::set(drawn.begin(), drawn.end()).size(), 14u);
}

}  // namespace
