#include "output/layout.hpp"

#include <algorithm>
#include <cmath>

#include "helpers.hpp"

namespace carom {
namespace {

/// Pixels from one labelled tick to the next.
double apart(const Axis& axis, double length) { return length * axis.step * axis.unit() / (axis.high - axis.low); }

double ticks(const Axis& axis) {
    const double step = axis.step * axis.unit();
    return std::floor(axis.high / step) - std::ceil(axis.low / step) + 1;
}

/// A disc that goes from one place to another.
Track way(Vec2 from, Vec2 to) { return {.label = "disc", .points = {from, to}, .radius = 0.1}; }

using Drawn = OutputTest;

void expect_readable(const Figure& figure) {
    const Layout layout = lay_out(figure);
    for (std::size_t i = 0; i < layout.places.size(); ++i) {
        const PanelPlace& place = layout.places[i];
        EXPECT_GT(apart(place.y, place.height), 1.2 * font_size);
        EXPECT_GE(ticks(place.y), 2);
        EXPECT_GE(ticks(place.x), 2);
        const double widest = 0.62 * font_size * static_cast<double>(place.x.label_length());
        EXPECT_GT(apart(place.x, place.width), 1.2 * widest);
        EXPECT_LE(place.top + place.height + 3.2 * font_size, layout.height) << "the x axis's label";
        // A metre is as long on both axes.
        EXPECT_NEAR(place.width / (place.x.high - place.x.low), place.height / (place.y.high - place.y.low), 1e-9);
    }
}

TEST(Layout, TicksOfAMotionAlongALinePrintedOverEachOther) {
    for (const auto& [angle, far] :
         {std::pair{0.0, 8.0}, {0.05, 6.0}, {0.0, 5.1}, {0.0, 10.1}, {1.52, 4.0}, {0.5 * M_PI, 8.0}}) {
        SCOPED_TRACE(angle);
        const Vec2 end = far * Vec2{std::cos(angle), std::sin(angle)};
        const Track track = way({}, end);
        expect_readable(trajectory_figure({&track, 1}));
        const std::vector<Moment> moments(4, {.discs = {{{}, 0.1, {}}, {end, 0.1, {}}}});
        expect_readable(snapshot_figure({moments.data(), 1}));
        expect_readable(snapshot_figure(moments));
    }
}

// Gnuplot left the whole legend out, and axes' labels were cut off at both ends.
TEST_F(Drawn, ALabelOf120LettersTookTheLegendWithIt) {
    const std::string name = "hypot(" + std::string(110, 'x') + "y) [m]";
    for (const std::size_t columns : {1u, 2u, 3u})
        for (const bool tall : {false, true}) {  // which has narrow axes
            Panel panel{.curves = {{.label = "first", .x = {0, 1}, .y = {0, 1}}, {.x = {0, 1}, .y = {1, 0}}}};
            panel.curves[1].label = panel.x_label = panel.y_label = name;
            panel.equal_aspect = tall;
            if (tall) panel.y_range = Interval{-50, 50};
            const Figure figure{.panels = {columns, panel}, .columns = columns};
            save(figure, path("a.svg"));
            const std::string svg = contents(path("a.svg"));
            std::vector<std::string> labels;
            for (auto at = svg.find(">hypot"); at != svg.npos; at = svg.find(">hypot", at + 1))
                labels.push_back(svg.substr(at + 1, svg.find('<', at + 1) - at - 1));
            std::size_t named = 0;
            for (auto at = svg.find(">first<"); at != svg.npos; at = svg.find(">first<", at + 1)) ++named;
            EXPECT_EQ(named, 2 * columns) << "in the legend, and as the name of the curve";
            EXPECT_EQ(labels.size(), 4 * columns) << "and two axes";
            for (const std::string& label : labels) EXPECT_TRUE(label.ends_with("[m]")) << label;
            const auto shorter = [](const std::string& label) { return label.find("…") != label.npos; };
            EXPECT_EQ(std::count_if(labels.begin(), labels.end(), shorter), 4 * columns);
        }
}

TEST(Layout, AShortenedTextIsWholeLetters) {
    const std::string greek = "αβγδεζηθικλμ";
    EXPECT_EQ(shortened(greek, text_width(greek) + 1), greek);
    EXPECT_EQ(shortened(greek, text_width(greek) - 1), "αβγδε…θικλμ");
    EXPECT_EQ(shortened(greek, 0), "αβγδ…κλμ");
}

// "residual…10⁻⁶ J]" is no label.
TEST(Layout, AShortenedTextKeepsItsUnitWhole) {
    EXPECT_EQ(shortened("residual [10⁻⁶ J]", 0), "residual [10⁻⁶ J]");
    EXPECT_EQ(shortened("kinetic energy [10⁻⁶ J]", 0), "kine…rgy [10⁻⁶ J]");
    EXPECT_EQ(shortened("kinetic energy [J]", text_width("kinetic e… [J]") + 1), "kinet…ergy [J]");
    EXPECT_EQ(shortened("chain[10][20]", 0), "chai…20]");
}

TEST_F(Drawn, LegendOfManyNamesWasCutOff) {
    std::vector<Track> tracks;
    for (int i = 0; i < 20; ++i) {
        tracks.push_back(way({0, 0.1 * i}, {8, 0.1 * i}));
        tracks.back().label = "disc" + std::to_string(i);
    }
    for (const std::size_t n : {1u, 7u, 10u, 13u, 20u}) {
        SCOPED_TRACE(n);
        const Figure figure = trajectory_figure({tracks.data(), n});
        save(figure, path("many.svg"));
        const std::string svg = contents(path("many.svg"));
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t word = svg.find("<text>" + tracks[i].label + "<");
            ASSERT_NE(word, svg.npos) << tracks[i].label << " was left out";
            // The group around it: "translate(x,y)".
            const std::size_t at = svg.rfind("translate(", word) + 10;
            EXPECT_LT(std::stod(svg.substr(at)) + text_width(tracks[i].label), figure.width) << tracks[i].label;
        }
    }
}

/// Where words begin in an SVG, from the group around them: "translate(x,y)".
Vec2 place_of(const std::string& svg, const std::string& words) {
    const std::size_t word = svg.find("<text>" + words + "<");
    if (word == svg.npos) return {NAN, NAN};
    const std::size_t at = svg.rfind("translate(", word) + 10;
    return {std::stod(svg.substr(at)), std::stod(svg.substr(svg.find(',', at) + 1))};
}

TEST_F(Drawn, LegendAboveNarrowAxesWasPrintedOverTheTitle) {
    std::vector<Track> tracks;
    for (int i = 0; i < 13; ++i) {
        tracks.push_back(way({0.1 * i, 0}, {0.1 * i, -20}));
        tracks.back().label = "b" + std::to_string(i);
    }
    const auto expect_places = [&](std::size_t n) {
        Figure figure = trajectory_figure({tracks.data(), n});
        figure.title = "Free fall";
        save(figure, path("narrow.svg"));
        const std::string svg = contents(path("narrow.svg"));
        const PanelPlace place = lay_out(figure).places[0];
        const double title = place_of(svg, figure.title).y, axes = place.top;
        for (std::size_t i = 0; i < n; ++i) {
            const Vec2 at = place_of(svg, tracks[i].label);
            EXPECT_GT(at.y, title + font_size) << tracks[i].label;
            EXPECT_TRUE(at.y < axes || at.x > place.left + place.width) << tracks[i].label << " lies on the axes";
            EXPECT_GT(at.x, 0) << tracks[i].label;
            EXPECT_LT(at.x + text_width(tracks[i].label), figure.width) << tracks[i].label;
        }
    };
    for (const std::size_t n : {1u, 3u, 9u, 10u, 13u}) {
        SCOPED_TRACE(n);
        expect_places(n);
    }
    for (const std::size_t letters : {16u, 30u, 50u, 70u}) {
        SCOPED_TRACE(letters);
        tracks[0].label.assign(letters, 'x');
        for (const std::size_t n : {2u, 9u, 13u}) expect_places(n);
    }
}

// An axis never spanned less than 2e-4 of its values: what a method loses of an energy was a line across.
TEST_F(Drawn, SmallDifferencesOfLargeValuesWereALineAcross) {
    for (const double whole : {0.5, -3e4, 1.5e18}) {
        const std::vector<double> time{0, 1, 2};
        const Series energy{.label = "E", .values = {whole, whole * (1 - 2e-6), whole * (1 - 3e-6)}};
        const Figure figure = time_figure(time, {&energy, 1}, "E [J]");
        const Axis axis = lay_out(figure).places[0].y;
        EXPECT_LT(axis.high - axis.low, 4e-6 * std::abs(whole)) << "the data and a margin";
        EXPECT_GE(ticks(axis), 2);
        EXPECT_LE(axis.label_length(), 5) << "-0.25, not 0.49999975";
        save(figure, path("a.svg"));
        EXPECT_CONTAINS(contents(path("a.svg")), whole == 0.5    ? ">E − 0.5 [10⁻⁶ J]<"
                                                 : whole == -3e4 ? ">E + 30000 [J]<"
                                                                 : ">E − 1.5 · 10¹⁸ [10¹² J]<");
    }
}

// A kinetic and a potential energy of 50 J are summed to 0.5 J with errors of some 3e-13 J.
TEST(Layout, RoundingIsNoMountain) {
    const std::vector<double> time{0, 1, 2};
    const Series energy{.label = "E", .values = {0.5, 0.5 - 3e-13, 0.5 + 3e-13}};
    const Axis axis = lay_out(time_figure(time, {&energy, 1}, "E [J]")).places[0].y;
    EXPECT_GT(axis.high - axis.low, 1e-4 * 0.5);
    EXPECT_EQ(axis.offset, 0) << "0.50000 needs none";
}

TEST(Layout, AMotionFarAwayWasADotInAFrameOf200Metres) {
    for (const Vec2 start : {Vec2{0, 1e6}, {-1e6, 1e6}, {1e3, 1e6}}) {
        const Track fall = way(start, start - Vec2{0, 5}), along = way(start, start + Vec2{5, 0});
        for (const Track& track : {fall, along}) {
            const Figure figure = trajectory_figure({&track, 1});
            const PanelPlace place = lay_out(figure).places[0];
            EXPECT_LT(std::max(place.x.high - place.x.low, place.y.high - place.y.low), 1.1 * 5.2) << "with its radius";
            const double widest = 0.62 * font_size * static_cast<double>(place.x.label_length());
            EXPECT_GT(apart(place.x, place.width), widest);
        }
    }
}

TEST(Layout, TheLastTicksLabelWasCutOff) {
    for (const double end : {100.0, 5e4, 99999.0}) {
        const std::vector<double> time{0, end};
        const Series series{.label = "x", .values = {0, 1}};
        const PanelPlace place = lay_out(time_figure(time, {&series, 1}, "x [m]")).places[0];
        const double step = place.x.step, last = step * std::floor(end / step);
        const double at = place.left + place.width * last / end, digits = std::floor(std::log10(last)) + 1;
        constexpr double widest = 0.637 * font_size;  // of DejaVu Sans, a digit
        EXPECT_LE(at + 0.5 * widest * digits, 1000) << last;
    }
}

// In one column, beside a quarter of a page that was empty.
TEST_F(Drawn, TheLegendOfAllPanelsStoodAboveOneOfThem) {
    Figure figure{.panels = std::vector<Panel>(4), .columns = 2, .shared_x = true};
    for (Panel& panel : figure.panels)
        for (int i = 0; i < 9; ++i) panel.curves.push_back({.x = {0, 1}, .y = {0, 1.0 * i}});
    for (int i = 0; i < 9; ++i)
        figure.panels[0].curves[static_cast<std::size_t>(i)].label = "world.integrator = a method " + std::to_string(i);
    save(figure, path("a.svg"));
    const std::string svg = contents(path("a.svg"));
    const Vec2 first = place_of(svg, figure.panels[0].curves[0].label);
    const Vec2 last = place_of(svg, figure.panels[0].curves[8].label);
    EXPECT_GT(last.x, first.x + text_width(figure.panels[0].curves[0].label));
    EXPECT_LT(last.x + text_width(figure.panels[0].curves[8].label), figure.width);
    EXPECT_LT(lay_out(figure).places[0].top, 6 * 1.5 * font_size) << "five rows, or less";
}

TEST_F(Drawn, MarksOfASharedAxisAreToldBelowAlone) {
    Panel panel{.log_x = true, .x_range = Interval{0.024, 0.11}};
    panel.curves.push_back({.x = {0.025, 0.05, 0.1}, .y = {1, 2, 3}});
    const Figure figure{.panels = {panel, panel}, .shared_x = true};
    save(figure, path("a.svg"));
    const std::string svg = contents(path("a.svg"));
    const std::size_t first = svg.find(">0.05<");
    ASSERT_NE(first, svg.npos);
    EXPECT_EQ(svg.find(">0.05<", first + 1), svg.npos);
}

TEST_F(Drawn, AHeatMapOfTinyDifferencesHasColoursForThem) {
    const HeatMap map{{0, 1}, {0, 1}, {1e4, 1e4 + 1e-5, 1e4 + 2e-5, 1e4 + 3e-5}, "T [K]"};
    const Axis heat = lay_out({.panels = {map_panel(map, "a", "b")}}).places[0].heat;
    EXPECT_EQ(std::pair(heat.low, heat.high), std::pair(map.values.front(), map.values.back()));
    EXPECT_GE(ticks(heat), 2);
    EXPECT_GE(heat.step, 0.99 * std::pow(10, -heat.decimals)) << "labels that are alike";
}

TEST_F(Drawn, AHeatMapOfWhatIsAlikeHadEmptyAxes) {
    for (const std::vector<double>& places : {std::vector{1e16}, {1e16, 1e16 + 2}, {-1e300}, {0, 1e-320}})
        for (const double value : {1e16, 1e-310, 1e-320, 0.0})
            save({.panels = {map_panel({places, {5}, std::vector(places.size(), value), "T"}, "a", "b")}},
                 path("a.png"));
}

TEST_F(Drawn, ErrorsAreBarsAroundTheirPoints) {
    Curve curve{.x = {1, 2, 3}, .y = {1, 2, 4}, .stroke = Stroke::points, .colour = {255, 0, 0, 255}};
    curve.error = {0.5, NAN, 3};
    Figure figure{.panels = {{.x_label = "x", .y_label = "y", .curves = {curve}}}};
    save(figure, path("a.png"));
    // From 0.5 to 7, of a frame around that; a part below zero has no place on an axis of decades.
    const auto [left, right, top, bottom] = Pixels(path("a.png")).extent({255, 0, 0, 255});
    EXPECT_GT(bottom - top, 350);
    EXPECT_GT(right - left, 800);
    figure.panels[0].log_y = true;
    figure.panels[0].curves[0].error = {2, 0, 3};
    save(figure, path("a.png"));
    figure.panels[0].curves[0].error = {1};
    EXPECT_CONTAINS(error_of([&] { save(figure, path("b.png")); }, Error::Cause::input), "has 3 y and 1 errors");
}

TEST_F(Drawn, AHeatMapOnALogAxisHasCellsOfOneWidth) {
    const HeatMap map{{1, 10, 100}, {1}, {0, 1, 2}, "T [K]"};
    save({.panels = {map_panel(map, "a", "b", true)}}, path("a.svg"));
    const std::string svg = contents(path("a.svg"));
    std::vector<double> widths;
    for (auto at = svg.find("<polygon"); at != svg.npos; at = svg.find("<polygon", at + 1)) {
        std::istringstream points(svg.substr(svg.find("points = '", at) + 10, 40));
        double x = 0, y = 0, right = 0;
        char comma = 0;
        if (points >> x >> comma >> y >> right) widths.push_back(right - x);
    }
    ASSERT_GE(widths.size(), 3u);
    widths.resize(3);  // the colour bar has more
    for (const double width : widths) EXPECT_NEAR(width, widths[0], 1.5) << "each goes on under the next by a pixel";
    for (const std::vector<double>& places : {std::vector<double>{0, 1}, {-1, 1}})
        EXPECT_CONTAINS(error_of(
                            [&] {
                                map_panel({places, {1}, {1, 2}, ""}, "a", "b", true);
                            },
                            Error::Cause::input),
                        "must be positive");
}

// Of a sweep over 1, 2 and 4 the axis had ticks at 1 and 2.
TEST(Layout, AShortLogAxisHasMoreThanTwoTicks) {
    Axis axis{.low = 0.93, .high = 4.3, .log = true};
    choose_ticks(axis, 800, 80);
    EXPECT_EQ(axis.marks, (std::vector<double>{1, 2, 3, 4}));
    axis = {.low = 0.019, .high = 0.11, .log = true};
    choose_ticks(axis, 800, 80);
    EXPECT_EQ(axis.marks.size(), 3u);  // 0.02, 0.05 and 0.1
}

// In a title it was a picture as large as the figure.
TEST(Layout, AnEmojiIsASquare) {
    EXPECT_EQ(without_emoji("A ball 🎾 flies"), "A ball □ flies");
    EXPECT_EQ(without_emoji("❤️ ½ m·v² 日本"), "❤ ½ m·v² 日本");
    EXPECT_EQ(without_emoji("\xf0"), "□");
}

// A speed in mathematical italics, as people paste it, was a square; a star and a tick, of three bytes, were pictures.
TEST(Layout, NotEveryCharacterOfFourBytesIsAnEmojiAndSomeOfThreeAre) {
    EXPECT_EQ(without_emoji("speed 𝑣, 𝛼 and 𠮷"), "speed 𝑣, 𝛼 and 𠮷");
    EXPECT_EQ(without_emoji("⭐ ✅ ⚽ ⌚ ⬛ ⏳ ♈ ❓"), "□ □ □ □ □ □ □ □");
    EXPECT_EQ(without_emoji("★ ✓ ⚙ ■ → ☀ é"), "★ ✓ ⚙ ■ → ☀ é");
    EXPECT_EQ(without_emoji("👩‍🚀"), "□□");
}

}  // namespace
}  // namespace carom
