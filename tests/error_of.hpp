#pragma once
#include <carom/error.hpp>
#include <string>

namespace carom::test {

/// What an act complains of.
template <class Do>
std::string error_of(Do act) {
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace carom::test
