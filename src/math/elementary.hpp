#pragma once
// Elementary functions that give the same bits on every compiler and machine. libm does not: glibc differs from musl,
// and glibc from itself on a processor without FMA. These use + - * / and sqrt alone, which IEEE 754 fixes.
//
// Largest errors, measured against quadruple precision: sin and cos 0.78 ulp, tan 0.93 ulp, all others 0.53 ulp; a
// subnormal result is within 1 ulp. Special values are those of C99's annex F, with one difference for the sake of
// equal bits: NaN is always the same quiet NaN, whichever NaN came in. The floating-point exception flags mean nothing
// here. To be compiled with -ffp-contract=off, without fast-math, and run with rounding to nearest.

namespace carom::portable {

struct SinCos {
    double sin, cos;
};

double sin(double x);
double cos(double x);
SinCos sincos(double x);  ///< the bits of sin and cos, the argument reduced once
double tan(double x);
double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);
double exp(double x);
double log(double x);
double pow(double x, double y);  ///< exact where the result is a double
double sinh(double x);
double cosh(double x);
double tanh(double x);
double hypot(double x, double y);

}  // namespace carom::portable
