/// Returns freed memory to the system, which the allocator would keep.
#pragma once

#include <cstddef>

namespace solidus {

/// Arrays from this size on are asked of the system one by one: smaller ones come and go too often. [bytes]
inline constexpr std::size_t k_large_array = std::size_t{4} << 20;

/// Gives freed memory back to the system: reading and setting up leave holes that later arrays are too large
/// for. Without effect where the C library cannot do it.
void return_free_memory();

/// From here on arrays of 4 MiB and more go back to the system when they are freed, and smaller ones as
/// soon as 64 MiB are free at the end of the heap. SuperLU_DIST, which comes with PETSc, tells the C library
/// as soon as it is loaded to keep whatever it ever had.
void give_large_arrays_back();

/// While it lives, freed arrays stay with the program for the next ones of their size, whatever
/// give_large_arrays_back() has said; without it nothing changes. For libraries that allocate the same large
/// arrays again in each call: the system clears every page that it gives.
class FreedArraysStay {
 public:
  FreedArraysStay();
  ~FreedArraysStay();
  FreedArraysStay(const FreedArraysStay&) = delete;
  FreedArraysStay& operator=(const FreedArraysStay&) = delete;
};

}  // namespace solidus
