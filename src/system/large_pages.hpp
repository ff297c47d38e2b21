/// Memory in large pages, for the few arrays that solvers read from end to end again and again.
#pragma once

#include <cstddef>
#include <vector>

namespace solidus {

/// Asks the system to back this memory with large pages (2 MiB) where it is first touched from now on: fewer
/// look-ups of addresses. A request only: without effect on systems that have none to give or give them
/// anyway.
void ask_for_large_pages(const void* first, std::size_t bytes);

/// Sets a large vector to n values, in large pages.
template <class T>
void assign_in_large_pages(std::vector<T>& to, std::size_t n, T value) {
  std::vector<T>().swap(to);
  to.reserve(n);
  ask_for_large_pages(to.data(), n * sizeof(T));
  to.assign(n, value);
}

}  // namespace solidus
