/// Texts of the answers about tearing tendencies: a value that is cut, and the share by shrinkage alone.
#pragma once

#include <span>
#include <string>

#include "criteria/criterion.hpp"

namespace solidus::results {

/// "100 or more" where a tendency is cut there, by which its place says nothing; else empty.
std::string cut_tendency(const quantities::Quantity& field, double value);
/// " (by shrinkage alone in 98 %)", of the tendency of held ends; of other fields, and without such metal,
/// empty.
std::string by_shrinkage(const quantities::Quantity& field, std::span<const criteria::CriterionResult> found);

}  // namespace solidus::results
