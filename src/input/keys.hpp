/// Every key of an input file, declared once: from the declaration come reading with validation, `explain`,
/// the JSON Schema and the reference manual (input/key_docs.hpp).
///
///   Section<HeatOptions> heat("heat", "The thermal phase.");
///   heat.key("max_iterations", &HeatOptions::max_iterations).initially(25).range(1, 1000).doc("Newton
///   iterations."); heat.choice("integration", &HeatOptions::rule, {{"closed", Rule::closed, "at the nodes"},
///   {"open", Rule::open, "Gauss"}}); heat.quantity("ambient", &HeatOptions::ambient, "K").initially("20
///   degC").positive().doc("Far temperature."); heat.function("film", &HeatOptions::film,
///   "W/m2/K").of({Argument::time, Argument::temperature}).doc("h."); const HeatOptions options =
///   heat.read(document);
///
/// A key without `initially` and whose member is no std::optional is required. Quantities are in SI after
/// reading.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "input/document.hpp"
#include "input/units.hpp"
#include "numbers/table.hpp"

namespace solidus {

/// The variable that a table-valued quantity depends on.
enum class Argument { constant, time, temperature, gap, pressure, strain };
std::string_view name(Argument argument);     ///< "time"
std::string_view si_unit(Argument argument);  ///< "s"

struct PlaceSpec;  // input/place_spec.hpp
template <class Interface>
class Kinds;  // input/kinds.hpp

/// A table-valued quantity as the user gave it, in SI: a constant ("2.3 N/mm/s/K"), or a table
/// { of = "time", argument_unit = "s", unit = "degC", points = [[0, 20], [10, 30]], extrapolation =
/// "constant", source = "…",
///   valid = ["0 s", "90 s"] }, or a constant with its source { value = "2700 kg/m3", source = "…" }.
struct Function {
  Table table;
  Argument of = Argument::constant;
  std::string source;                          ///< where the data come from; may be empty
  std::optional<std::array<double, 2>> valid;  ///< the range of the argument in which the source holds
  /// A function of position, and of time where the key has it; then the table says nothing. Null: a table.
  std::shared_ptr<const PlaceSpec> place;
  SourceLocation where;
};

/// The declaration of one key. Built by Section's functions and refined by the chain of calls behind them.
class Key {
 public:
  enum class Kind {
    text,
    integer,
    number,
    boolean,
    choice,
    quantity,
    function,
    section,
    sections,
    named_sections
  };
  /// Whether a quantity may also be a function of position, or of position and time.
  enum class Place { none, position, position_and_time };

  Key& doc(std::string text) { return doc_text = std::move(text), *this; }
  /// The value when the key is absent, as it would be in the file.
  Key& initially(Value value);
  /// The least and greatest value, in SI, both allowed.
  Key& range(double least, double greatest);
  Key& at_least(double least) { return range(least, upper); }
  /// Above zero.
  Key& positive();
  /// The texts allowed (keys of type text).
  Key& choices(std::vector<std::string> texts);
  /// The arguments allowed for a table (the first is meant when `of` is left out and it is the only one).
  Key& of(std::vector<Argument> which) { return arguments = std::move(which), *this; }
  /// It may vary from place to place: a formula, a table of points, a field of a file (input/place_spec.hpp).
  /// Only quantities read into a Function.
  Key& anywhere(Place with = Place::position_and_time) { return place = with, *this; }
  /// The key belongs to the section only when another key of it, a text, has one of these values.
  Key& when(std::string key, std::vector<std::string> values);
  /// A list of one may be written as its item.
  Key& or_one() { return single = true, *this; }
  /// Temperatures are differences: "5 degC" is 5 K.
  Key& difference() { return temperature = units::Temperature::difference, *this; }

  std::string name, doc_text, unit;  ///< unit: SI, quantities and functions only
  Kind kind = Kind::text;
  bool list = false;       ///< the value is a list of such values
  std::size_t length = 0;  ///< its length, zero: any
  bool single = false;     ///< a list of one may be written as its item
  bool required = true;
  std::optional<Value> initial;
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;           ///< `lower` itself is not allowed
  std::vector<std::string> allowed;  ///< texts, empty: any
  std::vector<std::string> allowed_docs;
  std::vector<Argument> arguments;
  Place place = Place::none;
  std::string when_key;
  std::vector<std::string> when_values;
  units::Temperature temperature = units::Temperature::absolute;
  std::shared_ptr<const struct SectionInfo> section;  ///< of sub-sections
};

/// The declaration of a section, without the C++ type it is read into.
struct SectionInfo {
  std::string name, doc;
  std::deque<Key> keys;  // a deque: references to its elements stay valid
  const Key* find(std::string_view key) const;
  /// Throws std::logic_error where the section has the key.
  void check_new(const std::string& key) const;
  /// The table with all defaults filled in, sub-sections included.
  /// Throws InputError for unknown, missing and misplaced keys.
  /// @param path the section as a user names it, "[mesh.parameters]"; for messages
  Value completed(const Value& table, const std::string& path) const;
  /// Adds the keys of a kind (input/kinds.hpp), which belong to the section where the key `chosen_by` has its
  /// name; several kinds may share a key. Throws std::logic_error where the section has such a key itself.
  void add_kind(const std::string& chosen_by, const std::string& kind, const SectionInfo& of_kind);
};

/// The one of `names` that the user may have meant; empty when none is near.
std::string nearest_name(std::string_view wrong, const std::vector<std::string>& names);
/// "one of: a, b, c; did you mean 'b'?" for the second part of an InputError.
std::string one_of(const std::vector<std::string>& names, std::string_view found = {});

namespace keys {

template <class M>
struct is_optional : std::false_type {};
template <class M>
struct is_optional<std::optional<M>> : std::true_type {};

// One value -> one member, checked against the key's declaration. Each throws InputError with the place.
void read(const Value& value, const Key& key, std::string& out);
void read(const Value& value, const Key& key, bool& out);
void read(const Value& value, const Key& key, int& out);
void read(const Value& value, const Key& key, std::int64_t& out);
void read(const Value& value, const Key& key, double& out);
void read(const Value& value, const Key& key, Function& out);
void read(const Value& value, const Key& key, Table& out);
const Value::List& list_items(const Value& value, const Key& key);
const std::string& choice_text(const Value& value, const Key& key);

template <class M>
void read(const Value& value, const Key& key, std::optional<M>& out) {
  read(value, key, out.emplace());
}
template <class M>
void read(const Value& value, const Key& key, std::vector<M>& out) {
  out.clear();
  if (key.single && !value.is_list()) return read(value, key, out.emplace_back());
  for (const Value& item : list_items(value, key)) read(item, key, out.emplace_back());
}
template <class M, std::size_t N>
void read(const Value& value, const Key& key, std::array<M, N>& out) {
  const auto& items = list_items(value, key);
  for (std::size_t i = 0; i < N; ++i) read(items[i], key, out[i]);
}

template <class M>
struct Plain {  ///< the value type of a list or optional
  using type = M;
  static constexpr bool list = false;
  static constexpr std::size_t length = 0;
};
template <class M>
struct Plain<std::optional<M>> : Plain<M> {};
template <class M>
struct Plain<std::vector<M>> {
  using type = M;
  static constexpr bool list = true;
  static constexpr std::size_t length = 0;
};
template <class M, std::size_t N>
struct Plain<std::array<M, N>> {
  using type = M;
  static constexpr bool list = true;
  static constexpr std::size_t length = N;
};

template <class M>
constexpr Key::Kind kind_of() {
  using P = typename Plain<M>::type;
  if constexpr (std::is_same_v<P, std::string>)
    return Key::Kind::text;
  else if constexpr (std::is_same_v<P, bool>)
    return Key::Kind::boolean;
  else if constexpr (std::is_integral_v<P>)
    return Key::Kind::integer;
  else
    return Key::Kind::number;
}

}  // namespace keys

/// The declaration of a section that is read into a struct T.
template <class T>
class Section {
 public:
  template <class E>
  struct Choice {
    std::string name;
    E value;
    std::string doc;
  };

  Section(std::string name, std::string doc) { info_->name = std::move(name), info_->doc = std::move(doc); }

  /// A text, whole number, number or truth value, or a list of them, by the member's type.
  template <class M>
  Key& key(std::string name, M T::*member) {
    return bind(std::move(name), member, keys::kind_of<M>());
  }
  /// A truth value into a map, by its name.
  Key& key(const std::string& name, std::map<std::string, bool> T::*member) {
    Key& key = add(name, Key::Kind::boolean);
    assign_.push_back(
        [&key, member, name](T& out, const Value& in) { keys::read(in, key, (out.*member)[name]); });
    return key;
  }
  /// A number with a unit, or a list of them; `unit` is SI.
  template <class M>
  Key& quantity(std::string name, M T::*member, std::string unit) {
    Key& key = bind(std::move(name), member, Key::Kind::quantity);
    key.unit = std::move(unit);
    return key;
  }
  /// A constant or a table; the member is a Function or a Table. `unit` is SI.
  template <class M>
  Key& function(std::string name, M T::*member, std::string unit) {
    Key& key = bind(std::move(name), member, Key::Kind::function);
    key.unit = std::move(unit);
    return key;
  }
  /// The same into a map, by its name; where the key is absent there is no entry.
  Key& function(std::string name, std::map<std::string, Function> T::*member, std::string unit) {
    Key& key = add(name, Key::Kind::function);
    key.unit = std::move(unit);
    assign_.push_back(
        [&key, member, name](T& out, const Value& in) { keys::read(in, key, (out.*member)[name]); });
    return key;
  }
  /// One of several texts, each standing for a value of an enumeration.
  template <class E>
  Key& choice(std::string name, E T::*member, std::vector<Choice<std::type_identity_t<E>>> values) {
    Key& key = add(std::move(name), Key::Kind::choice);
    for (const auto& value : values) {
      key.allowed.push_back(value.name);
      key.allowed_docs.push_back(value.doc);
    }
    assign_.push_back([&key, member, values](T& out, const Value& in) {
      const std::string& text = keys::choice_text(in, key);
      for (const auto& value : values)
        if (value.name == text) out.*member = value.value;
    });
    return key;
  }
  /// One of several kinds of object (input/kinds.hpp), whose keys are in this section too.
  template <class Interface>
  Key& kinds(const std::string& name, std::shared_ptr<const Interface> T::*member,
             const Kinds<Interface>& family) {
    Key& key = add(name, Key::Kind::choice);
    for (const auto& kind : family.all()) {
      key.allowed.push_back(kind.name);
      key.allowed_docs.push_back(kind.doc);
      info_->add_kind(name, kind.name, *kind.keys);
    }
    assign_.resize(info_->keys.size(), [](T&, const Value&) {});  // the kind reads its keys itself
    assign_whole_.push_back([&key, member, &family](T& out, const Value& section) {
      const Value* const chosen = section.find(key.name);
      if (chosen == nullptr) return;
      const std::string& text = keys::choice_text(*chosen, key);
      for (const auto& kind : family.all())
        if (kind.name == text) out.*member = kind.read(section);
    });
    return key;
  }
  /// A sub-section [name]; absent means its defaults, or nothing when the member is a std::optional.
  template <class M>
  Key& section(std::string name, M T::*member, const Section<typename keys::Plain<M>::type>& inner) {
    Key& key = add(std::move(name), Key::Kind::section);
    key.section = inner.shared_info();
    key.doc_text = inner.info().doc;
    key.required = false;
    if constexpr (!keys::is_optional<M>::value) key.initial = Value();
    assign_.push_back([member, inner](T& out, const Value& in) {
      if constexpr (keys::is_optional<M>::value)
        inner.assign((out.*member).emplace(), in);
      else
        inner.assign(out.*member, in);
    });
    return key;
  }
  /// Any number of [[name]] sections, in the order of the file.
  template <class U>
  Key& sections(std::string name, std::vector<U> T::*member, const Section<U>& inner) {
    Key& key = add(std::move(name), Key::Kind::sections);
    key.section = inner.shared_info();
    key.doc_text = inner.info().doc;
    key.required = false;
    assign_.push_back([member, inner](T& out, const Value& in) {
      for (const Value& item : in.items()) inner.assign((out.*member).emplace_back(), item);
    });
    return key;
  }
  /// Any number of [name.ANY] sections by a name of the user's choice.
  template <class U>
  Key& named_sections(std::string name, std::map<std::string, U> T::*member, const Section<U>& inner) {
    Key& key = add(std::move(name), Key::Kind::named_sections);
    key.section = inner.shared_info();
    key.doc_text = inner.info().doc;
    key.required = false;
    assign_.push_back([member, inner](T& out, const Value& in) {
      for (const auto& entry : in.entries()) inner.assign((out.*member)[entry.key], entry.value);
    });
    return key;
  }
  /// Keeps the place of the section itself in a member, for checks that come later.
  void place(SourceLocation T::*member) { place_ = member; }

  /// Reads a table, defaults filled in. Throws InputError with the place of the first thing that is wrong.
  T read(const Value& table) const {
    T result{};
    assign(result, info_->completed(table, info_->name));
    return result;
  }
  /// Reads a table that is complete already.
  void assign(T& out, const Value& complete) const {
    if (place_) out.*place_ = complete.where;
    for (std::size_t i = 0; i < assign_.size(); ++i)
      if (const Value* value = complete.find(info_->keys[i].name)) assign_[i](out, *value);
    for (const auto& assign_kind : assign_whole_) assign_kind(out, complete);
  }
  const SectionInfo& info() const { return *info_; }
  std::shared_ptr<const SectionInfo> shared_info() const { return info_; }

 private:
  /// Throws std::logic_error where the section has the key already.
  Key& add(std::string name, Key::Kind kind) {
    info_->check_new(name);
    Key& key = info_->keys.emplace_back();
    key.name = std::move(name);
    key.kind = kind;
    return key;
  }
  template <class M>
  Key& bind(std::string name, M T::*member, Key::Kind kind) {
    Key& key = add(std::move(name), kind);
    key.list = keys::Plain<M>::list;
    key.length = keys::Plain<M>::length;
    key.required = !keys::is_optional<M>::value;
    assign_.push_back([&key, member](T& out, const Value& in) { keys::read(in, key, out.*member); });
    return key;
  }

  std::shared_ptr<SectionInfo> info_ = std::make_shared<SectionInfo>();
  std::vector<std::function<void(T&, const Value&)>> assign_;        ///< one per key of info_, in its order
  std::vector<std::function<void(T&, const Value&)>> assign_whole_;  ///< from the whole section
  SourceLocation T::*place_ = nullptr;
};

}  // namespace solidus
