/// One call of a Fortran subroutine per point, with all arguments by reference in the order of the manual
/// of Abaqus.
#include "material/outside/umat_library.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "numbers/index_casts.hpp"

namespace solidus::material {

namespace {

// Integers of Fortran's default kind, texts of 80 characters whose length comes last.
using Umat = void (*)(double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd,
                      double* rpl, double* ddsddt, double* drplde, double* drpldt, const double* stran,
                      const double* dstran, const double* time, const double* dtime, const double* temp,
                      const double* dtemp, const double* predef, const double* dpred, const char* cmname,
                      const int* ndi, const int* nshr, const int* ntens, const int* nstatv,
                      const double* props, const int* nprops, const double* coords, const double* drot,
                      double* pnewdt, const double* celent, const double* dfgrd0, const double* dfgrd1,
                      const int* noel, const int* npt, const int* layer, const int* kspt, const int* kstep,
                      const int* kinc, std::size_t length_of_cmname);

/// A tensor in Abaqus' order: xx, yy, zz, xy, xz, yz.
using Vector = std::array<double, 6>;
Vector components(const Sym<double>& t, double of_shears) {
  return {t[0], t[1], t[2], of_shears * t[3], of_shears * t[5], of_shears * t[4]};
}

class UmatLibrary final : public ExternalLibrary {
 public:
  UmatLibrary(const SharedObject& object, const ExternalData& data)
      : umat_(reinterpret_cast<Umat>(object.get(data.behaviour, "the subroutine UMAT"))),
        properties_(data.properties),
        n_state_(as_size(*data.state_variables)),
        takes_rpl_(data.dissipation == ExternalDissipation::rpl) {
    name_.fill(' ');
    constexpr std::string_view name = "SOLIDUS";
    std::copy(name.begin(), name.end(), name_.begin());
    if (properties_.empty()) properties_.push_back(0);  // something to point to
    n_properties_ = static_cast<int>(data.properties.size());
  }

  std::size_t n_internal() const override { return n_state_; }
  std::size_t n_scratch() const override { return 0; }
  TangentForm tangent_form() const override { return {.by_columns = true, .shear = 1}; }
  std::vector<std::string> internal_names() const override {
    std::vector<std::string> names;
    for (std::size_t i = 1; i <= n_state_; ++i) names.push_back("STATEV(" + std::to_string(i) + ")");
    return names;
  }
  // A UMAT that does not compute energies leaves them as they are: nothing tells whether it does.
  bool tells_stored() const override { return false; }
  bool tells_dissipated() const override { return false; }
  double dissipated(const ExternalCall& c) const override {
    if (takes_rpl_) return c.heat * c.dt;
    return c.energies[1] + c.energies[2] - c.old_energies[1] - c.old_energies[2];
  }
  double stored(const double* energies) const override { return energies[0]; }

  bool integrate(ExternalCall& c) const override {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr int normal = 3, shears = 3, all = 6, one = 1, step[4] = {1, 1, 0, 0};
    static constexpr double unused[9] = {nan, nan, nan, nan, nan, nan, nan, nan, nan};
    static constexpr double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    c.tangent.fill(0.0);
    // Shear strains of a UMAT are doubled, and its components in another order.
    Vector stress = components(c.old_stress, 1);
    const Vector strain = components(c.old_strain, 2), change = components(c.strain - c.old_strain, 2);
    double stress_by_temperature[6] = {}, heat_by_strain[6] = {};
    double no_state = 0, heat_by_temperature = 0, shorter = 1;
    const double time[2] = {c.time, c.time}, warming = c.temperature - c.old_temperature, field = 0;
    const int n_state = static_cast<int>(n_state_);
    c.heat = 0;
    // What Solidus does not know of an element or of the geometry is not a number, so that a law that reads
    // it shows.
    umat_(stress.data(), n_state_ > 0 ? c.internal : &no_state, c.tangent.data(), &c.energies[0],
          &c.energies[1], &c.energies[2], &c.heat, stress_by_temperature, heat_by_strain,
          &heat_by_temperature, strain.data(), change.data(), time, &c.dt, &c.old_temperature, &warming,
          &field, &field, name_.data(), &normal, &shears, &all, &n_state, properties_.data(), &n_properties_,
          unused, identity, &shorter, unused, unused, unused, &one, &one, &one, &one, step, &one,
          name_.size());
    if (!(shorter >= 1)) {
      if (c.complaint != nullptr) *c.complaint = "the UMAT asks for a shorter step (PNEWDT below 1)";
      return false;
    }
    c.stress = {{stress[0], stress[1], stress[2], stress[3], stress[5], stress[4]}};
    return true;
  }

 private:
  Umat umat_;
  std::vector<double> properties_;
  int n_properties_ = 0;
  std::size_t n_state_;
  bool takes_rpl_;
  std::array<char, 80> name_{};
};

}  // namespace

std::shared_ptr<const ExternalLibrary> make_umat_library(const SharedObject& object,
                                                         const ExternalData& data) {
  return std::make_shared<UmatLibrary>(object, data);
}

}  // namespace solidus::material
