#pragma once
// A world in other units of length and mass, by the units that the descriptions of its fields name.

#include <carom/carom.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace carom::test {

/// How many of the new units are one of the old.
struct InUnits {
    double length = 1, mass = 1;

    /// What becomes of a number of a unit, as "N m/rad"; of "N/m or N m/rad" the second if it is of something that
    /// turns.
    double factor(std::string unit, bool turns) const {
        if (const auto other = unit.find(" or "); other != std::string::npos) {
            const std::string first = unit.substr(0, other), second = unit.substr(other + 4);
            const bool turns_first = first.find("rad") == 0;
            unit = turns == turns_first ? first : second;
        }
        double product = 1;
        bool divides = false;
        for (std::size_t i = 0; i < unit.size();) {
            const std::size_t end = std::min(unit.find_first_of(" /", i), unit.size());
            const double one = of_one(unit.substr(i, end - i));
            product = divides ? product / one : product * one;
            divides = divides || (end < unit.size() && unit[end] == '/');
            i = end + 1;
        }
        return product;
    }
    template <class T>
    void change(T& field, const char* unit = "", bool turns = false) const {
        if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Vec2>) {
            field = factor(unit, turns) * field;
        } else if constexpr (requires { fields(&field); }) {
            constexpr bool is_angle = std::is_same_v<T, RevoluteJoint> || std::is_same_v<T, WeldJoint>;
            const auto own = [&](const auto& described) {
                const bool turns_wheel = std::is_same_v<T, WheelJoint> && std::string("motor") == described.name;
                change(field.*described.member, described.unit, turns || is_angle || turns_wheel);
            };
            std::apply([&](const auto&... described) { (own(described), ...); }, fields(&field));
        } else {
            change_members(field, unit, turns);
        }
    }

  private:
    double of_one(const std::string& unit) const {
        const bool is_square = unit.ends_with("²");
        const std::string base = unit.substr(0, unit.find("²"));
        const double once = base == "m"                    ? length
                            : base == "kg"                 ? mass
                            : base == "N"                  ? mass * length
                            : base == "J"                  ? mass * length * length
                            : base == "s" || base == "rad" ? 1
                            : base == "Hz" || base == "1" || base == "C" || base.empty()
                                ? 1
                                : throw Error("no unit of these worlds: " + unit);
        return is_square ? once * once : once;
    }
    template <class T>
    void change_members(std::optional<T>& some, const char* unit, bool turns) const {
        if (some) change(*some, unit, turns);
    }
    template <class T>
    void change_members(std::vector<T>& all, const char* unit, bool turns) const {
        for (T& one : all) change(one, unit, turns);
    }
    template <class... T>
    void change_members(std::variant<T...>& chosen, const char* unit, bool turns) const {
        std::visit([&](auto& one) { change(one, unit, turns); }, chosen);
    }
    template <class T>
    void change_members(const T&, const char*, bool) const {}  // a name, a choice, a body
};

/// The world as it is put down, of bodies, joints, springs and walls: none was removed, so that all keep their numbers.
inline World in_units(const World& world, const InUnits& units) {
    Settings settings = world.settings();
    settings.gravity = units.length * settings.gravity;
    World other(settings);
    const auto add = [&](auto one) {
        units.change(one);
        other.add(one);
    };
    for (const BodyId id : world.ids()) add(world.body(id));
    for (const auto& one : world.springs()) add(one);
    for (const auto& one : world.rectangles()) add(one);
    for (const auto& one : world.half_planes()) add(one);
    for (const auto& one : world.joints()) add(one);
    return other;
}

}  // namespace carom::test
