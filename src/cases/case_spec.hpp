/// A case as the user wrote it, checked key by key, in SI: plain values, no mesh, no physics
/// (docs/guide/case_file.md).
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/channel_spec.hpp"
#include "cases/feeder_spec.hpp"
#include "cases/feeding_spec.hpp"
#include "cases/filling_spec.hpp"
#include "cases/friction_spec.hpp"
#include "cases/jet_spec.hpp"
#include "cases/life_spec.hpp"
#include "cases/load_spec.hpp"
#include "cases/travel_spec.hpp"
#include "cases/variation.hpp"
#include "contact/points/parameters.hpp"
#include "coupling/scheme_kind.hpp"
#include "coupling/step_limits.hpp"
#include "heat/thermal_phase.hpp"
#include "input/keys.hpp"
#include "linear/linear_solver.hpp"
#include "mechanics/mechanics_options.hpp"
#include "numbers/types.hpp"
#include "system/errors.hpp"

namespace solidus::cases {

enum class Physics { heat, mechanics, thermomechanical };

struct AnalysisSpec {
  AnalysisKind kind = AnalysisKind::plane_strain;
  Physics physics = Physics::thermomechanical;
  double gravity = 0;                     ///< [m/s²]
  std::vector<double> gravity_direction;  ///< any length > 0; empty: down the last axis
  SourceLocation where;
};

/// The built-in shape `cylinder_in_mould`: an axisymmetric casting in an open cylindrical mould
/// (monograph 7.3). All in metres.
struct CylinderInMouldSpec {
  double radius = 0, height = 0;  ///< of the casting
  double mould_wall = 0, mould_bottom = 0, mould_height = 0;
  double element_size = 0;        ///< in the casting
  double mould_element_size = 0;  ///< far from the casting
  double interface_ratio = 0;     ///< mould elements per casting element along the interface
};

/// The built-in shape `block`: a rectangle or a box of one body. All in metres.
struct BlockSpec {
  std::vector<double> size;    ///< two or three lengths
  std::vector<double> origin;  ///< of the corner with the smallest coordinates
  std::vector<int> divisions;  ///< elements along each axis
};

/// The built-in shape `two_blocks`: two rectangles or boxes, one above the other. All in metres.
struct TwoBlocksSpec {
  std::vector<double> lower, upper;                   ///< sizes
  std::vector<int> lower_divisions, upper_divisions;  ///< elements along each axis
  double gap = 0;                                     ///< between them
};

/// A constant of a .geo script, in the script's units.
struct MeshConstantSpec {
  std::string name;
  double value = 0;
};

/// Volumes or surfaces that get a name: of a geometry file by numbers, label or box
/// (mesh/geometry_choice.hpp); faces of any mesh by a rule (mesh/surfaces/face_rules.hpp).
struct MeshGroupSpec {
  enum class Kind { body, surface };
  std::string name;
  Kind kind = Kind::surface;
  std::vector<int> numbers;
  std::string label;
  std::vector<double> lowest, highest;  ///< corners of a box [m]
  std::string owner;                    ///< the body whose faces are meant
  std::vector<double> normal;           ///< outward, of any length
  double angle = 0;                     ///< between a face's normal and it, at most [rad]
  std::vector<double> plane;            ///< a point of the plane in which the faces lie [m]
  std::vector<double> nearest;          ///< a point [m]: the smooth part of the skin that is nearest to it
  SourceLocation where;
  /// Whether faces of the mesh are chosen, in place of surfaces of the geometry.
  bool by_rule() const { return !owner.empty() || !normal.empty() || !plane.empty() || !nearest.empty(); }
};

/// Sizes of the elements of a body (mesh/making/casting_geometry.hpp).
struct MeshSizeSpec {
  std::string body;                ///< group of the mesh
  double size = 0;                 ///< the largest [m]
  std::optional<double> smallest;  ///< [m]; absent: a quarter of `size`
  double across = 0;               ///< elements through the thickness of a wall, about
  double growth = 0;               ///< of the size for each length away from smaller elements
  SourceLocation where;
};

/// A block of mould around what the geometry holds (mesh/making/casting_geometry.hpp).
struct MouldBlockSpec {
  std::string name;
  std::vector<double> walls;  ///< [m], one, or six: x lowest, x highest, y …, z …
  std::string core;           ///< name of the mould in closed cavities of the parts
  bool bed = false;           ///< with coats: what lies beyond them stays
  SourceLocation where;
};

/// A coat of a shell around what the geometry holds (mesh/making/coats.hpp).
struct MeshCoatSpec {
  std::string name;
  double thickness = 0;  ///< [m]
  SourceLocation where;
};

/// Layers of a body's elements on one of its surfaces (mesh/making/wall_layers.hpp).
struct MeshLayersSpec {
  std::string name;
  std::string surface, body;  ///< groups of the mesh
  int number = 0;
  double growth = 0;            ///< thickness of a layer over that of the one before it
  std::optional<double> first;  ///< thickness of the one on the surface [m]
  SourceLocation where;
};

struct MeshSpec {
  std::optional<std::string> shape, file;   ///< exactly one of them
  std::string unit;                         ///< length unit of the file, "mm"
  std::optional<double> element_size;       ///< for files that are meshed here (.geo, STEP) [m]
  double size_factor = 1;                   ///< on all element sizes of such a file
  int order = 1;                            ///< of the elements, for files that are meshed here
  std::vector<MeshConstantSpec> constants;  ///< for .geo scripts
  std::vector<MeshGroupSpec> groups;        ///< of files that are meshed here
  std::vector<MeshLayersSpec> layers;
  int refine = 0;            ///< how often all edges are halved (mesh/refinement/refine.hpp)
  std::string refined_skin;  ///< "curved" or "flat": where new nodes of the skin lie
  bool conforming = false;   ///< bodies that touch share nodes, of STEP, BREP, IGES
  std::vector<MeshSizeSpec> sizes;
  int way = 0;  ///< of meshing solids and skins: the only one that is tried, from one; 0: one after the other
  std::optional<MouldBlockSpec> mould;
  std::vector<MeshCoatSpec> coats;  ///< from the metal outward
  std::vector<RiserBlockSpec> risers;
  std::vector<GatingBlockSpec> gatings;
  std::vector<ChillBlockSpec> chills;
  std::optional<SymmetrySpec> symmetry;
  /// Run a .geo script without checks. This is never a key of a case file: the user who runs a case decides
  /// whether to trust its scripts, not its author.
  bool trust_script = false;
  /// Known to process 0 once the mesh is loaded (mesh::RawMesh::unsound). This is never a key of a case file.
  std::optional<InputError> unsound;
  std::string element;  ///< of the built-in shapes: "tri3", ...
  std::optional<CylinderInMouldSpec> cylinder_in_mould;
  std::optional<BlockSpec> block;
  std::optional<TwoBlocksSpec> two_blocks;
  SourceLocation where;
};

struct TimeSpec {
  bool steady = false;
  std::optional<double> end, step;  ///< [s]; required unless steady
  enum class Until { end, solid };
  Until until = Until::end;
  bool adaptive = false;
  std::optional<double> min_step, max_step;  ///< [s]
  double growth = 0, cut = 0;
  int easy_iterations = 0;
  coupling::ErrorControl error_control = coupling::ErrorControl::predictor;
  std::optional<double> temperature_error, displacement_error;  ///< local, of a step [K], [m]
  std::optional<double> stress_error;                           ///< local, share of the stress [1]
  std::optional<double> solid_fraction_change, skin_change;     ///< in a step [1]
  SourceLocation where;
};

/// A part of the run with conditions of its own (cases/stage_input.hpp).
struct StageSpec {
  std::string name;
  double duration = 0;         ///< [s]
  std::optional<double> step;  ///< [s]
  std::optional<int> steps;
  std::optional<double> min_step, max_step;  ///< [s]
  SourceLocation where;
};

/// Stages that are run through several times.
struct CycleSpec {
  std::string name;
  std::vector<std::string> stages;
  int repeat = 1;
  /// Change of the temperature from the start to the end of a round, of bodies that stay, that ends them [K].
  std::optional<double> periodic;
  enum class Search { anderson, repetition };
  Search search = Search::anderson;  ///< of the periodic state
  SourceLocation where;
};

/// Role of a body in the foundry. Criteria, solid fraction and summary are of castings and risers.
enum class Role { casting, riser, mould, core, chill, sleeve, die, insulation, gating };

struct BodySpec {
  std::string name;
  std::optional<std::string> group;  ///< of the mesh; absent: as `name`
  std::string material;              ///< name in the library, or a file
  Function initial_temperature;      ///< [K], of position
  std::optional<InitialStressSpec> initial_stress;
  std::optional<Role> role;  ///< absent: deduced (cases/roles.hpp)
  /// automatic: heat where it is no casting and its material has no elastic properties, else all
  enum class ActivePhysics { automatic, all, heat };
  ActivePhysics physics = ActivePhysics::all;
  std::vector<std::string> stages;       ///< in which it is there; empty: all
  std::vector<double> initial_velocity;  ///< [m/s]; empty: at rest
  SourceLocation where;
  const std::string& mesh_group() const { return group ? *group : name; }
};

class SourceLaw;  // source_law.hpp

struct ThermalConditionSpec {
  enum class Kind { temperature, flux, film, radiation, source, exothermic };
  /// Whether it acts in the volume of a body, and its group is one.
  bool in_volume() const { return kind == Kind::source || kind == Kind::exothermic; }
  std::string name, group;
  Kind kind = Kind::temperature;
  // Functions of time, or of position and time.
  Function temperature;  ///< [K]
  Function flux;         ///< into the body [W/m²]
  Function coefficient;  ///< film [W/(m² K)]; or of the surface's temperature
  Function emissivity;   ///< [1]; or of the surface's temperature
  Function ambient;      ///< [K]
  enum class Sees { ambient, enclosure };
  Sees sees = Sees::ambient;             ///< of radiation: what the surface sees besides its surroundings
  std::shared_ptr<const SourceLaw> law;  ///< of a source; gives `power` where the case does not
  Function power;                        ///< [W/m³]
  double heat = 0;                       ///< of what burns [J/m³]
  double ignition = 0;                   ///< [K]
  double duration = 0;                   ///< of burning [s]
  Function factor;                       ///< of flux, coefficient, emissivity or power [1]
  std::vector<std::string> stages;       ///< in which it holds; empty: all
  TimeOrigin clock = TimeOrigin::run;
  SourceLocation where;
};

/// A contact pair; setup/contact_input.hpp makes the contact room's specification of it.
struct ContactSpec {
  std::string name, slave, master;
  std::vector<std::string> surfaces;  ///< both, where the program chooses the slave
  std::array<std::string, 2> sides() const {
    return surfaces.empty() ? std::array{slave, master} : std::array{surfaces[0], surfaces[1]};
  }
  contact::Formulation formulation = contact::Formulation::small_sliding;
  bool smoothing = false;
  enum class Normal { automatic, penalty, augmented_lagrangian, energy_conserving };
  Normal normal = Normal::automatic;
  double penetration_tolerance = 0;
  std::optional<double> penalty;         ///< ε_N [N/m³]; absent: from the factor
  std::optional<double> penalty_factor;  ///< ε_N = factor × E / height of the slave's elements
  double stabilisation = 0;              ///< share of ε_N added to the tangent only
  contact::IntegrationRule integration = contact::IntegrationRule::automatic;
  int gauss_degree = 0;
  std::optional<double> search_distance, touching;  ///< [m]
  bool wet = true;                                  ///< liquid metal is held on the wall by the atmosphere
  double atmosphere = 101325;                       ///< its pressure [Pa]
  std::optional<contact::HeatTransferSpec> heat;    ///< absent: no heat passes
  std::optional<FrictionSpec> friction;             ///< absent: none
  std::optional<WearSpec> wear;
  InterfaceSpec interface;
  std::vector<std::string> stages;  ///< in which it holds; empty: all
  std::string law;                  ///< of an interface: the card of its heat transfer
  SourceLocation where;
};

/// Contacts between bodies whose faces are found by themselves (setup/interfaces.hpp).
struct BodyInterfaceSpec {
  std::string name;
  std::vector<std::string> bodies;                ///< names of two, or "all"
  std::optional<double> distance;                 ///< up to which faces face each other [m]
  std::optional<double> touching;                 ///< as of a contact [m]
  std::string law;                                ///< name of a card of the library; empty: by the pair
  bool wet = true;                                ///< as of a contact
  std::optional<contact::HeatTransferSpec> heat;  ///< in place of the library
  std::optional<FrictionSpec> friction;
  std::vector<std::string> stages;  ///< in which it holds; empty: all
  SourceLocation where;
  bool all() const { return bodies.size() == 1 && bodies[0] == "all"; }
};

/// A tool without a mesh; setup/rigid_surface_input.hpp makes the contact room's surface of it.
struct RigidSurfaceSpec {
  std::string name;
  contact::RigidSurface::Shape shape = contact::RigidSurface::Shape::plane;
  std::vector<double> point;         ///< [m]
  std::vector<double> normal, axis;  ///< any length > 0; axis empty: that of the analysis
  double radius = 0;                 ///< [m]
  bool hollow = false;
  std::optional<Function> ux, uy, uz;   ///< [m] of time
  std::optional<Function> rotation;     ///< [rad] of time
  std::vector<double> rotation_centre;  ///< [m]; empty: `point`
  std::vector<double> rotation_axis;    ///< empty: that of the analysis or of the cylinder
  std::optional<Function> temperature;  ///< [K] of time; absent: it takes no heat
  SourceLocation where;
};

struct MechanicsSpec {
  double tolerance = 0, displacement_tolerance = 0;
  int max_iterations = 0;
  bool line_search = true;
  bool inexact = true;
  double linear_tolerance = 0;
  bool b_bar = true;
  mechanics::Simplices simplices = mechanics::Simplices::automatic;
  mechanics::Stabilisation stabilisation = mechanics::Stabilisation::automatic;
  mechanics::TimeIntegration integration = mechanics::TimeIntegration::backward_euler;
  linear::SolverKind solver = linear::SolverKind::automatic;
};

/// Inertia (mechanics/loads/motion.hpp, setup/dynamics_input.hpp).
struct DynamicsSpec {
  enum class Method { backward_euler, newmark, trapezoidal, generalised_alpha };
  mechanics::MassKind mass = mechanics::MassKind::consistent;
  Method method = Method::backward_euler;
  double gamma = 0, beta = 0;  ///< of Newmark's method
  double spectral_radius = 0;  ///< of generalised-alpha
  SourceLocation where;
};

struct CouplingSpec {
  std::shared_ptr<const coupling::SchemeKind> scheme = coupling::default_scheme();
  /// Form in which deformation enters the heat balance (mechanics/structural_heat.hpp); none: it does not.
  enum class StructuralHeatForm { energy, entropy, literal, temperature, none };
  StructuralHeatForm structural_heating = StructuralHeatForm::energy;
  bool as_printed = false;  ///< the sensible heat in the same form, not as a difference of enthalpies
  std::optional<double> ambient_temperature;  ///< Θ_a of 2.24 [K]; absent: from the conditions
  SourceLocation where;
};

struct ProbeSpec {
  enum class Kind { point, mean, minimum, maximum, integral, difference, global };
  std::string name;
  Kind kind = Kind::point;
  std::string field, component;     ///< component empty: a scalar field
  std::vector<double> point;        ///< [m]
  std::optional<std::string> body;  ///< the body the point belongs to, where bodies touch
  std::string group;                ///< of a mean, minimum, maximum, integral
  std::vector<std::string> of;      ///< two probes: first minus second
  std::string global;               ///< a column of history.csv, without its unit
  double factor = 1;                ///< of a global one
  std::string unit;                 ///< for display
  SourceLocation where;
};

struct ProfileColumnSpec {
  std::string name, field, component, unit;
  SourceLocation where;
};

struct ProfileSpec {
  std::string name, group, length_unit;
  std::vector<ProfileColumnSpec> columns;
  SourceLocation where;
};

struct OutputSpec {
  std::optional<double> every;  ///< [s]
  std::vector<double> times;    ///< [s]
  std::vector<std::string> fields;
  std::optional<int> checkpoint_every;  ///< steps
  std::optional<std::string> folder;
  bool stage_ends = true;               ///< outputs at the end of every stage
  std::map<std::string, bool> formats;  ///< of fields, by their keys (results/output/field_format.hpp)
  std::string length_unit, temperature_unit, stress_unit;  ///< of the printed answers
  SourceLocation where;
};

/// Settings of the criteria that are evaluated on a freezing casting (setup/criteria_input.hpp).
struct CriteriaSpec {
  bool follow = true;
  double evaluation = 0.1, feeding_limit = 0.7;
  std::vector<std::string> feeders;  ///< groups of the mesh
  SourceLocation where;
};

struct CaseSpec {
  std::string title;
  std::vector<std::string> include;  ///< resolved by load_case: empty afterwards
  AnalysisSpec analysis;
  MeshSpec mesh;
  TimeSpec time;  ///< with stages, `end` is that of the last one (resolve_stages)
  std::vector<StageSpec> stages;
  std::vector<CycleSpec> cycles;
  std::vector<BodySpec> bodies;
  std::vector<ThermalConditionSpec> thermal_conditions;
  std::vector<ChannelSpec> channels;        ///< that cool
  std::vector<SourceSpec> sources;          ///< that travel
  std::vector<DepositionSpec> depositions;  ///< bodies that grow
  std::vector<MechanicalConditionSpec> mechanical_conditions;
  std::optional<RotationSpec> rotation;  ///< absent: nothing turns
  std::vector<ContactSpec> contacts;     ///< with those of the interfaces, once the mesh is loaded
  std::vector<BodyInterfaceSpec> interfaces;
  std::vector<RigidSurfaceSpec> rigid_surfaces;
  heat::HeatOptions heat;
  MechanicsSpec mechanics;
  std::optional<DynamicsSpec> dynamics;  ///< absent: no inertia
  CouplingSpec coupling;
  std::vector<ProbeSpec> probes;
  std::vector<ProfileSpec> profiles;
  CriteriaSpec criteria;
  std::vector<DieLifeSpec> die_lives;  ///< bodies whose fatigue, wear or soldering is followed
  std::vector<JetSpec> jets;           ///< thermal_conditions has their films
  std::vector<ShotSleeveSpec> shot_sleeves;
  FeedingSpec feeding;
  GasSpec gas;
  std::optional<FillingSpec> filling;  ///< absent: the mould is full at the start
  OutputSpec output;
  VarySpec vary;
  SpreadSpec spread;

  /// Null where none has this name.
  const RigidSurfaceSpec* rigid_surface(const std::string& name) const {
    for (const RigidSurfaceSpec& s : rigid_surfaces)
      if (s.name == name) return &s;
    return nullptr;
  }
  int dimension() const { return analysis.kind == AnalysisKind::solid ? 3 : 2; }
  bool has_heat() const { return analysis.physics != Physics::mechanics; }
  bool has_mechanics() const { return analysis.physics != Physics::heat; }
  bool coupled() const { return analysis.physics == Physics::thermomechanical; }
  /// Deformation and heat exchange energy: not in one-way coupling, nor in a steady state, where nothing
  /// changes any more.
  bool exchanges_heat() const {
    return coupled() && !time.steady && coupling.structural_heating != CouplingSpec::StructuralHeatForm::none;
  }
  /// Both fields by one iteration.
  bool simultaneous() const {
    return coupled() && !time.steady && coupling.scheme->traits().mapping == mechanics::Mapping::simultaneous;
  }
  /// Heat and mechanics with a mechanical phase that holds entropy. Where they exchange no heat the entropy
  /// is a function of temperature alone, and to hold it is to hold the temperature.
  bool isentropic() const {
    return exchanges_heat() && coupling.scheme->traits().mapping == mechanics::Mapping::isentropic;
  }
};

}  // namespace solidus::cases
