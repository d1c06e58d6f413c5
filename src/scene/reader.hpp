#pragma once
// JSON → any described struct, by its fields.

#include <algorithm>
#include <carom/scene.hpp>

#include "scene/json.hpp"
#include "state/validate.hpp"

namespace carom {

/// What names mean while a document is read.
struct Names {
    std::vector<std::pair<std::string, double>> parameters;
    const World* world = nullptr;      ///< knows the bodies' names
    std::vector<std::string> later{};  ///< parameters that come after the one that is read
};

std::string not_one_of(const std::vector<std::string>& names, const Json& given);

/// Fields without a meaningful default.
template <class S, class M>
constexpr bool is_required(const Field<S, M>& f) {
    return std::is_same_v<M, BodyId> || *f.needed;
}

class Reader {
  public:
    explicit Reader(const Names& names) : names_(names) {}
    const Names& names() const { return names_; }

    /// Fills a described struct from an object; a key that is no field is an error with the nearest name.
    /// `also` are keys that the caller reads itself.
    template <Described T>
    void read(const Json& object, const Place& place, T& out, std::initializer_list<const char*> also = {}) const {
        if (!object.is_object()) throw place.expected("an object", object);
        const auto read_all = [&](const auto&... f) {
            (choose_flat(object, place, out, f), ...);
            std::vector<std::string> known(also.begin(), also.end());
            (add_keys(known, out, f), ...);
            check_known(object, place, known);
            (read_field(object, place, out, f), ...);
            (require(object, place, out, f), ...);
        };
        std::apply(read_all, fields(&out));
    }

    /// A number, or an expression in quotes that gives one.
    double number(const Json& value, const Place& place, const Range& range = any, const char* unit = "") const;

  private:
    /// What stands beside a flat field depends on what it chooses: that comes first.
    template <class T, class F>
    static void choose_flat(const Json& object, const Place& place, T& out, const F& f) {
        if constexpr (is_flat<F>) out.*f.member = named_by<typename F::Variant>(object, f.name, place);
    }

  public:
    /// The names of all fields.
    template <class T>
    static std::vector<std::string> keys(const T& value) {
        std::vector<std::string> known;
        std::apply([&](const auto&... f) { (add_keys(known, value, f), ...); }, fields(&value));
        return known;
    }

    static void check_known(const Json& object, const Place& place, const std::vector<std::string>& known);

  private:
    template <class T, class F>
    static void add_keys(std::vector<std::string>& known, const T& value, const F& f) {
        known.emplace_back(f.name);
        if constexpr (is_flat<F>) {
            const auto beside = std::visit([](const auto& chosen) { return keys(chosen); }, value.*f.member);
            known.insert(known.end(), beside.begin(), beside.end());
        }
    }

    // What is the same for all fields, or for all of one type, is no template of the field.
    template <class T, class S, class M>
    void read_field(const Json& object, const Place& place, T& out, const Field<S, M>& f) const {
        read_if_there(object, place, f.name, out.*f.member, f.range, f.unit);
    }
    template <class M>
    void read_if_there(const Json& object, const Place& place, const std::string& name, M& out, const Range& range,
                       const char* unit) const {
        if (const auto found = object.find(name); found != object.end())
            read_value(*found, place / name, out, range, unit);
    }

    /// What is there is looked at first: a wrong value says more than one that is missing.
    template <class T, class S, class M>
    static void require(const Json& object, const Place& place, const T&, const Field<S, M>& f) {
        if (is_required(f)) require(object, place, f.name, *f.needed ? f.needed : f.text);
    }
    static void require(const Json& object, const Place& place, const char* name, const char* what);

    template <class T, class S, class M>
    void read_field(const Json& object, const Place& place, T& out, const Flat<S, M>& f) const {
        const auto read_beside = [&](auto& chosen) {
            std::apply([&](const auto&... own) { (read_field(object, place, chosen, own), ...); }, fields(&chosen));
        };
        std::visit(read_beside, out.*f.member);
    }
    template <class T, class S, class M>
    static void require(const Json& object, const Place& place, const T& out, const Flat<S, M>& f) {
        const auto require_beside = [&](const auto& chosen) {
            std::apply([&](const auto&... own) { (require(object, place, chosen, own), ...); }, fields(&chosen));
        };
        std::visit(require_beside, out.*f.member);
    }

    template <class M>
    void read_value(const Json& value, const Place& place, M& out, const Range& range, const char* unit) const {
        if constexpr (std::is_same_v<M, double>) {
            out = number(value, place, range, unit);
        } else if constexpr (std::is_same_v<M, int>) {
            out = whole(value, place, range, unit);
        } else if constexpr (std::is_same_v<M, bool>) {
            if (!value.is_boolean()) throw place.expected("true or false", value);
            out = value.get<bool>();
        } else if constexpr (std::is_same_v<M, std::string>) {
            out = text(value, place);
        } else if constexpr (std::is_same_v<M, Vec2>) {
            out = vector(value, place, range, unit);
        } else if constexpr (std::is_same_v<M, BodyId>) {
            out = body(value, place);
        } else if constexpr (std::is_same_v<M, Colour>) {
            out = colour(value, place);
        } else if constexpr (std::is_enum_v<M>) {
            out = choice<M>(value, place);
        } else if constexpr (requires { std::visit([](auto&) {}, out); }) {
            out = variant<M>(value, place);
        } else if constexpr (requires { out.push_back(out.front()); }) {
            if (!value.is_array()) throw place.expected("a list", value);
            out.clear();
            for (std::size_t i = 0; i < value.size(); ++i)
                read_value(value[i], place / i, out.emplace_back(), range, unit);
        } else if constexpr (requires { out.emplace(); }) {  // std::optional
            read_value(value, place, out.emplace(), range, unit);
        } else {
            read(value, place, out);
        }
    }

    int whole(const Json& value, const Place& place, const Range& range, const char* unit) const;
    static std::string text(const Json& value, const Place& place);
    Vec2 vector(const Json& value, const Place& place, const Range& range, const char* unit) const;
    BodyId body(const Json& value, const Place& place) const;
    static Colour colour(const Json& value, const Place& place);

    template <class E>
    static E choice(const Json& value, const Place& place) {
        std::vector<std::string> names;
        for (const auto& c : choices(static_cast<const E*>(nullptr))) {
            if (value.is_string() && value.get<std::string>() == c.name) return c.value;
            names.push_back(c.name);
        }
        throw place.error(not_one_of(names, value));
    }

    /// "; did you mean 'world.integrator'?" of an integrator's name where a solver's is read, and the other way round.
    template <class V>
    static std::string under_other_key(const Json& name) {
        const auto is_of = [&]<class Other>(const char* key, const Other&) {
            const auto names = method_names<Other>();
            const bool is = std::find(names.begin(), names.end(), name) != names.end();
            return is ? fmt::format("; did you mean '{}'?", key) : "";
        };
        if constexpr (std::is_same_v<V, Solver>) return is_of("world.integrator", Integrator{});
        if constexpr (std::is_same_v<V, Integrator>) return is_of("world.solver", Solver{});
        return "";
    }
    /// The one of a variant's that has this name.
    template <class V>
    static V named(const Json& name, const Place& place) {
        V out;
        const bool found = [&]<std::size_t... k>(std::index_sequence<k...>) {
            return ((name == std::variant_alternative_t<k, V>::name && (out.template emplace<k>(), true)) || ...);
        }
        (std::make_index_sequence<std::variant_size_v<V>>{});
        if (!found) throw place.error(not_one_of(method_names<V>(), name) + under_other_key<V>(name));
        return out;
    }
    /// The one that an object names under a key.
    template <class V>
    static V named_by(const Json& object, const char* key, const Place& place) {
        if (const auto name = object.find(key); name != object.end()) return named<V>(*name, place / std::string(key));
        throw place.error(
            fmt::format("must have the field \"{}\": one of {}", key, fmt::join(method_names<V>(), ", ")));
    }

    /// A method by its name alone, or {"method": name, options…}.
    template <class V>
    V variant(const Json& value, const Place& place) const {
        if (!value.is_object()) return named<V>(value, place);
        V out = named_by<V>(value, "method", place);
        const auto read_options = [&]<class M>(M& method) {
            if constexpr (Described<M>)
                read(value, place, method, {"method"});
            else
                check_known(value, place, {"method"});
        };
        std::visit(read_options, out);
        return out;
    }

  public:
    template <class V>
    static std::vector<std::string> method_names() {
        return []<std::size_t... k>(std::index_sequence<k...>) {
            return std::vector<std::string>{std::variant_alternative_t<k, V>::name...};
        }
        (std::make_index_sequence<std::variant_size_v<V>>{});
    }

  private:
    const Names& names_;
};

}  // namespace carom
