#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "helpers.hpp"
#include "output/layout.hpp"

namespace carom {
namespace {

using Figures = OutputTest;

Figure sine(const std::string& title = "") {
    std::vector<double> t;
    std::vector<Series> x(2);
    x[0].label = "first";
    x[1].label = "second";
    for (int i = 0; i <= 100; ++i) {
        t.push_back(0.1 * i);
        x[0].values.push_back(std::sin(t.back()));
        x[1].values.push_back(0.5 * std::cos(t.back()));
    }
    Figure figure = time_figure(t, x, "x [m]");
    figure.title = title;
    return figure;
}

std::string svg_of(const Figure& figure, const std::filesystem::path& path) {
    save(figure, path);
    return contents(path);
}

/// The word as a whole text of an SVG. (append: g++ 12 warns of overlaps in "…" + string.)
std::string text_element(const std::string& word) { return std::string(">").append(word).append("<"); }

std::string xml_escaped(const std::string& text) {
    std::string result;
    for (char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else
            result += c;
    }
    return result;
}

TEST_F(Figures, LongNamesInTheLegendLeaveTheAxesTheirWidth) {
    Figure figure = sine();
    auto& curves = figure.panels[0].curves;
    const double alone = lay_out(figure).places[0].width;
    for (int i = 0; i < 6; ++i) {
        curves.push_back(curves[0]);
        curves.back().label = "angular_momentum_of_body_" + std::to_string(i) + "_about_the_centre_of_mass";
    }
    const Layout layout = lay_out(figure);
    const PanelPlace& place = layout.places[0];
    EXPECT_EQ(place.width, alone);
    EXPECT_FALSE(place.legend_right);
    // All of them have room above, within the picture.
    const std::size_t columns = (place.legend_entries + place.legend_rows - 1) / place.legend_rows;
    EXPECT_GE(place.top, static_cast<double>(place.legend_rows) * font_size);
    EXPECT_LT(static_cast<double>(columns) * text_width(curves.back().label), figure.width);
    const std::string svg = svg_of(figure, path("long.svg"));
    for (const Curve& curve : curves) EXPECT_NE(svg.find(text_element(curve.label)), std::string::npos);
    // Short ones stand beside the axes, as many as there are.
    for (std::size_t i = 2; i < curves.size(); ++i) curves[i].label = "curve number " + std::to_string(i);
    EXPECT_TRUE(lay_out(figure).places[0].legend_right);
}

TEST_F(Figures, PngHasTheSizeThatWasAskedFor) {
    Figure figure = sine();
    figure.width = 640;
    figure.height = 400;
    save(figure, path("a.png"));
    EXPECT_EQ(output_of("ffprobe -v error -show_entries stream=codec_name,width,height -of csv=p=0 " +
                        path("a.png").string()),
              "png,640,400\n");
    EXPECT_EQ(files().size(), 1u);
}

TEST_F(Figures, PdfIsAsLargeInInches) {
    Figure figure = sine("A title");
    figure.width = 720;
    figure.height = 432;
    save(figure, path("a.pdf"));
    EXPECT_CONTAINS(output_of("pdfinfo " + path("a.pdf").string()), "360 x 216 pts");
    const auto text = output_of("pdftotext " + path("a.pdf").string() + " -");
    for (const char* word : {"A title", "first", "second", "x [m]", "t [s]"}) EXPECT_CONTAINS(text, word);
}

TEST_F(Figures, SvgIsWellFormedAndNamesEverything) {
    Figure figure = sine("A title");
    figure.panels[0].title = "A panel";
    const auto svg = svg_of(figure, path("a.svg"));
    for (const char* word : {"A title", "A panel", "first", "second", "x [m]", "t [s]"}) {
        EXPECT_CONTAINS(svg, text_element(word));
    }
    EXPECT_EQ(output_of("xmllint --noout " + path("a.svg").string() + " 2>&1"), "");
}

TEST_F(Figures, TextIsPrintedAsItIs) {
    const std::string odd =
        "'a'_1 {b}^2 `touch " + path("executed").string() + "` 'q' \"d\" @x &y ~z \\n \\ 100% $p0c0 #'";
    Figure figure = sine(odd);
    figure.width = 3000;  // for a title on one line
    figure.panels[0].title = figure.panels[0].x_label = figure.panels[0].y_label = odd;
    figure.panels[0].curves[0].label = odd;
    figure.panels[0].curves[1].label = "two\nlines";
    const auto svg = svg_of(figure, path("a.svg"));
    std::size_t count = 0;
    for (auto at = svg.find(xml_escaped(odd)); at != svg.npos; at = svg.find(xml_escaped(odd), at + 1)) ++count;
    EXPECT_EQ(count, 6u);  // two titles, two axes, the legend, and the name of the curve as an element
    EXPECT_CONTAINS(svg, "two lines");
    EXPECT_FALSE(std::filesystem::exists(path("executed"))) << "gnuplot ran a command from a title";
}

// It stood on one line, cut off at both ends.
TEST_F(Figures, ALongTitleWasCutOff) {
    Figure figure = sine("A ball");
    const Layout with_one = lay_out(figure);
    figure.title =
        "A title that says more of an experiment than there is room for on one line: its masses, how long its rods "
        "are, and that µ is the friction of its bearings";
    const Layout layout = lay_out(figure);
    ASSERT_GT(layout.title.size(), 1u);
    std::string all;
    for (const std::string& line : layout.title) {
        EXPECT_LT(text_width(line) * title_size / font_size, figure.width) << line;
        all += (all.empty() ? "" : " ") + line;
    }
    EXPECT_EQ(all, figure.title);
    const double more = static_cast<double>(layout.title.size() - 1) * title_line;
    EXPECT_DOUBLE_EQ(layout.places[0].top, with_one.places[0].top + more);
    const auto svg = svg_of(figure, path("a.svg"));
    for (const std::string& line : layout.title) EXPECT_CONTAINS(svg, line);
}

// Its path was white on white.
TEST_F(Figures, AWhiteBodyWasNotToBeSeen) {
    const Colour white{255, 255, 255, 255}, blue = palette(0);
    for (const Colour colour : {white, blue}) {
        const std::vector<Track> tracks{{.label = "ball", .points = {{0, 0}, {1, 1}}, .colour = colour}};
        const Figure figure = trajectory_figure(tracks);
        for (const Curve& curve : figure.panels[0].curves) EXPECT_EQ(curve.colour == colour, colour == blue);
        EXPECT_EQ(figure.panels[0].discs[0].fill, colour);  // within its dark outline
    }
}

TEST_F(Figures, CommonPowerOfTenGoesToTheUnit) {
    Figure figure = sine();
    for (Curve& curve : figure.panels[0].curves) {
        for (double& y : curve.y) y *= 3e-8;
    }
    EXPECT_CONTAINS(svg_of(figure, path("a.svg")), ">x [10⁻⁹ m]<");
}

TEST_F(Figures, DiscsHaveTheirTrueSizeAndShape) {
    const Colour red{200, 0, 0, 255}, blue{0, 0, 200, 255};
    const std::vector<Moment> moments{{0, {{{5, 5}, 2, red}, {{15, 10}, 1, blue}}}};
    save(snapshot_figure(moments, Rectangle{{0, 0}, {20, 15}}), path("a.png"));
    const Pixels pixels(path("a.png"));
    const auto [left, right, top, bottom] = pixels.extent(red);
    const auto [left2, right2, top2, bottom2] = pixels.extent(blue);
    EXPECT_NEAR(right - left, bottom - top, 2) << "not a circle";
    EXPECT_NEAR((right - left) / (right2 - left2), 2, 0.1);
    // 10 m between the centres, 4 m is the larger one's diameter.
    const double metre = (left2 + right2 - left - right) / 2 / 10;
    EXPECT_NEAR((right - left) / metre, 4, 0.1);
    EXPECT_NEAR((top + bottom - top2 - bottom2) / 2 / metre, 5, 0.1);
}

TEST_F(Figures, APendulumHasItsRod) {
    World world({.solver = SoftStep{}});
    const BodyId bob = world.add(Body{.position = {3, -4}});
    world.add(Joint{.b = bob, .type = DistanceJoint{}});
    const std::vector<Line> lines = lines_of(world);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].from, (Vec2{0, 0}));
    EXPECT_EQ(lines[0].to, (Vec2{3, -4}));
    const Moment now = moment_of(world);
    const Figure figure = snapshot_figure({&now, 1});
    ASSERT_TRUE(figure.panels[0].x_range) << "from the nail to the bob";
    EXPECT_LT(figure.panels[0].x_range->low, 0);
}

TEST_F(Figures, ASwingingRodHadNoPivot) {
    World world({.solver = SoftStep{}});
    const BodyId rod = world.add(Body{.position = {3, -4}, .shapes = {{.geometry = Box{.width = 1, .height = 10}}}});
    const BodyId bob = world.add(Body{.position = {3, -9}});
    world.add(Joint{.b = rod, .anchor_a = {3, 1}, .anchor_b = {0, 5}, .type = RevoluteJoint{}});
    world.add(Joint{.a = rod, .b = bob, .anchor_a = {0, -5}, .type = RevoluteJoint{}});
    const Moment now = moment_of(world), still = surroundings_of(world);
    ASSERT_EQ(now.discs.size(), 3u) << "the bob and two hinges";
    EXPECT_EQ(now.discs[1].centre, (Vec2{3, 1}));
    EXPECT_EQ(now.discs[2].centre, (Vec2{3, -9}));
    ASSERT_EQ(still.discs.size(), 1u);
    EXPECT_EQ(still.discs[0].centre, (Vec2{3, 1}));
    const Track track{.points = {{3, -4}, {4, -3.9}}};
    EXPECT_EQ(trajectory_figure({&track, 1}, {}, {}, still).panels[0].discs.size(), 2u);
}

TEST_F(Figures, FixedBodiesBelongToThePathsAroundThem) {
    World world;
    world.add({.kind = Kind::fixed, .position = {5, 5}, .radius = 1});
    world.add({.kind = Kind::fixed, .shapes = {{.geometry = Box{.width = 1e4, .height = 1}}}});
    world.add({.position = {1, 1}, .radius = 1});
    const Moment still = surroundings_of(world);
    EXPECT_EQ(still.discs.size(), 1u);
    ASSERT_EQ(still.shapes.size(), 1u);
    const Track track{.points = {{1, 1}, {2, 3}}, .radius = 1};
    const Panel panel = trajectory_figure({&track, 1}, {}, {}, still).panels[0];
    EXPECT_EQ(panel.discs.size(), 2u);
    EXPECT_EQ(panel.shapes.size(), 1u);
    ASSERT_TRUE(panel.x_range);
    EXPECT_GT(panel.x_range->high, 6) << "as far as the fixed disc";
    EXPECT_LT(panel.x_range->high, 7) << "but not as the floor";
}

TEST_F(Figures, ShapesHaveTheirTrueSizeAndLook) {
    const Colour red{200, 0, 0, 255};
    World world({.solver = NoContact{}});
    world.add(
        {.position = {5, 5}, .angle = 0.5, .shapes = {{.geometry = Box{.width = 4, .height = 2}}}, .colour = red});
    world.add({.kind = Kind::fixed,
               .shapes = {{.geometry = Segment{{0, 1}, {20, 1}}}, {.geometry = Disc{}, .sensor = true}}});
    world.add({.position = {1, 1}});
    const Moment now = moment_of(world);
    ASSERT_EQ(now.shapes.size(), 3u);
    EXPECT_EQ(now.discs.size(), 1u) << "those with shapes are no points";
    EXPECT_EQ(now.shapes[0].look, Look::filled);
    EXPECT_EQ(now.shapes[1].look, Look::line);
    EXPECT_EQ(now.shapes[2].look, Look::dashed);
    EXPECT_EQ(now.shapes[0].points.front(), now.shapes[0].points.back());

    save(snapshot_figure(std::vector{now}, Rectangle{{0, 0}, {20, 15}}), path("a.png"));
    const Pixels pixels(path("a.png"));
    const auto [left, right, top, bottom] = pixels.extent(red);
    const double across = 4 * std::cos(0.5) + 2 * std::sin(0.5), up = 4 * std::sin(0.5) + 2 * std::cos(0.5);
    EXPECT_NEAR((right - left) / (bottom - top), across / up, 0.03);
    EXPECT_NEAR(static_cast<double>(pixels.count(red)) / ((right - left) * (bottom - top)), 8 / (across * up), 0.03);

    const Track track{.points = {{0, 0}, {5, 5}}, .shapes = shapes_of(world, world.ids()[0])};
    const Panel panel = trajectory_figure({&track, 1}).panels[0];
    EXPECT_EQ(panel.shapes.size(), 1u);
    EXPECT_TRUE(panel.discs.empty());
}

TEST_F(Figures, SnapshotsShareOneScale) {
    const std::vector<Moment> moments{{0, {{{0, 0}, 1, {}}}}, {1, {{{10, 4}, 1, {}}}}};
    const Figure figure = snapshot_figure(moments);
    ASSERT_EQ(figure.panels.size(), 2u);
    for (const Panel& panel : figure.panels) {
        ASSERT_TRUE(panel.x_range && panel.y_range);
        EXPECT_LT(panel.x_range->low, -1);
        EXPECT_GT(panel.x_range->high, 11);
        EXPECT_LT(panel.y_range->low, -1);
        EXPECT_GT(panel.y_range->high, 5);
    }
    const std::vector<Moment> with_shape{{0, {{{0, 0}, 1, {}}}, {{.points = {{0, 0}, {30, 0}, {0, 20}}}}}};
    EXPECT_GT(snapshot_figure(with_shape).panels[0].x_range->high, 30);
    EXPECT_GT(snapshot_figure(with_shape).panels[0].y_range->high, 20);
}

TEST_F(Figures, ProfilesAreAveragesOverSlicesOfTheLongerSide) {
    World world({.gravity = {}});
    const Periodic box{{-1, 0}, {1, 4}};
    world.add(box);
    const auto add = [&](Vec2 x, Vec2 v, double mass, Kind kind = Kind::dynamic) {
        world.add(Body{.kind = kind, .position = x, .velocity = v, .mass = mass});
    };
    add({0, 0.5}, {0, 1}, 1), add({0.5, 5.5}, {2, 4}, 2);  // the second is at 1.5 in the box
    add({0, 2.5}, {7, -1}, 3), add({0, 1}, {}, 1, Kind::fixed);
    const Profile now = profile_of(world, {.low = box.low, .high = box.high}, 2);
    EXPECT_EQ(now.density, (std::vector<double>{2 / 4.0, 1 / 4.0}));
    EXPECT_EQ(now.flow, (std::vector<double>{9 / 3.0, -1}));
    // What two bodies have about their mean: half of their reduced mass, 2/3 kg, times the square of (2, 3) m/s.
    EXPECT_NEAR(now.temperature[0], 0.5 * 2 / 3 * (4 + 9), 1e-12);
    EXPECT_TRUE(std::isnan(now.temperature[1]));  // one alone has no temperature
    const Figure figure = profile_figure({&now, 1}, {.low = box.low, .high = box.high});
    ASSERT_EQ(figure.panels.size(), 3u);
    EXPECT_EQ(figure.panels[0].x_label, "y [m]");
    EXPECT_EQ(figure.panels[0].curves[0].x, (std::vector<double>{1, 3}));
    EXPECT_THROW(profile_of(world, {.low = box.low, .high = box.high}, 0), Error);
    EXPECT_THROW(profile_of(world, {.low = box.low, .high = box.low}, 2), Error);
}

TEST_F(Figures, PlotDrewNoSpringsAndNoHalfPlanes) {
    World world;
    world.add(HalfPlane{.point = {0, -1}, .normal = {0, 2}});
    const BodyId a = world.add(Body{.kind = Kind::fixed}), b = world.add(Body{.position = {3, 2}, .angle = 0.5});
    world.add(Spring{.a = a, .b = b, .anchor_b = {0, 0.1}});
    const Moment now = moment_of(world);
    ASSERT_EQ(now.lines.size(), 1u);
    EXPECT_EQ(now.lines[0].from, (Vec2{0, 0}));
    EXPECT_NEAR(now.lines[0].to.x, 3 - 0.1 * std::sin(0.5), 1e-15);
    const Track track{.points = {{3, 2}, {2.5, 2}}};
    for (const Panel& panel : {snapshot_figure({&now, 1}, {}, world.half_planes()).panels[0],
                               trajectory_figure({&track, 1}, {}, world.half_planes(), now).panels[0]}) {
        ASSERT_EQ(panel.lines.size(), 1u);
        ASSERT_EQ(panel.endless.size(), 1u);
        EXPECT_DOUBLE_EQ(panel.endless[0].from.y, -1);
        EXPECT_DOUBLE_EQ(panel.endless[0].to.y, -1);
    }
}

TEST_F(Figures, ARampEndedBeforeThePictureDidOrWasNotThere) {
    // A slope of 45° through the middle of discs that are 8.2 m by 4.2 m wide, and of a margin of 0.328 m around.
    const std::vector<HalfPlane> ramp{{.point = {4, 2}, .normal = {1, 1}}};
    const Moment now{.discs = {{{0, 0}, 0.1, palette(0)}, {{8, 4}, 0.1, palette(0)}}};
    save(snapshot_figure({&now, 1}, {}, ramp), path("ramp.png"));
    const Pixels pixels(path("ramp.png"));
    const auto [left, right, top, bottom] = pixels.extent(palette(0));
    const double metre = (right - left) / 8.2, x = 0.5 * (left + right), y = 0.5 * (top + bottom);
    for (const double along : {-2.3, -1.5, 1.5, 2.3}) {  // 0.128 m before the frame, to the left and right
        std::size_t dark = 0;
        for (int dx = -3; dx <= 3; ++dx) dark += pixels.at(x + along * metre + dx, y + along * metre).r < 0x60;
        EXPECT_GT(dark, 0u) << along;
    }
}

TEST_F(Figures, PhasePortraitOfOneCurveNeedsNoLegend) {
    const std::vector<Series> x{{.label = "a.x", .values = {0, 1}}, {.label = "b.x", .values = {1, 0}}}, v = x;
    EXPECT_EQ(phase_figure({&x[0], 1}, {&v[0], 1}).panels[0].curves[0].label, "");
    EXPECT_EQ(phase_figure(x, v).panels[0].curves[0].label, "a.x");
}

TEST_F(Figures, RoomFramesTheTrajectories) {
    const std::vector<Track> tracks{{.points = {{1, 1}, {5, 4}, {9, 1}}, .radius = 0.5}};
    const Figure figure = trajectory_figure(tracks, Rectangle{{0, 0}, {10, 5}});
    save(figure, path("a.png"));
    const Pixels pixels(path("a.png"));
    const auto [left, right, top, bottom] = pixels.extent(palette(0));
    EXPECT_GT(right - left, 0.75 * 900) << "the path should span 8 of the room's 10 m";
    EXPECT_NEAR((right - left) / (bottom - top), 8. / 3, 0.15) << "aspect";
}

TEST_F(Figures, EnergyShowsTheAccountsThatAreUsed) {
    std::vector<double> t;
    std::vector<Energy> energy;
    for (int i = 0; i < 50; ++i) {
        t.push_back(i);
        Energy e;
        e.kinetic = i;
        e.gravity = 49 - i;
        e.initial_total = 49;
        e.heat.drag = 1e-4 * i;
        e.heat.friction = 1e-13 * i;  // rounding
        e.residual = 1e-4 * i;
        energy.push_back(e);
    }
    const auto svg = svg_of(energy_figure(t, energy), path("a.svg"));
    for (const char* word : {"kinetic", "gravity", "heat: drag", "total", "energy [J]", "residual [10⁻³ J]"}) {
        EXPECT_CONTAINS(svg, text_element(word));
    }
    for (const char* word : {"springs", "friction", "rotational"}) EXPECT_EQ(svg.find(word), svg.npos) << word;
}

// The work of a motor and that against overlap were both black and dashed, the heat of joints as blue as driven work.
TEST_F(Figures, TwoAccountsOfOneEnergyLookedAlike) {
    const std::vector<double> t{0, 1};
    std::vector<Energy> energy(2);
    energy[1].heat = {1, 1, 1, 1, 1, 1, 1, 1};
    energy[1].work = {1, 1, 1, 1, 1, 1};
    energy[1].kinetic = energy[1].rotational = energy[1].gravity = energy[1].spring = energy[1].field = 1;
    std::set<std::tuple<Stroke, int, int, int>> looks;
    const Panel panel = energy_figure(t, energy).panels[0];
    for (const Curve& c : panel.curves)
        EXPECT_TRUE(looks.emplace(c.stroke, c.colour.r, c.colour.g, c.colour.b).second) << c.label;
    EXPECT_EQ(looks.size(), 17u);
}

TEST_F(Figures, ErrorOfASimulationIsItsDifference) {
    std::vector<double> t, simulated, analytic;
    for (int i = 0; i < 300; ++i) {
        t.push_back(i);
        analytic.push_back(std::cos(i));
        simulated.push_back(std::cos(i) + 1e-5 * i);
    }
    const Figure figure = comparison_figure(t, simulated, analytic, "x [m]");
    ASSERT_EQ(figure.panels.size(), 2u);
    for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(figure.panels[1].curves[0].y[i], 1e-5 * t[i], 1e-15);
    EXPECT_CONTAINS(svg_of(figure, path("a.svg")), ">error of x [10⁻³ m]<");
}

TEST_F(Figures, OddDataAreDrawnAllTheSame) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    Figure figure;
    figure.columns = 2;
    figure.panels = {Panel{},
                     Panel{.curves = {{.label = "nothing"}}},
                     Panel{.curves = {{.x = {1}, .y = {1}}}},
                     Panel{.curves = {{.x = {0, 1, 2, 3, 4}, .y = {nan, 1, infinity, nan, 2}}}},
                     Panel{.log_x = true, .log_y = true, .curves = {{.x = {0, 1, 2}, .y = {-1, 0, 0}}}},
                     Panel{.curves = {{.x = {0, 1}, .y = {1e9, 1e9 + 1e-6}}}},
                     Panel{.equal_aspect = true, .curves = {{.x = {2, 2}, .y = {0, 1}}}},
                     Panel{.equal_aspect = true, .discs = {{{0, 0}, 0, Colour{}}}}};
    save(figure, path("a.png"));
    EXPECT_GT(std::filesystem::file_size(path("a.png")), 1000u);
}

TEST_F(Figures, FiguresOfAMillionPointsStaySmall) {
    Curve curve;
    for (int i = 0; i < 1000000; ++i) {
        curve.x.push_back(std::cos(1e-4 * i));
        curve.y.push_back(std::sin(1e-4 * i));
    }
    save({.panels = {Panel{.equal_aspect = true, .curves = {curve}}}}, path("a.svg"));
    EXPECT_LT(std::filesystem::file_size(path("a.svg")), 4u << 20);
}

TEST_F(Figures, ASingleOutlierAmongManyPointsIsSeen) {
    Curve curve;
    for (int i = 0; i < 100000; ++i) {
        curve.x.push_back(i);
        curve.y.push_back(i == 61803 ? 1 : 1e-3 * std::sin(i));
    }
    const Interval range{-0.1, 1.1};
    save({.panels = {Panel{.y_range = range, .curves = {curve}}}}, path("a.png"));
    const auto [left, right, top, bottom] = Pixels(path("a.png")).extent(palette(0));
    EXPECT_GT(bottom - top, 300) << "the curve is flat";
}

TEST_F(Figures, CurvesAreInterruptedWhereTheyAreNotFinite) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto middle_row = [&](double y) {
        Panel panel{.x_range = Interval{0, 4}, .y_range = Interval{-1, 1}};
        panel.curves = {{.x = {0, 1, 2, 3, 4}, .y = {0, 0, y, 0, 0}}};
        save({.panels = {panel}}, path("a.png"));
        return Pixels(path("a.png")).count(palette(0));
    };
    const auto whole = static_cast<double>(middle_row(0));
    EXPECT_GT(whole, 500);
    EXPECT_NEAR(static_cast<double>(middle_row(nan)), whole / 2, 0.05 * whole);
}

TEST_F(Figures, CellsOfAHeatMapHaveTheColoursOfTheirValues) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    Figure figure{.panels = {map_panel({{0, 1, 3}, {0, 2}, {1, 2, none, 3, 4, 5}, "T [K]"}, "a", "b")}};
    save(figure, path("a.png"));
    const Pixels pixels(path("a.png"));
    const PanelPlace place = lay_out(figure).places[0];
    const auto at = [&](double x, double y) {
        return pixels.at(place.left + place.width * (x - place.x.low) / (place.x.high - place.x.low),
                         place.top + place.height * (place.y.high - y) / (place.y.high - place.y.low));
    };
    EXPECT_EQ(std::tuple(place.x.low, place.x.high, place.y.low, place.y.high), std::tuple(-0.5, 4, -1, 3));
    const auto far = [](Colour a, Colour b) { return std::hypot(a.r - b.r, a.g - b.g, a.b - b.b); };
    EXPECT_LT(far(at(0.1, 0.1), {0x44, 0x01, 0x54, 255}), 12);
    EXPECT_EQ(at(0.6, -0.5), at(1.9, 0.9));  // half-way to the neighbours
    EXPECT_NE(at(0.6, -0.5), at(0.4, -0.5));
    EXPECT_LT(far(at(3.5, 2.1), {0xfd, 0xe7, 0x25, 255}), 12);
    EXPECT_EQ(at(3.1, 0.1), (Colour{255, 255, 255, 255}));
    // No gap between two cells.
    EXPECT_GT(far(at(2 - 0.001, 2), {255, 255, 255, 255}), 150);
    const std::string svg = svg_of(figure, path("a.svg"));
    for (const char* word : {"T [K]", "a", "b"}) EXPECT_NE(svg.find(text_element(word)), std::string::npos) << word;
    // One value alone, and none at all.
    save({.panels = {map_panel({{1}, {1}, {7}, "T"}, "a", "b")}}, path("one.png"));
    save({.panels = {map_panel({{1}, {1}, {none}, "T"}, "a", "b")}}, path("none.png"));
    for (const HeatMap& wrong : {HeatMap{{0, 1}, {0}, {1}, ""}, HeatMap{{1, 0}, {0}, {1, 2}, ""}})
        EXPECT_THROW(save({.panels = {map_panel(wrong, "a", "b")}}, path("x.png")), Error);
}

TEST_F(Figures, NameWhatIsWrong) {
    EXPECT_CONTAINS(error_of([&] { save(sine(), path("a.bmp")); }, Error::Cause::input), "a.bmp");
    Figure uneven = sine();
    uneven.panels[0].curves[1].y.pop_back();
    EXPECT_CONTAINS(error_of([&] { save(uneven, path("a.png")); }, Error::Cause::input),
                    "\"second\" has 101 x and 100 y");
    error_of([&] { save(Figure{}, path("a.png")); }, Error::Cause::input);
    error_of([&] { save(sine(), path("no/a.png")); });
    EXPECT_TRUE(files().empty());
}

TEST_F(Figures, SayThatGnuplotIsMissing) {
    const WithPath nowhere(folder_.string());
    EXPECT_CONTAINS(error_of([&] { save(sine(), path("a.png")); }),
                    "gnuplot failed, which figures need: it is not installed (or not in PATH)");
    EXPECT_TRUE(files().empty());
}

TEST_F(Figures, GiveGnuplotsOwnWordsWhenItFails) {
    const auto fake = path("bin");
    std::filesystem::create_directory(fake);
    std::ofstream(fake / "gnuplot") << "#!/bin/sh\nread line\necho 'line 0: no such terminal' >&2\nexit 1\n";
    std::filesystem::permissions(fake / "gnuplot", std::filesystem::perms::owner_all);
    const WithPath first(fake.string() + ":/usr/bin:/bin");
    std::ofstream(path("a.png")) << "old";
    EXPECT_CONTAINS(error_of([&] { save(sine(), path("a.png")); }), "no such terminal");
    EXPECT_EQ(contents(path("a.png")), "old");
    EXPECT_EQ(files().size(), 2u);
}

}  // namespace
}  // namespace carom
