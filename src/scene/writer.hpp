#pragma once
// Any described struct → JSON, by its fields.

#include <carom/body.hpp>
#include <functional>

#include "scene/json.hpp"
#include "state/validate.hpp"

namespace carom {

/// Every field that differs from its default, or is required. Bodies are named by `name_of`.
class Writer {
  public:
    explicit Writer(std::function<std::string(BodyId)> name_of) : name_of_(std::move(name_of)) {}

    template <Described T>
    Json write(const T& value) const {
        Json out = Json::object();
        const T standard{};
        std::apply([&](const auto&... f) { (write_field(out, value, standard, f), ...); }, fields(&value));
        return out;
    }

    /// All fields, those at their defaults too.
    template <Described T>
    Json every(const T& value) const {
        Json out = Json::object();
        std::apply([&](const auto&... f) { (add_field(out, value, f), ...); }, fields(&value));
        return out;
    }

  private:
    template <class T, class S, class M>
    void write_field(Json& out, const T& value, const T& standard, const Field<S, M>& f) const {
        // Null is nobody's value: what is needed is always written.
        add(out, f.name, json(value.*f.member), *f.needed ? Json() : json(standard.*f.member));
    }
    static void add(Json& out, const std::string& name, Json value, const Json& standard) {
        if (value != standard) out[name] = std::move(value);
    }

    template <class T, class S, class M>
    void write_field(Json& out, const T& value, const T&, const Flat<S, M>& f) const {
        add_flat(out, f.name, value.*f.member, [this](const auto& chosen) { return this->write(chosen); });
    }

    template <class T, class S, class M>
    void add_field(Json& out, const T& value, const Field<S, M>& f) const {
        out[f.name] = json(value.*f.member);
    }
    template <class T, class S, class M>
    void add_field(Json& out, const T& value, const Flat<S, M>& f) const {
        add_flat(out, f.name, value.*f.member, [this](const auto& chosen) { return this->every(chosen); });
    }

    template <class V, class F>
    static void add_flat(Json& out, const char* key, const V& value, F written) {
        const auto add = [&](const auto& chosen) {
            out[key] = chosen.name;
            out.update(written(chosen));
        };
        std::visit(add, value);
    }

    template <class M>
    Json json(const M& value) const {
        if constexpr (std::is_arithmetic_v<M> || std::is_same_v<M, std::string>) {
            return value;
        } else if constexpr (std::is_same_v<M, Vec2>) {
            return {value.x, value.y};
        } else if constexpr (std::is_same_v<M, BodyId>) {
            return name_of_(value);
        } else if constexpr (std::is_same_v<M, Colour>) {
            return fmt::format("#{:02x}{:02x}{:02x}", value.r, value.g, value.b) +
                   (value.a == 255 ? "" : fmt::format("{:02x}", value.a));
        } else if constexpr (std::is_enum_v<M>) {
            for (const auto& c : choices(&value))
                if (c.value == value) return c.name;
            return nullptr;
        } else if constexpr (requires { std::visit([](auto&) {}, value); }) {
            return std::visit(
                [&](const auto& method) -> Json {
                    Json options = Json::object();
                    if constexpr (requires { fields(&method); }) options = write(method);
                    if (options.empty()) return method.name;
                    Json whole{{"method", method.name}};
                    whole.update(options);
                    return whole;
                },
                value);
        } else if constexpr (requires { value.has_value(); }) {
            return value ? json(*value) : Json();
        } else if constexpr (requires { value.begin(); }) {
            Json list = Json::array();
            for (const auto& item : value) list.push_back(json(item));
            return list;
        } else {
            return write(value);
        }
    }

    std::function<std::string(BodyId)> name_of_;
};

}  // namespace carom
