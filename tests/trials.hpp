#pragma once
// How many random trials a test makes.

namespace carom::test {

/// All of so many; under the sanitizers, where each takes nine times as long and what they look for is not in the
/// numbers, one in eight.
constexpr int trials(int all) {
#ifdef CAROM_SPOILS_SCRATCH
    return (all + 7) / 8;
#else
    return all;
#endif
}

}  // namespace carom::test
