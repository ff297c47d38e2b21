/// Where the history of a block keeps what belongs to a point: the numbers of the law's state that its
/// material can change, behind them, with structural heat, the base of the energy (StructuralBase), and last
/// what an element formulation keeps besides.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

#include "mechanics/elements/law_parts.hpp"
#include "mechanics/elements/law_traits.hpp"
#include "mechanics/elements/structural_points.hpp"

namespace solidus::mechanics {

/// @tparam Law  whose state is made of lanes, or lies in place (law_traits.hpp)
template <class Law>
class HistoryLayout {
 public:
  using State = typename Law::template State<Lane>;
  static_assert(KeepsStateInPlace<Law> || sizeof(State) % sizeof(Lane) == 0, "a state is made of lanes");

  /// @param n_extra  lanes that the element formulation keeps at a point
  HistoryLayout(const Law& law, std::size_t n_extra)
      : kept_(kept_lanes(law)), n_law_(kept_.size()), n_all_(n_law_ + n_extra) {}

  /// Histories made from now on have the base of the energy.
  void add_base() {
    if (std::exchange(has_base_, true)) return;
    n_law_ += k_base_lanes;
    n_all_ += k_base_lanes;
  }
  bool has_base() const { return has_base_; }
  /// Histories made from now on have so many more lanes of the element formulation.
  void add_extra(std::size_t n) { n_all_ += n; }
  /// Lanes of a point.
  std::size_t lanes() const { return n_all_; }
  /// The first lane of the element formulation at a point, in BlockHistory::values.
  std::size_t extra(std::size_t point) const { return point * n_all_ + n_law_; }

  State state(const BlockHistory& history, std::size_t point) const {
    const Lane* from = history.values.data() + point * n_all_;
    if constexpr (KeepsStateInPlace<Law>) {
      return State{from};
    } else {
      Lanes lanes{};
      for (const std::size_t lane : kept_) lanes[lane] = *from++;
      return std::bit_cast<State>(lanes);
    }
  }
  void write(const State& state, BlockHistory& history, std::size_t point) const {
    Lane* to = history.values.data() + point * n_all_;
    if constexpr (KeepsStateInPlace<Law>) {
      std::copy_n(state.values, kept_.size(), to);
    } else {
      const auto lanes = std::bit_cast<Lanes>(state);
      for (const std::size_t lane : kept_) *to++ = lanes[lane];
    }
  }
  /// Writes the elements where the mask holds.
  void replace(const State& state, const LaneMask& mask, BlockHistory& history, std::size_t point) const {
    Lane* to = history.values.data() + point * n_all_;
    if constexpr (KeepsStateInPlace<Law>) {
      for (std::size_t i = 0; i < kept_.size(); ++i) to[i] = select(mask, state.values[i], to[i]);
    } else {
      const auto lanes = std::bit_cast<Lanes>(state);
      for (const std::size_t lane : kept_) {
        *to = select(mask, lanes[lane], *to);
        ++to;
      }
    }
  }

  /// The base of the energy, of histories that have it; zero where nothing has been solved yet.
  StructuralBase base(const BlockHistory& history, std::size_t point) const {
    const Lane* const from = history.values.data() + extra(point) - k_base_lanes;
    return {from[0], from[1], from[2]};
  }
  void write_base(const StructuralBase& base, BlockHistory& history, std::size_t point) const {
    Lane* const to = history.values.data() + extra(point) - k_base_lanes;
    to[0] = base.line_temperature;
    to[1] = base.strain_offset;
    to[2] = base.solid;
  }

 private:
  using Lanes = std::array<Lane, sizeof(State) / sizeof(Lane)>;
  static constexpr std::size_t k_base_lanes = sizeof(StructuralBase) / sizeof(Lane);

  std::vector<std::size_t> kept_;  ///< lanes of the state that the material can change, rising
  std::size_t n_law_;              ///< of them, and of the base
  std::size_t n_all_;
  bool has_base_ = false;
};

}  // namespace solidus::mechanics
