/// The kinds of a plug-in: objects that share an interface and are chosen by a key of the case file, as laws
/// and coupling schemes are. A kind declares its name, what it is and its keys in a file of its own; the
/// section that it is chosen in asks for all kinds (Section::kinds in input/keys.hpp) and gets their keys.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "input/keys.hpp"

namespace solidus {

template <class Interface>
struct Kind {
  std::string name, doc;
  std::shared_ptr<const SectionInfo> keys;
  /// Makes an object from a section that is complete.
  std::function<std::shared_ptr<const Interface>(const Value& complete)> read;
};

/// Declares a kind from a struct that has `name`, `doc` and, where it has keys, `static void
/// keys(Section<Data>&)`.
/// @tparam Adapter  an Interface with a member `data` of that type
template <class Interface, class Adapter>
Kind<Interface> kind_of() {
  using Data = decltype(Adapter::data);
  Section<Data> section{std::string(Data::name), std::string(Data::doc)};
  if constexpr (requires { Data::keys(section); }) Data::keys(section);
  return {std::string(Data::name), std::string(Data::doc), section.shared_info(),
          [section](const Value& complete) {
            auto object = std::make_shared<Adapter>();
            section.assign(object->data, complete);
            return object;
          }};
}

/// Throws std::logic_error with the reason where a kind cannot be added to the others: its name is taken, or
/// another one declares one of its keys otherwise.
void check_kind(const std::string& family, const std::string& name, const SectionInfo& keys,
                const std::string& other_name, const SectionInfo& other_keys);

template <class Interface>
class Kinds {
 public:
  /// @param family  for messages: "law of the gap"
  explicit Kinds(std::string family) : family_(std::move(family)) {}
  /// Throws std::logic_error as check_kind() does, and once all() has been asked: keys are made of it.
  void add(Kind<Interface> kind) {
    if (asked_)
      throw std::logic_error("the " + family_ + " '" + kind.name + "': added after the keys were made");
    for (const Kind<Interface>& other : kinds_)
      check_kind(family_, kind.name, *kind.keys, other.name, *other.keys);
    kinds_.push_back(std::move(kind));
  }
  const std::vector<Kind<Interface>>& all() const {
    asked_ = true;
    return kinds_;
  }

 private:
  std::string family_;
  std::vector<Kind<Interface>> kinds_;
  mutable bool asked_ = false;
};

}  // namespace solidus
