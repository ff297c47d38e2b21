/// Histories of contact points in a checkpoint: a table per pair, by the points' numbers.
#pragma once

#include "contact/points/contact_state.hpp"
#include "results/checkpoint/checkpoint_tables.hpp"

namespace solidus::results {

/// Every point once, by the process that counts it. Collective.
void write_contacts(TableWriter& out, const std::vector<contact::ContactState>& contacts);
/// Fills the points that this process holds; `contacts` have their sizes and numbers. Collective.
void take_contacts(TableReader& in, std::vector<contact::ContactState>& contacts);

}  // namespace solidus::results
