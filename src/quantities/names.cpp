/// One switch for each enumeration; a new member without a word is a warning of the compiler.
#include "quantities/names.hpp"

namespace solidus::quantities {

std::string_view name(Group group) {
  switch (group) {
    case Group::heat:
      return "heat";
    case Group::mechanics:
      return "mechanics";
    case Group::contact:
      return "contact";
    case Group::criteria:
      return "criteria";
  }
  return {};
}

std::string_view name(Rank rank) {
  switch (rank) {
    case Rank::scalar:
      return "scalar";
    case Rank::vector:
      return "vector";
    case Rank::tensor:
      return "tensor";
  }
  return {};
}

std::string_view name(Place place) {
  switch (place) {
    case Place::node:
      return "node";
    case Place::element:
      return "element";
    case Place::contact:
      return "contact";
  }
  return {};
}

std::string_view name(Written written) {
  switch (written) {
    case Written::always:
      return "always";
    case Written::on_request:
      return "on_request";
  }
  return {};
}

std::string_view name(Extreme extreme) {
  switch (extreme) {
    case Extreme::none:
      return "none";
    case Extreme::least:
      return "least";
    case Extreme::greatest:
      return "greatest";
  }
  return {};
}

std::string_view name(Colours colours) {
  switch (colours) {
    case Colours::sequential:
      return "sequential";
    case Colours::hot:
      return "hot";
    case Colours::share:
      return "share";
    case Colours::by_sign:
      return "by_sign";
  }
  return {};
}

}  // namespace solidus::quantities
