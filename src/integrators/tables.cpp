#include "integrators/runge_kutta.hpp"

namespace carom {

namespace {

constexpr double euler_c[] = {0}, euler_b[] = {1};
constexpr double midpoint_c[] = {0, 0.5}, midpoint_a[] = {0.5}, midpoint_b[] = {0, 1};
constexpr double heun_c[] = {0, 1}, heun_a[] = {1}, heun_b[] = {0.5, 0.5};
constexpr double ralston_c[] = {0, 2. / 3}, ralston_a[] = {2. / 3}, ralston_b[] = {0.25, 0.75};
constexpr double kutta3_c[] = {0, 0.5, 1}, kutta3_a[] = {0.5, -1, 2}, kutta3_b[] = {1. / 6, 2. / 3, 1. / 6};
constexpr double rk4_c[] = {0, 0.5, 0.5, 1}, rk4_a[] = {0.5, 0, 0.5, 0, 0, 1},
                 rk4_b[] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
constexpr double kutta38_c[] = {0, 1. / 3, 2. / 3, 1}, kutta38_a[] = {1. / 3, -1. / 3, 1, 1, -1, 1},
                 kutta38_b[] = {1. / 8, 3. / 8, 3. / 8, 1. / 8};

// Dormand, Prince, J. Comput. Appl. Math. 6, 19 (1980): RK5(4)7M.
constexpr double dopri5_c[] = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1};
constexpr double dopri5_a[] = {1. / 5,       3. / 40,       9. / 40,        44. / 45,      -56. / 15,
                               32. / 9,      19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729,
                               9017. / 3168, -355. / 33,    46732. / 5247,  49. / 176,     -5103. / 18656};
constexpr double dopri5_b[] = {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84};

}  // namespace

namespace tables {
const Table euler{euler_c, {}, euler_b, 1, 0};
const Table midpoint{midpoint_c, midpoint_a, midpoint_b, 2, 0};
const Table heun{heun_c, heun_a, heun_b, 2, 0};
const Table ralston{ralston_c, ralston_a, ralston_b, 2, 0};
const Table kutta3{kutta3_c, kutta3_a, kutta3_b, 3, 1.7320508};
const Table rk4{rk4_c, rk4_a, rk4_b, 4, 2.8284271};
const Table kutta38{kutta38_c, kutta38_a, kutta38_b, 4, 2.8284271};
const Table dormand_prince5{dopri5_c, dopri5_a, dopri5_b, 5, 0.99};
}  // namespace tables

}  // namespace carom
