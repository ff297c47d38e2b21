/// A formula that the user wrote, "3000 * (z < 0.1)", parsed once and evaluated often; muParser behind it.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace solidus {

/// Arithmetic, comparisons (1 or 0), `&&`, `||`, `condition ? a : b`, the functions of functions(), the
/// constants `pi` and `e`, and names. Numbers have no units: what they mean is up to the caller. One formula
/// serves one thread.
class Formula {
 public:
  using Constants = std::map<std::string, double>;

  /// @param variables  names whose values come with each evaluation
  /// @param constants  names with a value
  /// Throws std::invalid_argument with the place in the text for anything but a formula of one value whose
  /// names are known.
  Formula(std::string text, const std::vector<std::string>& variables, const Constants& constants = {});
  ~Formula();

  /// Whether the formula depends on the variable of this number in the list of the constructor.
  bool uses(std::size_t variable) const { return uses_[variable] != 0; }
  const std::string& text() const { return text_; }

  /// The value for one value of every variable, in the order of the constructor; not finite where the formula
  /// is not defined (0/0, sqrt(-1)).
  double value(std::span<const double> variables) const;

  /// The comparisons in the formula, "x > 0.1" in "3e6 * (x > 0.1) * (t < 5)", each as a formula of the same
  /// variables whose value is 1 or 0: where one of them changes the formula may jump or bend.
  std::vector<std::unique_ptr<const Formula>> comparisons() const;

  /// "sin, cos, ...": the functions there are.
  static std::vector<std::string> functions();
  /// Whether a constant may have this name: a letter, then letters, digits and underscores; none of a
  /// function.
  static bool is_name(const std::string& text);

 private:
  struct Parser;
  std::string text_;
  std::vector<std::string> variables_;
  Constants constants_;
  std::vector<char> uses_;
  std::unique_ptr<Parser> parser_;
};

}  // namespace solidus
