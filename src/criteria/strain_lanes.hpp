/// Tensors of elements in columns of a record, eight elements at a time, and what criteria of strain take of
/// them.
#pragma once

#include <span>
#include <vector>

#include "numbers/simd.hpp"
#include "numbers/tensor.hpp"

namespace solidus::criteria {

inline constexpr std::size_t k_tensor = 6;  ///< numbers of a symmetric tensor

/// Eight elements of a column of rows from element `first` on; lanes beyond `count` are zero.
/// @param width  numbers of a row, whose first six are the tensor; `at` moves that place
Sym<Lane> load_tensors(const std::vector<double>& column, std::size_t width, std::size_t first, int count,
                       std::size_t at = 0);
void store_tensors(const Sym<Lane>& a, std::size_t width, std::size_t first, int count,
                   std::vector<double>& column, std::size_t at = 0);
/// The tensor that six numbers are.
Sym<double> tensor_at(const double* numbers);

/// The share of a step in which a fraction that runs evenly from `from` to `to` is within [low, high).
Lane share_within(const Lane& from, const Lane& to, double low, double high);

/// The largest principal value of a deviator, 2 √(J₂/3) cos θ with cos 3θ = (3√3/2) J₃/J₂^(3/2).
double largest_principal(const Sym<double>& deviator);

}  // namespace solidus::criteria
