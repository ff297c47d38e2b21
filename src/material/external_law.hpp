/// The law of a solid from a shared object that was compiled without Solidus: [external] of a material file,
/// behind the generic interface of MFront (mfront_library.hpp) or that of Abaqus' UMAT (umat_library.hpp).
///
/// The library sees what the solid has in common with both interfaces:
///
///   e = ε − ⅓ e^θ 1 − ε^v     strain without thermal strain, phase changes and the flow of the melt
///   (σ, z, D)_{n+1} = law(e_n, e_{n+1}, Θ_n, Θ_{n+1}, σ_n, z_n, Δt)
///
/// Solidus adds what its energy balance needs, with the moduli k, G of the material file:
///
///   ε^in = e − (p/3k) 1 − s/2G,   Δξ = √⅔ ‖dev Δε^in‖
///   σ : Δε^in = D Δt + Δe^cw
///
/// so that elastic energy, heat of deformation and the first law are those of the laws of the program
/// (structural_partials.hpp), whatever the library does inside. Below coherency, f_S < coherency_fraction of
/// [casting], the Maxwell element (viscoelastic.hpp) takes its place; what had flowed then counts as viscous
/// strain, and the library starts from its initial state when the solid is coherent again.
///
/// Symbols: z the library's state variables, D dissipation [W/m³], e^cw energy of inelastic work that is
/// stored [J/m³], ε^v viscous strain of the melt. Validity: infinitesimal strain; isotropic moduli.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "material/viscoelastic.hpp"
#include "numbers/tensor.hpp"
#include "system/errors.hpp"

namespace solidus::material {

/// `built_in`: a law of the program that works on one point at a time (granular.hpp), which no user has to
/// trust.
enum class ExternalInterface { mfront, umat, built_in };

/// The share of inelastic work that becomes heat.
enum class ExternalDissipation {
  automatic,  ///< what the library says it dissipates, where its interface tells that it does; else `share`
  share,      ///< heat_share of the inelastic work
  law,        ///< MFront: dissipated energy; UMAT: SPD + SCD
  rpl         ///< UMAT: RPL
};

/// [external] of a material file.
struct ExternalData {
  std::string library;  ///< as written, relative to the material file
  std::string behaviour;
  ExternalInterface interface = ExternalInterface::mfront;
  std::vector<double> properties;                ///< in the order and the units of the library
  std::vector<double> external_state_variables;  ///< MFront: those besides the temperature
  std::optional<int> state_variables;            ///< of a UMAT
  std::vector<double> initial_state;             ///< of the state variables; empty: zero
  bool unsymmetric = false;
  ExternalDissipation dissipation = ExternalDissipation::automatic;
  double heat_share = 0;
  double coherency_fraction = 1;  ///< of the material: f_S from which the library answers
  SourceLocation where;

  std::string path() const;  ///< of the library: absolute or as found from the working folder
};

/// One integration of the library, component order and shears as in Sym (tensor components).
struct ExternalCall {
  double dt, time;  ///< [s], time: since the point is integrated, at the start
  double old_temperature, temperature;
  Sym<double> old_strain, strain, old_stress;
  double bulk, shear;          ///< k, G of the material file at `temperature` [Pa]
  bool fresh;                  ///< the first one of this point: z and energies are initial ones
  bool wants_tangent;          ///< else `tangent` is not read
  const double* old_internal;  ///< z_n
  const double* old_energies;  ///< [k_external_energies] [J/m³]
  double* scratch;             ///< [ExternalLibrary::n_scratch()], for the library's use

  Sym<double> stress;
  std::array<double, 36> tangent;  ///< ∂σ/∂e as the library writes it (TangentForm); where it is wanted
  double* internal;                ///< z_n before the call
  double* energies;                ///< those of t_n before the call
  double heat = 0;                 ///< RPL of a UMAT [W/m³]
  std::string* complaint;          ///< why there is none, where false is returned; may be null
};
inline constexpr std::size_t k_external_energies = 3;  ///< stored, dissipated (MFront); SSE, SPD, SCD (UMAT)

/// How a library writes its tangent: components 11, 22, 33, 12, 13, 23.
struct TangentForm {
  bool by_columns = false;
  double shear = 1;  ///< factor of each row and column of a shear that makes it one on engineering shears
};

/// A library behind its interface.
class ExternalLibrary {
 public:
  virtual ~ExternalLibrary() = default;
  virtual std::size_t n_internal() const = 0;
  /// Numbers that a call works with; nothing of a call is kept in the library's object.
  virtual std::size_t n_scratch() const = 0;
  virtual TangentForm tangent_form() const = 0;
  /// Name of each number of the state.
  virtual std::vector<std::string> internal_names() const = 0;
  /// Whether it tells the energies that it stores and dissipates.
  virtual bool tells_stored() const = 0;
  virtual bool tells_dissipated() const = 0;
  /// D Δt of a call [J/m³], where `dissipation` of the data says so.
  virtual double dissipated(const ExternalCall& call) const = 0;
  /// Energy that is stored, where it tells it [J/m³].
  virtual double stored(const double* energies) const = 0;
  /// False where there is no answer, or the step is too long.
  virtual bool integrate(ExternalCall& call) const = 0;
};

class ExternalLaw {
 public:
  /// Places of the numbers of a point in its history.
  enum : std::size_t {
    k_viscous = 0,                                 ///< ε^v
    k_inelastic = 6,                               ///< ε^in
    k_strain = 12,                                 ///< e
    k_stress = 18,                                 ///< σ
    k_equivalent = 24,                             ///< ξ
    k_cold_work = 25,                              ///< e^cw [J/m³]
    k_warming = 26,                                ///< Θ − Θ_0 [K]
    k_time = 27,                                   ///< for which the point has been integrated [s]
    k_solid = 28,                                  ///< one: the library has state of its own
    k_energies = 29,                               ///< of the library
    k_internal = k_energies + k_external_energies  ///< its state, less the initial one
  };

  /// A law that is not loaded: no code of the library runs.
  explicit ExternalLaw(ExternalData data) : data_(std::move(data)) {}
  ExternalLaw(ExternalData data, std::shared_ptr<const ExternalLibrary> library);

  const ExternalData& data() const { return data_; }
  bool loaded() const { return library_ != nullptr; }
  bool built_in() const { return data_.interface == ExternalInterface::built_in; }
  const ExternalLibrary& library() const { return *library_; }
  bool symmetric() const { return !data_.unsymmetric; }
  /// Numbers of a point.
  std::size_t size() const { return k_internal + n_internal_; }

  /// The memory of a caller for its calls, and what it asks for.
  struct Workspace {
    explicit Workspace(const ExternalLaw& law);
    std::vector<double> numbers;  ///< z_n, z_{n+1} and scratch of the point that is integrated
    bool wants_tangent = true;    ///< else that of the answer is zero
    std::string* failures =
        nullptr;  ///< set where a point has no answer, [k_lanes] or [1]; null: not asked for
  };

  /// @tparam T  double, or Lane for eight points
  template <class T>
  struct Properties {
    PointProperties<T> elastic;
    T temperature, initial_temperature;  ///< Θ, Θ_0 [K]
  };
  template <class T>
  struct Response {
    Sym<T> stress;                                      ///< σ [Pa]
    Sym4<T> tangent;                                    ///< on engineering shears [Pa]
    T dissipation, plastic_dissipation, plastic_power;  ///< [W/m³]
    Status status = Status::converged;
  };
  /// @param old  [size()] at t_n
  /// @param now  [size()] at t_{n+1}, written
  /// @param strain  total strain at t_{n+1}
  /// @param r    the answer, zero before
  template <class T>
  void update(const Properties<T>& p, const T* old, T* now, const Sym<T>& strain, double dt, Workspace& space,
              Response<T>& r) const;
  /// The same for a few points.
  /// @param failure  set where there is no answer; may be null
  Response<double> update(const Properties<double>& p, const double* old, double* now,
                          const Sym<double>& strain, double dt, std::string* failure = nullptr) const;

 private:
  /// The library at one point of a lane; false where it has no answer.
  template <class T>
  bool integrate(const Properties<T>& p, const T* old, T* now, const Sym<T>& strain, double dt, int lane,
                 Workspace& space, Response<T>& r, T& dissipated) const;

  template <class T>
  void forget(T* now, int lane) const;

  ExternalData data_;
  std::shared_ptr<const ExternalLibrary> library_;
  std::size_t n_internal_ = 0;
  bool told_ = false;                            ///< dissipation as the library tells it
  std::array<std::size_t, 36> tangent_place_{};  ///< of each entry, by rows of Sym4, in that of the library
  std::array<double, 36> tangent_factor_{};
  std::vector<double> initial_;
};

/// The law from outside of a material; null: the laws of the program.
const ExternalLaw* external_law(const Material& material);
void set_external_law(Material& material, std::shared_ptr<const ExternalLaw> law);
/// "the law from outside of 'steel'", "the granular law of 'green_sand'", for messages.
std::string name_of_law(const Material& material);
/// At which a law is tried and compared with the moduli of its material file: where the table of Young's
/// modulus has points in the solid, and room temperature [K], rising.
std::vector<double> temperatures_of_law(const Material& material);

/// Allows to load laws from shared objects, whose code then runs as a program of their author would. Only the
/// user who starts the program does that: no file can.
void trust_external_laws();
bool external_laws_are_trusted();

/// Loads the library, after a trial in a process of its own (external_trial.hpp). Throws InputError with the
/// place in the material file: not trusted, no such file or symbol, wrong sizes, a library that ends the
/// process or finds no answer.
/// @param material  whose law it is; the trial evaluates it at temperatures of its tables
std::shared_ptr<const ExternalLaw> load_external_law(const Material& material, const ExternalLaw& law);

}  // namespace solidus::material
