// Every field of every described struct goes from JSON into the struct and back.

#include "scene/reader.hpp"

#include <gtest/gtest.h>

#include <carom/random.hpp>

#include "error_of.hpp"
#include "scene/kinds.hpp"
#include "scene/writer.hpp"

namespace {

using namespace carom;

/// Random objects of a described struct.
class Maker {
  public:
    explicit Maker(std::uint64_t seed) : random_(seed) {}

    /// Some of the fields, and all that are required.
    template <class T>
    Json object() {
        Json out = Json::object();
        if constexpr (Described<T>) {
            std::apply([&](const auto&... f) { (add(out, f), ...); }, fields(static_cast<const T*>(nullptr)));
        }
        return out;
    }

  private:
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.uniform(0, static_cast<double>(n))); }

    template <class S, class M>
    void add(Json& out, const Field<S, M>& f) {
        if (is_required(f) || below(3) > 0) out[f.name] = value<M>(f.range);
    }
    template <class S, class V>
    void add(Json& out, const Flat<S, V>& f) {
        out.update(alternative<V>(f.name, below(std::variant_size_v<V>)));
    }

    double number(const Range& range) {
        const double low = std::max(range.low, -1e3), high = std::min(range.high, 1e3);
        return range.high - range.low == 0 ? low : random_.uniform(low, high) + (range.low_open ? 1e-9 : 0);
    }

    template <class M>
    Json value(const Range& range) {
        if constexpr (std::is_same_v<M, bool>) {
            return below(2) == 1;
        } else if constexpr (std::is_same_v<M, double>) {
            return number(range);
        } else if constexpr (std::is_same_v<M, int>) {
            return static_cast<int>(number(range));
        } else if constexpr (std::is_same_v<M, std::string>) {
            static const char* const words[] = {"", "a word", "\"quoted\"\n", "größer ≥ 1", "t"};
            return words[below(std::size(words))];
        } else if constexpr (std::is_same_v<M, Vec2>) {
            return {number(range), number(range)};
        } else if constexpr (std::is_same_v<M, BodyId>) {
            return below(2) == 1 ? "a" : "b[0]";
        } else if constexpr (std::is_same_v<M, Colour>) {
            return fmt::format("#{:06x}", below(1 << 24)) + (below(2) == 1 ? "" : fmt::format("{:02x}", below(255)));
        } else if constexpr (std::is_enum_v<M>) {
            const auto all = choices(static_cast<const M*>(nullptr));
            return all[below(all.size())].name;
        } else if constexpr (requires(M m) { std::visit([](auto&) {}, m); }) {
            const Json method = alternative<M>("method", below(std::variant_size_v<M>));
            return below(2) == 1 ? method["method"] : method;
        } else if constexpr (requires(M m) { m.push_back(m.front()); }) {
            Json list = Json::array();
            for (std::size_t n = below(4); n > 0; --n) list.push_back(value<typename M::value_type>(range));
            return list;
        } else if constexpr (requires(M m) { m.has_value(); }) {
            return value<typename M::value_type>(range);
        } else {
            return object<M>();
        }
    }

    template <class V, std::size_t i = 0>
    Json alternative(const char* key, std::size_t which) {
        if constexpr (i < std::variant_size_v<V>) {
            using M = std::variant_alternative_t<i, V>;
            if (which != i) return alternative<V, i + 1>(key, which);
            Json whole{{key, M::name}};
            whole.update(object<M>());
            return whole;
        }
        return nullptr;
    }

    Random random_;
};

struct Everything : testing::Test {
    World world = [] {
        World w;
        w.add(Body{.name = "a"});
        w.add(Body{.name = "b[0]"});
        return w;
    }();
    Names names{{}, &world};
    Reader reader{names};
    Writer writer{[this](BodyId id) { return world.contains(id) ? world.body(id).name : ""; }};
    Place place{"test", ""};

    template <class T>
    void there_and_back() {
        Maker maker(1);
        for (int n = 0; n < 100; ++n) {
            const Json given = maker.object<T>();
            T once{}, twice{};
            reader.read(given, place, once);
            reader.read(writer.write(once), place, twice);
            EXPECT_EQ(writer.every(once), writer.every(twice)) << given;
            const Json all = writer.every(once);
            for (const auto& [key, value] : given.items())
                if (!value.is_structured()) {
                    EXPECT_EQ(all[key], value) << key;
                }
            EXPECT_EQ(pretty(parse_json(pretty(given), "test")), pretty(given));
        }
    }

    template <class... T>
    void all_of(const std::tuple<Type<T>...>&) {
        (there_and_back<T>(), ...);
    }
};

TEST_F(Everything, Settings) { there_and_back<Settings>(); }
TEST_F(Everything, Plan) { there_and_back<Plan>(); }
TEST_F(Everything, Body) { there_and_back<Body>(); }
TEST_F(Everything, Expectation) { there_and_back<Expectation>(); }
TEST_F(Everything, Picture) { there_and_back<Picture>(); }
TEST_F(Everything, Walls) { all_of(wall_types); }
TEST_F(Everything, Forces) { all_of(force_types); }
TEST_F(Everything, Builders) { all_of(builder_types); }

/// What is said of a body that is wrong.
std::string complaint(const std::string& body, const Names& names = {}) {
    return test::error_of([&] {
        Body out;
        Reader(names).read(Json::parse(body), Place{"f", "b"}, out);
    });
}

TEST(Reader, NamesPlaceValueAndWhatIsAllowed) {
    const std::pair<const char*, const char*> table[] = {
        {R"(3)", "f: b must be an object, got 3"},
        {R"({"mass": true})", "f: b.mass must be a number > 0 in kg, got true"},
        {R"({"mass": null})", "f: b.mass must be a number > 0 in kg, got null"},
        {R"({"mass": -1})", "f: b.mass must be a number > 0 in kg, got -1"},
        {R"({"mass": 0})", "f: b.mass must be a number > 0 in kg, got 0"},
        {R"({"mass": "1-2"})", "f: b.mass must be a number > 0 in kg, got \"1-2\": it is -1"},
        {R"({"mass": "1/0"})", "f: b.mass must be a number > 0 in kg, got \"1/0\": it is inf"},
        {R"({"mass": "mm"})",
         "f: b.mass must be a number > 0 in kg or an expression of the parameters, got \"mm\": there is no 'mm' here"},
        {R"({"position": 3})", "f: b.position must be [x, y] in m, got 3"},
        {R"({"position": [1]})", "f: b.position must be [x, y] in m, got [1]"},
        {R"({"position": [1, false]})", "f: b.position[1] must be a finite number in m, got false"},
        {R"({"name": 3})", "f: b.name must be a text, for example \"3\", got 3"},
        {R"({"kind": "fixd"})", "f: b.kind must be one of dynamic, fixed, driven, got \"fixd\"; did you mean 'fixed'?"},
        {R"({"kind": 3})", "f: b.kind must be one of dynamic, fixed, driven, got 3"},
        {R"({"restitution": 1.5})", "f: b.restitution must be a number from 0 to 1, got 1.5"},
        {R"({"colour": "bleu"})",
         "f: b.colour must be a colour like \"#0072b2\", \"#0072b280\" or \"blue\", got \"bleu\"; did you mean "
         "'blue'?"},
        {R"({"colour": "#00000"})",
         "f: b.colour must be a colour like \"#0072b2\", \"#0072b280\" or \"blue\", got \"#00000\""},
        {R"({"colour": 7})", "f: b.colour must be a colour like \"#0072b2\", \"#0072b280\" or \"blue\", got 7"},
        {R"({"mas": 1})", "f: b has no field \"mas\"; did you mean 'mass'?"},
        {R"({"type": "fixed"})", "f: b has no field \"type\"; did you mean 'kind'?"},
        {R"({"qqqqqqqq": 1})",
         "f: b has no field \"qqqqqqqq\"; known are name, kind, position, angle, velocity, angular_velocity, mass, "
         "moment_of_inertia, fixed_rotation, radius, shapes, charge, restitution, friction, colour"},
    };
    for (const auto& [body, text] : table) EXPECT_EQ(complaint(body), text) << body;
}

TEST(Reader, ErrorsAreShort) {
    EXPECT_LT(complaint(R"({"name": [")" + std::string(10000, 'x') + "\"]}").size(), 200u);
    EXPECT_LT(complaint(R"({"mass": ")" + std::string(10000, 'x') + "\"}").size(), 300u);
    EXPECT_LT(complaint(R"({")" + std::string(10000, 'x') + "\": 3}").size(), 500u);
}

template <class T>
std::string complaint_of(const std::string& text) {
    const World world;
    const Names names{{}, &world};
    return test::error_of([&] {
        T out{};
        Reader(names).read(Json::parse(text), Place{"f", "x"}, out);
    });
}

TEST(Reader, OtherKindsOfFields) {
    EXPECT_EQ(complaint_of<Plan>(R"({"every": 1.5})"),
              "f: x.every must be a whole number >= 1, and whole and at most 2147483647, got 1.5");
    EXPECT_EQ(complaint_of<Fill>(R"({"seed": 2147483647})"), "no error");
    EXPECT_EQ(complaint_of<Fill>(R"({"seed": 2147483648})"),
              "f: x.seed must be a whole number from 0 to 2147483647, got 2147483648");
    EXPECT_EQ(complaint_of<Drag>(R"({"body": 3})"), "f: x.body must be the name of a body, got 3");
    EXPECT_EQ(complaint_of<Drag>(R"({"body": "q"})"),
              "f: x.body must be the name of a body, got \"q\": there is no body 'q'");
    EXPECT_EQ(complaint_of<Spring>(R"({"a": "q"})"),
              "f: x.a must be the name of a body, got \"q\": there is no body 'q'");
    EXPECT_EQ(complaint_of<Spring>("{}"), "f: x must have the field \"a\": body at one end");
    EXPECT_EQ(complaint_of<Rope>(R"({"fixed_a": 1})"), "f: x.fixed_a must be true or false, got 1");
    EXPECT_EQ(complaint_of<Picture>(R"({"at": 3})"), "f: x.at must be a list, got 3");
    EXPECT_EQ(complaint_of<Picture>(R"({"at": [1, -2]})"), "f: x.at[1] must be a number >= 0 in s, got -2");
    EXPECT_EQ(complaint_of<Rectangle>(R"({"left": {"friction": -1}})"),
              "f: x.left.friction must be a number >= 0, got -1");
    EXPECT_EQ(complaint_of<Settings>(R"({"solver": "impuls"})"),
              "f: x.solver must be one of impulse, softstep, events, none, got \"impuls\"; did you mean 'impulse'?");
    EXPECT_EQ(
        complaint_of<Settings>(R"({"solver": {"method": "impuls"}})"),
        "f: x.solver.method must be one of impulse, softstep, events, none, got \"impuls\"; did you mean 'impulse'?");
    EXPECT_EQ(complaint_of<Settings>(R"({"solver": {"time_of_impact": true}})"),
              "f: x.solver must have the field \"method\": one of impulse, softstep, events, none");
    EXPECT_EQ(complaint_of<Settings>(R"({"solver": {"method": "none", "time_of_impact": true}})"),
              "f: x.solver has no field \"time_of_impact\"; known are method");
    EXPECT_EQ(complaint_of<Settings>(R"({"threads": 0})"), "f: x.threads must be a whole number from 1 to 1024, got 0");
}

TEST(Reader, AShapesTypeSaysWhatStandsBesideIt) {
    Body body;
    Reader(Names{{{"w", 2}}, nullptr})
        .read(Json::parse(R"({"shapes": [{"type": "box", "friction": 0.5, "width": "w"},
                                         {"type": "chain", "points": [[0, 0], ["w", 1]], "filter": {"mask": 3}}]})"),
              {"f", ""}, body);
    ASSERT_EQ(body.shapes.size(), 2u);
    EXPECT_EQ(std::get<Box>(body.shapes[0].geometry).width, 2);
    EXPECT_EQ(body.shapes[0].friction, 0.5);
    EXPECT_EQ(std::get<Chain>(body.shapes[1].geometry).points.back(), (Vec2{2, 1}));
    EXPECT_EQ(body.shapes[1].filter.mask, 3);
    const Json written = Writer([](BodyId) { return ""; }).write(body);
    EXPECT_EQ(written.dump(), R"({"shapes":[{"type":"box","width":2.0,"friction":0.5},)"
                              R"({"type":"chain","points":[[0.0,0.0],[2.0,1.0]],"filter":{"mask":3}}]})");

    const std::pair<const char*, const char*> table[] = {
        {R"({"shapes": {}})", "f: b.shapes must be a list, got {}"},
        {R"({"shapes": [3]})", "f: b.shapes[0] must be an object, got 3"},
        {R"({"shapes": [{"radius": 1}]})",
         "f: b.shapes[0] must have the field \"type\": one of disc, capsule, box, polygon, hull, segment, chain"},
        {R"({"shapes": [{"type": "bax"}]})",
         "f: b.shapes[0].type must be one of disc, capsule, box, polygon, hull, segment, chain, got \"bax\"; did you "
         "mean 'box'?"},
        {R"({"shapes": [{"type": "box", "widht": 2}]})",
         "f: b.shapes[0] has no field \"widht\"; did you mean 'width'?"},
        {R"({"shapes": [{"type": "box", "points": []}]})",
         "f: b.shapes[0] has no field \"points\"; known are type, width, height, centre, angle, rounding, density, "
         "restitution, friction, rolling_resistance, surface_speed, sensor, filter"},
        {R"({"shapes": [{"type": "box"}, {"type": "box", "width": 0}]})",
         "f: b.shapes[1].width must be a number > 0 in m, got 0"},
        {R"({"shapes": [{"type": "hull", "points": [[0, 0], [1]]}]})",
         "f: b.shapes[0].points[1] must be [x, y] in m, got [1]"},
    };
    for (const auto& [text, what] : table) EXPECT_EQ(complaint(text), what) << text;
}

TEST(Reader, NumbersMayBeExpressionsOfParameters) {
    const Names names{{{"g", 9.8}, {"n", 3}}};
    Body body;
    Reader(names).read(Json::parse(R"json({"mass": "2*n", "velocity": ["-g", "sqrt(g*g)"]})json"), {"f", ""}, body);
    EXPECT_EQ(body.mass, 6);
    EXPECT_EQ(body.velocity.x, -9.8);
    EXPECT_EQ(body.velocity.y, 9.8);
    Plan plan;
    Reader(names).read(Json::parse(R"({"every": "2*n"})"), {"f", ""}, plan);
    EXPECT_EQ(plan.every, 6);
}

}  // namespace
