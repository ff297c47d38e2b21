#include "material/cards/card_import.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "material/cards/library.hpp"
#include "material/cards/unit_spelling.hpp"

namespace solidus::material {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::array<fs::path, 1> k_library{fs::path(SOLIDUS_SOURCE_DIR) / "materials"};

struct Row {
  double celsius, solid, enthalpy;  ///< enthalpy in J/g
};

/// An alloy as a Scheil calculation prints it, from the melt down: primary solid with 380 J/g, then a
/// eutectic with 510 J/g whose rest freezes at one temperature.
std::vector<Row> scheil_rows() {
  std::vector<Row> rows;
  const auto solid = [](double t) { return t >= 614 ? 0.0 : 1 - std::pow((660 - t) / 46.0, -1 / 0.87); };
  double h = 1000;
  for (double t = 650; t >= 577; t -= 1) {
    rows.push_back({t, solid(t), h});
    h -= 1.1 + 2e-4 * (t - 577) + 380 * (solid(t - 1) - solid(t)) * (t > 577 ? 1 : 0);
  }
  const double eutectic = rows.back().enthalpy - 510 * (1 - solid(577));
  rows.push_back({577, 1, eutectic});
  for (double t = 576; t >= 500; t -= 1)
    rows.push_back({t, 1, eutectic - 1.15 * (577 - t) + 3e-4 * std::pow(577 - t, 2)});
  return rows;
}

std::string csv(const std::vector<Row>& rows) {
  std::string text =
      "Alloy: Al-7Si\n# by a program\nTemperature [C],Mass fraction of all solid phases,Enthalpy [J/g]\n";
  for (const Row& r : rows) text += fmt::format("{},{},{}\n", r.celsius, r.solid, r.enthalpy);
  return text;
}

ImportedCard imported(const std::string& text, const ImportOptions& options) {
  Material base;
  if (!options.like.empty()) base = find_material(options.like, k_library);
  return import_card(parse_column_table(text, "table.csv"), options, options.like.empty() ? nullptr : &base);
}

/// The card as a run reads it: written, read again, completed by the card that it is like.
Material card_of(const ImportedCard& card) {
  const fs::path file = fs::temp_directory_path() / fmt::format("solidus_import_{}.toml", ::getpid());
  std::ofstream(file) << to_toml(card.document);
  const Material m = load_material(file, k_library);
  fs::remove(file);
  return m;
}

ImportOptions like_a356() {
  ImportOptions options;
  options.like = "aluminium_alsi7mg";
  return options;
}

/// Compares the card with the rows: enthalpies to 1e-6 J/kg, fractions to 1e-12.
void expect_rows(const Material& m, const std::vector<Row>& rows) {
  const EnthalpyCurve h = m.enthalpy();
  const double rho = m.density;
  const Row& coldest = rows.back();
  const double zero = h.lower(coldest.celsius + 273.15) / rho - 1e3 * coldest.enthalpy;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double t = rows[i].celsius + 273.15;
    const bool cold_side = i > 0 && rows[i - 1].celsius == rows[i].celsius;
    const double card = (cold_side ? h.lower(t) : h.upper(t)) / rho;
    EXPECT_NEAR(card - zero, 1e3 * rows[i].enthalpy, 1e-6) << rows[i].celsius;
    const PhaseFraction& f = m.solidification()->fraction;
    EXPECT_NEAR(cold_side ? f.below(t) : f.above(t), rows[i].solid, 1e-12) << rows[i].celsius;
  }
}

TEST(CardImport, GivesTheTablesEnthalpyAndSolidFractionBack) {
  const std::vector<Row> rows = scheil_rows();
  const Material m = card_of(imported(csv(rows), like_a356()));
  expect_rows(m, rows);
  EXPECT_EQ(m.phase_changes.size(), 2u);  // primary solid and eutectic differ in their heats
  EXPECT_NEAR(m.solidification()->latent_heat, 380e3, 10e3);
  EXPECT_GT(m.specific_heat.min_value(), 500);
  EXPECT_LT(m.specific_heat.max_value(), 2000);
  EXPECT_EQ(m.density, find_material("aluminium_alsi7mg", k_library).density);
}

TEST(CardImport, TakesRisingTemperaturesJsonAndLiquidInPerCent) {
  std::vector<Row> rows = scheil_rows();
  std::string t, liquid, h;
  for (auto r = rows.rbegin(); r != rows.rend(); ++r) {
    const char* comma = t.empty() ? "" : ", ";
    t += fmt::format("{}{}", comma, r->celsius + 273.15);
    liquid += fmt::format("{}{}", comma, 100 * (1 - r->solid));
    h += fmt::format("{}{}", comma, 1e3 * r->enthalpy * 0.0271);
  }
  ImportOptions options = like_a356();
  options.molar_mass = 0.0271;
  const Material m = card_of(imported("{\"T [K]\": [" + t + "],\n\"Liquid (wt%)\": [" + liquid +
                                          "],\n\"Enthalpy (J/mol)\": [" + h + "], \"method\": \"scheil\"}",
                                      options));
  const EnthalpyCurve curve = m.enthalpy();
  const double span = (curve.upper(650 + 273.15) - curve.lower(500 + 273.15)) / m.density;
  EXPECT_NEAR(span, 1e3 * (rows.front().enthalpy - rows.back().enthalpy), 1e-6);
  EXPECT_NEAR(m.solid_fraction(600 + 273.15), 1 - std::pow(60 / 46.0, -1 / 0.87), 1e-9);
}

// A pure metal: everything at one temperature, where the specific heat may not jump.
TEST(CardImport, TakesAnIsothermalChange) {
  std::vector<Row> rows;
  for (double t = 700; t >= 661; t -= 3) rows.push_back({t, 0, 500 + 1.18 * (t - 661)});
  rows.push_back({660, 0, 500 - 1.18});
  rows.push_back({660, 1, 500 - 1.18 - 397});
  for (double t = 655; t >= 600; t -= 5) rows.push_back({t, 1, 500 - 1.18 - 397 - 1.25 * (660 - t)});
  const Material m = card_of(imported(csv(rows), like_a356()));
  expect_rows(m, rows);
  EXPECT_EQ(m.phase_changes.size(), 1u);
  EXPECT_NEAR(m.solidification()->latent_heat, 397e3, 1e-3);
}

TEST(CardImport, TakesAllPropertiesOfATableAsJMatProPrintsThem) {
  std::string text =
      "T (C);fraction solid (wt%);Enthalpy (J/g);Density (g/cm^3);Thermal conductivity (W/(m K));"
      "Young's modulus (GPa);Poisson's ratio\n";
  for (double t = 700; t >= 20; t -= 20) {
    const double s = std::clamp((640 - t) / 80, 0.0, 1.0);
    const double density = 2.70 / std::pow(1 + 24e-6 * (t - 20), 3) * (1 - 0.05 * (1 - s));
    text += fmt::format("{};{};{};{};{};{};{}\n", t, 100 * s, 0.9 * t + 2e-4 * t * t + 390 * (1 - s), density,
                        160 - 0.02 * t, s < 1 ? 0.1 : 70 - 0.05 * t, 0.33);
  }
  ImportOptions options;
  options.title = "Test";
  const ImportedCard card = imported(text, options);
  const Material m = card_of(card);
  EXPECT_NEAR(m.density, 2700, 1e-9);
  EXPECT_NEAR(m.conductivity.value(273.15 + 100), 158, 1e-9);
  EXPECT_NEAR(m.young_modulus.value(273.15 + 20), 69e9, 1);
  EXPECT_GT(m.young_modulus.min_value(), 40e9) << "what the melt has is no modulus of a solid";
  EXPECT_NEAR(m.expansion.value(273.15 + 400), 24e-6, 1e-9);
  EXPECT_NEAR(m.expansion_reference, 293.15, 1e-9);
  EXPECT_NEAR(m.solidification()->volume_change, -0.05, 0.003);
  EXPECT_NEAR(m.solidification()->latent_heat, 390e3, 3e3);
}

// pycalphad's Scheil prints temperatures and fractions only, stops at the last of the melt, and writes NaN.
TEST(CardImport, TakesPycalphadsScheil) {
  const std::string text =
      R"({"temperatures": [900, 880, 860, 850, 850], "fraction_solid": [0, 0.2, 0.5, 0.6, 0.998],
    "x_liquid": {"SI": [0.07, 0.08, NaN, 0.1, 0.12]}, "converged": true, "method": "scheil"})";
  EXPECT_THAT(card_of(imported(text, like_a356())).solidification()->latent_heat, 389e3);
  const ImportedCard card = imported(text, like_a356());
  const Material m = card_of(card);
  EXPECT_NEAR(m.solid_fraction(870), 0.35, 1e-12);
  EXPECT_EQ(m.solidification()->fraction.below(850), 1);
  EXPECT_THAT(card.remarks.front(), HasSubstr("the last 0.2 % of melt freeze"));
  ImportOptions alone;
  EXPECT_THROW(imported(text, alone), InputError);
}

// Its graphite belongs to a freezing range that the card no longer has.
TEST(CardImport, NamesThePhaseChangesThatItLeavesBehind) {
  ImportOptions options;
  options.like = "grey_iron";
  const ImportedCard card =
      imported("T [C],fs,H [J/g]\n1300,0,1300\n1200,0,1200\n1140,1,900\n1000,1,800\n", options);
  EXPECT_THAT(card.remarks.front(), HasSubstr("'graphite' of grey_iron is not taken over"));
  EXPECT_EQ(card_of(card).phase_changes.size(), 1u);
}

struct Nonsense {
  const char *what, *with, *message;
};

TEST(CardImport, RefusesNonsenseWithFileAndLine) {
  const std::string good =
      "T [C],fs,Enthalpy [J/g]\n650,0,900\n620,0,870\n600,0.4,700\n577,0.6,580\n577,1,400\n560,1,380\n";
  ASSERT_NO_THROW(imported(good, like_a356()));
  const Nonsense cases[] = {
      {"600,0.4", "600,1.4", "table.csv:4: a solid fraction of 1.4"},
      {"600,0.4", "600,-0.1", "table.csv:4: a solid fraction of -0.1"},
      {"577,0.6,", "577,0.3,", "table.csv:4: the solid fraction 0.4"},
      {"600,0.4,700", "600,0.4,900", "table.csv:3: the enthalpy 870000 J/kg"},
      {"600,0.4", "630,0.4", "table.csv:4: the temperature 903.15 K lies above the one before"},
      {"600,0.4,700", "600,,700", "table.csv:4: 'fs' has no number"},
      {"600,0.4,700", "600,0.4", "table.csv:4: the line has 2 cells, the header has 3"},
      {"T [C]", "T", "the column 'T' has no unit"},
      {"T [C]", "Q [C]", "the table has no column of the temperature"},
      {"[J/g]", "[J/mol]", "is for each mole"},
      {"[J/g]", "[J/s]", "the column 'Enthalpy [J/s]'"},
      {"577,1,400\n560,1,380\n", "", "table.csv:5: the coldest row, 850.15 K, is 40.0 % melt"},
      {"650,0,900\n620,0,870\n", "", "table.csv:2: the hottest row, 873.15 K, is 40.0 % solid"},
      {"577,1,400\n560,1,380", "577,1,579\n560,1,400", "rises by less than the specific heat"},
      {good.c_str(), "T [C],fs\n", "there is no table"},
      {good.c_str(), "{\"T [K]\": [900, 880, \"fs\": 3}", "table.csv:1:26: expected ',' or ']'"},
  };
  for (const Nonsense& one : cases) {
    std::string text = good;
    text.replace(text.find(one.what), std::string(one.what).size(), one.with);
    try {
      imported(text, like_a356());
      ADD_FAILURE() << "accepted: " << one.message;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(one.message));
    }
  }
}

TEST(CardImport, NamesWhatACardStillNeeds) {
  const std::string text = "T [C],fs,Enthalpy [J/g]\n650,0,900\n620,0,870\n577,1,400\n560,1,380\n";
  try {
    imported(text, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("density, conductivity"), HasSubstr("--like")));
  }
  ImportOptions options = like_a356();
  options.columns["enthalpie"] = "Enthalpy";
  EXPECT_THROW(imported(text, options), InputError);
  options.columns = {{"enthalpy", "HM"}};
  try {
    imported(text, options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("there is no column 'HM'"));
  }
  std::string other = text;
  other.replace(other.find("Enthalpy [J/g]"), 14, "HMR");
  options.columns = {{"enthalpy", "HMR:J/g"}};
  EXPECT_NO_THROW(imported(other, options));
}

/// A table as JMatPro or Thermo-Calc would print it: 430 kJ/kg between 557 and 614 degC, 1 J/g/K next to it.
std::string table(const std::string& headers, const std::function<std::string(double, double)>& row) {
  std::string text = headers + "\n";
  for (double t = 700; t >= 25; t -= t > 614 ? 2 : t > 557 ? 1 : 19)
    text += row(t, std::clamp((t - 557) / 57, 0.0, 1.0)) + "\n";
  return text;
}

double heat_of_freezing(const Material& m) {
  double heat = 0;
  for (const PhaseChange& change : m.phase_changes) heat += change.latent_heat;
  return heat;
}

TEST(CardImport, HeadersOfJmatproAreKnown) {
  const std::string text = table(
      "T (C);Phases vol%-LIQUID-1.0(C/s);Density (g/(cm)^3)-TOTAL-1.0(C/s);Average expansion coeff. (10e-6 "
      "1/K)-  "
      "-1.0(C/s);Thermal conductivity (W/(m*K))-TOTAL-1.0(C/s);Young's modulus "
      "(GPa)-TOTAL-1.0(C/s);Poisson's "
      "ratio-TOTAL-1.0(C/s);Enthalpy (J/g)-TOTAL-1.0(C/s);Phases vol%-FCC_A1-1.0(C/s)",
      [](double t, double liquid) {
        return fmt::format("{};{};{};{};{};{};0.33;{};{}", t, 100 * liquid, 2.7 - 2e-4 * t,
                           21 + 0.0045 * (t - 25), 150, 70 - 0.05 * t, t + 430 * liquid, 100 - 100 * liquid);
      });
  const ImportedCard card = imported(text, like_a356());
  const Material m = card_of(card);
  EXPECT_NEAR(heat_of_freezing(m), 430e3, 430);
  EXPECT_NEAR(m.density, 2695, 1);
  EXPECT_NEAR(m.conductivity.value(400), 150, 1e-9);
  EXPECT_THAT(card.remarks,
              ::testing::Contains(AllOf(HasSubstr("columns that are not used"), HasSubstr("FCC_A1"),
                                        ::testing::Not(HasSubstr("Density")))));
}

TEST(CardImport, HeadersOfThermoCalcAreKnown) {
  const std::string text = table(
      "Temperature [C];Mass fraction of all solid phases;Enthalpy per gram of system [J/g];Density of system "
      "[g/cm3];Thermal conductivity of system [W/(m*K)];Viscosity [Pa*s]",
      [](double t, double liquid) {
        return fmt::format("{};{};{};{};{};1", t, 1 - liquid, t + 430 * liquid, 2.7 - 2e-4 * t, 150);
      });
  const ImportedCard card = imported(text, like_a356());
  EXPECT_NEAR(heat_of_freezing(card_of(card)), 430e3, 430);
  EXPECT_NEAR(card_of(card).density, 2695, 1);
  EXPECT_THAT(card.remarks, ::testing::Contains(HasSubstr("not used: 'Viscosity [Pa*s]'")));
}

TEST(CardImport, ASpecificHeatThatHoldsTheHeatOfFreezingIsTakenOnce) {
  const std::string text = table("T [C];fs;Apparent heat capacity [J/(g*K)]", [](double t, double liquid) {
    const bool freezes = liquid > 0 && liquid < 1;
    return fmt::format("{};{};{}", t, 1 - liquid, 1 + (freezes ? 430.0 / 56 : 0.0));
  });
  const ImportedCard card = imported(text, like_a356());
  EXPECT_NEAR(heat_of_freezing(card_of(card)), 430e3, 0.01 * 430e3);
  EXPECT_THAT(card.remarks, ::testing::Contains(HasSubstr("holds the heat of freezing, 430 kJ/kg")));
  ImportOptions given = like_a356();
  given.latent_heat = 400e3;
  const Material m = card_of(imported(text, given));
  EXPECT_NEAR(heat_of_freezing(m), 400e3, 1e-6);
  EXPECT_NEAR(m.specific_heat.value(590 + 273.15), 1000, 1e-6);
}

TEST(CardImport, APlainSpecificHeatKeepsTheLatentHeatOfTheOtherCard) {
  const std::string text = table("T [C];fs;cp [J/gK]", [](double t, double liquid) {
    return fmt::format("{};{};{}", t, 1 - liquid, 0.9 + 0.2 * liquid);
  });
  const Material base = find_material("aluminium_alsi7mg", k_library);
  EXPECT_NEAR(heat_of_freezing(card_of(imported(text, like_a356()))), base.solidification()->latent_heat,
              1e-6);
}

TEST(UnitSpelling, DataSheetsAreRead) {
  const auto in_si = [](const char* unit, const char* expected) {
    return conversion_of_spelling(unit, expected).scale;
  };
  for (const char* unit : {"W/(m*K)", "W/mK", "W/m-K", "W/m K", "W/m.K", "W/m/K", "W m^-1 K^-1", "W m-1 K-1",
                           "W/(m K)", "W/(m.K)", "W/(m·K)", "W/(m °C)", "W/m°C", "W/m·K", "W/(m C)", "W/m⋅K",
                           "W/mC", "W·m⁻¹·K⁻¹", "W/m/degC"})
    EXPECT_DOUBLE_EQ(in_si(unit, "W/m/K"), 1) << unit;
  EXPECT_DOUBLE_EQ(in_si("W/cmK", "W/m/K"), 100);
  EXPECT_DOUBLE_EQ(in_si("mW/mK", "W/m/K"), 1e-3);
  EXPECT_NEAR(in_si("Btu/hr-ft-F", "W/m/K"), 1.730735, 1e-5);
  for (const char* unit :
       {"g/(cm)^3", "g/cm^3", "g/cm3", "g/cm**3", "g cm^-3", "g/cc", "kg/dm3", "t/m3", "g/cm³"})
    EXPECT_NEAR(in_si(unit, "kg/m3"), 1000, 1e-9) << unit;
  for (const char* unit : {"kg/m^3", "kg m-3", "kg/m³", "kg·m⁻³"})
    EXPECT_DOUBLE_EQ(in_si(unit, "kg/m3"), 1) << unit;
  EXPECT_NEAR(in_si("lbm/in^3", "kg/m3"), 27679.9047, 1e-3);
  EXPECT_NEAR(in_si("lb/in3", "kg/m3"), 27679.9047, 1e-3);
  for (const char* unit :
       {"10^6/K", "10^-6/K", "10e-6 1/K", "10e-6/K", "1e-6/K", "1/K x 10^6", "10-6/K", "10-6/C", "10^-6 1/K",
        "ppm/K", "um/m.K", "µm/(m K)", "10^-6 K^-1", "10⁻⁶/K", "x10^-6 1/K", "um/m/K", "um/m-°C", "10^-6/°C"})
    EXPECT_NEAR(in_si(unit, "1/K"), 1e-6, 1e-18) << unit;
  EXPECT_NEAR(in_si("1/K", "1/K"), 1, 1e-15);
  EXPECT_NEAR(in_si("10-6 in/in-F", "1/K"), 1.8e-6, 1e-18);
  for (const char* unit : {"J/g", "kJ/kg", "J g-1", "J/(g)", "MJ/t", "J.g-1"})
    EXPECT_NEAR(in_si(unit, "J/kg"), 1000, 1e-9) << unit;
  EXPECT_NEAR(in_si("J/(g*K)", "J/kg/K"), 1000, 1e-9);
  EXPECT_NEAR(in_si("kJ/kg-K", "J/kg/K"), 1000, 1e-9);
  EXPECT_NEAR(in_si("J/gK", "J/kg/K"), 1000, 1e-9);
  EXPECT_NEAR(in_si("Btu/lb-F", "J/kg/K"), 4186.8, 0.1);
  EXPECT_NEAR(in_si("msi", "Pa"), 6.894757293e9, 10);
  EXPECT_NEAR(in_si("ksi", "Pa"), 6.894757293e6, 0.01);
  EXPECT_NEAR(in_si("N/mm2", "Pa"), 1e6, 1e-6);
  EXPECT_NEAR(in_si("N/mm²", "Pa"), 1e6, 1e-6);
  EXPECT_DOUBLE_EQ(in_si("wt.%", "1"), 0.01);
  EXPECT_NEAR(conversion_of_spelling("F", "K")(32), 273.15, 1e-9);
  EXPECT_NEAR(conversion_of_spelling("°F", "K")(212), 373.15, 1e-9);
  EXPECT_NEAR(conversion_of_spelling("R", "K")(491.67), 273.15, 1e-9);
  EXPECT_NEAR(conversion_of_spelling("°C", "K")(20), 293.15, 1e-9);
  std::string mole = "J/(mol K)";
  EXPECT_TRUE(take_mole(mole));
  EXPECT_NEAR(in_si(mole.c_str(), "J/K"), 1, 1e-15);
}

TEST(UnitSpelling, OthersAreToldWithAnExample) {
  for (const char* unit : {"W/m2", "furlongs", "kg", "J/s"}) try {
      conversion_of_spelling(unit, "W/m/K");
      ADD_FAILURE() << unit;
    } catch (const std::invalid_argument& e) {
      EXPECT_THAT(std::string(e.what()), AllOf(HasSubstr(unit), HasSubstr("45 W/m/K")));
    }
}

}  // namespace
}  // namespace solidus::material
