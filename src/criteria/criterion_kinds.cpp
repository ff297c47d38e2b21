/// The list of criteria that have described themselves.
#include <algorithm>
#include <stdexcept>

#include "criteria/built_in_criteria.hpp"
#include "criteria/criterion_kind.hpp"

namespace solidus::criteria {

namespace {

/// Puts a kind behind all whose place is not behind its own.
void insert(std::vector<SharedCriterionKind>& kinds, SharedCriterionKind kind) {
  const auto next = std::ranges::upper_bound(kinds, kind->place(), {}, &CriterionKind::place);
  kinds.insert(next, std::move(kind));
}

/// Made when it is first asked for: objects at namespace scope add to it before main() begins.
std::vector<SharedCriterionKind>& kinds() {
  static std::vector<SharedCriterionKind> all = [] {
    std::vector<SharedCriterionKind> built_in;
    for (SharedCriterionKind& kind : built_in_criteria()) insert(built_in, std::move(kind));
    return built_in;
  }();
  return all;
}

}  // namespace

const std::vector<SharedCriterionKind>& criterion_kinds() {
  return kinds();
}

void add_criterion(SharedCriterionKind kind) {
  for (const quantities::Quantity* field : kind->fields())
    for (const SharedCriterionKind& other : kinds())
      if (std::ranges::find(other->fields(), field->name, &quantities::Quantity::name) !=
          other->fields().end())
        throw std::logic_error("two criteria have a field '" + std::string(field->name) + "'");
  insert(kinds(), std::move(kind));
}

}  // namespace solidus::criteria
