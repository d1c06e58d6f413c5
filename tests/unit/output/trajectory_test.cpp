// Trajectories in all formats. How other programs read them is tested in tests/e2e/cli/data_test.py.

#include <cmath>

#include "error_of.hpp"
#include "helpers.hpp"

namespace carom {
namespace {

using Trajectories = OutputTest;

const DataFormat formats[] = {DataFormat::csv, DataFormat::xyz, DataFormat::h5md};

World two_bodies() {
    World world({.gravity = {0, -10}});
    world.add(Body{.velocity = {3, 4}, .name = "ball"});
    world.add(Body{.position = {1, 0}, .angle = 0.5, .angular_velocity = 2, .radius = 0.1});
    return world;
}

const Provenance provenance{
    .version = "1.2.3", .build = "by hand", .seed = "7", .scene = "{\"carom\": 1,\n  \"a\": \"\\\\\"}"};

TEST_F(Trajectories, AreByTheirEnding) {
    EXPECT_EQ(data_format("a/b.csv"), DataFormat::csv);
    EXPECT_EQ(data_format("b.xyz"), DataFormat::xyz);
    EXPECT_EQ(data_format("b.extxyz"), DataFormat::xyz);
    EXPECT_EQ(data_format("b.h5"), DataFormat::h5md);
    EXPECT_EQ(data_format("b.c.h5md"), DataFormat::h5md);
    for (const char* wrong : {"", "csv", "b", "b.hdf", "b.csv/c", ".csv"})
        EXPECT_CONTAINS(error_of([&] { data_format(wrong); }, Error::Cause::input), "a data file ends with .csv");
}

TEST_F(Trajectories, HaveTheirRunInside) {
    for (const DataFormat format : formats) {
        const World world = two_bodies();
        Trajectory data(path("a"), format, world, provenance);
        data.add(world);
        data.commit("{\"ended\": \"well\"}");
        const auto inside = provenance_of(path("a"));
        ASSERT_TRUE(inside);
        EXPECT_EQ(inside->version, "1.2.3");
        EXPECT_EQ(inside->build, "by hand");
        EXPECT_EQ(inside->seed, "7");
        // Line breaks between the words of JSON mean nothing, and CSV and XYZ leave them away.
        const std::string flat = "{\"carom\": 1,\"a\": \"\\\\\"}";
        EXPECT_EQ(inside->scene, format == DataFormat::h5md ? provenance.scene : flat);
        EXPECT_EQ(inside->summary, format == DataFormat::h5md ? "{\"ended\": \"well\"}" : "");
        if (format == DataFormat::csv) {
            EXPECT_CONTAINS(contents(path("a")), "\n# carom.summary: {\"ended\": \"well\"}\n");
        }
    }
}

TEST_F(Trajectories, WithoutAProvenanceHaveNone) {
    for (const DataFormat format : formats) {
        const World world = two_bodies();
        Trajectory data(path("a"), format, world);
        data.add(world);
        data.commit();
        if (format == DataFormat::h5md) {
            EXPECT_CONTAINS(error_of([&] { provenance_of(path("a")); }, Error::Cause::input),
                            "no scene of Carom's in it");
        } else {
            EXPECT_FALSE(provenance_of(path("a")));
        }
    }
    EXPECT_FALSE(provenance_of(path("none")));
    EXPECT_FALSE(provenance_of(folder_));
}

// What Python prints of the file a.h5.
std::string python(const std::filesystem::path& file, const std::string& expression) {
    return output_of("/usr/bin/python3 -c 'import h5py; f = h5py.File(\"" + file.string() +
                     "\"); p = f[\"particles/bodies\"]; print(" + expression + ")' 2>&1");
}

TEST_F(Trajectories, KeepThePlacesOfBodiesThatComeAndGo) {
    if (output_of("/usr/bin/python3 -c 'import h5py' 2>&1") != "") GTEST_SKIP() << "no h5py";
    World world = two_bodies();
    Trajectory data(path("a.h5"), DataFormat::h5md, world, provenance);
    data.add(world);
    world.remove(world.find("ball"));
    data.add(world);
    world.add(Body{.position = {5, 5}, .mass = 8});
    world.add(Body{.position = {6, 6}});
    data.add(world);
    data.commit();
    EXPECT_EQ(python(path("a.h5"), "p[\"id/value\"][()].tolist()"), "[[0, 1, -1], [-1, 1, -1], [4294967296, 1, 2]]\n");
    EXPECT_EQ(python(path("a.h5"), "p[\"position/value\"][:, :, 0].tolist()"),
              "[[0.0, 1.0, nan], [nan, 1.0, nan], [5.0, 1.0, 6.0]]\n");
    EXPECT_EQ(python(path("a.h5"), "p[\"mass/value\"][2].tolist(), p[\"species/value\"][0].tolist()"),
              "[8.0, 1.0, 1.0] [0, 0, -1]\n");
}

// Who followed an id found one body where two had been. In both formats a body is called the same.
TEST_F(Trajectories, OfXyzGaveTheIdOfARemovedBodyToAnother) {
    World world = two_bodies();
    Trajectory data(path("a.xyz"), DataFormat::xyz, world, provenance);
    const BodyId removed = world.find("ball");
    world.remove(removed);
    const BodyId added = world.add(Body{.position = {5, 5}, .velocity = {0.5, 0.25}});
    ASSERT_EQ(added.index, removed.index);
    data.add(world);
    data.commit();
    EXPECT_NE(contents(path("a.xyz")).find("\nX 5 5 0 0.5 0.25 0 4294967296 0 "), std::string::npos);
}

TEST_F(Trajectories, ManyFramesFillManyChunks) {
    if (output_of("/usr/bin/python3 -c 'import h5py' 2>&1") != "") GTEST_SKIP() << "no h5py";
    World world;
    for (int i = 0; i < 7; ++i) world.add(Body{.velocity = {1.0 * i, 0}});
    Trajectory data(path("a.h5"), DataFormat::h5md, world, provenance);
    for (int frame = 0; frame < 5000; ++frame) {
        data.add(world);
        world.step(0.5);
    }
    data.commit();
    EXPECT_EQ(
        python(path("a.h5"),
               "all((p[\"position/value\"][k, :, 0] == [0.5 * k * i for i in range(7)]).all() for k in range(5000))"),
        "True\n");
    EXPECT_EQ(python(path("a.h5"), "p[\"position/value\"].shape, p[\"position/time\"][-1], p[\"position/step\"][-1]"),
              "(5000, 7, 2) 2499.5 4999\n");
}

TEST_F(Trajectories, AppearWholeOrNotAtAll) {
    for (const DataFormat format : formats) {
        const World world = two_bodies();
        {
            Trajectory data(path("a"), format, world, provenance);
            data.add(world);
            EXPECT_FALSE(std::filesystem::exists(path("a")));
        }
        EXPECT_TRUE(files().empty());
    }
}

TEST_F(Trajectories, GoOnFromABookmark) {
    for (const DataFormat format : formats) {
        World world = two_bodies();
        Trajectory whole(path("whole"), format, world, provenance);
        Bookmark bookmark;
        {
            Trajectory cut(path("cut"), format, world, provenance);
            for (int k = 0; k < 20; ++k) {
                whole.add(world), cut.add(world);
                if (k == 10) bookmark = cut.sync();
                if (k < 11) world.step(0.1);
            }
            // Its process dies here: what came after the bookmark is lost.
        }
        Trajectory again(bookmark, format, world, provenance);
        for (int k = 11; k < 20; ++k) again.add(world);
        whole.commit("{}"), again.commit("{}");
        again.release();
        EXPECT_EQ(contents(path("whole")), contents(path("cut")));
    }
    EXPECT_EQ(files().size(), 2u);
}

TEST_F(Trajectories, GoOnAfterTheyGotTheirName) {
    for (const DataFormat format : {DataFormat::csv, DataFormat::xyz}) {
        World world = two_bodies();
        Bookmark bookmark;
        {
            Trajectory first(path("a"), format, world, provenance);
            first.add(world);
            bookmark = first.sync();
            first.commit("{\"interrupted\": true}");
        }
        const std::string before = contents(path("a"));
        {
            Trajectory second(bookmark, format, world, provenance);
            second.add(world);
            EXPECT_EQ(contents(path("a")), before) << "it is whole until the end";
        }
        EXPECT_EQ(files().size(), 1u) << "a copy that nobody needs";
        Trajectory third(bookmark, format, world, provenance);
        third.add(world);
        third.commit("{\"interrupted\": true}");
        EXPECT_GT(contents(path("a")).size(), before.size());
        std::filesystem::remove(path("a"));
        EXPECT_CONTAINS(error_of([&] { Trajectory(bookmark, format, world, provenance); }, Error::Cause::input),
                        "are not where the checkpoint left them");
    }
}

// ---- Checkpoints ----------------------------------------------------------------------------------------------------

using Checkpointed = OutputTest;

TEST_F(Checkpointed, ComeBack) {
    save_checkpoint(path("c"), provenance, [](Saver& to) { to(std::string("words"), 1.5, std::vector<int>{1, 2}); });
    const std::string bytes = load_checkpoint(path("c"));
    Loader from(bytes);
    std::string words;
    double number = 0;
    std::vector<int> list;
    from(words, number, list);
    EXPECT_EQ(words, "words");
    EXPECT_EQ(number, 1.5);
    EXPECT_EQ(list, (std::vector<int>{1, 2}));
    EXPECT_TRUE(from.at_end());
    EXPECT_EQ(provenance_of(path("c"))->scene, provenance.scene);
    EXPECT_EQ(files().size(), 1u);
}

TEST_F(Checkpointed, DamagedAnywhereAreAnError) {
    save_checkpoint(path("c"), provenance, [](Saver& to) { to(std::string("words")); });
    const std::string good = contents(path("c"));
    for (std::size_t n = 0; n < good.size(); ++n) {
        std::string bad = good;
        bad[n] = static_cast<char>(bad[n] ^ 16);
        std::ofstream(path("bad"), std::ios::binary) << bad;
        error_of([&] { load_checkpoint(path("bad")); }, Error::Cause::input);
        std::ofstream(path("bad"), std::ios::binary) << good.substr(0, n);
        error_of([&] { load_checkpoint(path("bad")); }, Error::Cause::input);
    }
}

TEST_F(Checkpointed, OfAnotherVersionSaySo) {
    // What an older Carom wrote: the hash is right, the version is not.
    save_checkpoint(path("c"), provenance, [](Saver&) {});
    std::string bytes = contents(path("c"));
    bytes[17] = 9;
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (std::size_t n = 0; n + 8 < bytes.size(); ++n)
        hash = (hash ^ static_cast<unsigned char>(bytes[n])) * 0x100000001b3u;
    bytes.replace(bytes.size() - 8, 8, reinterpret_cast<const char*>(&hash), 8);
    std::ofstream(path("c"), std::ios::binary) << bytes;
    EXPECT_CONTAINS(error_of([&] { load_checkpoint(path("c")); }, Error::Cause::input), "(format 9), and this is");
}

TEST_F(Checkpointed, ThatCannotBeWrittenLeaveTheOneBefore) {
    save_checkpoint(path("c"), provenance, [](Saver&) {});
    const std::string before = contents(path("c"));
    struct Trouble {};
    EXPECT_THROW(save_checkpoint(path("c"), provenance, [](Saver&) { throw Trouble{}; }), Trouble);
    EXPECT_EQ(contents(path("c")), before);
    EXPECT_EQ(files().size(), 1u);
}

// At two frames.
TEST_F(Trajectories, OfH5mdKeptTheMassOfAnEditedBody) {
    if (output_of("/usr/bin/python3 -c 'import h5py' 2>&1") != "") GTEST_SKIP() << "no h5py";
    World world = two_bodies();
    Trajectory data(path("a"), DataFormat::h5md, world, provenance);
    data.add(world);
    Body ball = world.body(world.find("ball"));
    ball.mass = 7, ball.radius = 0.5, ball.charge = 3, ball.kind = Kind::driven, ball.name = "heavy";
    world.set(world.find("ball"), ball);
    data.add(world);
    data.commit();
    EXPECT_EQ(python(path("a"),
                     "*(p[k][\"value\"][:, 0].tolist() for k in (\"mass\", \"radius\", \"charge\", \"species\", "
                     "\"id\", \"name\"))"),
              "[1.0, 7.0] [0.0, 0.5] [0.0, 3.0] [0, 2] [0, 0] [b'ball', b'heavy']\n");
}

// A place below the box by less than rounding: no place in a box is its upper edge.
TEST_F(Trajectories, OfH5mdPutABodyOnTheUpperEdge) {
    if (output_of("/usr/bin/python3 -c 'import h5py' 2>&1") != "") GTEST_SKIP() << "no h5py";
    World world;
    world.add(Periodic{.high = {1, 1}});
    world.add(Body{.position = {-1e-18, 3}});
    Trajectory data(path("a"), DataFormat::h5md, world, provenance);
    data.add(world);
    data.commit();
    EXPECT_EQ(python(path("a"), "p[\"position/value\"][0, 0].tolist(), p[\"image/value\"][0, 0].tolist()"),
              "[0.0, 0.0] [0, 3]\n");
}

// Three milliard boxes away was -2147483648.
TEST_F(Trajectories, OfH5mdLostTheBoxOfABodyFarAway) {
    if (output_of("/usr/bin/python3 -c 'import h5py' 2>&1") != "") GTEST_SKIP() << "no h5py";
    World world;
    world.add(Periodic{.high = {1, 1}});
    world.add(Body{.position = {3e9 + 0.5, -3e9 + 0.5}});
    Trajectory data(path("a"), DataFormat::h5md, world, provenance);
    data.add(world);
    data.commit();
    EXPECT_EQ(python(path("a"), "p[\"position/value\"][0, 0].tolist(), p[\"image/value\"][0, 0].tolist()"),
              "[0.5, 0.5] [3000000000, -3000000000]\n");
    // Beyond all whole numbers a place in a box says nothing.
    world.add(Body{.position = {1e20, 0}});
    Trajectory lost(path("b"), DataFormat::h5md, world, provenance);
    lost.add(world);
    EXPECT_NE(
        test::error_of([&] { lost.commit(); }).find("a body is 1e+20 boxes away, and 'image' counts up to 9.2e+18"),
        std::string::npos);
}

}  // namespace
}  // namespace carom
