/// Watches the walls of cooling channels and warns once for each that water boils there.
///
/// The films of channels know no boiling: beyond the boiling point nucleate boiling takes more heat than they
/// say, and where it turns to film boiling much less.
#pragma once

#include <vector>

#include "cases/case_spec.hpp"
#include "coupling/observer.hpp"

namespace solidus::run {

class ChannelWatch : public coupling::Observer {
 public:
  /// @param spec  kept by reference
  explicit ChannelWatch(const cases::CaseSpec& spec) : spec_(spec), warned_(spec.channels.size(), 0) {}
  void begin(const coupling::State&) override {}
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State&) override {}
  void end(const coupling::State&) override {}

 private:
  const cases::CaseSpec& spec_;
  std::vector<char> warned_;  ///< [channel]
};

}  // namespace solidus::run
