/// The directions of plastic flow as unknowns of their own in Newton's method (primal-dual Newton method).
///
/// Where metal flows the deviatoric stress is s = β (1 − 2Ĝγ/‖β‖) with the relative trial stress β, which is
/// linear in the strain, and the consistent tangent has the part c n ⊗ n, n = β/‖β‖. It takes n for the
/// direction that flow will have at the solution. Where the strain increment is many times the yield strain,
/// as at the solidus, n of an early iterate is wrong: along n the tangent is all but zero, the step is many
/// times too long, and a line search that shortens it for some points does so for all. The direction is
/// therefore an unknown m of its own, bound to the strain by ‖β‖ m = β. Newton's method on that equation,
///
///   m_{k+1} = [β_{k+1} − (n_k · (β_{k+1} − β_k)) m_k]/‖β_k‖,   ‖m‖ <= 1,
///
/// and elimination of dm leave the tangent with m in place of one n, here made symmetric:
///
///   c n ⊗ n  →  ½ c (m ⊗ n + n ⊗ m)
///
/// With ‖m‖ < 1, where the direction still changes, it is stiffer than the consistent tangent, and it is
/// positive semi-definite as that one is. At the solution m = n, and convergence is quadratic. Sources:
/// T. F. Chan, G. H. Golub, P. Mulet, SIAM J. Sci. Comput. 20 (1999) 1964 (total variation); J. Rudi,
/// Y. Shih, G. Stadler, Geochem. Geophys. Geosyst. 21 (2020) e2020GC009059 (viscoplastic flow).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "numbers/index_casts.hpp"
#include "numbers/simd.hpp"
#include "numbers/tensor.hpp"

namespace solidus::mechanics {

/// m and the last β at the points of a block, in single precision, which is enough for a tangent. Nothing is
/// kept until a point flows.
class FlowDirections {
 public:
  /// A solution is sought: no iterate is known.
  void begin() { known_.assign(known_.size(), Known{}); }

  /// m at an iterate where some lanes of a point flow; the iterate is the one before at the next call.
  /// @param point, n_points  of the block
  /// @param relative  β [Pa]; its direction is n. Where a lane does not flow it is ignored.
  /// @param flows     the lanes that flow
  /// @param loading   called for m_0, of lanes that flow for the first time: the direction in which the state
  ///                  at t_n is loaded, of length <= 1 (material::Viscoplastic::loading)
  template <class Loading>
  Sym<Lane> at(std::size_t point, std::size_t n_points, const Sym<Lane>& relative, const LaneMask& flows,
               const Loading& loading) {
    if (known_.empty()) known_.resize(n_points);
    const Lane zero(0.0), one(1.0);
    Known& known = known_[point];
    const Sym<Lane> old_direction = load(known.direction), old_relative = load(known.relative);
    const Lane size = norm(old_relative);
    const LaneMask seen = size > zero;
    const Lane inverse = one / select(seen, size, one);
    const Sym<Lane> n = inverse * old_relative;
    Sym<Lane> m = inverse * (relative - dot(n, relative - old_relative) * old_direction);
    if (any(flows & !seen)) {
      const Sym<Lane> first = loading();
      for (int i = 0; i < 6; ++i) m[i] = select(seen, m[i], first[i]);
    }
    const Lane length = norm(m);
    m *= one / max(length, one);
    for (int i = 0; i < 6; ++i) m[i] = select(flows, m[i], old_direction[i]);
    store(m, known.direction);
    Sym<Lane> last;
    for (int i = 0; i < 6; ++i) last[i] = select(flows, relative[i], old_relative[i]);
    store(last, known.relative);
    return m;
  }

  std::size_t bytes() const { return known_.capacity() * sizeof(Known); }

 private:
  using Values = std::array<std::array<float, k_lanes>, 6>;
  struct Known {
    Values direction{};  ///< m of the iterate before
    Values relative{};   ///< its β [Pa]; zero: there was none that flowed
  };
  static Sym<Lane> load(const Values& values) {
    Sym<Lane> a;
    for (std::size_t i = 0; i < 6; ++i)
      for (int lane = 0; lane < k_lanes; ++lane)
        a.c[i].set(lane, static_cast<double>(values[i][as_size(lane)]));
    return a;
  }
  static void store(const Sym<Lane>& a, Values& values) {
    for (std::size_t i = 0; i < 6; ++i)
      for (int lane = 0; lane < k_lanes; ++lane) values[i][as_size(lane)] = static_cast<float>(a.c[i][lane]);
  }

  std::vector<Known> known_;  ///< [point]; empty where nothing has flowed
};

}  // namespace solidus::mechanics
