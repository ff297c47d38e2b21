/// Two laws of one kind may share a key only if they declare it alike.
#include "material/laws/law_list.hpp"

#include <stdexcept>

namespace solidus::material::detail {

void refuse_law(const char* kind, std::string_view name, const std::string& why) {
  throw std::logic_error("the " + std::string(kind) + " '" + std::string(name) + "': " + why);
}

bool declared_alike(const LawParameter& a, const LawParameter& b) {
  return std::string_view(a.unit) == b.unit && std::string_view(a.doc) == b.doc && a.least == b.least &&
         a.greatest == b.greatest && a.above_least == b.above_least;
}

}  // namespace solidus::material::detail
