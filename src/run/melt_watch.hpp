/// Warns once where a melt has flowed so far that it has run out: nothing holds it at its sides or below.
#pragma once

#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "coupling/observer.hpp"
#include "setup/assembly.hpp"

namespace solidus::run {

/// The advice for melt that flows without end.
inline constexpr const char* k_melt_remedy =
    "does a mould, a support or a plane of symmetry hold it on all sides but the upper one?";

/// A melt that neither a mould nor a support holds on all sides is driven out by its weight, and goes on with
/// every step. Such a case has no answer, only a step that does not converge or results that mean nothing.
/// Melt that moves within the box of its body has not run out: the surface of a riser that feeds its casting
/// sinks to a funnel of half its height or more.
class MeltWatch final : public coupling::Observer {
 public:
  struct Box {
    mesh::Point low, high;  ///< [m]
    double diagonal() const;
    /// Distance to the nearest place of the box [m]; zero: the place is within.
    double distance_outside(const mesh::Point& place) const;
  };

  /// @param a  with phases.coherency; must outlive this object
  MeltWatch(const cases::CaseSpec& spec, const setup::Assembly& a);
  void begin(const coupling::State&) override {}
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State&) override {}
  void end(const coupling::State&) override {}

  /// Says which melt has run out, how far, and since when; empty: none has.
  const std::string& ran_out() const { return ran_out_; }

 private:
  const cases::CaseSpec& spec_;
  const setup::Assembly& a_;
  std::vector<int> body_;   ///< [owned node]: the body that its first element belongs to
  std::vector<Box> boxes_;  ///< [body] as drawn, over all processes
  std::string ran_out_;
};

}  // namespace solidus::run
