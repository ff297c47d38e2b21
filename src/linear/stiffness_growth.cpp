/// The largest quotient of the traces of diagonal blocks, now and when the preconditioner was made, over
/// all nodes.
#include "linear/stiffness_growth.hpp"

#include <algorithm>
#include <limits>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::linear {

namespace {

float trace(BlockMatrix& a, Index node) {
  const double* const block = a.diagonal_block(node);
  double sum = 0;
  for (int i = 0; i < a.block_size(); ++i) sum += block[i * (a.block_size() + 1)];
  return static_cast<float>(sum);
}

}  // namespace

void StiffnessGrowth::remember(BlockMatrix& a) {
  trace_.resize(a.row_start().size() - 1);
  for (std::size_t node = 0; node < trace_.size(); ++node) trace_[node] = trace(a, as_index(node));
}

double StiffnessGrowth::since(BlockMatrix& a) const {
  double growth = 1;
  if (trace_.size() != a.row_start().size() - 1) {
    growth = std::numeric_limits<double>::infinity();
  } else {
    // By the traces of the diagonal blocks: where a node has become stiffer.
    for (std::size_t node = 0; node < trace_.size(); ++node) {
      const float now = trace(a, as_index(node));
      if (trace_[node] > 0 && now > 0) growth = std::max(growth, static_cast<double>(now / trace_[node]));
    }
  }
  return parallel::global_max(growth);
}

}  // namespace solidus::linear
