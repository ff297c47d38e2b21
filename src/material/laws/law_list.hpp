/// The laws of one kind, built in and added, by the place that an enumeration or its continuation names.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "material/laws/parameter.hpp"

namespace solidus::material {

namespace detail {
/// Throws std::logic_error: the kind and the name of the law, and why it cannot be added.
[[noreturn]] void refuse_law(const char* kind, std::string_view name, const std::string& why);
/// Whether two laws declare a key alike.
bool declared_alike(const LawParameter& a, const LawParameter& b);
}  // namespace detail

/// Initialised before any object of the program (constinit), so that laws of other files can be added to it.
/// @tparam Law  has name() and parameters()
template <class Law>
struct LawList {
  static constexpr std::size_t k_most = 32;

  const char* kind;             ///< "law of isotropic hardening", for messages
  std::size_t most_parameters;  ///< as many numbers are kept
  const Law* laws[k_most];
  std::size_t count;
  bool asked = false;  ///< all() has been called

  /// From the first call on no more may be added: the keys of the material file are made of them.
  std::span<const Law* const> all() {
    asked = true;
    return {laws, count};
  }
  /// Throws std::logic_error where its name is taken, it has too many parameters, a parameter is declared
  /// otherwise by another law, or all() has been called.
  /// @return its place
  std::size_t add(const Law& law) {
    if (asked) detail::refuse_law(kind, law.name(), "added after the keys of the material file were made");
    if (count == k_most) detail::refuse_law(kind, law.name(), "there are too many laws");
    if (law.parameters().size() > most_parameters)
      detail::refuse_law(kind, law.name(),
                         std::to_string(law.parameters().size()) + " parameters, at most " +
                             std::to_string(most_parameters));
    for (std::size_t i = 0; i < count; ++i) {
      const Law& other = *laws[i];
      if (other.name() == law.name()) detail::refuse_law(kind, law.name(), "the name is taken");
      for (const LawParameter& mine : law.parameters())
        for (const LawParameter& theirs : other.parameters())
          if (std::string_view(mine.key) == theirs.key && !detail::declared_alike(mine, theirs))
            detail::refuse_law(
                kind, law.name(),
                "'" + std::string(other.name()) + "' declares the key '" + mine.key + "' otherwise");
    }
    laws[count] = &law;
    return count++;
  }
};

namespace detail {
/// The parameters of a law's struct; none where it declares none.
template <class Law>
std::span<const LawParameter> parameters_of() {
  if constexpr (requires { Law::parameters; })
    return Law::parameters;
  else
    return {};
}
}  // namespace detail

}  // namespace solidus::material
