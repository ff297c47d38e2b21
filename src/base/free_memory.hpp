/// Memory that has been freed, but not given back.
#pragma once

namespace solidus {

/// Gives freed memory back to the system: reading and setting up leave holes that later arrays are too large
/// for. Without effect where the C library cannot do it.
void return_free_memory();

}  // namespace solidus
