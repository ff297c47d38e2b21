/// Steps of an iteration toward f(x) = 0 from the secants of the steps before it: Anderson's acceleration.
///
///   δ = −Σ_k γ_k s_k + (f − Σ_k γ_k y_k),   γ = argmin ‖f − Σ_k γ_k y_k‖,   y_k = change of f by the step
///   s_k
///
/// The part of f that the steps before explain is taken back along them, and the rest of f is the step of the
/// plain iteration x += f. Where f is linear it comes to its root in as many steps as f has different rates,
/// at most one more than unknowns, as GMRES does (H. F. Walker, P. Ni, SIAM J. Numer. Anal. 49 (2011) 1715).
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <vector>

namespace solidus::contact {

class Secants {
 public:
  using Values = std::vector<double>;
  /// Over all processes. Collective.
  using Dot = std::function<double(const Values&, const Values&)>;

  void clear() {
    pairs_.clear();
    last_f_.clear();
    last_step_.clear();
  }
  /// f of now; to be followed by step() or took(). Secants that have led to twice the residual are dropped.
  void look(const Values& f, const Dot& dot) {
    if (last_f_.size() == f.size()) {
      if (dot(f, f) > k_rise * k_rise * dot(last_f_, last_f_)) pairs_.clear();
      pairs_.push_front({last_step_, f});
      for (std::size_t i = 0; i < f.size(); ++i) pairs_.front().change[i] -= last_f_[i];
      if (pairs_.size() > k_memory) pairs_.pop_back();
    }
    last_f_ = f;
  }
  /// The step from the last f on.
  Values step(const Dot& dot) const {
    Values left = last_f_, result(left.size(), 0.0);
    std::vector<Pair> directions;  // changes of which are orthonormal
    for (Pair d : pairs_) {
      const double before = std::sqrt(dot(d.change, d.change));
      for (const Pair& other : directions) add(-dot(other.change, d.change), other, d);
      const double length = std::sqrt(dot(d.change, d.change));
      if (!(length > k_independent * before)) continue;
      for (Values* v : {&d.step, &d.change})
        for (double& value : *v) value /= length;
      const double share = dot(left, d.change);
      for (std::size_t i = 0; i < left.size(); ++i) {
        left[i] -= share * d.change[i];
        result[i] -= share * d.step[i];
      }
      directions.push_back(std::move(d));
    }
    for (std::size_t i = 0; i < left.size(); ++i) result[i] += left[i];
    return result;
  }
  /// The step that was taken from there.
  void took(Values step) { last_step_ = std::move(step); }

 private:
  static constexpr std::size_t k_memory = 8;
  static constexpr double k_rise = 2;            ///< of ‖f‖
  static constexpr double k_independent = 1e-3;  ///< share of a change that others do not explain
  struct Pair {
    Values step, change;
  };
  static void add(double factor, const Pair& from, Pair& to) {
    for (std::size_t i = 0; i < to.step.size(); ++i) {
      to.step[i] += factor * from.step[i];
      to.change[i] += factor * from.change[i];
    }
  }
  std::deque<Pair> pairs_;  ///< the newest first
  Values last_f_, last_step_;
};

}  // namespace solidus::contact
