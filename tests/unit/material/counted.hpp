/// A type of numbers for tests of how often a function is called.
#pragma once

#include <cmath>

namespace solidus::material::test {

/// A double that counts its exponentials: one for each look at Φ when hardening saturates.
struct Counted {
  double v = 0;
  Counted() = default;
  Counted(double x) : v(x) {}  // NOLINT
  double value() const { return v; }
  static inline int exponentials = 0;

  friend Counted operator+(Counted a, Counted b) { return a.v + b.v; }
  friend Counted operator-(Counted a, Counted b) { return a.v - b.v; }
  friend Counted operator*(Counted a, Counted b) { return a.v * b.v; }
  friend Counted operator/(Counted a, Counted b) { return a.v / b.v; }
  friend Counted operator-(Counted a) { return -a.v; }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  friend bool operator<(Counted a, Counted b) { return a.v < b.v; }
  friend bool operator>(Counted a, Counted b) { return a.v > b.v; }
  friend bool operator<=(Counted a, Counted b) { return a.v <= b.v; }
  friend Counted sqrt(Counted a) { return std::sqrt(a.v); }
  friend Counted log(Counted a) { return std::log(a.v); }
  friend Counted exp(Counted a) {
    ++exponentials;
    return std::exp(a.v);
  }
};

}  // namespace solidus::material::test
