#pragma once

namespace carom::test {

inline constexpr double frame = 1.0 / 60;  ///< [s], the step of the tests of contacts and joints

}  // namespace carom::test
