#include <cmath>
#include <cstring>
#include <limits>

#include "helpers.hpp"

namespace carom {
namespace {

using Tables = OutputTest;

std::vector<std::vector<std::string>> table(const std::filesystem::path& path) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream text(contents(path));
    for (std::string line; std::getline(text, line);) {
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
}

TEST_F(Tables, NameTheirUnitsInTheFirstLine) {
    Csv csv(path("a.csv"), {{"t", "s"}, {"x", "m"}, {"n"}});
    csv.row(0.5, 2.0, ~std::uint64_t{0});
    csv.commit();
    EXPECT_EQ(contents(path("a.csv")), "t [s],x [m],n\n0.5,2,18446744073709551615\n");
}

TEST_F(Tables, NumbersReadBackToTheLastBit) {
    std::vector<double> numbers{0.0,
                                -0.0,
                                0.1,
                                1.0 / 3,
                                1e300,
                                5e-324,
                                123456789.123456789,
                                -2.2250738585072014e-308,
                                std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::epsilon()};
    std::uint64_t bits = 1;
    for (int i = 0; i < 10000; ++i) {
        bits = bits * 6364136223846793005u + 1442695040888963407u;
        double number;
        std::memcpy(&number, &bits, sizeof number);
        if (std::isfinite(number)) numbers.push_back(number);
    }
    Csv csv(path("a.csv"), {{"x", "m"}});
    for (double number : numbers) csv.row(number);
    csv.commit();
    const auto rows = table(path("a.csv"));
    ASSERT_EQ(rows.size(), numbers.size() + 1);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double exact = std::strtod(rows[i + 1][0].c_str(), nullptr);
        EXPECT_EQ(std::memcmp(&exact, &numbers[i], sizeof exact), 0) << rows[i + 1][0];
    }
    EXPECT_EQ(rows[3][0], "0.1") << "not the shortest form";
}

TEST_F(Tables, QuoteTextThatWouldBreakTheRow) {
    Csv csv(path("a.csv"), {{"name"}, {"a, b", "m"}});
    csv.row("say \"hi\", twice", 1.0);
    csv.commit();
    EXPECT_EQ(contents(path("a.csv")), "name,\"a, b [m]\"\n\"say \"\"hi\"\", twice\",1\n");
}

TEST_F(Tables, RefuseARowOfAnotherLength) {
    Csv csv(path("a.csv"), {{"t", "s"}, {"x", "m"}});
    EXPECT_CONTAINS(error_of([&] { csv.row(1.0); }, Error::Cause::input), "a row of 1 cells in a table of 2 columns");
    csv.row_of(std::vector<double>{1, 2});
    csv.commit();
    EXPECT_EQ(contents(path("a.csv")), "t [s],x [m]\n1,2\n");
}

TEST_F(Tables, StreamWithoutGrowing) {
    Csv csv(path("a.csv"), {{"x", "m"}, {"y", "m"}});
    const auto memory = [] {
        std::ifstream status("/proc/self/statm");
        long all, resident;
        status >> all >> resident;
        return resident * 4096;
    };
    csv.row(0.1, 0.2);
    const long before = memory();
    for (int i = 0; i < 2000000; ++i) csv.row(i * 0.1, i * 0.7);
    EXPECT_LT(memory() - before, 8 << 20);
    csv.commit();
    EXPECT_GT(std::filesystem::file_size(path("a.csv")), 20u << 20);
}

TEST_F(Tables, TrajectoryOfAThrow) {
    World world({.gravity = {0, -10}});
    world.add(Body{.velocity = {3, 4}, .name = "ball"});
    world.add(Body{.position = {1, 0}, .angle = 0.5, .angular_velocity = 2, .radius = 0.1});
    Trajectory csv(path("a.csv"), DataFormat::csv, world);
    for (int i = 0; i < 5; ++i) {
        csv.add(world);
        world.step(0.125);
    }
    csv.commit();
    const auto rows = table(path("a.csv"));
    ASSERT_EQ(rows.size(), 11u);
    const std::vector<std::string> header{"t [s]",       "body",     "x [m]",    "y [m]",
                                          "angle [rad]", "vx [m/s]", "vy [m/s]", "omega [rad/s]"};
    EXPECT_EQ(rows[0], header);
    for (int i = 0; i < 5; ++i) {
        const auto& ball = rows[1 + 2 * i];
        const auto& disc = rows[2 + 2 * i];
        const double t = 0.125 * i;
        EXPECT_EQ(ball[1], "ball");
        EXPECT_EQ(disc[1], "1");
        EXPECT_DOUBLE_EQ(std::stod(ball[0]), t);
        EXPECT_NEAR(std::stod(ball[2]), 3 * t, 1e-12);
        EXPECT_NEAR(std::stod(ball[3]), 4 * t - 5 * t * t, 1e-12);
        EXPECT_NEAR(std::stod(ball[6]), 4 - 10 * t, 1e-12);
        EXPECT_NEAR(std::stod(disc[4]), 0.5 + 2 * t, 1e-12);
        EXPECT_NEAR(std::stod(disc[7]), 2, 1e-12);
    }
}

TEST_F(Tables, TrajectoryTellsANewBodyFromTheOneBeforeIt) {
    World world;
    world.add(Body{});
    const BodyId old = world.add(Body{.name = "old"});
    Trajectory csv(path("a.csv"), DataFormat::csv, world);
    csv.add(world);
    world.remove(old);
    const BodyId fresh = world.add(Body{});
    csv.add(world);
    csv.commit();
    const auto rows = table(path("a.csv"));
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_EQ(rows[2][1], "old");
    ASSERT_EQ(fresh.index, old.index) << "the test wants an index that is used again";
    EXPECT_EQ(rows[4][1], std::to_string(fresh.index) + "." + std::to_string(fresh.generation));
}

}  // namespace
}  // namespace carom
