/// Symbols of the shared object are read and checked against what Solidus offers; a call then fills the
/// structure that the interface defines, point by point.
#include "material/outside/mfront_library.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace solidus::material {

namespace {

// The layout of version 1 of the interface.
struct InitialView {
  const double *gradients, *forces, *density, *properties, *internal, *stored, *dissipated, *external;
};
struct EndView {
  const double* gradients;
  double* forces;
  const double *density, *properties;
  double *internal, *stored, *dissipated;
  const double* external;
};
struct DataView {
  char* message;  ///< of 512 characters
  double dt;
  double* stiffness;  ///< its first entry says what is asked for
  double* step_factor;
  double* sound;
  InitialView start;
  EndView end;
};
using EntryPoint = int (*)(DataView*);

constexpr unsigned short k_version = 1;
constexpr double k_no_tangent = 0, k_consistent_tangent = 4;
constexpr const char* k_hypothesis = "Tridimensional";
constexpr double k_root_two = 1.4142135623730950488, k_half_root = 1 / k_root_two;

/// A tensor in MFront's order: xx, yy, zz, √2 xy, √2 xz, √2 yz.
using Vector = std::array<double, 6>;
Vector components(const Sym<double>& t) {
  return {t[0], t[1], t[2], k_root_two * t[3], k_root_two * t[5], k_root_two * t[4]};
}

/// The description of a behaviour, read from its symbols.
class Symbols {
 public:
  Symbols(const SharedObject& object, const ExternalData& data) : object_(object), name_(data.behaviour) {}

  const SharedObject& object() const { return object_; }
  unsigned short number(const std::string& what) const {
    return *static_cast<const unsigned short*>(object_.get(name_ + "_" + what, k_what));
  }
  unsigned short number_or(const std::string& what, unsigned short otherwise) const {
    const void* found = find(what);
    return found != nullptr ? *static_cast<const unsigned short*>(found) : otherwise;
  }
  /// Looks for the symbol of the hypothesis first, then for that of all hypotheses.
  unsigned short own_number(const std::string& what) const {
    return *static_cast<const unsigned short*>(get(what));
  }
  std::vector<std::string> names(const std::string& what) const {
    const unsigned short n = own_number("n" + what);
    if (n == 0) return {};
    const char* const* list = static_cast<const char* const*>(get(what));
    return {list, list + n};
  }
  /// Kinds of the variables: 0 scalar, 1 symmetric tensor, 2 vector, 3 tensor.
  std::vector<int> types(const std::string& what, std::size_t n) const {
    if (n == 0) return {};
    const int* list = static_cast<const int*>(get(what + "Types"));
    return {list, list + n};
  }
  bool has(const std::string& what) const { return find(what) != nullptr; }
  EntryPoint entry() const {
    return reinterpret_cast<EntryPoint>(
        object_.get(name_ + "_" + k_hypothesis, "the law in three dimensions"));
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& allowed) const {
    throw InputError(object_.where(), fmt::format("'{}' of '{}' {}", name_, object_.file(), what), allowed);
  }

 private:
  static constexpr const char* k_what = "of MFront's generic interface";
  std::string own(const std::string& what) const { return name_ + "_" + k_hypothesis + "_" + what; }
  void* find(const std::string& what) const {
    void* found = object_.find(own(what));
    return found != nullptr ? found : object_.find(name_ + "_" + what);
  }
  const void* get(const std::string& what) const {
    const void* found = object_.find(own(what));
    return found != nullptr ? found : object_.get(name_ + "_" + what, k_what);
  }

  const SharedObject& object_;
  std::string name_;
};

std::size_t size_of(int type, const Symbols& symbols) {
  switch (type) {
    case 0:
      return 1;
    case 1:
      return 6;
    case 2:
      return 3;
    case 3:
      return 9;
    default:
      break;
  }
  symbols.refuse(fmt::format("has a state variable of the unknown kind {}", type),
                 "scalars, vectors, tensors and symmetric tensors");
}

void check_kind(const Symbols& s) {
  // What the library says of itself must fit what Solidus does: the interface, small strains,
  // isotropy, strain in and stress out.
  if (s.number_or("api_version", 0) != k_version)
    s.refuse(fmt::format("speaks version {} of the generic interface", s.number_or("api_version", 0)),
             "version 1, of TFEL 4 and newer");
  if (s.number("mfront_mkt") != 1) s.refuse("is no behaviour", "a behaviour (mfront_mkt = 1)");
  if (s.number("BehaviourType") != 1 || s.number("BehaviourKinematic") != 1)
    s.refuse("is no law of infinitesimal strain", "BehaviourType = 1 and BehaviourKinematic = 1");
  // Isotropic, since moulds and castings have no axes of a material.
  if (s.number("SymmetryType") != 0)
    s.refuse("is orthotropic: a casting has no axes of a material", "an isotropic law");
  if (const auto gradients = s.names("Gradients"); gradients != std::vector<std::string>{"Strain"})
    s.refuse(fmt::format("works with the gradients {}", gradients), "Strain");
  if (const auto forces = s.names("ThermodynamicForces"); forces != std::vector<std::string>{"Stress"})
    s.refuse(fmt::format("answers with {}", forces), "Stress");
  if (s.own_number("requiresThermalExpansionCoefficientTensor") != 0)
    s.refuse(
        "takes thermal strain off itself; Solidus has done so already, with the expansion of the material "
        "file",
        "no @RequireThermalExpansionCoefficientTensor in the law");
}

class MfrontLibrary final : public ExternalLibrary {
 public:
  MfrontLibrary(const SharedObject& object, const ExternalData& data) {
    const Symbols s(object, data);
    check_kind(s);
    entry_ = s.entry();
    // The properties as the library expects them, in its own order.
    std::vector<std::string> wanted;
    // Elastic moduli come before the properties that the behaviour names itself.
    if (s.own_number("requiresStiffnessTensor") != 0) wanted = {"YoungModulus", "PoissonRatio"};
    for (const std::string& name : s.names("MaterialProperties")) wanted.push_back(name);
    if (wanted.size() != data.properties.size())
      s.refuse(fmt::format("takes {} properties{}, [external] gives {}", wanted.size(), list(wanted),
                           data.properties.size()),
               "properties, in this order and in the units of the law");
    properties_ = data.properties;

    // Scalars and tensors of the internal state are named component by component.
    const auto names = s.names("InternalStateVariables");
    const auto types = s.types("InternalStateVariables", names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::size_t n = size_of(types[i], s);
      if (names[i] == "ElasticStrain" && n == 6) elastic_strain_ = static_cast<int>(names_.size());
      for (std::size_t j = 0; j < n; ++j)
        names_.push_back(n == 1 ? names[i] : fmt::format("{}[{}]", names[i], j));
    }
    // External state variables besides temperature, and which energies it computes.
    external_ = data.external_state_variables;
    read_external(s, data);
    stores_ = s.own_number("ComputesInternalEnergy") == 1;
    dissipates_ = s.own_number("ComputesDissipatedEnergy") == 1;
    if (data.dissipation == ExternalDissipation::law && !dissipates_)
      s.refuse("does not compute the energy that it dissipates",
               "dissipation = \"share\", or @DissipatedEnergy");
  }

  std::size_t n_internal() const override { return names_.size(); }
  std::size_t n_scratch() const override { return names_.size() + 2 * (external_.size() + 1); }
  TangentForm tangent_form() const override { return {.by_columns = false, .shear = 1 / k_root_two}; }
  std::vector<std::string> internal_names() const override { return names_; }
  bool tells_stored() const override { return stores_; }
  bool tells_dissipated() const override { return dissipates_; }
  double dissipated(const ExternalCall& c) const override { return c.energies[1] - c.old_energies[1]; }
  double stored(const double* energies) const override { return energies[0]; }

  bool integrate(ExternalCall& c) const override {
    // MFront orders shear components otherwise, and scales them by √2; strain and stress are converted on the
    // way in and out.
    const Vector old_strain = components(c.old_strain), strain = components(c.strain),
                 old_stress = components(c.old_stress);
    Vector stress = old_stress;
    double sound = 0, longer = 1;
    // A fresh point has as elastic strain the strain at which it begins, if the law has such a variable.
    const double* old_state = c.old_internal;
    if (c.fresh && elastic_strain_ >= 0) {
      std::copy_n(c.old_internal, names_.size(), c.scratch);
      std::copy_n(old_strain.data(), 6, c.scratch + elastic_strain_);
      std::copy_n(old_strain.data(), 6, c.internal + elastic_strain_);
      old_state = c.scratch;
    }
    // External state variables are the temperature and constants, at both ends of the step.
    double* const old_external = c.scratch + names_.size();
    double* const new_external = old_external + external_.size() + 1;
    old_external[0] = c.old_temperature;
    new_external[0] = c.temperature;
    for (std::size_t i = 0; i < external_.size(); ++i)
      old_external[i + 1] = new_external[i + 1] = external_[i];
    char message[513];
    message[0] = 0;
    constexpr double density = 0;
    // The first entry of the tangent tells the library whether a tangent is wanted.
    if (c.wants_tangent) c.tangent.fill(0.0);
    c.tangent[0] = c.wants_tangent ? k_consistent_tangent : k_no_tangent;
    DataView view{message,
                  c.dt,
                  c.tangent.data(),
                  &longer,
                  &sound,
                  {old_strain.data(), old_stress.data(), &density, properties_.data(), old_state,
                   &c.old_energies[0], &c.old_energies[1], old_external},
                  {strain.data(), stress.data(), &density, properties_.data(), c.internal, &c.energies[0],
                   &c.energies[1], new_external}};
    // Any answer but 1 is a failure; the library's message is passed on.
    const int status = entry_(&view);
    if (status != 1) {  // 0: an answer that is not reliable
      message[512] = 0;
      if (c.complaint != nullptr)
        *c.complaint =
            fmt::format("the library answers {}{}{}", status, message[0] != 0 ? ": " : "", message);
      return false;
    }
    c.stress = {{stress[0], stress[1], stress[2], k_half_root * stress[3], k_half_root * stress[5],
                 k_half_root * stress[4]}};
    return true;
  }

 private:
  static std::string list(const std::vector<std::string>& names) {
    return names.empty() ? std::string() : fmt::format(" ({})", fmt::join(names, ", "));
  }
  /// The temperature, which older versions name among the others, and what the material file gives.
  void read_external(const Symbols& s, const ExternalData& data) {
    auto names = s.names("ExternalStateVariables");
    if (s.has("ExternalStateVariablesTypes"))
      for (const int type : s.types("ExternalStateVariables", names.size()))
        if (type != 0) s.refuse("has external state variables that are no numbers", "scalars");
    // Newer versions of the interface take the temperature apart from the others.
    if (s.number_or("TemperatureRemovedFromExternalStateVariables", 1) == 0) {
      if (names.empty() || names[0] != "Temperature")
        s.refuse("does not take the temperature as its first external state variable", "Temperature");
      names.erase(names.begin());
    }
    if (names.size() != data.external_state_variables.size())
      s.refuse(fmt::format("has {} external state variables besides the temperature{}, [external] gives {}",
                           names.size(), list(names), data.external_state_variables.size()),
               "external_state_variables, in this order");
  }

  EntryPoint entry_ = nullptr;
  std::vector<double> properties_, external_;
  std::vector<std::string> names_;
  int elastic_strain_ = -1;  ///< where it is in the state; negative: nowhere
  bool stores_ = false, dissipates_ = false;
};

}  // namespace

std::shared_ptr<const ExternalLibrary> make_mfront_library(const SharedObject& object,
                                                           const ExternalData& data) {
  return std::make_shared<MfrontLibrary>(object, data);
}

}  // namespace solidus::material
