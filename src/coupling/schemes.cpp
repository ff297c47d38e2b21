/// The coupling schemes that every program has, in the order of the reference page.
#include "coupling/scheme_names.hpp"
#include "coupling/schemes/block_iterative_keys.hpp"
#include "coupling/schemes/double_pass_keys.hpp"
#include "coupling/schemes/isentropic_keys.hpp"
#include "coupling/schemes/isothermal_keys.hpp"
#include "coupling/schemes/simultaneous_keys.hpp"

namespace solidus::coupling {

Kinds<SchemeKind>& schemes() {
  static Kinds<SchemeKind> kinds = [] {
    Kinds<SchemeKind> all("coupling scheme");
    all.add(kind_of<SchemeKind, SchemeKindOf<IsentropicScheme>>());
    all.add(kind_of<SchemeKind, SchemeKindOf<IsothermalScheme>>());
    all.add(kind_of<SchemeKind, SchemeKindOf<DoublePassScheme>>());
    all.add(kind_of<SchemeKind, SchemeKindOf<BlockIterativeScheme>>());
    all.add(kind_of<SchemeKind, SchemeKindOf<SimultaneousKeys>>());
    return all;
  }();
  return kinds;
}

std::string names_of_schemes(const std::function<bool(const SchemeTraits&)>& wanted) {
  std::string names;
  for (const Kind<SchemeKind>& kind : schemes().all())
    if (wanted(kind.read(kind.keys->completed(Value{}, ""))->traits()))
      names += (names.empty() ? "\"" : " or \"") + kind.name + "\"";
  return names;
}

std::shared_ptr<const SchemeKind> default_scheme() {
  static const std::shared_ptr<const SchemeKind> kind = scheme_kind(IsentropicScheme{});
  return kind;
}

std::unique_ptr<CouplingScheme> single_phase(const Phases& phases) {
  return std::make_unique<IsothermalSplit>(phases);
}

}  // namespace solidus::coupling
