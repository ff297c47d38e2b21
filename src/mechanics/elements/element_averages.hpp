/// The values of elements of one law: averages over the points of each element, eight elements at a time, a
/// value that is the same everywhere once.
#pragma once

#include <memory>
#include <utility>

#include "mechanics/elements/law_parts.hpp"
#include "mechanics/state/element_values.hpp"
#include "numbers/common_packs.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::mechanics {

/// @tparam Values  of the law at a point (law_parts.hpp), of lanes
template <class Values>
class ElementAverages final : public ElementValues {
 public:
  explicit ElementAverages(Index n_elements, Index n_batches)
      : n_elements_(n_elements), averages_(as_size(n_batches)) {}

  void get(ElementField which, std::span<double> out) const override {
    if (which == ElementField::pore_fraction && !pores_.empty()) {
      for (Index e = 0; e < n_elements_; ++e)
        out[as_size(e)] = pores_[as_size(e / k_lanes)][static_cast<int>(e % k_lanes)];
      return;
    }
    const int n_components = component_count(which);
    double* to = out.data();
    for (Index e = 0; e < n_elements_; e += k_lanes) {
      const Values values = averages_[as_size(e / k_lanes)];
      for (int lane = 0; lane < k_lanes && e + lane < n_elements_; ++lane) {
        put(which, element_of<typename Values::OfOne>(values, lane), to);
        to += n_components;
      }
    }
  }
  void set(Index batch, const Values& average) { averages_.set(as_size(batch), average); }
  void set_pores(Index batch, const Lane& fraction) {
    pores_.resize(averages_.size(), Lane(0.0));
    pores_[as_size(batch)] = fraction;
  }
  std::size_t bytes() const override { return averages_.bytes() + pores_.capacity() * sizeof(Lane); }

 private:
  Index n_elements_;
  CommonPacks<Values> averages_;  ///< [batch]
  PackVector<Lane> pores_;        ///< θ, [batch]; empty where there are none
};

/// Returns the values of a block for writing: those at hand where no other state has them, else new ones,
/// which are at hand from then on.
template <class Values>
ElementAverages<Values>& averages_to_write(SharedElementValues& at_hand, Index n_elements, Index n_batches) {
  // Made here and never shared with this state alone as its owner: writing to it is seen by no other state.
  if (at_hand && at_hand.use_count() == 1)
    if (const auto* own = dynamic_cast<const ElementAverages<Values>*>(at_hand.get()))
      return *const_cast<ElementAverages<Values>*>(own);
  auto fresh = std::make_shared<ElementAverages<Values>>(n_elements, n_batches);
  ElementAverages<Values>& written = *fresh;
  at_hand = std::move(fresh);
  return written;
}

}  // namespace solidus::mechanics
