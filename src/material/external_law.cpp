/// The library's strain, stress and tangent are brought to ours and back; solid points call it, points that
/// are melt use the Maxwell element.
#include "material/external_law.hpp"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <type_traits>

#include "numbers/index_casts.hpp"
#include "numbers/simd.hpp"

namespace solidus::material {

namespace {

template <class T>
inline constexpr int k_points = std::is_same_v<T, Lane> ? k_lanes : 1;

/// One number of a lane in memory. The lane's own subscript, where it is not known before run time, takes the
/// whole lane into a register and back.
template <class T>
double at(const T& value, int lane) {
  double number;
  std::memcpy(&number, reinterpret_cast<const char*>(&value) + sizeof number * as_size(lane), sizeof number);
  return number;
}
template <class T>
void set(T& value, int lane, double to) {
  std::memcpy(reinterpret_cast<char*>(&value) + sizeof to * as_size(lane), &to, sizeof to);
}
bool holds(bool mask, int) {
  return mask;
}
bool holds(const LaneMask& mask, int lane) {
  return mask[lane];
}

template <class T>
Sym<T> tensor_at(const T* numbers, std::size_t place) {
  const T* from = numbers + place;
  return {{from[0], from[1], from[2], from[3], from[4], from[5]}};
}
template <class T>
void put(const Sym<T>& tensor, T* numbers, std::size_t place) {
  for (int i = 0; i < 6; ++i) numbers[place + as_size(i)] = tensor[i];
}
template <class T>
Sym<double> tensor_of(const T* numbers, std::size_t place, int lane) {
  Sym<double> tensor;
  for (int i = 0; i < 6; ++i) tensor[i] = at(numbers[place + as_size(i)], lane);
  return tensor;
}

template <class T, class Mask>
Sym<T> choose(const Mask& mask, const Sym<T>& a, const Sym<T>& b) {
  Sym<T> r;
  for (int i = 0; i < 6; ++i) r[i] = select(mask, a[i], b[i]);
  return r;
}

bool trusted = false;

/// The library's tangent is by its own components; place and factor bring it to ours (engineering shear
/// strains and their order).
template <class T>
void bring_to_our_components(const auto& factor, const auto& place, Sym4<T>& tangent) {
  const Sym4<T> of_library = tangent;
  const T* const entries = of_library.c[0].data();
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) tangent.c[i][j] = T(factor[6 * i + j]) * entries[place[6 * i + j]];
}

/// Whether an answer of the library is a number throughout.
template <class T>
auto all_finite(const auto& answer, std::span<const T> energies, const T& dissipated, bool with_tangent) {
  const T zero(0.0);
  // Zero, or not a number where one of the values is not finite.
  T check = zero * dissipated, check_of_tangent = zero;
  for (int i = 0; i < 6; ++i) {
    check += zero * answer.stress[i];
    if (with_tangent)
      for (std::size_t j = 0; j < 6; ++j) check_of_tangent += zero * answer.tangent[i][j];
  }
  for (const T& value : energies) check += zero * value;
  return check + check_of_tangent == zero;
}

}  // namespace

std::string ExternalData::path() const {
  namespace fs = std::filesystem;
  return (fs::absolute(where.file).parent_path() / library).lexically_normal().string();
}

ExternalLaw::ExternalLaw(ExternalData data, std::shared_ptr<const ExternalLibrary> library)
    : data_(std::move(data)),
      library_(std::move(library)),
      n_internal_(library_->n_internal()),
      told_(data_.dissipation == ExternalDissipation::law || data_.dissipation == ExternalDissipation::rpl ||
            (data_.dissipation == ExternalDissipation::automatic && library_->tells_dissipated())),
      initial_(data_.initial_state) {
  initial_.resize(n_internal_);
  constexpr std::array<std::size_t, 6> component{0, 1, 2, 3, 5, 4};  // of Sym, of each of the library's
  // Where each entry of the library's tangent goes: by rows or columns, with factors where shear strains are
  // halved.
  const TangentForm form = library_->tangent_form();
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      const std::size_t entry = 6 * component[i] + component[j];
      tangent_place_[entry] = form.by_columns ? 6 * j + i : 6 * i + j;
      tangent_factor_[entry] = (i < 3 ? 1 : form.shear) * (j < 3 ? 1 : form.shear);
    }
}

ExternalLaw::Workspace::Workspace(const ExternalLaw& law)
    : numbers(2 * law.n_internal_ + (law.library_ ? law.library_->n_scratch() : 0)) {}

/// A point where the library is not asked has no state of it.
template <class T>
void ExternalLaw::forget(T* now, int lane) const {
  for (std::size_t i = k_energies; i < size(); ++i) set(now[i], lane, 0.0);
}

template <class T>
bool ExternalLaw::integrate(const Properties<T>& p, const T* old, T* now, const Sym<T>& strain, double dt,
                            int lane, Workspace& space, Response<T>& r, T& dissipated) const {
  // A library works on one point with plain numbers: state and strain of the lane are copied out of their
  // packs, in the order that the interface asks for.
  double old_energies[k_external_energies], energies[k_external_energies];
  double* const old_internal = space.numbers.data();
  double* const internal = old_internal + n_internal_;
  for (std::size_t i = 0; i < k_external_energies; ++i)
    old_energies[i] = energies[i] = at(old[k_energies + i], lane);
  // Internal variables are stored as differences to their initial values, so that a history of zeros is a
  // fresh point.
  for (std::size_t i = 0; i < n_internal_; ++i)
    old_internal[i] = internal[i] = initial_[i] + at(old[k_internal + i], lane);
  ExternalCall call;
  call.dt = dt;
  call.time = at(old[k_time], lane);
  call.old_temperature = at(p.initial_temperature, lane) + at(old[k_warming], lane);
  call.temperature = at(p.temperature, lane);
  call.old_strain = tensor_of(old, k_strain, lane);
  call.strain = tensor_of(strain.c.data(), 0, lane);
  call.old_stress = tensor_of(old, k_stress, lane);
  call.bulk = at(p.elastic.bulk, lane);
  call.shear = at(p.elastic.shear, lane);
  // A fresh point is one that has just become coherent: it starts from its present strain.
  call.fresh = !(at(old[k_solid], lane) > 0);
  call.wants_tangent = space.wants_tangent;
  call.old_internal = old_internal;
  call.old_energies = old_energies;
  call.scratch = internal + n_internal_;
  call.internal = internal;
  call.energies = energies;
  call.complaint = space.failures == nullptr ? nullptr : space.failures + lane;
  // A library that finds no state leaves the complaint to whom it was asked for; the step is then shortened.
  if (!library_->integrate(call)) return false;

  // What has been found goes back into the lane: stress, tangent, internal variables, energies, and the
  // dissipation where the law tells it.
  for (int i = 0; i < 6; ++i) set(r.stress[i], lane, call.stress[i]);
  if (space.wants_tangent)  // as the library writes it
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) set(r.tangent.c[i][j], lane, call.tangent[6 * i + j]);
  for (std::size_t i = 0; i < n_internal_; ++i) set(now[k_internal + i], lane, internal[i] - initial_[i]);
  for (std::size_t i = 0; i < k_external_energies; ++i) set(now[k_energies + i], lane, energies[i]);
  if (told_) set(dissipated, lane, library_->dissipated(call));
  return true;
}

template <class T>
void ExternalLaw::update(const Properties<T>& p, const T* old, T* now, const Sym<T>& strain, double dt,
                         Workspace& space, Response<T>& r) const {
  // The law takes the strain without thermal growth and without the viscous strain of the melt.
  const T zero(0.0), one(1.0), third(1.0 / 3.0);
  const T bulk = p.elastic.bulk, twice_shear = T(2.0) * p.elastic.shear;
  const auto solid = p.elastic.solid_fraction >= T(data_.coherency_fraction);
  const Sym<T> old_inelastic = tensor_at(old, k_inelastic);
  Sym<T> viscous = tensor_at(old, k_viscous);
  const T growth = third * p.elastic.thermal_strain;
  Sym<T> of_law = strain - viscous;  // e
  for (int i = 0; i < 3; ++i) of_law[i] -= growth;

  T dissipated = zero;
  bool answered = true;
  // Lanes of one kernel may hold solid and melt: the library is called for solid points alone, and
  // history is forgotten where a point has melted again.
  for (int lane = 0; lane < k_points<T>; ++lane)
    if (holds(solid, lane))
      answered = integrate(p, old, now, of_law, dt, lane, space, r, dissipated) && answered;
    else
      forget(now, lane);
  if (!answered) {
    r.status = Status::cut_the_step;
    return;
  }
  if (space.wants_tangent) bring_to_our_components<T>(tangent_factor_, tangent_place_, r.tangent);
  const auto finite = all_finite<T>(r, {now + k_energies, now + size()}, dissipated, space.wants_tangent);
  if (any(!finite)) {
    r.status = Status::cut_the_step;
    for (int lane = 0; space.failures != nullptr && lane < k_points<T>; ++lane)
      if (!holds(finite, lane))
        space.failures[lane] = "the answer of the library holds values that are not finite";
  }

  // The balance of the inelastic work, with the moduli of the material file.
  Sym<T> inelastic = of_law - (one / twice_shear) * dev(r.stress);
  const T mean = trace(r.stress) * (third * third / bulk);
  for (int i = 0; i < 3; ++i) inelastic[i] -= mean;
  const Sym<T> flow = inelastic - old_inelastic;
  const T work = dot(r.stress, flow);
  if (!told_) dissipated = T(data_.heat_share) * select(work > zero, work, zero);
  T stored = work - dissipated, equivalent = T(std::sqrt(2.0 / 3.0)) * norm(dev(flow));
  const T rate(1.0 / dt);
  r.plastic_power = rate * work;
  r.dissipation = r.plastic_dissipation = rate * dissipated;

  // Points below coherency are the Maxwell element: they forget the deviatoric inelastic strain and
  // keep what they have grown by.
  if (any(!solid)) {
    const T volume = third * trace(old_inelastic);
    Sym<T> swollen = strain;
    for (int i = 0; i < 3; ++i) swollen[i] -= volume;
    const auto melt = Viscoelastic::update(p.elastic, {viscous + dev(old_inelastic)}, swollen, dt);
    const Sym4<T> isotropic = Sym4<T>::isotropic(melt.bulk, melt.twice_shear);
    r.stress = choose(solid, r.stress, melt.stress);
    for (int i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) r.tangent[i][j] = select(solid, r.tangent[i][j], isotropic[i][j]);
    viscous = choose(solid, viscous, melt.state.viscous_strain);
    Sym<T> kept;
    kept[0] = kept[1] = kept[2] = volume;
    inelastic = choose(solid, inelastic, kept);
    Sym<T> of_melt = strain - melt.state.viscous_strain;
    for (int i = 0; i < 3; ++i) of_melt[i] -= growth;
    of_law = choose(solid, of_law, of_melt);
    stored = select(solid, stored, zero);
    equivalent = select(solid, equivalent, zero);
    r.plastic_power = select(solid, r.plastic_power, zero);
    r.plastic_dissipation = select(solid, r.plastic_dissipation, zero);
    r.dissipation = select(solid, r.dissipation, melt.dissipation);
  }
  // History at the end: viscous and inelastic strain, the law's own strain and stress, sums of
  // strain and energy.
  put(viscous, now, k_viscous);
  put(inelastic, now, k_inelastic);
  put(of_law, now, k_strain);
  put(r.stress, now, k_stress);
  now[k_equivalent] = old[k_equivalent] + equivalent;
  now[k_cold_work] = old[k_cold_work] + stored;
  now[k_warming] = p.temperature - p.initial_temperature;
  now[k_time] = old[k_time] + T(dt);
  now[k_solid] = select(solid, one, zero);
}

template void ExternalLaw::update(const Properties<double>&, const double*, double*, const Sym<double>&,
                                  double, Workspace&, Response<double>&) const;
template void ExternalLaw::update(const Properties<Lane>&, const Lane*, Lane*, const Sym<Lane>&, double,
                                  Workspace&, Response<Lane>&) const;

ExternalLaw::Response<double> ExternalLaw::update(const Properties<double>& p, const double* old, double* now,
                                                  const Sym<double>& strain, double dt,
                                                  std::string* failure) const {
  Workspace space(*this);
  space.failures = failure;
  Response<double> r{};
  update(p, old, now, strain, dt, space, r);
  return r;
}

void trust_external_laws() {
  trusted = true;
}
bool external_laws_are_trusted() {
  return trusted;
}

}  // namespace solidus::material
