/// The program's `operator new`: large arrays lie in large pages.
///
/// Vectors of a million nodes take 8 MB each, and heat has some dozen of them, which come and go with every
/// solve (decision 0010). In pages of 4 kB each costs two thousand faults whenever it is made again, and
/// look-ups of addresses wherever a kernel jumps between nodes. Small arrays and those of other programs that
/// embed the library are as they were.
#include <cstddef>
#include <cstdlib>
#include <new>

#include "system/free_memory.hpp"
#include "system/large_pages.hpp"

void* operator new(std::size_t size) {
  while (true) {
    if (void* const memory = std::malloc(size > 0 ? size : 1)) {
      if (size >= solidus::k_large_array) solidus::ask_for_large_pages(memory, size);
      return memory;
    }
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
