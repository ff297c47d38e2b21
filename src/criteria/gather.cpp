/// Lists of numbers of all processes, one behind the other.
#include "criteria/gather.hpp"

#include "system/processes.hpp"

namespace solidus::criteria {

std::vector<double> gathered(std::span<const double> own) {
  return processes::gather(own);
}

}  // namespace solidus::criteria
