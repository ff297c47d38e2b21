/// The part of a step over which a load is averaged, so that the heat it brings is its integral.
#pragma once

#include <array>

namespace solidus {

/// Σ_k weight_k × mean over [begin_k, end_k], the weights adding up to one; values that are not averaged
/// (prescribed temperatures) are those of `time`. Without parts the value at `time` stands for all.
struct LoadWindow {
  struct Part {
    double begin = 0, end = 0, weight = 1;  ///< [s], [s], [1]
  };
  double time = 0;  ///< [s]
  std::array<Part, 2> parts{};
  int n_parts = 0;
  /// A step of backward Euler: what exchanges heat follows the values of the end, where a mean would lag by
  /// half a step, but for what the mean differs from that of a straight line from the begin to the end.
  bool to_end = false;

  static LoadWindow at(double time) { return {.time = time}; }
  static LoadWindow over(double begin, double end) {
    return {.time = end, .parts = {Part{begin, end, 1}, {}}, .n_parts = 1};
  }
  static LoadWindow backward_euler(double begin, double end) {
    LoadWindow window = over(begin, end);
    window.to_end = true;
    return window;
  }
};

}  // namespace solidus
