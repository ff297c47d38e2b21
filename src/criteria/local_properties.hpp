/// Strength, elongation, hardness and grain size by where the metal froze, of the tables [[local]] of the
/// cards (material/local_law.hpp, docs/theory/local_properties.md).
///
/// Each place takes thickness, arm spacing or cooling rate of the criteria of freezing (freezing.hpp), and of
/// them the values that were measured on castings. Where a table ends, or a place has not frozen, there is
/// no value. Followed are bodies whose card has such tables, in runs that compute heat.
#pragma once

#include <memory>
#include <vector>

#include "criteria/criterion.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/freezing.hpp"

namespace solidus::criteria {

class LocalProperties : public Criterion {
 public:
  /// Null where no body that is followed has a table.
  static std::unique_ptr<LocalProperties> make(const CriterionContext& context);
  explicit LocalProperties(const CriterionContext& context);

  CriterionRecord initial(const CriterionInput& start) const override;
  CriterionRecord restart(const CriterionRecord& before, const CriterionInput& start) const override;
  void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) override;
  std::span<const quantities::Quantity* const> fields() const override { return fields_; }
  void fill(const CriterionInput& now, const CriterionRecord& record,
            std::span<const std::span<double>> values) const override;
  /// Least, mean and largest value of each property in each body that has it: "hardness_in_casting_min".
  std::vector<CriterionResult> findings(const CriterionRecord& record) const override;
  void know_plates(std::span<const PlateTimes> plates) override { freezing_.know_plates(plates); }

 private:
  /// A node of a body with tables.
  struct Node {
    Index node;
    int body;     ///< with tables, of which it holds most
    double room;  ///< of it [m³]; zero at ghosts
  };
  /// [field][local node]; the mark for no value where there is none.
  std::vector<std::vector<double>> values(const CriterionInput& now, const CriterionRecord& record) const;

  const mesh::Mesh& mesh_;
  std::vector<std::vector<material::LocalLaw>> laws_;  ///< [body]
  std::vector<std::string> names_;                     ///< in the case, [body]
  Freezing freezing_;                                  ///< of these bodies alone
  std::vector<Node> nodes_;                            ///< owned
  std::vector<const quantities::Quantity*> fields_;    ///< those that some card has
  std::vector<std::size_t> which_;                     ///< their numbers in k_of_local_properties
  parallel::GhostExchange ghosts_;
};

}  // namespace solidus::criteria
