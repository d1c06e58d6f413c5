#include "scene/closed_forms.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <tuple>

#include "math/elementary.hpp"
#include "math/elliptic.hpp"

namespace carom {

namespace {

using portable::exp;
using portable::log;
constexpr double pi = 3.14159265358979323846;

// ---- Flight ---------------------------------------------------------------------------------------------------------

double projectile(const double* p) {
    const auto [t, x, v, a] = std::tuple{p[0], p[1], p[2], p[3]};
    return x + v * t + 0.5 * a * t * t;
}

/// (1 − exp(−s))/s, near s = 0 too: 2 sinh(s/2) exp(−s/2)/s.
double decayed_mean(double s) { return s == 0 ? 1 : 2 * portable::sinh(s / 2) * exp(-s / 2) / s; }

/// (1 − (1 − exp(−s))/s)/s, by its series where that cancels.
double decayed_lag(double s) {
    if (std::abs(s) > 0.5) return (1 - decayed_mean(s)) / s;
    double term = 0.5, sum = 0;  // Σ (−s)ⁿ/(n + 2)!
    for (int n = 0; n < 20; ++n) sum += term, term *= -s / (n + 3);
    return sum;
}

// x'' = a − b x': the speed decays to a/b, and the limit b → 0 is the throw without air.
double drag_place(const double* p) {
    const auto [t, x, v, a, b] = std::tuple{p[0], p[1], p[2], p[3], p[4]};
    return x + v * t * decayed_mean(b * t) + a * t * t * decayed_lag(b * t);
}
double drag_speed(const double* p) {
    const auto [t, v, a, b] = std::tuple{p[0], p[1], p[2], p[3]};
    return v * exp(-b * t) + a * t * decayed_mean(b * t);
}

double newton_fall(const double* p) {
    const auto [t, g, k] = std::tuple{p[0], p[1], p[2]};
    const double s = std::sqrt(g * k) * t;
    if (s > 1) return (s + log(0.5 * (1 + exp(-2 * s)))) / k;             // ln cosh without overflow
    const double half = portable::sinh(0.5 * s), more = 2 * half * half;  // cosh s − 1
    // ln(1 + more)/more, where 1 + more is rounded in both (W. Kahan).
    const double mean = 1 + more == 1 ? 1 : log(1 + more) / ((1 + more) - 1);
    const double sinhc = s == 0 ? 1 : 2 * half / s;
    return 0.5 * g * t * t * sinhc * sinhc * mean;
}
double newton_fall_speed(const double* p) {
    const auto [t, g, k] = std::tuple{p[0], p[1], p[2]};
    return k == 0 ? g * t : std::sqrt(g / k) * portable::tanh(std::sqrt(g * k) * t);
}

/// A ball dropped from a height on a floor at 0 that gives back a fraction of its speed.
double bouncing_ball(const double* p) {
    const auto [t, h, g, e] = std::tuple{p[0], p[1], p[2], p[3]};
    const double since = t - std::sqrt(2 * h / g), flight = 2 * e * std::sqrt(2 * h / g);
    if (since < 0) return h - 0.5 * g * t * t;
    if (!(flight > 0)) return 0;
    // n flights, each e times as long as the one before, take flight (1 − eⁿ)/(1 − e), which near e = 1 cancels.
    const double decay = -log(e), per_flight = e == 1 ? 1 : decay / (1 - e);
    const auto taken = [&](double n) { return flight * per_flight * n * decayed_mean(decay * n); };
    const double left = 1 - since / flight * (1 - e);  // eⁿ, with the part of a flight in n
    if (!(left > 0)) return 0;
    double n = std::floor(e == 1 ? since / flight : -log(left) / decay);
    if (since < taken(n)) --n;  // rounding may have gone over the impact, either way
    if (since >= taken(n + 1)) ++n;
    const double in_flight = since - taken(n);
    return std::max(0.0, 0.5 * g * in_flight * (flight * exp(-decay * n) - in_flight));
}

// ---- Oscillators ----------------------------------------------------------------------------------------------------

struct Motion1 {
    double place, speed;
};

/// x'' + 2γ x' + ω² x = 0 from x, v: with s² = γ² − ω², x(t) = e^(−γt) (x C + (v + γx) S), where C and S are cosh(st)
/// and sinh(st)/s, or cos and sin, and at s = 0 are 1 and t.
Motion1 free_oscillation(double t, double x, double v, double w, double gamma) {
    const double square = (gamma - w) * (gamma + w), s = std::sqrt(std::abs(square));
    double c, d;
    if (square < 0) {
        c = portable::cos(s * t), d = portable::sin(s * t) / s;
    } else if (s * t > 1e-4) {
        // The exponentials in one, so that neither overflows.
        const double slow = exp((s - gamma) * t), fast = exp(-(s + gamma) * t);
        c = 0.5 * (slow + fast), d = 0.5 * (slow - fast) / s;
        return {x * c + (v + gamma * x) * d, v * c - (w * w * x + gamma * v) * d};
    } else {
        c = 1 + 0.5 * square * t * t, d = t * (1 + square * t * t / 6);
    }
    const double decay = exp(-gamma * t);
    return {decay * (x * c + (v + gamma * x) * d), decay * (v * c - (w * w * x + gamma * v) * d)};
}

double oscillator(const double* p) { return free_oscillation(p[0], p[1], p[2], p[3], p[4]).place; }
double oscillator_speed(const double* p) { return free_oscillation(p[0], p[1], p[2], p[3], p[4]).speed; }

using Complex = std::complex<double>;
Complex exp(Complex z) {
    const double size = exp(z.real());
    return {size * portable::cos(z.imag()), size * portable::sin(z.imag())};
}
/// (exp(z) − 1)/z of a small z, by its series.
Complex grown_mean(Complex z) {
    Complex term = 1, sum = 0;  // Σ zⁿ/(n + 1)!
    for (int n = 0; n < 20; ++n) sum += term, term *= z / (n + 2.0);
    return sum;
}
/// What a cos(Ωt) makes of rest near resonance, where the two oscillations of the general form cancel: by the roots r
/// of the free one, Σ ±a (exp(iΩt) − exp(rt))/(iΩ − r)/2is.
Motion1 resonance(double t, double s, double gamma, double a, double drive) {
    const Complex driven{0, drive}, near{-gamma, s}, far{-gamma, -s};
    const Complex apart = driven - far, per_apart = std::conj(apart) / std::norm(apart), size{0, -a / (2 * s)},
                  with_near = t * exp(near * t) * grown_mean((driven - near) * t),
                  with_far = (exp(driven * t) - exp(far * t)) * per_apart;
    return {(size * (with_near - with_far)).real(), (size * (near * with_near - far * with_far)).real()};
}

/// x'' + 2γ x' + ω² x = a cos(Ωt): the steady oscillation, and a free one that makes up for where it starts.
Motion1 forced_oscillation(double t, double x, double v, double w, double gamma, double a, double drive) {
    const double real = (w - drive) * (w + drive), imaginary = 2 * gamma * drive;
    const double square = real * real + imaginary * imaginary;
    const Motion1 own = free_oscillation(t, x, v, w, gamma);
    if (square == 0 && w == 0) return {own.place + 0.5 * a * t * t, own.speed + a * t};
    const double free = std::sqrt(std::max(0.0, (w - gamma) * (w + gamma)));
    if (free > 0.5 * w && (std::abs(std::abs(drive) - free) + gamma) * std::abs(t) < 0.5) {
        const Motion1 forced = resonance(t, free, gamma, a, std::abs(drive));
        return {own.place + forced.place, own.speed + forced.speed};
    }
    const double sine = portable::sin(drive * t), cosine = portable::cos(drive * t);
    const double in = a * real / square, out = a * imaginary / square;
    const Motion1 start = free_oscillation(t, -in, -out * drive, w, gamma);
    return {own.place + start.place + in * cosine + out * sine,
            own.speed + start.speed + drive * (out * cosine - in * sine)};
}
double driven_oscillator(const double* p) { return forced_oscillation(p[0], p[1], p[2], p[3], p[4], p[5], p[6]).place; }
double driven_oscillator_speed(const double* p) {
    return forced_oscillation(p[0], p[1], p[2], p[3], p[4], p[5], p[6]).speed;
}

/// Of θ'' = −ω² sin θ, released at rest: sin(θ/2) = k sn(K − ωt), k = sin(θ₀/2), and cn/dn is sn a quarter period on.
double pendulum(const double* p) {
    const auto [t, angle, w] = std::tuple{p[0], p[1], p[2]};
    const double k = portable::sin(0.5 * angle);
    const Jacobi j = jacobi(w * t, std::abs(k));
    return 2 * portable::asin(k * j.cn / j.dn);
}
double pendulum_speed(const double* p) {
    const auto [t, angle, w] = std::tuple{p[0], p[1], p[2]};
    const double k = portable::sin(0.5 * angle), other = portable::cos(0.5 * angle);
    const Jacobi j = jacobi(w * t, std::abs(k));
    return -2 * w * k * std::abs(other) * j.sn / j.dn;
}
double pendulum_period(const double* p) { return 4 * elliptic_k(std::abs(portable::sin(0.5 * p[0]))) / p[1]; }

double chain_frequency(const double* p) {
    const auto [count, mode, w] = std::tuple{p[0], p[1], p[2]};
    return 2 * w * portable::sin(mode * pi / (2 * (count + 1)));
}
double chain_mode(const double* p) {
    const auto [t, mass, count, mode, a, w] = std::tuple{p[0], p[1], p[2], p[3], p[4], p[5]};
    const double frequency[] = {count, mode, w};
    return a * portable::sin(mass * mode * pi / (count + 1)) * portable::cos(chain_frequency(frequency) * t);
}

// ---- Orbits ---------------------------------------------------------------------------------------------------------

/// The eccentric anomaly a time after the pericentre.
double anomaly(double t, double a, double e, double mu) {
    return eccentric_anomaly(std::sqrt(mu / (a * a * a)) * t, e);
}
double kepler_x(const double* p) { return p[1] * (portable::cos(anomaly(p[0], p[1], p[2], p[3])) - p[2]); }
double kepler_y(const double* p) {
    return p[1] * std::sqrt((1 - p[2]) * (1 + p[2])) * portable::sin(anomaly(p[0], p[1], p[2], p[3]));
}

// ---- The table ------------------------------------------------------------------------------------------------------

using Parameter = ClosedForm::Parameter;
constexpr Parameter of_time{"t", "s", "time"}, of_place{"x", "m", "place at t = 0"},
    of_speed{"v", "m/s", "speed at t = 0"};

bool is_positive(double own, const double*) { return own > 0; }
bool is_not_negative(double own, const double*) { return own >= 0; }
bool is_fraction(double own, const double*) { return own >= 0 && own <= 1; }
bool is_elliptic(double own, const double*) { return own >= 0 && own < 1; }
bool is_below_pi(double own, const double*) { return std::abs(own) < pi; }
bool is_count(double own, const double*) { return own >= 1 && own == std::floor(own); }
template <std::size_t count>
bool is_one_of(double own, const double* arguments) {
    return is_count(own, arguments) && own <= arguments[count];
}

std::vector<ClosedForm> flights() {
    const Parameter a{"a", "m/s²", "acceleration"}, b{"b", "1/s", "drag over mass and speed"},
        k{"k", "1/m", "drag over mass and squared speed", "k >= 0", is_not_negative},
        h{"h", "m", "height", "h >= 0", is_not_negative}, e{"e", "", "restitution", "0 <= e <= 1", is_fraction},
        falling{"g", "m/s²", "gravity, downwards positive", "g >= 0", is_not_negative},
        bouncing{"g", "m/s²", "gravity, downwards positive", "g > 0", is_positive};
    return {{"projectile",
             "A place under a constant acceleration.",
             "x + v t + ½ a t²",
             {of_time, of_place, of_speed, a},
             projectile},
            {"drag_place",
             "A place under a constant acceleration and linear drag.",
             "x'' = a − b x'; x + v t φ₁ + a t² φ₂ with φ₁ = (1 − exp(−bt))/bt, φ₂ = (1 − φ₁)/bt",
             {of_time, of_place, of_speed, a, b},
             drag_place},
            {"drag_speed", "Its speed.", "v exp(−bt) + a (1 − exp(−bt))/b", {of_time, of_speed, a, b}, drag_speed},
            {"newton_fall",
             "How far a body has fallen from rest against quadratic drag.",
             "ln(cosh(√(gk) t))/k",
             {of_time, falling, k},
             newton_fall},
            {"newton_fall_speed", "Its speed.", "√(g/k) tanh(√(gk) t)", {of_time, falling, k}, newton_fall_speed},
            {"bouncing_ball",
             "Height of a point dropped from h on a floor at 0.",
             "parabolas, each e² as high as the one before; at rest from √(2h/g) (1 + e)/(1 − e) on",
             {of_time, h, bouncing, e},
             bouncing_ball}};
}

std::vector<ClosedForm> oscillations() {
    const Parameter w{"w", "rad/s", "angular frequency, √(k/m)"}, gamma{"gamma", "1/s", "rate of decay, c/2m"},
        f{"f", "m/s²", "amplitude of the driving force over mass"},
        drive{"drive", "rad/s", "angular frequency of the driving force"};
    return {
        {"oscillator",
         "A damped oscillator: weakly, critically, strongly or not at all.",
         "x'' + 2 gamma x' + w² x = 0 (Landau, Lifshitz, Mechanics, § 25)",
         {of_time, of_place, of_speed, w, gamma},
         oscillator},
        {"oscillator_speed", "Its speed.", "the derivative", {of_time, of_place, of_speed, w, gamma}, oscillator_speed},
        {"driven_oscillator",
         "A damped oscillator under a periodic force, from any start; at resonance too.",
         "x'' + 2 gamma x' + w² x = f cos(drive t) (Landau, Lifshitz, Mechanics, § 26)",
         {of_time, of_place, of_speed, w, gamma, f, drive},
         driven_oscillator},
        {"driven_oscillator_speed",
         "Its speed.",
         "the derivative",
         {of_time, of_place, of_speed, w, gamma, f, drive},
         driven_oscillator_speed}};
}

std::vector<ClosedForm> pendulums_and_chains() {
    const Parameter angle{"angle", "rad", "where it is released", "|angle| < pi", is_below_pi},
        swing{"w", "rad/s", "angular frequency of small swings, √(g/L)"},
        returning{"w", "rad/s", "angular frequency of small swings, √(g/L)", "w > 0", is_positive},
        count{"n", "", "number of masses", "a whole n >= 1", is_count},
        mass{"i", "", "which mass", "a whole i from 1 to n", is_one_of<2>},
        mode{"j", "", "which mode", "a whole j from 1 to n", is_one_of<2>},
        tone{"j", "", "which mode", "a whole j from 1 to n", is_one_of<0>}, amplitude{"A", "m", "amplitude"},
        link{"w", "rad/s", "√(k/m) of one spring and one mass"};
    return {
        {"pendulum",
         "Angle of a pendulum released at rest, however far out (below π).",
         "sin(θ/2) = k cn(wt)/dn(wt), k = sin(angle/2) (Jacobi; Landau, Lifshitz, Mechanics, § 11)",
         {of_time, angle, swing},
         pendulum},
        {"pendulum_speed", "Its angular velocity.", "−2 w k √(1 − k²) sn/dn", {of_time, angle, swing}, pendulum_speed},
        {"pendulum_period", "Its period.", "4 K(k)/w", {angle, returning}, pendulum_period},
        {"chain_mode",
         "Displacement of mass i in mode j of n masses on n + 1 springs between walls.",
         "A sin(ijπ/(n + 1)) cos(chain_frequency t)",
         {of_time, mass, count, mode, amplitude, link},
         chain_mode},
        {"chain_frequency",
         "Angular frequency of that mode.",
         "2 w sin(jπ/(2(n + 1)))",
         {count, tone, link},
         chain_frequency}};
}

std::vector<ClosedForm> orbits() {
    const Parameter axis{"a", "m", "semi-major axis", "a > 0", is_positive},
        e{"e", "", "eccentricity", "0 <= e < 1", is_elliptic},
        mu{"mu", "m³/s²", "G times the mass in the focus", "mu > 0", is_positive};
    return {{"kepler_x",
             "An orbit about a focus at the origin, from its pericentre on the x axis at t = 0.",
             "a (cos E − e), E − e sin E = √(mu/a³) t (Kepler's equation)",
             {of_time, axis, e, mu},
             kepler_x},
            {"kepler_y", "The same, counterclockwise.", "a √(1 − e²) sin E", {of_time, axis, e, mu}, kepler_y}};
}

}  // namespace

std::size_t ClosedForm::first_refused(const double* arguments) const {
    std::size_t k = 0;
    while (k < parameters.size() && (!parameters[k].allows || parameters[k].allows(arguments[k], arguments))) ++k;
    return k;
}

std::span<const ClosedForm> closed_forms() {
    static const std::vector<ClosedForm> all = [] {
        std::vector<ClosedForm> out;
        for (const auto& part : {flights(), oscillations(), pendulums_and_chains(), orbits()})
            out.insert(out.end(), part.begin(), part.end());
        return out;
    }();
    return all;
}

}  // namespace carom
