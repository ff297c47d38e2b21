/// An object that stays where it was made: others keep references to it or to parts of it.
#pragma once

namespace solidus {

class Pinned {
 public:
  Pinned() = default;
  Pinned(const Pinned&) = delete;
  Pinned& operator=(const Pinned&) = delete;
};

}  // namespace solidus
