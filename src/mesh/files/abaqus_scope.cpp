/// Plain tables of a scope, by number and by name in upper case; what is missing or there twice is an error
/// with its line.
#include "mesh/files/abaqus_scope.hpp"

#include "mesh/files/abaqus_deck.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

void AbaqusSet::add(GlobalIndex number, int scope) {
  if (!ranges.empty()) {
    NumberRange& end = ranges.back();
    if (end.scope == scope && end.step == 1 && number == end.last + 1) {
      end.last = number;
      return;
    }
  }
  ranges.push_back({scope, number, number, 1});
}

AbaqusSet& set_of(AbaqusSets& sets, const std::string& name, const SourceLocation& at) {
  AbaqusSet& set = sets[upper(name)];
  if (set.name.empty()) {
    set.name = name;
    set.at = at;
  }
  return set;
}

void AbaqusScope::add_node(GlobalIndex number, const Point& place, const SourceLocation& where) {
  if (!node_at.emplace(number, as_index(x.size())).second)
    throw InputError(where, "node " + std::to_string(number) + " is defined twice",
                     "one numbering in the deck, or in each *PART");
  x.push_back(place);
  node_number.push_back(number);
}

void AbaqusScope::add_element(AbaqusElement element, const SourceLocation& where) {
  if (!element_at.emplace(element.number, as_index(elements.size())).second)
    throw InputError(where, "element " + std::to_string(element.number) + " is defined twice");
  elements.push_back(std::move(element));
}

Index AbaqusScope::node(GlobalIndex number, const SourceLocation& where) const {
  const auto n = node_at.find(number);
  if (n == node_at.end())
    throw InputError(where, "there is no node " + std::to_string(number) + " up to here");
  return n->second;
}

}  // namespace solidus::mesh
