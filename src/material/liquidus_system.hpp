/// A corner of a phase diagram as straight lines, and how an alloy of it freezes by Scheil's equation or the
/// lever rule: `solidus materials scheil` (docs/theory/solidification_path.md).
///
/// The primary solid: T = T_m + Σ m_i c_i with the concentrations c_i of the melt in weight per cent. Without
/// diffusion in the solid (Scheil) c_i = c_i0 f_L^(k_i − 1), with all of it (lever rule) c_i = c_i0/(f_L +
/// k_i (1 − f_L)). It gives way to the primary solid and a second phase together where T has fallen to a line
/// T = T_e + Σ n_j c_j of the other solutes; of what freezes there the share w is the primary solid, which
/// alone takes up the others. At the last eutectic the rest freezes at one temperature.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "input/keys.hpp"

namespace solidus::material {

struct LiquidusSystem {
  struct Solute {
    std::string name, source;
    double slope = 0;      ///< m of the liquidus [K per weight per cent]
    double partition = 0;  ///< k
    double up_to = 0;      ///< concentration to which the line is meant [weight per cent]
    SourceLocation where;
  };
  struct Slope {
    std::string name;
    double slope = 0;      ///< n [K per weight per cent]
    double partition = 0;  ///< k between the primary solid and the melt in the valley; 0: as elsewhere
    SourceLocation where;
  };
  struct Eutectic {
    std::string solute, source;
    double temperature = 0;    ///< T_e of the binary [K]
    double solvent_share = 0;  ///< w, mass fraction of the primary solid in the freezing metal
    std::vector<Slope> other;
    SourceLocation where;
  };
  struct Last {
    std::vector<std::string> solutes;
    std::string source;
    double temperature = 0;  ///< [K]
    SourceLocation where;
  };
  std::string title, solvent, source;
  double melting_point = 0;  ///< T_m of the solvent [K]
  std::vector<Solute> solutes;
  std::vector<Eutectic> eutectics;
  std::vector<Last> last;
  SourceLocation where;
};

/// The declaration of the keys of a file.
const Section<LiquidusSystem>& liquidus_section();

/// Reads and checks a file. Throws InputError with the place.
LiquidusSystem load_liquidus_system(const std::filesystem::path& file);

/// The system of a solvent in the folders `liquidus` of the material library. Throws InputError with the
/// solvents that there are.
LiquidusSystem find_liquidus_system(const std::string& solvent,
                                    std::span<const std::filesystem::path> library);

/// An alloy as "Al-9Si-3Cu-0.3Mg": the solvent, then weight per cent and name of each solute.
struct Composition {
  std::string solvent;
  std::vector<std::pair<std::string, double>> solutes;  ///< name, weight per cent
};
/// Throws InputError when the text is of another form, or the solutes are more than a half.
Composition parse_composition(const std::string& text);

enum class SolidificationRule { scheil, lever_rule };

struct SolidificationPath {
  std::vector<std::pair<double, double>>
      points;                        ///< temperature [K], rising, and solid fraction, falling from 1
  double liquidus = 0;               ///< [K]
  double primary_fraction = 0;       ///< solid fraction where the primary solid alone ends
  double primary_end = 0;            ///< temperature there [K]
  double end = 0;                    ///< temperature of the last melt [K]
  double last_fraction = 0;          ///< fraction that freezes at that temperature
  std::vector<std::string> remarks;  ///< solutes beyond their lines, without a line in the valley
};

/// @param tolerance  how far the chords between the points may be from the curve, in solid fraction
/// Throws InputError for a solute that the system does not have.
SolidificationPath solidification_path(const LiquidusSystem& system, const Composition& alloy,
                                       SolidificationRule rule, double tolerance);

}  // namespace solidus::material
