// A program that was built for a processor that there is not: it must say so and end before main.
#include <cstdio>

#include "app/instructions.hpp"

namespace solidus::app {
extern const Instructions k_built_for;
const Instructions k_built_for = ~0U;
}  // namespace solidus::app

int main() {
  std::puts("main was reached");
  return 0;
}
